#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "io/text_cursor.hpp"

namespace vspring {

/// A line of a file of rows.
struct TableLine {
  enum class Kind { blank, comment, row };

  std::string_view text;  ///< without its end and the blanks there
  std::size_t offset;
  Kind kind;
};

/// The line that begins at an offset, and the offset behind it. A comment begins with #; a row of nothing but blanks
/// and delimiters, as spreadsheets write it, is blank. Lines end with LF, CR LF, or CR where `line_end` says so.
TableLine line_at(std::string_view bytes, std::size_t offset, char line_end);

/// LF, or CR in files that have no LF.
char line_end_of(std::string_view bytes);

/// Calls use(line) for the lines of a file, without a byte order mark, until it returns false.
template <typename Use>
void walk_lines(std::string_view bytes, const Use& use) {
  const char line_end = line_end_of(bytes);
  for (std::size_t at = byte_order_mark_length(bytes); at < bytes.size();) {
    if (!use(line_at(bytes, at, line_end))) return;
    at = std::min(bytes.find(line_end, at), bytes.size() - 1) + 1;
  }
}

/// All lines of a file, without a byte order mark.
std::vector<TableLine> table_lines(std::string_view bytes);

/// Cuts rows into cells.
class CellCutter {
 public:
  /// delimiter: what stands between two cells; a blank stands for any run of blanks. quotes: a cell may stand in
  /// quotes, and delimiters in them.
  CellCutter(char delimiter, bool quotes) : delimiter_(delimiter), quotes_(quotes) {}

  /// The cells of a row, without the blanks and quotes around them; valid until the next call.
  const std::vector<std::string_view>& cut(std::string_view row);
  [[nodiscard]] bool cuts_at_blanks() const { return delimiter_ == ' '; }

 private:
  [[nodiscard]] std::size_t cell_end(std::string_view row, std::size_t begin) const;
  [[nodiscard]] bool is_delimiter(char c) const;

  char delimiter_;
  bool quotes_;
  std::vector<std::string_view> cells_;
};

/// The number that a cell is, if it is one; "nan" and "inf" are.
std::optional<double> number_of(std::string_view cell);

/// Whether a cell is a number but for a comma in the place of its point.
bool has_decimal_comma(std::string_view cell);

}  // namespace vspring
