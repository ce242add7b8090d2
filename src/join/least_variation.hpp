#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/threads.hpp"
#include "join/rim_shape.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// A node that does not move, of a face with one that does.
struct RimNode {
  Index node = 0;
  Vector3 normal = Vector3::Zero();     ///< that the surface is to have there; zero: any
  std::optional<Eigen::Matrix3d> form;  ///< the second fundamental form that it is to have (RimShape); none: any
};

struct LeastVariationTask {
  const PolygonMesh* mesh = nullptr;   ///< in coordinates of about size 1, from where the nodes go
  std::vector<std::uint8_t> moves;     ///< one entry per node
  std::vector<RimNode> rim;            ///< all of them
  double tolerance = 1e-5;             ///< expected largest distance of a node from its final place
  double most_step = 1;                ///< of one node; what asks for more leads nowhere
  std::function<void(int)> on_step{};  ///< called after every step
};

struct LeastVariation {
  std::vector<Vector3> positions;  ///< of all nodes
  bool converged = false;
  int steps = 0;
  double expected_error = 0;
};

/// Takes a surface to where the change of its mean curvature is least, ∫ |∇H|² dA, between a rim where its place, its
/// tangent plane and its second fundamental form are given: one order more than springs, whose lengths change evenly
/// (ΔH = 0), have; there Δ²H = 0. So it has the curvature of what is around, and normal curvatures leave the rim
/// without a jump.
///
/// ∇H at a node is that of a polynomial of third degree, in which second degrees go by whole distances, so that spheres
/// have none on any mesh: h = p u + q v + H r²/2 + a (u² − v²)/2 + b u v + third degree, fitted to 2 h/r² of the nodes
/// of one ring of faces or more. A rim node has p = q = 0, and where its form is known that. What heights are off this
/// counts, too. Steps of Gauss and Newton along normals, on a sparse factor. Cost of each: that of the factor, about
/// n^1.5 for n moving nodes. Throws Cancelled.
LeastVariation least_variation(const LeastVariationTask& task, ThreadTeam& team);

}  // namespace vspring
