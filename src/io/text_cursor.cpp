#include "io/text_cursor.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <charconv>
#include <cstring>
#include <system_error>

#include "base/message_text.hpp"

namespace vspring {

const char* parse_number(const char* begin, const char* end, double& value, char decimal_mark) {
  if (end - begin > 1 && *begin == '+' && begin[1] != '-') ++begin;
  const fast_float::parse_options options(fast_float::chars_format::general, decimal_mark);
  const auto [stop, fault] = fast_float::from_chars_advanced(begin, end, value, options);
  return fault == std::errc() || fault == std::errc::result_out_of_range ? stop : nullptr;
}

TextCursor::TextCursor(const InputFile& file, std::size_t begin, bool continued, bool commented)
    : file_(&file),
      at_(file.bytes.data() + begin),
      end_(file.bytes.data() + file.bytes.size()),
      continued_(continued),
      commented_(commented),
      // Lines end with LF, or with CR in files that have no LF; in CR LF the CR is a blank.
      line_end_(file.bytes.find('\n') == std::string::npos ? '\r' : '\n') {}

void TextCursor::skip_comment() {
  const void* end = std::memchr(at_, line_end_, bytes_left());
  at_ = end == nullptr ? end_ : static_cast<const char*>(end);
}

void TextCursor::skip_to_line_end() {
  const char* begin = at_;
  for (skip_comment(); continued_ && at_ != end_; skip_comment()) {
    const char* back = at_;
    if (back != begin && back[-1] == '\r') --back;
    if (back == begin || back[-1] != '\\') return;
    begin = ++at_;
  }
}

std::string_view TextCursor::word() {
  const char* begin = at_;
  while (!at_word_end()) ++at_;
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

double TextCursor::number(const char* what) {
  double value = 0;
  const char* const stop = parse_number(at_, end_, value);
  if (stop == nullptr) refuse_word(what);
  const char* const start = at_;
  at_ = stop;
  if (at_word_end()) return value;
  at_ = start;
  refuse_word(what);
}

std::int64_t TextCursor::integer(const char* what) {
  const char* begin = at_;
  if (end_ - begin > 1 && *begin == '+' && begin[1] != '-') ++begin;
  std::int64_t value = 0;
  const auto [stop, fault] = std::from_chars(begin, end_, value);
  if (fault != std::errc()) refuse_word(what);
  at_ = stop;
  return value;
}

std::int64_t TextCursor::whole_word(const char* what) {
  const char* const start = at_;
  const std::int64_t value = integer(what);
  if (at_word_end()) return value;
  at_ = start;
  refuse_word(what);
}

void TextCursor::refuse_word(const char* what) const {
  TextCursor ahead(*this);
  const std::string_view word = ahead.word();
  if (!word.empty()) refuse(fmt::format("{} stands where {} belongs; repair the line", in_quotes(word), what));
  if (at_end()) refuse(fmt::format("the file ends where {} belongs; it is cut off", what));
  refuse(fmt::format("the line ends where {} belongs; repair the line", what));
}

}  // namespace vspring
