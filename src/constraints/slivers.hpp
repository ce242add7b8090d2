#pragma once

#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Faces of a mesh that are next to nothing but their longest edge. They have no normal, so a held node in the middle
/// of one would not know what it lies on, and what is faired beside it would swell.
class Slivers {
 public:
  /// Cost: linear. What is asked for later costs next to nothing where there are none.
  explicit Slivers(const PolygonMesh& mesh);

  /// The same shape, in which slivers of held nodes are left out: faces across their longest edges have the nodes in
  /// between, too. In place of a sliver there are two nodes, which are no face, so that all faces keep their numbers.
  /// Shares all with the mesh where none changes.
  [[nodiscard]] PolygonMesh left_out(const Constraints& constraints) const;

 private:
  PolygonMesh mesh_;
  std::vector<Index> faces_;
};

}  // namespace vspring
