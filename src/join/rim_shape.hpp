#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// How a surface is at a node: its tangent plane, and how it bends.
struct RimShape {
  Vector3 normal = Vector3::Zero();  ///< of unit length, in the sense of the faces
  /// The second fundamental form: the surface leaves its tangent plane by d·form·d/2 along the normal, d the way there.
  Eigen::Matrix3d form = Eigen::Matrix3d::Zero();
};

/// How the surface is at held nodes, by what is held around them alone: by a polynomial of third degree, fitted to the
/// nodes of two to eight rings of faces without a moving node. None where there are too few, or they are off that by
/// more than noise, as at a sharp edge.
///
/// nodes: those that are asked for. moves: one entry per node. Of noise of a tenth of an edge some 0.004 is left in
/// curvatures times edges; on smooth surfaces their error is of second order. Cost: linear in the nodes asked for, some
/// tens of microseconds each.
std::vector<std::optional<RimShape>> rim_shapes(const PolygonMesh& mesh, const std::vector<std::uint8_t>& moves,
                                                const std::vector<Index>& nodes);

}  // namespace vspring
