#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "spring/net.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Where a point stands over a surface, to first order in moves of nodes along their normals.
struct HeightOverFace {
  std::array<std::uint32_t, 3> nodes = {};  ///< of the nearest triangle, in the net
  std::array<double, 3> rise = {};          ///< of the surface for a move of 1 of each; 0 for held nodes
  double height = 0;                        ///< of the surface over the point
};

/// Measures how far scattered points are from the faces around their nodes. From the tangent plane of its node alone a
/// point beside a tip would be far away even if it lies on the surface.
class FaceTies {
 public:
  /// net: of this mesh, its points tied; must outlive this object. Cost: linear.
  FaceTies(const PolygonMesh& mesh, const Net& net);

  /// Of a point of the net, tied to this moving node whose normal is known. If the point was moved since, as to draw
  /// the surface beyond it, the height is that over its new place. Cost: that of the faces around the node.
  [[nodiscard]] HeightOverFace of(std::size_t node, std::uint32_t point) const;

 private:
  const Net* net_;
  std::vector<Vector3> places_;  ///< of the points as they were given
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  // For each node of the net those of the faces around it.
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> around_;
};

}  // namespace vspring
