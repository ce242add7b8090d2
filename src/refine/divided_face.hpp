#pragma once

#include <functional>
#include <span>
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

/// Appends the parts of a face. middle: makes a node at the mean of the face's corners; called once at most. positions:
/// of all nodes but that one. A face without new nodes on its edges is divided around its middle.
void divide(const FaceToDivide& face, const std::vector<Vector3>& positions, const std::function<Index()>& middle,
            FaceParcel& parts);

}  // namespace vspring
