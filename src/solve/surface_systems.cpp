#include "solve/surface_systems.hpp"

#include <utility>
#include <vector>

#include "solve/bending_form.hpp"
#include "solve/cholesky_solver.hpp"
#include "solve/multigrid_solver.hpp"

namespace vspring {

BendingSystem::BendingSystem(const SystemLevels& levels, ThreadTeam& team) : levels_(&levels), team_(&team) {
  if (levels.interpolations.empty()) factor_ = std::make_unique<CholeskySolver>(team);
}

BendingSystem::~BendingSystem() = default;

void BendingSystem::build() {
  if (factor_) {
    factor_->build(bending_form(*levels_->net, *team_));
    return;
  }
  FactoredMatrix matrix = factored_bending_form(*levels_->net, *team_);
  if (multigrid_) {
    multigrid_->replace_finest(std::move(matrix));
    return;
  }
  multigrid_ = std::make_unique<MultigridSolver>(levels_->interpolations, *team_);
  multigrid_->build(std::move(matrix));
}

void BendingSystem::solve(std::span<double> values, const Accuracy& accuracy) {
  if (factor_) {
    factor_->solve(values, accuracy);
  } else {
    multigrid_->solve(values, accuracy);
  }
}

std::unique_ptr<LinearSolver> spreading_solver(const SystemLevels& levels, ThreadTeam& team) {
  const Net& net = *levels.net;
  if (levels.interpolations.empty()) {
    auto solver = std::make_unique<CholeskySolver>(team);
    solver->build(spreading_form(net, team));
    return solver;
  }
  auto solver = std::make_unique<MultigridSolver>(levels.interpolations, team);
  if (net.shares.empty()) {
    solver->build(GraphLaplacian(net));
  } else {
    solver->build(WholeMatrix(spreading_form(net, team), team));
  }
  return solver;
}

}  // namespace vspring
