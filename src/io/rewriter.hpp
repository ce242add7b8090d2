#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Appends the shortest text that reads back as the same number.
void append_number(std::string& text, double value);
void append_number(std::string& text, float value);

/// Appends the first `count` numbers of a vector.
void append_numbers(std::string& text, const Vector3& vector, int count = 3, char between = ' ');
/// Appends a whole number.
void append_whole(std::string& text, std::size_t number);

/// A number to stand in place of a word. column: of the word, counted from the beginning of its row.
struct NewNumber {
  int column;
  double value;
  bool single = false;  ///< written in single precision
};

/// The numbers of a row that begins with three coordinates or components.
inline std::array<NewNumber, 3> row_of(const Vector3& vector) {
  return {{{0, vector.x()}, {1, vector.y()}, {2, vector.z()}}};
}

/// Copies bytes and puts numbers in the place of words. Places have to ascend.
class TextRewriter {
 public:
  /// commented: # ends a word, and what follows it on its line is passed over.
  explicit TextRewriter(std::string_view bytes, bool commented = false);

  /// row: offset of the first word of a row; a row may go over line ends. numbers: ascending in column.
  void replace_words(std::size_t row, std::span<const NewNumber> numbers);
  void replace(std::size_t begin, std::size_t end, std::string_view text);
  /// The rest as it is; the rewriter is spent.
  [[nodiscard]] std::string finish();

 private:
  /// Of what stands between words here; 0 where a word or the end of the bytes is.
  [[nodiscard]] std::size_t gap_at(std::size_t at) const;

  std::string_view bytes_;
  char comment_end_ = '\0';  ///< where comments are passed over
  std::string text_;
  std::size_t copied_ = 0;
};

/// What stands in the line of a row behind its first `words`, up to a comment, without blanks around it.
[[nodiscard]] std::string_view behind_words(std::string_view bytes, std::size_t row, int words);
/// How the lines of a text end: as the first one does.
[[nodiscard]] std::string_view line_ending(std::string_view bytes);
/// A line end where text does not end with one.
[[nodiscard]] std::string_view missing_line_end(std::string_view text);

/// Marks the nodes whose position is not the one in `before`, to the bit, and those that `before` has not. Throws
/// Error(invalid_argument) for one that moved to nowhere.
std::vector<std::uint8_t> moved_nodes(const std::vector<Vector3>& before, const std::vector<Vector3>& positions);

}  // namespace vspring
