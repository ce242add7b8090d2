#pragma once

#include <optional>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// The part of a mesh that takes part in fairing if only a region moves.
struct ActiveSubmesh {
  PolygonMesh mesh;
  Constraints constraints;
  std::vector<Index> node;  ///< the number in the whole mesh of every node, ascending
};

/// Cuts out the faces that touch a moving node or a node that shares a face with one, so these nodes have all their
/// faces. Nothing if more than half of the mesh moves, or constraints are not as many as nodes. Cost: linear, a few
/// passes over flags.
std::optional<ActiveSubmesh> active_submesh(const PolygonMesh& mesh, const Constraints& constraints);

/// The constraints of some nodes, in that order.
Constraints constraints_of(const Constraints& constraints, const std::vector<Index>& nodes);

}  // namespace vspring
