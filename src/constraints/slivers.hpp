#pragma once

#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Faces of a mesh that are hardly more than their longest edge. They have no normal, so a held node on that edge would
/// have no normal, and the surface faired next to it would swell.
class Slivers {
 public:
  /// Cost: linear. If there are none, later calls cost hardly anything.
  explicit Slivers(const PolygonMesh& mesh);

  /// The same shape without slivers of held nodes: the face across a sliver's longest edge gets the nodes in between.
  /// Two nodes, which are no face, replace the sliver, so all faces keep their numbers. A copy of the mesh if nothing
  /// changes.
  [[nodiscard]] PolygonMesh left_out(const Constraints& constraints) const;

 private:
  PolygonMesh mesh_;
  std::vector<Index> faces_;
};

}  // namespace vspring
