#pragma once

#include <optional>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// What fairing sees of a mesh of which only a region moves.
struct ActiveSubmesh {
  PolygonMesh mesh;
  Constraints constraints;
  std::vector<Index> node;  ///< number in the whole mesh of every node, ascending
};

/// Cuts out the faces that touch a moving node or a neighbour of one by a face, so that these have all their faces.
/// Nothing where more than half of the mesh moves, or constraints are not as many as nodes. Cost: linear, a few passes
/// over flags.
std::optional<ActiveSubmesh> active_submesh(const PolygonMesh& mesh, const Constraints& constraints);

/// What constraints say of some nodes, in that order.
Constraints constraints_of(const Constraints& constraints, const std::vector<Index>& nodes);

}  // namespace vspring
