#pragma once

#include <string_view>
#include <vector>

#include "io/surface_source.hpp"

namespace vspring {

/// Binary STL: 80 bytes of any text, the number of facets, then for each twelve floats (normal, corners) and two bytes
/// for attributes; all little-endian.
namespace stl {
constexpr std::size_t header_size = 80;
constexpr std::size_t facets_begin = 84;
constexpr std::size_t facet_size = 50;
/// Bytes of a binary file, by the number of facets that it promises; 0 where it is too short to promise any.
std::size_t promised_size(std::string_view bytes);
/// The unit normal of a triangle, zero for one without area.
Vector3 facet_normal(const Vector3& a, const Vector3& b, const Vector3& c);
}  // namespace stl

/// An STL file: where its facets are and which node each of their corners is.
class StlSource : public SurfaceSource {
 public:
  [[nodiscard]] std::string rewritten(Rewrite& rewrite) const override;

  std::vector<Index> corner_nodes;  ///< three per facet, those that are no faces among them
  std::vector<std::size_t> rows;    ///< text: offset of the first number of each facet's normal

 private:
  [[nodiscard]] std::string rewritten_text(const Rewrite& rewrite) const;
  [[nodiscard]] std::string rewritten_binary(const Rewrite& rewrite) const;
};

}  // namespace vspring
