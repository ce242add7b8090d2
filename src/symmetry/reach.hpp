#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "vspring/symmetry.hpp"

namespace vspring {

/// Calls use(a, b) for the edges of a surface, those between two faces twice, or of a curve. Faces of fewer than three
/// nodes have none.
template <typename Use>
void for_each_edge(const PolygonMesh& mesh, const Use& use) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (face.size() < 3) continue;
    for (std::size_t k = 0; k < face.size(); ++k) use(face[k], face[k + 1 < face.size() ? k + 1 : 0]);
  }
}
template <typename Use>
void for_each_edge(const PolygonCurve& curve, const Use& use) {
  for (const PolygonCurve::Chain& chain : curve.chains()) {
    for (std::size_t k = 0; k + 1 < chain.nodes.size(); ++k) use(chain.nodes[k], chain.nodes[k + 1]);
    if (chain.closed && chain.nodes.size() > 1) use(chain.nodes.back(), chain.nodes.front());
  }
}

/// How far from the exact mirror image of a node that of a whole may be: half the mean length of its edges. One entry
/// per node; 0 without edges.
template <typename Shape>
std::vector<double> pair_tolerances(const Shape& shape) {
  constexpr double share_of_edges = 0.5;
  std::vector<double> sum(shape.positions().size(), 0);
  std::vector<double> count(sum.size(), 0);
  for_each_edge(shape, [&](Index a, Index b) {
    const double length = (shape.position(a) - shape.position(b)).norm();
    for (const Index node : {a, b}) {
      sum[static_cast<std::size_t>(node)] += length;
      count[static_cast<std::size_t>(node)] += 1;
    }
  });
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = count[i] > 0 ? share_of_edges * sum[i] / count[i] : 0;
  return sum;
}

/// How a shape lies to the plane.
struct Reach {
  /// Throws Error(unusable_shape) for a shape without an edge, and for a node of one that is not finite.
  template <typename Shape>
  Reach(const Shape& shape, const MirrorPlane& plane) {
    has_edge.assign(shape.positions().size(), 0);
    for_each_edge(shape, [&](Index a, Index b) {
      has_edge[static_cast<std::size_t>(a)] = 1;
      has_edge[static_cast<std::size_t>(b)] = 1;
    });
    measure(shape.positions(), plane);
  }

  /// Whether a node is on the plane, as those of halves have to be.
  [[nodiscard]] bool on_plane(Index node) const {
    const auto i = static_cast<std::size_t>(node);
    return has_edge[i] != 0 && std::abs(distance[i]) <= tolerance;
  }

  /// Whether the shape is a half, or else a whole. Throws Error(unusable_shape) for neither.
  [[nodiscard]] bool is_half(const MirrorPlane& plane) const;

  std::vector<std::uint8_t> has_edge;  ///< 1 for nodes with an edge
  std::vector<double> distance;        ///< from the plane; 0 for others
  double tolerance = 0;
  Index nearest = -1;
  std::array<Index, 2> furthest = {-1, -1};  ///< before and behind the plane; −1: none is there

 private:
  void measure(const std::vector<Vector3>& positions, const MirrorPlane& plane);
  [[nodiscard]] double depth(std::size_t side) const {
    return furthest[side] < 0 ? 0 : std::abs(distance[static_cast<std::size_t>(furthest[side])]);
  }
};

/// "the plane x = 0", or "the plane" without a name.
std::string in_words(const MirrorPlane& plane);

/// Nodes of halves no further from the plane than this share of the diagonal of the box around nodes with an edge are
/// on it.
constexpr double share_on_plane = 1e-6;

/// That distance.
template <typename Shape>
double nearness_on_plane(const Symmetric<Shape>& shape) {
  Eigen::AlignedBox<double, 3> box;
  for (Index i = 0; i < shape.given.node_count(); ++i) {
    if (shape.partner[static_cast<std::size_t>(i)] >= 0) box.extend(shape.given.position(i));
  }
  return share_on_plane * box.diagonal().norm();
}

}  // namespace vspring
