#include "equilibrium/newton.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "base/cancellation.hpp"
#include "equilibrium/edge_turns.hpp"
#include "linear/lu_factor.hpp"

namespace vspring {

namespace {

// As a share of the mean length of a node's edges.
constexpr double difference_step = 1e-6;

void sort_out(std::vector<std::uint32_t>& nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

// Turn of an edge in one step, in radians.
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
      // The last step is not taken: its length is the expected error of the shape before it.
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

ForceDerivative::ForceDerivative(Net& net, const Model& model)
    : net_(&net), model_(&model), normals_(net.moving), forces_(net.moving) {
  std::vector<std::vector<std::uint32_t>> seen_by(net.computed);
  for (std::size_t i = 0; i < net.computed; ++i) {
    const auto number = static_cast<std::uint32_t>(i);
    if (i < net.moving) normals_[i].push_back(number);
    for (const Link link : net.rings.links(i)) {
      const std::size_t j = link.node();
      if (j < net.moving) normals_[j].push_back(number);
      if (link.spoke() && i < net.moving && j < net.computed) seen_by[j].push_back(number);
    }
  }
  std::vector<int> begin = {0};
  std::vector<int> rows;
  for (std::size_t j = 0; j < net.moving; ++j) {
    end_if_cancelled();
    sort_out(normals_[j]);
    std::vector<std::uint32_t>& forces = forces_[j];
    for (const std::uint32_t i : normals_[j]) {
      if (i < net.moving) forces.push_back(i);
      forces.insert(forces.end(), seen_by[i].begin(), seen_by[i].end());
    }
    sort_out(forces);
    for (int coordinate = 0; coordinate < 3; ++coordinate) {
      for (const std::uint32_t i : forces) {
        for (int k = 0; k < 3; ++k) rows.push_back(3 * static_cast<int>(i) + k);
      }
      begin.push_back(static_cast<int>(rows.size()));
    }
  }
  const std::vector<double> values(rows.size(), 0);
  const auto size = static_cast<Eigen::Index>(3 * net.moving);
  matrix_ = Eigen::Map<const Eigen::SparseMatrix<double>>(size, size, static_cast<Eigen::Index>(rows.size()),
                                                          begin.data(), rows.data(), values.data());
}

const Eigen::SparseMatrix<double>& ForceDerivative::find() {
  Net& net = *net_;
  std::vector<Vector3> ahead;
  double* value = matrix_.valuePtr();
  for (std::size_t j = 0; j < net.moving; ++j) {
    end_if_cancelled();
    const double step = std::max(difference_step * mean_edge(net, j), std::sqrt(net.tiny));
    const Vector3 place = net.positions[j];
    const auto turn_normals = [&] {
      for (const std::uint32_t i : normals_[j]) model_->update_directions(net, i, i + 1);
    };
    const auto displacement = [&](std::size_t i) -> Vector3 {
      NodeForce force;
      model_->find_forces(net, {i, i + 1}, std::span(&force, 1));
      return force.spring + force.regularisation;
    };
    for (Eigen::Index coordinate = 0; coordinate < 3; ++coordinate) {
      net.positions[j][coordinate] = place[coordinate] + step;
      turn_normals();
      ahead.clear();
      for (const std::uint32_t i : forces_[j]) ahead.push_back(displacement(i));
      net.positions[j][coordinate] = place[coordinate] - step;
      turn_normals();
      for (std::size_t k = 0; k < ahead.size(); ++k) {
        const Vector3 difference = (ahead[k] - displacement(forces_[j][k])) / (2 * step);
        for (const double one : difference) *value++ = one;
      }
      net.positions[j][coordinate] = place[coordinate];
    }
    turn_normals();
  }
  return matrix_;
}

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
