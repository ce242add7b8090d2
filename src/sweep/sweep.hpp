#pragma once

#include <vector>

#include "base/threads.hpp"
#include "spring/model.hpp"
#include "vspring/model.hpp"

namespace vspring {

/// The order of a Gauss–Seidel sweep (§4.1) that may run on any number of threads: blocks in groups, no two blocks of a
/// group joined by an edge. Groups follow each other, blocks of a group run in parallel, nodes of a block in order. So
/// the newest positions that a node sees depend on the net alone.
std::vector<std::vector<Block>> parallel_order(const Net& net);

/// The order of Fig. 3: the moving nodes by their numbers in the shape, each a block of its own.
std::vector<Block> file_order(const Net& net);

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
