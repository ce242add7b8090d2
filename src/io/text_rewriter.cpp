#include "io/text_rewriter.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/text_cursor.hpp"

namespace vspring {
namespace {

template <typename Number>
void append_shortest(std::string& text, Number value) {
  char buffer[40];
  const char* const end = fmt::format_to(buffer, FMT_COMPILE("{}"), value);
  text.append(buffer, static_cast<std::size_t>(end - buffer));
}

}  // namespace

void append_number(std::string& text, double value) { append_shortest(text, value); }
void append_number(std::string& text, float value) { append_shortest(text, value); }

TextRewriter::TextRewriter(std::string_view bytes, bool commented) : bytes_(bytes) {
  // Fair positions have more digits than most files give.
  text_.reserve(bytes.size() + bytes.size() / 2);
  if (commented) comment_end_ = bytes.find('\n') == std::string_view::npos ? '\r' : '\n';
}

std::size_t TextRewriter::gap_at(std::size_t at) const {
  if (at == bytes_.size()) return 0;
  if (is_space(bytes_[at])) return 1;
  if (comment_end_ != '\0' && bytes_[at] == '#') return std::min(bytes_.find(comment_end_, at), bytes_.size()) - at;
  return continuation_length(bytes_.data() + at, bytes_.data() + bytes_.size());
}

void TextRewriter::replace_words(std::size_t row, std::span<const NewNumber> numbers) {
  std::size_t at = row;
  int column = 0;
  for (const NewNumber& number : numbers) {
    for (;; ++column) {
      while (const std::size_t gap = gap_at(at)) at += gap;
      const std::size_t begin = at;
      while (at != bytes_.size() && gap_at(at) == 0) ++at;
      if (column < number.column) continue;
      text_.append(bytes_, copied_, begin - copied_);
      copied_ = at;
      if (number.single)
        append_number(text_, static_cast<float>(number.value));
      else
        append_number(text_, number.value);
      ++column;
      break;
    }
  }
}

void TextRewriter::replace(std::size_t begin, std::size_t end, std::string_view text) {
  text_.append(bytes_, copied_, begin - copied_);
  text_.append(text);
  copied_ = end;
}

std::string TextRewriter::finish() {
  text_.append(bytes_, copied_, bytes_.size() - copied_);
  return std::move(text_);
}

}  // namespace vspring
