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

/// A number that replaces a word. column: of the word, counted from the beginning of its row.
struct NewNumber {
  int column;
  double value;
  bool single = false;  ///< written in single precision
};

/// The numbers of a row that begins with three coordinates or components.
inline std::array<NewNumber, 3> row_of(const Vector3& vector) {
  return {{{0, vector.x()}, {1, vector.y()}, {2, vector.z()}}};
}

/// Copies bytes and replaces words by numbers. Places must ascend.
class TextRewriter {
 public:
  /// commented: # ends a word, and the rest of its line is skipped.
  explicit TextRewriter(std::string_view bytes, bool commented = false);

  /// row: offset of the first word of a row; a row may go over line ends. numbers: ascending in column.
  void replace_words(std::size_t row, std::span<const NewNumber> numbers);
  void replace(std::size_t begin, std::size_t end, std::string_view text);
  /// Appends the rest unchanged and returns all; the rewriter is spent.
  [[nodiscard]] std::string finish();

 private:
  /// The length of the gap between words here; 0 at a word or the end of the bytes.
  [[nodiscard]] std::size_t gap_at(std::size_t at) const;

  std::string_view bytes_;
  char comment_end_ = '\0';  ///< set if comments are skipped
  std::string text_;
  std::size_t copied_ = 0;
};

/// The rest of a row's line after its first `words`, up to a comment, trimmed.
[[nodiscard]] std::string_view behind_words(std::string_view bytes, std::size_t row, int words);
/// The line ending of a text: that of its first line.
[[nodiscard]] std::string_view line_ending(std::string_view bytes);
/// A line end if the text does not end with one, else nothing.
[[nodiscard]] std::string_view missing_line_end(std::string_view text);

/// Marks the nodes whose position differs in a bit from that in `before`, and those beyond `before`. Throws
/// Error(invalid_argument) for one whose new position is not finite.
std::vector<std::uint8_t> moved_nodes(const std::vector<Vector3>& before, const std::vector<Vector3>& positions);

}  // namespace vspring
