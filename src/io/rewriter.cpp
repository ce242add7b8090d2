#include "io/rewriter.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <utility>

#include "io/text_cursor.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

template <typename Number>
void append_shortest(std::string& text, Number value) {
  char buffer[40];
  const char* const end = fmt::format_to(buffer, FMT_COMPILE("{}"), value);
  text.append(buffer, static_cast<std::size_t>(end - buffer));
}

bool same_bits(const Vector3& a, const Vector3& b) {
  using Bits = std::array<std::uint64_t, 3>;
  return Eigen::numext::bit_cast<Bits>(std::array{a.x(), a.y(), a.z()}) ==
         Eigen::numext::bit_cast<Bits>(std::array{b.x(), b.y(), b.z()});
}

}  // namespace

void append_number(std::string& text, double value) { append_shortest(text, value); }
void append_number(std::string& text, float value) { append_shortest(text, value); }

void append_numbers(std::string& text, const Vector3& vector, int count, char between) {
  for (int k = 0; k < count; ++k) {
    if (k > 0) text += between;
    append_number(text, vector[k]);
  }
}

void append_whole(std::string& text, std::size_t number) {
  const fmt::format_int digits(number);
  text.append(digits.data(), digits.size());
}

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

std::string_view behind_words(std::string_view bytes, std::size_t row, int words) {
  std::string_view line = bytes.substr(row);
  line = line.substr(0, std::min(line.find_first_of("#\n\r\\"), line.size()));
  for (; words > 0; --words) {
    const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
    line.remove_prefix(std::min(line.find_first_of(" \t", begin), line.size()));
  }
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
  return line;
}

std::string_view line_ending(std::string_view bytes) {
  const std::size_t end = bytes.find_first_of("\r\n");
  if (end == std::string_view::npos || bytes[end] == '\n') return "\n";
  return bytes.substr(end, 2) == "\r\n" ? "\r\n" : "\r";
}

std::string_view missing_line_end(std::string_view text) {
  return text.ends_with('\n') || text.ends_with('\r') ? "" : line_ending(text);
}

std::vector<std::uint8_t> moved_nodes(const std::vector<Vector3>& before, const std::vector<Vector3>& positions) {
  std::vector<std::uint8_t> moved(positions.size(), 0);
  for (std::size_t node = 0; node < positions.size(); ++node) {
    if (node < before.size() && same_bits(before[node], positions[node])) continue;
    moved[node] = 1;
    if (!positions[node].allFinite())
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("node {}: its position is not finite; only a position that was read so may be", node));
  }
  return moved;
}

}  // namespace vspring
