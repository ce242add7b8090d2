#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/surface_formats.hpp"

namespace vspring {

// Binary STL: 80 bytes of any text, the number of facets, then for each twelve floats (normal, corners) and two bytes
// for attributes; all little-endian.
inline constexpr std::size_t stl_header_size = 80;
inline constexpr std::size_t stl_facets_begin = 84;
inline constexpr std::size_t stl_facet_size = 50;

/// Whether a word of an STL file is `wanted`, in small letters, whatever its case.
inline bool same_word(std::string_view word, std::string_view wanted) {
  return std::equal(word.begin(), word.end(), wanted.begin(), wanted.end(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

/// An STL file: where its facets are and which node each of their corners is.
class StlSource : public SurfaceSource {
 public:
  [[nodiscard]] std::string rewritten(Rewrite& rewrite) const override;
  [[nodiscard]] SurfaceFile refined(const RefinedMesh& refined) const override;
  [[nodiscard]] bool has_single_precision() const override { return rows.empty(); }

  std::vector<Index> corner_nodes;  ///< three per facet, also of facets that are no faces
  std::vector<std::size_t> rows;    ///< text: offset of the first number of each facet's normal

 private:
  /// The corners of added facets.
  [[nodiscard]] static std::vector<std::array<Vector3, 3>> added_facets(const Rewrite& rewrite);
  [[nodiscard]] std::string rewritten_text(const Rewrite& rewrite) const;
  [[nodiscard]] std::string rewritten_binary(const Rewrite& rewrite) const;
  /// Where facet `facet` begins and ends in the file; in text, from its keyword on.
  [[nodiscard]] std::pair<std::size_t, std::size_t> place_of(std::size_t facet) const;
  /// One triangle, in the place of `facet`.
  [[nodiscard]] std::string facet_bytes(std::size_t facet, std::span<const Index> nodes,
                                        const std::vector<Vector3>& positions) const;
};

}  // namespace vspring
