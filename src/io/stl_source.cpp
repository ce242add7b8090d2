#include "io/stl_source.hpp"

#include <Eigen/Geometry>
#include <array>

#include "io/byte_order.hpp"
#include "io/file_normals.hpp"
#include "io/single.hpp"
#include "io/text_rewriter.hpp"

namespace vspring {

std::size_t stl::promised_size(std::string_view bytes) {
  if (bytes.size() < facets_begin) return 0;
  return facets_begin + facet_size * std::size_t{load<std::uint32_t>(bytes.data() + header_size, little_swapped)};
}

Vector3 stl::facet_normal(const Vector3& a, const Vector3& b, const Vector3& c) {
  return unit_or_zero(unit_or_zero(b - a).cross(unit_or_zero(c - a)));
}

std::string StlSource::rewritten(Rewrite& rewrite) const {
  return rows.empty() ? rewritten_binary(rewrite) : rewritten_text(rewrite);
}

std::string StlSource::rewritten_text(const Rewrite& rewrite) const {
  // Words of a facet: three of the normal, `outer loop`, and four for each `vertex` line.
  constexpr std::array<int, 3> columns = {6, 10, 14};
  TextRewriter out(file.bytes);
  std::vector<NewNumber> numbers;
  for (std::size_t facet = 0; facet < rows.size(); ++facet) {
    numbers.clear();
    std::array<Vector3, 3> corners;
    for (int c = 0; c < 3; ++c) {
      const Index node = corner_nodes[3 * facet + c];
      corners[c] = rewrite.positions[node];
      if (rewrite.moved[node] == 0) continue;
      for (int k = 0; k < 3; ++k) numbers.push_back({columns[c] + k, corners[c][k]});
    }
    if (numbers.empty()) continue;
    const Vector3 normal = stl::facet_normal(corners[0], corners[1], corners[2]);
    numbers.insert(numbers.begin(), {{0, normal.x()}, {1, normal.y()}, {2, normal.z()}});
    out.replace_words(rows[facet], numbers);
  }
  return out.finish();
}

std::string StlSource::rewritten_binary(const Rewrite& rewrite) const {
  std::string out = file.bytes;
  for (std::size_t facet = 0; 3 * facet < corner_nodes.size(); ++facet) {
    char* const record = out.data() + stl::facets_begin + facet * stl::facet_size;
    const auto put = [&](std::size_t vector, const Vector3& value, Index node) {
      for (std::size_t k = 0; k < 3; ++k)
        store(record + 12 * vector + 4 * k, single(value[k], static_cast<std::size_t>(node)), little_swapped);
    };
    std::array<Vector3, 3> corners;
    bool any_moved = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const Index node = corner_nodes[3 * facet + c];
      corners[c] = rewrite.positions[node];
      if (rewrite.moved[node] == 0) continue;
      put(c + 1, corners[c], node);
      any_moved = true;
    }
    if (any_moved) put(0, stl::facet_normal(corners[0], corners[1], corners[2]), 0);
  }
  return out;
}

}  // namespace vspring
