#include "equilibrium/newton.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/cancellation.hpp"
#include "equilibrium/edge_turns.hpp"
#include "equilibrium/force_derivative.hpp"
#include "linear/lu_factor.hpp"

namespace vspring {

namespace {

// Of an edge, in one step.
constexpr double most_turn_of_step = 0.5;

class Newton {
 public:
  Newton(Net& net, const Model& model, ThreadTeam& team)
      : net_(net), model_(model), team_(team), derivative_(net, model) {
    model.prepare(net);
  }

  void run(const EquilibriumTask& task, EquilibriumResult& result) {
    for (; result.iterations < task.max_iterations; ++result.iterations) {
      if (result.work + work_of_newton_step > task.most_work) {
        result.outcome = Outcome::work_limit;
        return;
      }
      result.work += work_of_newton_step;
      end_if_cancelled();
      const bool has_step = find_step();
      const double size =
          has_step ? std::sqrt(greatest_over_nodes(net_, team_, [&](std::size_t i) { return step_[i].squaredNorm(); }))
                   : 0;
      if (!has_step || !std::isfinite(size)) {
        result.outcome = Outcome::stalled;
        return;
      }
      if (task.on_iteration) task.on_iteration(size);
      const double turn = edge_turns(net_, step_, team_).largest;
      // The last step is not taken, as the shape is to be the one that it says the distance of.
      if (size < task.tolerance && turn <= most_turn_of_step) {
        ++result.iterations;
        result.outcome = Outcome::converged;
        result.expected_error = size;
        return;
      }
      const double share = std::min(1.0, most_turn_of_step / turn);
      for (std::size_t i = 0; i < net_.moving; ++i) net_.positions[i] += share * step_[i];
    }
  }

 private:
  /// −F′ step = F. False where that has no solution.
  bool find_step() {
    update_directions(net_, model_, team_);
    std::vector<NodeForce> forces(net_.moving);
    model_.find_forces(net_, {0, net_.moving}, forces);
    Eigen::VectorXd displacements(static_cast<Eigen::Index>(3 * net_.moving));
    for (std::size_t i = 0; i < net_.moving; ++i)
      displacements.segment<3>(static_cast<Eigen::Index>(3 * i)) = forces[i].spring + forces[i].regularisation;
    const Eigen::SparseMatrix<double> matrix = -derivative_.find();
    if (!analysed_) factor_.analyzePattern(matrix);
    analysed_ = true;
    factor_.factorize(matrix);
    if (factor_.info() != Eigen::Success) return false;
    const Eigen::VectorXd solution = factor_.solve(displacements);
    step_.resize(net_.moving);
    for (std::size_t i = 0; i < net_.moving; ++i) step_[i] = solution.segment<3>(static_cast<Eigen::Index>(3 * i));
    return true;
  }

  Net& net_;
  const Model& model_;
  ThreadTeam& team_;
  ForceDerivative derivative_;
  LuFactor factor_;
  bool analysed_ = false;
  std::vector<Vector3> step_;
};

}  // namespace

EquilibriumResult go_by_newton(Net& net, const Model& model, const EquilibriumTask& task, ThreadTeam& team,
                               Context& context) {
  EquilibriumResult result;
  try {
    const CancellationScope cancellation(context);
    Newton(net, model, team).run(task, result);
  } catch (const Cancelled&) {
    result.outcome = Outcome::cancelled;
  }
  return result;
}

}  // namespace vspring
