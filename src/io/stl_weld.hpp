#pragma once

#include <cstdint>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Gives one number to all positions whose coordinates are the same bits; 0 and −0 are the same.
class Weld {
 public:
  /// corners: how many positions will come.
  explicit Weld(std::size_t corners);

  /// The node at this position, a new one where there is none yet. Nodes are numbered as they come.
  Index node_at(const Vector3& position);

  /// Of each node, as it first came.
  std::vector<Vector3> positions;

 private:
  void grow();

  std::vector<Index> slots_;  ///< open addressing; −1 is free
  std::size_t mask_;
};

}  // namespace vspring
