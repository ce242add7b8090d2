#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "linear/interpolation.hpp"
#include "linear/linear_solver.hpp"
#include "spring/net.hpp"

namespace vspring {

/// What a system is of, a net with directions, and the interpolations between it and coarser versions of it, the finest
/// first. Without any a sparse factor solves, with them multigrid does. Must outlive what is made of it.
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

  /// Builds the form from where the nodes are now, with `pull` added to its diagonal (empty: nothing); that of coarser
  /// levels once, but where pulled_otherwise.
  void build(std::span<const double> pull = {}, bool pulled_otherwise = false);
  void solve(std::span<double> values, const Accuracy& accuracy);

  /// In iterations of the equilibrium solver on the net.
  [[nodiscard]] double work_of_building() const;

 private:
  const SystemLevels* levels_;
  ThreadTeam* team_;
  std::unique_ptr<class CholeskySolver> factor_;
  std::unique_ptr<class MultigridSolver> multigrid_;
};

/// A solver with the Laplacian of the net's graph, see tangential_laplacian(). held: whether all of it hangs together
/// with held nodes; else constants are damped.
std::unique_ptr<LinearSolver> spreading_solver(const SystemLevels& levels, ThreadTeam& team, bool held = true);

}  // namespace vspring
