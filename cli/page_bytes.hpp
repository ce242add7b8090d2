#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vspring/types.hpp"

namespace vspring::cli {

// Numbers as base64 of little-endian bytes, as small as the page allows. page/data.js reads them.

[[nodiscard]] std::string base64(std::span<const unsigned char> bytes);

/// Decodes bytes; empty if a character is not one of base64.
[[nodiscard]] std::optional<std::string> from_base64(std::string_view text);

/// Coordinates, −½ to ½, with 24 bits each: on a mesh with 1,000 nodes along its side, angles between neighbouring
/// faces err by 0.01°, which neither reflection lines nor histograms show; 16 bits would be visible.
[[nodiscard]] std::string encode_coordinates(std::span<const Vector3> points);

/// Coordinates in double precision, for curves: curvature is a second difference.
[[nodiscard]] std::string encode_doubles(std::span<const Vector3> points);

/// Values in half precision, clamped to its range. They must be finite.
[[nodiscard]] std::string encode_halves(std::span<const double> values);

/// Node numbers of faces or chains, mostly near the one before: a byte or two each.
class RunEncoder {
 public:
  /// length: of every run, which is then not stored; 0: they differ.
  explicit RunEncoder(std::size_t length = 0) : length_(length) {}
  void add(std::span<const Index> nodes);
  [[nodiscard]] std::string take() const { return base64(bytes_); }

 private:
  void number(std::uint64_t value);

  std::size_t length_;
  std::vector<unsigned char> bytes_;
  std::int64_t last_ = 0;
};

}  // namespace vspring::cli
