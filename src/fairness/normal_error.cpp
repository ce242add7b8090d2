#include "fairness/normal_error.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/degrees.hpp"
#include "fairness/counted.hpp"

namespace vspring {

namespace {

/// Between two lines, 0 to π/2: the sense of a normal does not matter.
double angle_between_lines(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

void include(std::optional<double>& greatest, double angle) {
  greatest = std::max(greatest.value_or(0), degrees_per_radian * angle);
}

/// The curve on one side of a node.
struct Side {
  bool moves = false;
  Vector3 tangent = Vector3::Zero();  ///< away from the node; zero if there is none
};

/// Of the circle through the node and the next two: exact on circles, of second order elsewhere.
Side side_of(const PolygonCurve& curve, const PolygonCurve::Chain& chain, std::size_t place, int step,
             const Constraints& constraints) {
  const auto count = static_cast<std::ptrdiff_t>(chain.nodes.size());
  const auto next = [&](int steps) -> Index {
    std::ptrdiff_t k = static_cast<std::ptrdiff_t>(place) + static_cast<std::ptrdiff_t>(steps) * step;
    if (chain.closed) k = ((k % count) + count) % count;
    return k < 0 || k >= count ? -1 : chain.nodes[static_cast<std::size_t>(k)];
  };
  Side side;
  const Index first = next(1);
  if (first < 0) return side;
  const Vector3& centre = curve.position(chain.nodes[place]);
  const Vector3 e1 = curve.position(first) - centre;
  // Scaled by the first edge, so that squares neither overflow nor vanish.
  const double unit = e1.stableNorm();
  if (!std::isfinite(unit) || !(unit > 0)) return side;
  side.moves = !constraints.position_fixed(first);
  side.tangent = e1 / unit;
  const Index second = next(2);
  if (second < 0) return side;
  const Vector3 e2 = (curve.position(second) - centre) / unit;
  if (!e2.allFinite() || e2.isZero(0)) return side;
  const Vector3 sum = side.tangent - e2 / e2.dot(e2);
  if (sum.allFinite() && !sum.isZero(0)) side.tangent = sum.normalized();
  return side;
}

}  // namespace

std::optional<double> normal_error(const PolygonMesh& mesh, const Constraints& constraints) {
  const auto faces = counted_faces(mesh, &constraints);
  const auto counted = counted_nodes(mesh, faces);
  std::vector<Index> nodes;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (counted[static_cast<std::size_t>(i)] != 0 && constraints.normal_fixed(i)) nodes.push_back(i);
  }
  if (nodes.empty()) return std::nullopt;
  const auto normals = estimate_normals(mesh, nodes, faces);
  std::optional<double> greatest;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!normals[k].isZero(0)) include(greatest, angle_between_lines(normals[k], constraints.normal(nodes[k])));
  }
  return greatest;
}

std::optional<double> normal_error(const PolygonCurve& curve, const Constraints& constraints) {
  std::optional<double> greatest;
  for (const auto& chain : curve.chains()) {
    for (std::size_t k = 0; k < chain.nodes.size(); ++k) {
      const Index node = chain.nodes[k];
      for (const int step : {1, -1}) {
        const NodeSide where = step > 0 ? NodeSide::after : NodeSide::before;
        if (!constraints.tangent_fixed(node, where) && !constraints.normal_fixed(node)) continue;
        const Side side = side_of(curve, chain, k, step, constraints);
        if (side.tangent.isZero(0) || (!side.moves && constraints.position_fixed(node))) continue;
        if (constraints.tangent_fixed(node, where)) {
          const Vector3 given = step * constraints.tangent(node, where);
          include(greatest, std::atan2(given.cross(side.tangent).norm(), given.dot(side.tangent)));
        } else {
          include(greatest, std::numbers::pi / 2 - angle_between_lines(constraints.normal(node), side.tangent));
        }
      }
    }
  }
  return greatest;
}

}  // namespace vspring
