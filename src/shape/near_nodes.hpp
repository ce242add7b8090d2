#pragma once

#include <Eigen/Geometry>
#include <span>
#include <utility>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// The nodes of faces, ascending, without those that are not finite, and the box around them.
struct FaceNodes {
  explicit FaceNodes(const PolygonMesh& mesh);

  /// A share of the diagonal of the box, as a length. Throws Error(invalid_argument) where it is negative or not
  /// finite.
  [[nodiscard]] double length(double share) const;

  std::vector<Index> nodes;
  Eigen::AlignedBox<double, 3> box;
};

/// Which nodes are so near to each other that they may be taken for one.
struct NearNodes {
  std::vector<Index> first;  ///< of every node the least number of those that are one with it, its own among them
  std::pair<Index, Index> chained;  ///< two nodes of a chain that leads too far, else −1; `first` is then of no use
};

/// Makes one what is no further apart than `tolerance`, a length, and what hangs together so, unless a chain leads
/// further than twice that along an axis. Lengths of less than 1e-16 of the box count as 0.
///
/// positions: one per node. nodes: those that are looked at; their positions must be finite. box: around them. The
/// groups do not depend on the order. Cost: n log n.
NearNodes near_nodes(std::span<const Vector3> positions, std::vector<Index> nodes,
                     const Eigen::AlignedBox<double, 3>& box, double tolerance);

}  // namespace vspring
