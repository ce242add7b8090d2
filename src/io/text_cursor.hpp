#pragma once

#include <cstdint>
#include <string_view>

#include "io/input_file.hpp"

namespace vspring {

/// White space of every text format here, line ends included.
constexpr bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// The length of a backslash and the line end after it, which OBJ reads as a blank; else 0.
inline std::size_t continuation_length(const char* p, const char* end) {
  if (p == end || *p != '\\' || p + 1 == end) return 0;
  if (p[1] == '\n') return 2;
  if (p[1] != '\r') return 0;
  return p + 2 != end && p[2] == '\n' ? 3 : 2;
}

/// The length of the mark that some programs put before UTF-8 text; 0 if there is none.
constexpr std::size_t byte_order_mark_length(std::string_view bytes) {
  return bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0;
}

/// Reads a number as far as it goes and returns its end, or null if none begins here. "nan" and "inf" are numbers too.
const char* parse_number(const char* begin, const char* end, double& value, char decimal_mark = '.');

/// Walks the words and lines of a file. Numbers mean the same in every locale.
class TextCursor {
 public:
  /// continued: a backslash before a line end joins the next line to this one. commented: # ends a word.
  explicit TextCursor(const InputFile& file, std::size_t begin = 0, bool continued = false, bool commented = false);

  [[nodiscard]] std::size_t offset() const { return static_cast<std::size_t>(at_ - file_->bytes.data()); }
  [[nodiscard]] std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
  [[nodiscard]] bool at_end() const { return at_ == end_; }
  [[nodiscard]] bool at_line_end() const { return at_ == end_ || *at_ == line_end_; }
  /// The next character, or 0 at the end.
  [[nodiscard]] char peek() const { return at_ == end_ ? '\0' : *at_; }
  void skip(std::size_t count) { at_ += count; }

  /// Skips blanks, not line ends.
  void skip_blanks() {
    for (;;) {
      if (at_ != end_ && *at_ != line_end_ && is_space(*at_)) {
        ++at_;
      } else if (const std::size_t length = continued_ ? continuation_length(at_, end_) : 0; length > 0) {
        at_ += length;
      } else {
        return;
      }
    }
  }
  /// Skips blanks and line ends.
  void skip_space() {
    for (skip_blanks(); at_ != end_ && *at_ == line_end_; skip_blanks()) ++at_;
  }
  /// Goes to the end of this line, over joined lines.
  void skip_to_line_end();
  /// Goes to the next line end, even one after a backslash, as at the end of a comment.
  void skip_comment();

  /// Reads up to the end of a word; empty at white space and at the end.
  [[nodiscard]] std::string_view word();
  [[nodiscard]] bool at_word_end() const {
    return at_ == end_ || is_space(*at_) || (continued_ && continuation_length(at_, end_) > 0) ||
           (commented_ && *at_ == '#');
  }

  /// Reads a number, up to the end of a word. what: its name in messages.
  [[nodiscard]] double number(const char* what);
  /// Reads a whole number, with or without a sign; it may begin a longer word.
  [[nodiscard]] std::int64_t integer(const char* what);
  /// Reads a word that is a whole number.
  [[nodiscard]] std::int64_t whole_word(const char* what);

  [[nodiscard]] const InputFile& file() const { return *file_; }
  [[noreturn]] void refuse(std::string_view what) const { file_->refuse_line(offset(), what); }
  /// Throws: says that `what` is expected here, and what is here.
  [[noreturn]] void refuse_word(const char* what) const;

 private:
  const InputFile* file_;
  const char* at_;
  const char* end_;
  bool continued_;
  bool commented_;
  char line_end_;
};

}  // namespace vspring
