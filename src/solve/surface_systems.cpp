#include "solve/surface_systems.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "solve/bending_form.hpp"
#include "solve/cholesky_solver.hpp"
#include "solve/multigrid_solver.hpp"

namespace vspring {

namespace {

// Of the greatest error of a value; the iteration around the solver does the rest.
constexpr double bending_reduction = 0.05;
constexpr double spreading_reduction = 0.02;

/// The form of functions with a slope of one, per area, at moving nodes with moving neighbours only. A node has the
/// area of its Voronoi cell if its neighbours lay evenly around it.
double spreading_unit(const Net& net, const FloatRows& rows) {
  double form = 0;
  double area = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    double spokes = 0;
    double square = 0;
    bool inner = true;
    for (const Link link : net.rings.links(i)) {
      inner = inner && !link.start() && link.node() < net.moving;
      if (!link.spoke()) continue;
      spokes += 1;
      square += (net.positions[link.node()] - net.positions[i]).squaredNorm();
    }
    if (!inner || spokes <= 2) continue;
    area += 0.25 * square * std::tan(std::numbers::pi / spokes);
    for (const FloatRows::Entry& entry : rows.row(i))
      form -= 0.25 * entry.value * (net.positions[entry.column] - net.positions[i]).squaredNorm();
  }
  return area > 0 ? form / area : 1;
}

LevelMatrix bending_matrix(const Net& net, ThreadTeam& team) {
  LevelMatrix matrix;
  matrix.rows = bending_rows<float>(net, team);
  matrix.columns = matrix.rows.transposed();
  return matrix;
}

struct Matrices {
  std::vector<LevelMatrix> matrices;
  SparseRows coarsest;
};

SparseRows galerkin_matrix(const LevelMatrix& fine, const Interpolation& interpolation, ThreadTeam& team) {
  if (!fine.whole.empty())
    return product<double>(interpolation.down, product<double>(fine.whole, interpolation.up, team), team);
  const auto rows = product<float>(fine.rows, interpolation.up, team);
  return product<double>(rows.transposed(), rows, team);
}

/// On coarse nets, as irregular as they are, forms of their own would differ too much from that of the finest.
Matrices bending_matrices(const SystemLevels& levels, ThreadTeam& team) {
  Matrices result;
  result.matrices.push_back(bending_matrix(*levels.nets.front(), team));
  const std::size_t count = levels.interpolations.size();
  for (std::size_t k = 0; k < count; ++k) {
    SparseRows coarse = galerkin_matrix(result.matrices.back(), levels.interpolations[k], team);
    if (k + 1 == count) {
      result.coarsest = std::move(coarse);
    } else {
      result.matrices.emplace_back().whole = std::move(coarse);
    }
  }
  return result;
}

LevelMatrix spreading_matrix(const Net& net, ThreadTeam& team) {
  LevelMatrix matrix;
  matrix.rows = spreading_form<float>(net, team);
  matrix.unit = spreading_unit(net, matrix.rows);
  return matrix;
}

}  // namespace

BendingSystem::BendingSystem(const SystemLevels& levels, ThreadTeam& team) : levels_(&levels), team_(&team) {
  if (levels.interpolations.empty()) {
    factor_ = std::make_unique<CholeskySolver>(team);
  } else {
    multigrid_ = std::make_unique<MultigridSolver>(levels.interpolations, bending_reduction, team);
  }
}

BendingSystem::~BendingSystem() = default;

void BendingSystem::build() {
  if (factor_) {
    factor_->build(bending_form(*levels_->nets.front(), *team_));
  } else if (built_) {
    multigrid_->replace_finest(bending_matrix(*levels_->nets.front(), *team_));
  } else {
    Matrices made = bending_matrices(*levels_, *team_);
    multigrid_->build(std::move(made.matrices), made.coarsest, 1);
    built_ = true;
  }
}

void BendingSystem::solve(std::span<double> values, double enough) {
  if (factor_) {
    factor_->solve(values, enough);
  } else {
    multigrid_->solve(values, enough);
  }
}

std::unique_ptr<LinearSolver> spreading_solver(const SystemLevels& levels, ThreadTeam& team) {
  const Net& coarsest = *levels.nets.back();
  const SparseRows form = spreading_form<double>(coarsest, team);
  if (levels.interpolations.empty()) {
    auto solver = std::make_unique<CholeskySolver>(team);
    solver->build(form);
    return solver;
  }
  std::vector<LevelMatrix> matrices;
  matrices.reserve(levels.interpolations.size());
  for (std::size_t k = 0; k < levels.interpolations.size(); ++k)
    matrices.push_back(spreading_matrix(*levels.nets[k], team));
  auto solver = std::make_unique<MultigridSolver>(levels.interpolations, spreading_reduction, team);
  solver->build(std::move(matrices), form, spreading_unit(coarsest, spreading_form<float>(coarsest, team)));
  return solver;
}

}  // namespace vspring
