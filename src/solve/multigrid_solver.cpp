#include "solve/multigrid_solver.hpp"

#include <algorithm>
#include <cmath>

namespace vspring {

namespace {

constexpr std::size_t rows_per_task = 4096;
constexpr int degree = 3;
constexpr int most_iterations = 60;
// The smoother sees to eigenvalues from this share of the greatest on.
constexpr double smoothed_from = 1.0 / 12;
constexpr int power_steps = 12;
// The power iteration stays below the greatest eigenvalue.
constexpr double power_margin = 1.15;

template <int columns>
using Values = std::vector<Eigen::Array<double, columns, 1>>;

template <typename Body>
void for_rows(ThreadTeam& team, std::size_t rows, const Body& body) {
  parallel_ranges(team, rows, rows_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

template <int columns>
Eigen::Array<double, columns, 1> row_times(const SparseRows& matrix, std::size_t i, const Values<columns>& values) {
  Eigen::Array<double, columns, 1> sum = Eigen::Array<double, columns, 1>::Zero();
  for (const SparseRows::Entry& entry : matrix.row(i)) sum += entry.value * values[entry.column];
  return sum;
}

/// Column by column; in fixed pieces, so that the bits do not depend on threads.
template <int columns>
Eigen::Array<double, columns, 1> dot(ThreadTeam& team, const Values<columns>& a, const Values<columns>& b) {
  using Sum = Eigen::Array<double, columns, 1>;
  std::vector<Sum> parts((a.size() + rows_per_task - 1) / rows_per_task, Sum::Zero());
  parallel_ranges(team, a.size(), rows_per_task, [&](std::size_t begin, std::size_t end) {
    Sum sum = Sum::Zero();
    for (std::size_t i = begin; i < end; ++i) sum += a[i] * b[i];
    parts[begin / rows_per_task] = sum;
  });
  Sum total = Sum::Zero();
  for (const Sum& part : parts) total += part;
  return total;
}

}  // namespace

MultigridSolver::MultigridSolver(std::span<const Interpolation> interpolations, double reduction, ThreadTeam& team)
    : interpolations_(interpolations), reduction_(reduction), team_(&team), levels_(interpolations.size() + 1) {}

void MultigridSolver::build(SparseRows matrix) {
  levels_.front().matrix = std::move(matrix);
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    Level& level = levels_[k];
    if (k > 0)
      level.matrix = product(interpolations_[k - 1].down,
                             product(levels_[k - 1].matrix, interpolations_[k - 1].up, *team_), *team_);
    if (k + 1 == levels_.size()) break;
    level.inverse_diagonal.resize(level.matrix.rows());
    for_rows(*team_, level.matrix.rows(),
             [&](std::size_t i) { level.inverse_diagonal[i] = 1 / std::max(level.matrix.diagonal(i), 1e-300); });
    level.greatest = greatest_eigenvalue(level);
  }
  if (!coarsest_) coarsest_ = std::make_unique<CholeskySolver>(*team_);
  coarsest_->build(levels_.back().matrix);
}

double MultigridSolver::greatest_eigenvalue(const Level& level) const {
  const std::size_t rows = level.matrix.rows();
  Values<1> values(rows);
  Values<1> next(rows);
  // Rough, and along no eigenvector of any shape.
  for (std::size_t i = 0; i < rows; ++i)
    values[i] = (i % 2 == 0 ? 1 : -1) * (1 + static_cast<double>(i * 7919 % 97) / 97);
  double greatest = 0;
  double size = std::sqrt(dot(*team_, values, values)[0]);
  for (int step = 0; step < power_steps; ++step) {
    for_rows(*team_, rows,
             [&](std::size_t i) { next[i] = level.inverse_diagonal[i] * row_times(level.matrix, i, values) / size; });
    std::swap(values, next);
    greatest = size = std::sqrt(dot(*team_, values, values)[0]);
  }
  return power_margin * greatest;
}

/// One V-cycle, with the room that it needs.
template <int columns>
class MultigridSolver::Cycle {
 public:
  explicit Cycle(MultigridSolver& solver) : solver_(&solver), room_(solver.levels_.size()) {
    for (std::size_t k = 0; k < room_.size(); ++k) {
      const std::size_t rows = solver.levels_[k].matrix.rows();
      for (Values<columns>* values : {&room_[k].right, &room_[k].solution, &room_[k].residual, &room_[k].step})
        values->resize(rows);
    }
  }

  /// solution ≈ matrix⁻¹ right, a symmetric operator.
  void apply(const Values<columns>& right, Values<columns>& solution) {
    std::swap(room_[0].solution, solution);
    descend(0, right);
    std::swap(room_[0].solution, solution);
  }

 private:
  struct Room {
    Values<columns> right;
    Values<columns> solution;
    Values<columns> residual;
    Values<columns> step;
  };

