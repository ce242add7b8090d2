#pragma once

#include <vector>

#include "shape/frame.hpp"
#include "spring/rings.hpp"
#include "vspring/constraints.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// The part of a shape that takes part in fairing, in coordinates and an order of its own: all that the sweep and the
/// solvers see.
///
/// Local nodes: first those that move, numbered so that neighbours lie close in memory; then held nodes whose normal is
/// computed; then all other nodes that a moving node looks at. Coordinates are centred and scaled by a power of two to
/// a box of about 1.
struct Net {
  std::vector<Vector3> positions;
  std::vector<Vector3> normals;  ///< unit, or zero where there is none
  std::size_t moving = 0;        ///< nodes 0 … moving − 1 move
  std::size_t computed = 0;      ///< nodes 0 … computed − 1 have rings; normals are computed where not fixed
  std::vector<std::uint8_t> normal_fixed;  ///< for the nodes with rings
  Rings rings;
  std::vector<Index> node;  ///< number in the mesh of every local node
  Frame frame;
  double tiny = 0;  ///< see node_force()
};

/// Gathers the net of a mesh under constraints. The mesh must have passed check_constraints(). Cost: linear in the
/// mesh, once, and in the moving nodes.
Net gather_net(const PolygonMesh& mesh, const Constraints& constraints);

/// The mesh's positions with those of the net in place: moving nodes go the share `strength` of their way, fixed nodes
/// are exactly where the constraints say, all others untouched.
std::vector<Vector3> scatter_positions(const Net& net, const PolygonMesh& mesh, const Constraints& constraints,
                                       double strength);

}  // namespace vspring
