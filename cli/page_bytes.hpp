#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vspring/types.hpp"

namespace vspring::cli {

// Numbers as base64 of little-endian bytes, as small as a page can do with. page/data.js reads them.

[[nodiscard]] std::string base64(std::span<const unsigned char> bytes);

/// The bytes back; empty where a character is none of base64.
[[nodiscard]] std::optional<std::string> from_base64(std::string_view text);

/// Coordinates, −½ to ½, with 24 bits each: an angle between neighbouring faces of a mesh with 1,000 nodes along its
/// side is off by 0.01°, which neither reflection lines nor histograms show; 16 bits would be seen.
[[nodiscard]] std::string encode_coordinates(std::span<const Vector3> points);

/// The same in double precision: curvature is a second difference.
[[nodiscard]] std::string encode_doubles(std::span<const Vector3> points);

/// In half precision, what is beyond its range at the end of it. Values are finite.
[[nodiscard]] std::string encode_halves(std::span<const double> values);

/// Node numbers of faces or chains, mostly near the one before: a byte or two each.
class RunEncoder {
 public:
  /// length: of every run, which is then not said again; 0 where they differ.
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
