#include "io/text_rewriter.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

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

TextRewriter::TextRewriter(std::string_view bytes) : bytes_(bytes) {
  // Fair positions have more digits than most files give.
  text_.reserve(bytes.size() + bytes.size() / 2);
}

void TextRewriter::replace_words(std::size_t row, std::span<const NewNumber> numbers) {
  const char* const end = bytes_.data() + bytes_.size();
  const char* at = bytes_.data() + row;
  const auto offset = [&] { return static_cast<std::size_t>(at - bytes_.data()); };
  int column = 0;
  for (const NewNumber& number : numbers) {
    for (;; ++column) {
      for (std::size_t length = 0; at != end; at += length) {
        length = is_space(*at) ? 1 : continuation_length(at, end);
        if (length == 0) break;
      }
      const std::size_t begin = offset();
      while (at != end && !is_space(*at) && continuation_length(at, end) == 0) ++at;
      if (column < number.column) continue;
      text_.append(bytes_, copied_, begin - copied_);
      copied_ = offset();
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
