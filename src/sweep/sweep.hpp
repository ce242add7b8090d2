#pragma once

#include <vector>

#include "base/threads.hpp"
#include "spring/model.hpp"
#include "sweep/blocks.hpp"
#include "vspring/model.hpp"

namespace vspring {

/// The paper's iteration over all nodes (Fig. 3).
class Sweep {
 public:
  Sweep(Net& net, const Model& model, ThreadTeam& team, SweepOrder order = SweepOrder::parallel);

  /// One iteration. Returns the largest displacement of a node relative to the mean length of its edges (§4.6).
  double iterate();

 private:
  Net* net_;
  const Model* model_;
  ThreadTeam* team_;
  std::vector<Block> sequence_;             // one after the other; else groups_
  std::vector<std::vector<Block>> groups_;  // side by side
  std::vector<double> greatest_;
};

}  // namespace vspring
