#include "precondition/surface_systems.hpp"

#include <utility>
#include <vector>

#include "linear/cholesky_solver.hpp"
#include "linear/multigrid_solver.hpp"

namespace vspring {

namespace {

// As a share of the diagonal; enough for single precision.
constexpr double shift_of_free = 1e-5;
constexpr double shift_of_held = 1e-13;
// In iterations.
constexpr double work_of_levels = 1;

}  // namespace

BendingSystem::BendingSystem(const SystemLevels& levels, ThreadTeam& team) : levels_(&levels), team_(&team) {
  if (levels.interpolations.empty()) factor_ = std::make_unique<CholeskySolver>(team);
}

BendingSystem::~BendingSystem() = default;

void BendingSystem::build(std::span<const double> pull, bool pulled_otherwise) {
  if (factor_) {
    factor_->build(bending_operator(*levels_->net, *team_, pull));
    return;
  }
  FactoredMatrix matrix = factored_bending_operator(*levels_->net, *team_, pull);
  if (multigrid_ && !pulled_otherwise) {
    multigrid_->replace_finest(std::move(matrix));
    return;
  }
  auto solver = std::make_unique<MultigridSolver>(levels_->interpolations, *team_);
  solver->build(std::move(matrix));
  multigrid_ = std::move(solver);
}

void BendingSystem::solve(std::span<double> values, const Accuracy& accuracy) {
  if (factor_) {
    factor_->solve(values, accuracy);
  } else {
    multigrid_->solve(values, accuracy);
  }
}

double BendingSystem::work_of_building() const { return factor_ ? factor_->work_of_building() : work_of_levels; }

std::unique_ptr<LinearSolver> spreading_solver(const SystemLevels& levels, ThreadTeam& team, bool held,
                                               SlidingNodes sliding) {
  const Net& net = *levels.net;
  const auto form = [&] { return tangential_laplacian(net, team, held ? shift_of_held : shift_of_free, sliding); };
  if (levels.interpolations.empty()) {
    auto solver = std::make_unique<CholeskySolver>(team);
    solver->build(form());
    return solver;
  }
  auto solver = std::make_unique<MultigridSolver>(levels.interpolations, team);
  if (net.laplacian_weights.empty() && net.supports.empty() && held) {
    solver->build(GraphLaplacian(net));
  } else {
    solver->build(LinkMatrix(net, form(), team));
  }
  return solver;
}

}  // namespace vspring
