#pragma once

#include <Eigen/Geometry>
#include <span>
#include <utility>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// The finite nodes of faces, ascending, and the box around them.
struct FaceNodes {
  explicit FaceNodes(const PolygonMesh& mesh);

  /// A share of the diagonal of the box, as a length. Throws Error(invalid_argument) if the share is negative or not
  /// finite.
  [[nodiscard]] double length(double share) const;

  std::vector<Index> nodes;
  Eigen::AlignedBox<double, 3> box;
};

/// Which nodes are near enough to each other to be joined.
struct CoincidentNodes {
  std::vector<Index> first;         ///< per node the least number in its group
  std::pair<Index, Index> chained;  ///< two nodes of a chain that leads too far, and then `first` means nothing; else
                                    ///< −1
};

/// Groups nodes at most `tolerance`, a length, apart, and chains of such nodes, unless a chain leads further than twice
/// that along an axis. A tolerance below 1e-16 of the box counts as 0.
///
/// positions: one per node. nodes: those to group; their positions must be finite. box: around them. The groups do not
/// depend on the order. Cost: n log n.
CoincidentNodes coincident_nodes(std::span<const Vector3> positions, std::vector<Index> nodes,
                                 const Eigen::AlignedBox<double, 3>& box, double tolerance);

}  // namespace vspring