  void descend(std::size_t k, const Values<columns>& right) {
    Room& room = room_[k];
    if (k + 1 == room_.size()) {
      solve_coarsest(right, room.solution);
      return;
    }
    ThreadTeam& team = *solver_->team_;
    const Interpolation& interpolation = solver_->interpolations_[k];
    room.residual = right;
    smooth(k, true);
    Room& below = room_[k + 1];
    for_rows(team, below.right.size(),
             [&](std::size_t i) { below.right[i] = row_times(interpolation.down, i, room.residual); });
    descend(k + 1, below.right);
    for_rows(team, room.solution.size(),
             [&](std::size_t i) { room.solution[i] += row_times(interpolation.up, i, below.solution); });
    for_rows(team, room.solution.size(), [&](std::size_t i) {
      room.residual[i] = right[i] - row_times(solver_->levels_[k].matrix, i, room.solution);
    });
    smooth(k, false);
  }

  /// Chebyshev iteration from the residual; from a solution of zero at first. The last residual is only worked out
  /// before going down.
  void smooth(std::size_t k, bool first) {
    ThreadTeam& team = *solver_->team_;
    const Level& level = solver_->levels_[k];
    Room& room = room_[k];
    const double middle = 0.5 * (1 + smoothed_from) * level.greatest;
    const double radius = 0.5 * (1 - smoothed_from) * level.greatest;
    double rho = radius / middle;
    for (int step = 0; step < degree; ++step) {
      const double before = rho;
      if (step > 0) rho = 1 / (2 * middle / radius - before);
      const double keep = step == 0 ? 0 : rho * before;
      const double take = step == 0 ? 1 / middle : 2 * rho / radius;
      for_rows(team, room.step.size(), [&](std::size_t i) {
        const auto correction = take * level.inverse_diagonal[i] * room.residual[i];
        if (step == 0) {
          room.step[i] = correction;
        } else {
          room.step[i] = keep * room.step[i] + correction;
        }
        if (first && step == 0) {
          room.solution[i] = room.step[i];
        } else {
          room.solution[i] += room.step[i];
        }
      });
      if (!first && step + 1 == degree) break;
      for_rows(team, room.step.size(),
               [&](std::size_t i) { room.residual[i] -= row_times(level.matrix, i, room.step); });
    }
  }

  void solve_coarsest(const Values<columns>& right, Values<columns>& solution) {
    Eigen::MatrixXd values(static_cast<Eigen::Index>(right.size()), columns);
    for (std::size_t i = 0; i < right.size(); ++i)
      values.row(static_cast<Eigen::Index>(i)) = right[i].matrix().transpose();
    solver_->coarsest_->solve(values);
    for (std::size_t i = 0; i < right.size(); ++i)
      solution[i] = values.row(static_cast<Eigen::Index>(i)).transpose().array();
  }

  MultigridSolver* solver_;
  std::vector<Room> room_;
};

template <int columns>
void MultigridSolver::solve_columns(Eigen::MatrixXd& values) {
  using Scalars = Eigen::Array<double, columns, 1>;
  const SparseRows& matrix = levels_.front().matrix;
  const std::size_t rows = matrix.rows();
  Values<columns> residual(rows);
  Values<columns> solution(rows, Scalars::Zero());
  Values<columns> direction(rows);
  Values<columns> preconditioned(rows);
  Values<columns> image(rows);
  for (std::size_t i = 0; i < rows; ++i) residual[i] = values.row(static_cast<Eigen::Index>(i)).transpose().array();
  Cycle<columns> cycle(*this);
  const auto ratio = [](const Scalars& a, const Scalars& b) -> Scalars {
    return (b > 0).select(a / b, Scalars::Zero());
  };
  Scalars size = Scalars::Zero();
  Scalars wanted = Scalars::Zero();
  for (iterations_ = 0; iterations_ < most_iterations; ++iterations_) {
    cycle.apply(residual, preconditioned);
    const Scalars next_size = dot(*team_, residual, preconditioned);
    if (iterations_ == 0) {
      wanted = reduction_ * reduction_ * next_size;
      direction = preconditioned;
    } else {
      const Scalars keep = ratio(next_size, size);
      for_rows(*team_, rows, [&](std::size_t i) { direction[i] = preconditioned[i] + keep * direction[i]; });
    }
    size = next_size;
    if (!(size > wanted).any()) break;
    for_rows(*team_, rows, [&](std::size_t i) { image[i] = row_times(matrix, i, direction); });
    const Scalars share = ratio(size, dot(*team_, direction, image));
    for_rows(*team_, rows, [&](std::size_t i) {
      solution[i] += share * direction[i];
      residual[i] -= share * image[i];
    });
  }
  for (std::size_t i = 0; i < rows; ++i) values.row(static_cast<Eigen::Index>(i)) = solution[i].matrix().transpose();
}

void MultigridSolver::solve(Eigen::MatrixXd& columns) {
  if (columns.cols() == 3) {
    solve_columns<3>(columns);
    return;
  }
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    Eigen::MatrixXd column = columns.col(k);
    solve_columns<1>(column);
    columns.col(k) = column;
  }
}

std::unique_ptr<LinearSolver> linear_solver(std::span<const Interpolation> interpolations, double reduction,
                                            ThreadTeam& team) {
  if (interpolations.empty()) return std::make_unique<CholeskySolver>(team);
  return std::make_unique<MultigridSolver>(interpolations, reduction, team);
}

}  // namespace vspring
