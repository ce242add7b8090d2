#include "page_bytes.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>

namespace vspring::cli {

namespace {

void append(std::vector<unsigned char>& bytes, std::uint64_t value, int count) {
  for (int k = 0; k < count; ++k) bytes.push_back(static_cast<unsigned char>(value >> (8 * k) & 0xFFU));
}

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string base64(std::span<const unsigned char> bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - k);
    unsigned group = 0;
    for (std::size_t i = 0; i < 3; ++i) group = group << 8 | (i < left ? bytes[k + i] : 0U);
    for (std::size_t i = 0; i < 4; ++i) text += i <= left ? digits[group >> (18 - 6 * i) & 63U] : '=';
  }
  return text;
}

std::optional<std::string> from_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  unsigned group = 0;
  int bits = 0;
  while (text.ends_with('=')) text.remove_suffix(1);
  for (const char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string_view::npos) return std::nullopt;
    group = (group << 6 | static_cast<unsigned>(digit)) & 0xFFFFU;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 0xFFU);
  }
  return bytes;
}

std::string encode_coordinates(std::span<const Vector3> points) {
  constexpr double most = 0xFFFFFF;
  std::vector<unsigned char> bytes;
  bytes.reserve(9 * points.size());
  for (const Vector3& point : points) {
    for (const double part : point)
      append(bytes, static_cast<std::uint64_t>(std::clamp(std::round((part + 0.5) * most), 0.0, most)), 3);
  }
  return base64(bytes);
}

std::string encode_doubles(std::span<const Vector3> points) {
  std::vector<unsigned char> bytes;
  bytes.reserve(24 * points.size());
  for (const Vector3& point : points) {
    for (const double part : point) append(bytes, std::bit_cast<std::uint64_t>(part), 8);
  }
  return base64(bytes);
}

std::string encode_halves(std::span<const double> values) {
  constexpr double most = 65504;
  std::vector<unsigned char> bytes;
  bytes.reserve(2 * values.size());
  for (const double value : values)
    append(bytes, Eigen::numext::bit_cast<std::uint16_t>(Eigen::half(std::clamp(value, -most, most))), 2);
  return base64(bytes);
}

void RunEncoder::number(std::uint64_t value) {
  for (; value >= 128; value >>= 7) bytes_.push_back(static_cast<unsigned char>((value & 127U) | 128U));
  bytes_.push_back(static_cast<unsigned char>(value));
}

void RunEncoder::add(std::span<const Index> nodes) {
  if (length_ == 0) number(nodes.size());
  for (const Index node : nodes) {
    const std::int64_t step = static_cast<std::int64_t>(node) - last_;
    number(step < 0 ? static_cast<std::uint64_t>(-step) * 2 - 1 : static_cast<std::uint64_t>(step) * 2);
    last_ = node;
  }
}

}  // namespace vspring::cli
