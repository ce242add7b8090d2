#pragma once

#include <vector>

#include "base/threads.hpp"
#include "spring/net.hpp"
#include "sweep/blocks.hpp"
#include "vspring/model.hpp"

namespace vspring {

/// Computes the pseudo-normals of all nodes of the net that have rings and no given normal (§4.2, Step 1 of Fig. 3).
void update_normals(Net& net, PseudoNormals kind, ThreadTeam& team);

/// What every link counts in the mean that the regularisation (§4.4) sends its node to, so that the present place of
/// each node is where it is sent; aligned with the links of the net. Needs normals.
std::vector<double> present_shares(const Net& net);

/// The paper's iteration over all nodes (Fig. 3).
class Sweep {
 public:
  Sweep(Net& net, PseudoNormals pseudo_normals, Distribution distribution, ThreadTeam& team);

  /// One iteration. Returns the largest displacement of a node relative to the mean length of its edges (§4.6).
  double iterate();

 private:
  double sweep_block(Block block);

  Net* net_;
  PseudoNormals pseudo_normals_;
  ThreadTeam* team_;
  std::vector<std::vector<Block>> groups_;
  std::vector<double> shares_;
  std::vector<double> greatest_;
};

}  // namespace vspring
