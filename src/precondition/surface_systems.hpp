#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "linear/interpolation.hpp"
#include "linear/linear_solver.hpp"
#include "precondition/bending_operator.hpp"
#include "spring/net.hpp"

namespace vspring {

/// A net with directions, and the interpolations between it and coarser nets, the finest first. Without interpolations
/// a sparse factor solves, else multigrid. Must outlive the systems made from it.
struct SystemLevels {
  const Net* net = nullptr;
  std::vector<Interpolation> interpolations = {};
};

/// Solves with the bending form of the net, see bending_operator().
class BendingSystem {
 public:
  BendingSystem(const SystemLevels& levels, ThreadTeam& team);
  ~BendingSystem();
  BendingSystem(const BendingSystem&) = delete;
  BendingSystem& operator=(const BendingSystem&) = delete;

  /// Builds the form from the present places, with `pull` added to its diagonal (empty: nothing); the forms of coarser
  /// levels only once, unless pulled_otherwise.
  void build(std::span<const double> pull = {}, bool pulled_otherwise = false);
  void solve(std::span<double> values, const Accuracy& accuracy);

  /// The cost of build(), in iterations of the equilibrium solver on the net.
  [[nodiscard]] double work_of_building() const;

 private:
  const SystemLevels* levels_;
  ThreadTeam* team_;
  std::unique_ptr<class CholeskySolver> factor_;
  std::unique_ptr<class MultigridSolver> multigrid_;
};

/// A solver with the Laplacian of the net's graph, see tangential_laplacian(). held: whether every part of it has held
/// nodes; else constants are damped.
std::unique_ptr<LinearSolver> spreading_solver(const SystemLevels& levels, ThreadTeam& team, bool held = true,
                                               SlidingNodes sliding = SlidingNodes::stay);

}  // namespace vspring
