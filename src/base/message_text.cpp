#include "base/message_text.hpp"

#include <algorithm>

namespace vspring {

std::string in_quotes(std::string_view bytes) {
  constexpr std::size_t longest = 24;
  std::string result = "'";
  for (const char c : bytes.substr(0, longest)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (bytes.size() > longest ? "…'" : "'");
}

std::string in_one_line(std::string_view text, std::size_t longest) {
  std::size_t end = text.size();
  if (end > longest) {
    end = longest;
    // Keeps characters of UTF-8 whole: continuation bytes begin with the bits 10.
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  }
  std::string result;
  for (const char c : text.substr(0, end)) {
    const auto byte = static_cast<unsigned char>(c);
    result += byte < 0x20U || byte == 0x7FU ? '?' : c;
  }
  return result + (end < text.size() ? "…" : "");
}

std::string nodes_in_words(std::span<const Index> nodes) {
  constexpr std::size_t most = 5;
  std::string text = nodes.size() == 1 ? "node" : "nodes";
  for (std::size_t k = 0; k < std::min(nodes.size(), most); ++k)
    text += (k == 0 ? " " : ", ") + std::to_string(nodes[k]);
  return text + (nodes.size() > most ? " and " + std::to_string(nodes.size() - most) + " more" : "");
}

}  // namespace vspring
