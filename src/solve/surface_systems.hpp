#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "solve/interpolation.hpp"
#include "solve/linear_solver.hpp"
#include "spring/net.hpp"

namespace vspring {

/// The levels that a system is solved over, the finest first: nets that have one shape, with directions, and between
/// each and the next one an interpolation. With one level a sparse factor solves, with more multigrid does. All must
/// outlive what is made of them.
struct SystemLevels {
  std::vector<const Net*> nets;
  std::vector<Interpolation> interpolations;
};

/// Solves with the bending form of the finest net, see bending_form().
class BendingSystem {
 public:
  BendingSystem(const SystemLevels& levels, ThreadTeam& team);
  ~BendingSystem();
  BendingSystem(const BendingSystem&) = delete;
  BendingSystem& operator=(const BendingSystem&) = delete;

  /// Builds the form from where the nodes are now; that of coarser levels once.
  void build();
  void solve(std::span<double> values, double enough);

 private:
  const SystemLevels* levels_;
  ThreadTeam* team_;
  std::unique_ptr<class CholeskySolver> factor_;
  std::unique_ptr<class MultigridSolver> multigrid_;
  bool built_ = false;
};

/// A solver with the Laplacian of the finest net's graph, see spreading_form().
std::unique_ptr<LinearSolver> spreading_solver(const SystemLevels& levels, ThreadTeam& team);

}  // namespace vspring
