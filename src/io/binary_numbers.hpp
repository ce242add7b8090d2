#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cmath>
#include <string>

#include "vspring/error.hpp"

namespace vspring {

// Eigen's bit_cast: some C++20 libraries, such as Emscripten's, lack std::bit_cast.

/// A number at an address that need not be aligned. swapped: whether its byte order is not this machine's.
template <typename Number>
Number load(const char* from, bool swapped) {
  std::array<char, sizeof(Number)> bytes;
  for (std::size_t k = 0; k < sizeof(Number); ++k) bytes[k] = from[swapped ? sizeof(Number) - 1 - k : k];
  return Eigen::numext::bit_cast<Number>(bytes);
}

template <typename Number>
void store(char* to, Number number, bool swapped) {
  const auto bytes = Eigen::numext::bit_cast<std::array<char, sizeof(Number)>>(number);
  for (std::size_t k = 0; k < sizeof(Number); ++k) to[k] = bytes[swapped ? sizeof(Number) - 1 - k : k];
}

/// Whether numbers in this order have to be swapped on this machine.
constexpr bool swapped_here(std::endian order) { return order != std::endian::native; }

/// The same for little-endian numbers, as in binary STL and new files.
inline constexpr bool little_swapped = swapped_here(std::endian::little);

/// Appends a number, by default in little-endian order.
template <typename Number>
void append_bytes(std::string& bytes, Number number, bool swapped = little_swapped) {
  std::array<char, sizeof(Number)> room;
  store(room.data(), number, swapped);
  bytes.append(room.data(), room.size());
}

/// A value rounded to single precision, infinite beyond its range.
inline double as_single(double value) {
  // volatile forces the rounding: where it vectorises, g++ 12 drops a cast to float and back.
  const volatile float single = static_cast<float>(value);
  return single;
}

/// A coordinate of a node in single precision. Throws Error(invalid_argument) beyond its range.
inline float single(double value, std::size_t node) {
  const auto narrow = static_cast<float>(value);
  if (std::isfinite(value) && !std::isfinite(narrow))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("node {}: {} does not fit single precision; write another format", node, value));
  return narrow;
}

}  // namespace vspring
