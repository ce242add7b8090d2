#pragma once

#include <functional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "refine/edge_table.hpp"

namespace vspring {

/// A face to be divided.
struct FaceToDivide {
  std::span<const Index> nodes;
  std::span<const Index> middles;  ///< per node the new one on the edge to the next, or −1
  Index from;                      ///< face of the input
  bool is_convex;
};

/// Whether a face turns to the same side at all its corners, seen along its vector area, or has no area.
bool is_convex(std::span<const Index> face, const std::vector<Vector3>& positions);

/// What divide() needs to know of the rest of the mesh.
struct DivisionContext {
  const std::vector<Vector3>& positions;  ///< of all nodes but middles of faces
  /// Makes a node at the mean of some nodes.
  std::function<Index(std::span<const Index>)> add_mean;
  /// Whether an edge joins two nodes, the lower number first.
  std::function<bool(Index, Index)> is_edge;
  std::set<std::pair<Index, Index>> new_edges;  ///< between nodes that were there before
};

/// Appends the parts of a face. A face without new nodes on its edges is divided around its middle.
void divide(const FaceToDivide& face, DivisionContext& context, FaceParcel& parts);

}  // namespace vspring
