#include "equilibrium/pseudo_transient.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/cancellation.hpp"
#include "equilibrium/edge_turns.hpp"
#include "equilibrium/force_derivative.hpp"
#include "linear/lu_factor.hpp"

namespace vspring {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

// Of an edge in one step: at most, and what steps become longer up to.
constexpr double greatest_flow_turn = 0.5;
constexpr double wanted_turn = 0.3;
// Lengths of steps; 1 is about a sweep.
constexpr double shortest = 1;
constexpr double longest = 1e14;
constexpr double growth = 1.2;
constexpr double greatest_growth = 10;
// Of the forces' norm: where they are below, the first step is longer.
constexpr double near_by = 0.003;
// Steps of that many tolerances are near enough to try Newton's.
constexpr double near = 10;

class Flow {
 public:
  Flow(Net& net, const Model& model, ThreadTeam& team)
      : net_(net), model_(model), team_(team), derivative_(net, model) {
    model.prepare(net);
  }

  EquilibriumResult run(const EquilibriumTask& task, FlowStart start, Context& context) {
    EquilibriumResult result;
    try {
      const CancellationScope cancellation(context);
      follow(task, start, result);
    } catch (const Cancelled&) {
      result.outcome = Outcome::cancelled;
    }
    return result;
  }

 private:
  void follow(const EquilibriumTask& task, FlowStart start, EquilibriumResult& result) {
    find_forces();
    double length = start == FlowStart::near ? longest : std::max(shortest, near_by / forces_.norm());
    bool newton = false;
    for (; result.iterations < task.max_iterations && result.work + work_of_flow_step <= task.most_work;
         ++result.iterations) {
      result.work += work_of_flow_step;
      end_if_cancelled();
      const bool solved = find_step(newton ? 0 : 1 / length);
      const double size =
          solved ? std::sqrt(greatest_over_nodes(net_, team_, [&](std::size_t i) { return step_[i].squaredNorm(); }))
                 : 0;
      if (!solved || !std::isfinite(size)) {
        newton = false;
        length *= 0.3;
        continue;
      }
      if (task.on_iteration) task.on_iteration(size);
      const double turn = edge_turns(net_, step_, team_).largest;
      // Only Newton's step says how far it is; it is not taken, as the shape is to be the one that it says it of.
      if (newton && size < task.tolerance && turn <= greatest_flow_turn) {
        ++result.iterations;
        result.outcome = Outcome::converged;
        result.expected_error = size;
        return;
      }
      const double share = std::min(1.0, greatest_flow_turn / turn);
      const double before = forces_.norm();
      const std::vector<Vector3> places(net_.positions.begin(),
                                        net_.positions.begin() + static_cast<std::ptrdiff_t>(net_.moving));
      for (std::size_t i = 0; i < net_.moving; ++i) net_.positions[i] += share * step_[i];
      find_forces();
      const double now = forces_.norm();
      newton = share == 1 && size < near * task.tolerance;
      if (!std::isfinite(now)) {
        std::copy(places.begin(), places.end(), net_.positions.begin());
        find_forces();
        length *= 0.1;
      } else if (share < 1) {
        length = std::max(length * std::max(share, 0.3), shortest);
      } else if (now > 2 * before) {
        length *= 0.5;
      } else {
        const double factor = std::max(growth * before / now, wanted_turn / turn);
        length = std::min(length * std::clamp(factor, 0.5, greatest_growth), longest);
      }
    }
    if (result.iterations < task.max_iterations) result.outcome = Outcome::work_limit;
  }

  void find_forces() {
    update_directions(net_, model_, team_);
    std::vector<NodeForce> forces(net_.moving);
    model_.find_forces(net_, {0, net_.moving}, forces);
    forces_.resize(static_cast<Eigen::Index>(3 * net_.moving));
    for (std::size_t i = 0; i < net_.moving; ++i)
      forces_.segment<3>(static_cast<Eigen::Index>(3 * i)) = forces[i].spring + forces[i].regularisation;
  }

  /// (damping − F′) step = F. False where that has no solution.
  bool find_step(double damping) {
    Matrix matrix = -derivative_.find();
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) matrix.coeffRef(i, i) += damping;
    if (!analysed_) factor_.analyzePattern(matrix);
    analysed_ = true;
    factor_.factorize(matrix);
    if (factor_.info() != Eigen::Success) return false;
    const Eigen::VectorXd solution = factor_.solve(forces_);
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
  Eigen::VectorXd forces_;
  std::vector<Vector3> step_;
};

}  // namespace

EquilibriumResult follow_flow(Net& net, const Model& model, const EquilibriumTask& task, FlowStart start,
                              ThreadTeam& team, Context& context) {
  return Flow(net, model, team).run(task, start, context);
}

}  // namespace vspring
