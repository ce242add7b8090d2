#include "shape/corners.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "shape/direction.hpp"
#include "vspring/error.hpp"

namespace vspring {

std::vector<Index> find_corners(const PolygonCurve& curve, double angle) {
  if (!(angle > 0 && angle < 180))
    throw Error(
        ErrorCode::invalid_argument,
        fmt::format("corners turn by more than an angle of more than 0 and less than 180 degrees, not {}", angle));
  std::vector<Index> corners;
  for (const auto& chain : curve.chains()) {
    // One of several nodes at the same place.
    std::vector<Index> nodes;
    for (const Index node : chain.nodes) {
      if (nodes.empty() || curve.position(nodes.back()) != curve.position(node)) nodes.push_back(node);
    }
    while (chain.closed && nodes.size() > 1 && curve.position(nodes.back()) == curve.position(nodes.front()))
      nodes.pop_back();
    const std::size_t count = nodes.size();
    const std::size_t ends = chain.closed ? 0 : 1;
    for (std::size_t k = ends; k + ends < count && count > 2; ++k) {
      const Vector3& here = curve.position(nodes[k]);
      const Vector3 before = here - curve.position(nodes[(k + count - 1) % count]);
      const Vector3 after = curve.position(nodes[(k + 1) % count]) - here;
      // By unit vectors, as squares of lengths may overflow.
      if (degrees_between(before.stableNormalized(), after.stableNormalized()) > angle) corners.push_back(nodes[k]);
    }
  }
  return corners;
}

std::vector<std::uint8_t> marked_corners(std::span<const Index> corners, Index node_count) {
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(node_count), 0);
  for (const Index node : corners) {
    if (node < 0 || node >= node_count)
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("corner {}: there is no such node, there are {}", node, node_count));
    marks[static_cast<std::size_t>(node)] = 1;
  }
  return marks;
}

PolygonCurve cut_at_corners(const PolygonCurve& curve, std::span<const std::uint8_t> corners) {
  const auto is_corner = [&](Index node) { return corners[static_cast<std::size_t>(node)] != 0; };
  std::vector<PolygonCurve::Chain> chains;
  for (const auto& chain : curve.chains()) {
    std::vector<Index> nodes = chain.nodes;
    const auto first = std::find_if(nodes.begin(), nodes.end(), is_corner);
    if (first == nodes.end()) {
      chains.push_back(chain);
      continue;
    }
    if (chain.closed) {
      std::rotate(nodes.begin(), first, nodes.end());
      nodes.push_back(nodes.front());
    }
    PolygonCurve::Chain side;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      side.nodes.push_back(nodes[k]);
      if (k == 0 || k + 1 == nodes.size() || !is_corner(nodes[k])) continue;
      chains.push_back(std::exchange(side, {}));
      side.nodes.push_back(nodes[k]);
    }
    chains.push_back(std::move(side));
  }
  return {curve.positions(), std::move(chains)};
}

}  // namespace vspring
