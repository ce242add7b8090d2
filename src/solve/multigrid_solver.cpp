#include "solve/multigrid_solver.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace vspring {

namespace {

constexpr std::size_t rows_per_task = 4096;
constexpr int degree = 3;
constexpr int most_iterations = 60;
// The smoother sees to eigenvalues from this share of the greatest on.
constexpr double smoothed_from = 1.0 / 12;
constexpr int power_steps = 10;
constexpr int further_power_steps = 2;
// The power iteration stays below the greatest eigenvalue.
constexpr double power_margin = 1.15;

/// What a node has of one column, or of three with one to spare.
using One = float;
using Three = Eigen::Array4f;

template <typename Value>
Value zero() {
  if constexpr (std::is_same_v<Value, One>)
    return 0;
  else
    return Three::Zero();
}

template <typename Body>
void for_rows(ThreadTeam& team, std::size_t rows, const Body& body) {
  parallel_ranges(team, rows, rows_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// What is summed up in double precision.
template <typename Value>
using Sum = std::conditional_t<std::is_same_v<Value, One>, double, Eigen::Array4d>;

template <typename Value>
Sum<Value> wide(const Value& value) {
  if constexpr (std::is_same_v<Value, One>)
    return value;
  else
    return value.template cast<double>();
}

template <typename Value>
Value narrow(const Sum<Value>& value) {
  if constexpr (std::is_same_v<Value, One>)
    return static_cast<float>(value);
  else
    return value.template cast<float>();
}

template <typename Value>
Value row_times(const FloatRows& matrix, std::size_t i, const std::vector<Value>& values) {
  Value sum = zero<Value>();
  for (const FloatRows::Entry& entry : matrix.row(i)) sum += entry.value * values[entry.column];
  return sum;
}

template <typename Value>
Value row_times(const SparseRows& matrix, std::size_t i, const std::vector<Value>& values) {
  Sum<Value> sum = wide<Value>(zero<Value>());
  for (const SparseRows::Entry& entry : matrix.row(i)) sum += entry.value * wide<Value>(values[entry.column]);
  return narrow<Value>(sum);
}

/// In fixed pieces, so that the bits do not depend on threads.
template <typename Value>
Sum<Value> dot(ThreadTeam& team, const std::vector<Value>& a, const std::vector<Value>& b) {
  Sum<Value> nothing = wide<Value>(zero<Value>());
  std::vector<Sum<Value>> parts((a.size() + rows_per_task - 1) / rows_per_task, nothing);
  parallel_ranges(team, a.size(), rows_per_task, [&](std::size_t begin, std::size_t end) {
    Sum<Value> sum = nothing;
    for (std::size_t i = begin; i < end; ++i) sum += wide<Value>(a[i]) * wide<Value>(b[i]);
    parts[begin / rows_per_task] = sum;
  });
  Sum<Value> total = nothing;
  for (const Sum<Value>& part : parts) total += part;
  return total;
}

/// The greatest length of a value.
template <typename Value>
double greatest(ThreadTeam& team, const std::vector<Value>& values) {
  std::vector<float> parts((values.size() + rows_per_task - 1) / rows_per_task, 0);
  parallel_ranges(team, values.size(), rows_per_task, [&](std::size_t begin, std::size_t end) {
    float square = 0;
    for (std::size_t i = begin; i < end; ++i) {
      if constexpr (std::is_same_v<Value, One>) {
        square = std::max(square, values[i] * values[i]);
      } else {
        square = std::max(square, values[i].square().sum());
      }
    }
    parts[begin / rows_per_task] = square;
  });
  return std::sqrt(*std::max_element(parts.begin(), parts.end()));
}

template <typename Value>
Sum<Value> ratio(const Sum<Value>& a, const Sum<Value>& b) {
  if constexpr (std::is_same_v<Value, One>)
    return b > 0 ? a / b : 0;
  else
    return (b > 0).select(a / b, Sum<Value>::Zero());
}

/// then(i, y_i) for every i of y = matrix · values. room: for what lies between the factors.
template <typename Value, typename Then>
void multiply(ThreadTeam& team, const LevelMatrix& matrix, const std::vector<Value>& values, std::vector<Value>& room,
              const Then& then) {
  if (!matrix.whole.empty()) {
    for_rows(team, values.size(), [&](std::size_t i) { then(i, row_times(matrix.whole, i, values)); });
    return;
  }
  if (matrix.columns.empty()) {
    for_rows(team, values.size(), [&](std::size_t i) { then(i, row_times(matrix.rows, i, values)); });
    return;
  }
  room.resize(matrix.rows.rows());
  for_rows(team, room.size(), [&](std::size_t i) { room[i] = row_times(matrix.rows, i, values); });
  for_rows(team, values.size(), [&](std::size_t i) { then(i, row_times(matrix.columns, i, room)); });
}

}  // namespace

MultigridSolver::MultigridSolver(std::span<const Interpolation> interpolations, double reduction, ThreadTeam& team)
    : interpolations_(interpolations), reduction_(reduction), team_(&team), coarsest_(team) {}

void MultigridSolver::build(std::vector<LevelMatrix> matrices, const SparseRows& coarsest, double coarsest_unit) {
  levels_.resize(matrices.size());
  for (std::size_t k = 0; k < matrices.size(); ++k) set_level(levels_[k], std::move(matrices[k]));
  coarsest_.build(coarsest);
  coarsest_unit_ = coarsest_unit;
}

void MultigridSolver::replace_finest(LevelMatrix matrix) { set_level(levels_.front(), std::move(matrix)); }

void MultigridSolver::set_level(Level& level, LevelMatrix matrix) const {
  level.matrix = std::move(matrix);
  const std::size_t rows = level.matrix.size();
  level.inverse_diagonal.resize(rows);
  for_rows(*team_, rows, [&](std::size_t i) {
    float diagonal = 0;
    if (!level.matrix.whole.empty()) {
      diagonal = static_cast<float>(level.matrix.whole.diagonal(i));
    } else if (level.matrix.columns.empty()) {
      diagonal = level.matrix.rows.diagonal(i);
    } else {
      for (const FloatRows::Entry& entry : level.matrix.columns.row(i)) diagonal += entry.value * entry.value;
    }
    level.inverse_diagonal[i] = 1 / std::max(diagonal, 1e-30F);
  });
  const bool first = level.rough.empty();
  if (first) {
    // Rough, and along no eigenvector of any shape.
    level.rough.resize(rows);
    for (std::size_t i = 0; i < rows; ++i)
      level.rough[i] = (i % 2 == 0 ? 1.0F : -1.0F) * (1 + static_cast<float>(i * 7919 % 97) / 97);
  }
  std::vector<One> next(rows);
  std::vector<One> room;
  double size = std::sqrt(dot<One>(*team_, level.rough, level.rough));
  for (int step = 0; step < (first ? power_steps : further_power_steps); ++step) {
    multiply<One>(*team_, level.matrix, level.rough, room, [&](std::size_t i, One image) {
      next[i] = level.inverse_diagonal[i] * image / static_cast<float>(size);
    });
    std::swap(level.rough, next);
    size = std::sqrt(dot<One>(*team_, level.rough, level.rough));
  }
  level.greatest = power_margin * size;
}

/// One V-cycle, with the room that it needs.
template <typename Value>
class MultigridSolver::Cycle {
 public:
  explicit Cycle(MultigridSolver& solver) : solver_(&solver), levels_(solver.levels_.size() + 1) {
    for (std::size_t k = 0; k < levels_.size(); ++k) {
      const std::size_t rows = k == 0 ? solver.levels_[0].matrix.size() : solver.interpolations_[k - 1].up.columns();
      levels_[k].solution.resize(rows);
      if (k + 1 == levels_.size()) break;
      levels_[k].residual.resize(rows);
      levels_[k].step.resize(rows);
    }
  }

  /// solution ≈ matrix⁻¹ right, a symmetric operator.
  void apply(const std::vector<Value>& right, std::vector<Value>& solution) {
    levels_[0].residual = right;
    descend(0);
    std::swap(levels_[0].solution, solution);
    levels_[0].solution.resize(solution.size());
  }

 private:
  struct Room {
    std::vector<Value> residual;
    std::vector<Value> solution;
    std::vector<Value> step;
  };

  /// From the right side in `residual`; leaves the solution in `solution`.
  void descend(std::size_t k) {
    Room& room = levels_[k];
    ThreadTeam& team = *solver_->team_;
    const Interpolation& interpolation = solver_->interpolations_[k];
    smooth(k, true);
    Room& below = levels_[k + 1];
    const bool coarsest = k + 2 == levels_.size();
    const double unit_below = coarsest ? solver_->coarsest_unit_ : solver_->levels_[k + 1].matrix.unit;
    const auto share = static_cast<float>(solver_->levels_[k].matrix.unit / unit_below);
    // The matrix below is that much too small for the residual from here.
    std::vector<Value>& right = coarsest ? below.solution : below.residual;
    for_rows(team, right.size(),
             [&](std::size_t i) { right[i] = row_times(interpolation.down, i, room.residual) / share; });
    if (coarsest) {
      solve_coarsest(below.solution);
    } else {
      descend(k + 1);
    }
    for_rows(team, room.step.size(), [&](std::size_t i) {
      room.step[i] = row_times(interpolation.up, i, below.solution);
      room.solution[i] += room.step[i];
    });
    multiply<Value>(team, solver_->levels_[k].matrix, room.step, between_,
                    [&](std::size_t i, const Value& image) { room.residual[i] -= image; });
    smooth(k, false);
  }

  /// Chebyshev iteration from the residual; from a solution of zero at first. The last residual is only worked out
  /// before going down.
  void smooth(std::size_t k, bool first) {
    ThreadTeam& team = *solver_->team_;
    const Level& level = solver_->levels_[k];
    Room& room = levels_[k];
    const double middle = 0.5 * (1 + smoothed_from) * level.greatest;
    const double radius = 0.5 * (1 - smoothed_from) * level.greatest;
    double rho = radius / middle;
    for (int step = 0; step < degree; ++step) {
      const double before = rho;
      if (step > 0) rho = 1 / (2 * middle / radius - before);
      const auto keep = static_cast<float>(step == 0 ? 0 : rho * before);
      const auto take = static_cast<float>(step == 0 ? 1 / middle : 2 * rho / radius);
      for_rows(team, room.step.size(), [&](std::size_t i) {
        const Value correction = take * level.inverse_diagonal[i] * room.residual[i];
        room.step[i] = step == 0 ? correction : Value(keep * room.step[i] + correction);
        room.solution[i] = first && step == 0 ? room.step[i] : Value(room.solution[i] + room.step[i]);
      });
      if (!first && step + 1 == degree) break;
      multiply<Value>(team, level.matrix, room.step, between_,
                      [&](std::size_t i, const Value& image) { room.residual[i] -= image; });
    }
  }

  void solve_coarsest(std::vector<Value>& values) {
    using Wide = std::conditional_t<std::is_same_v<Value, One>, double, Vector3>;
    std::vector<Wide> wide_values(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      if constexpr (std::is_same_v<Value, One>)
        wide_values[i] = values[i];
      else
        wide_values[i] = values[i].template head<3>().matrix().template cast<double>();
    }
    solver_->coarsest_.solve(std::span<Wide>(wide_values), 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if constexpr (std::is_same_v<Value, One>)
        values[i] = static_cast<float>(wide_values[i]);
      else
        values[i].template head<3>() = wide_values[i].template cast<float>().array();
    }
  }

  MultigridSolver* solver_;
  std::vector<Room> levels_;
  std::vector<Value> between_;
};

template <typename Values>
void MultigridSolver::solve_any(Values values, double enough) {
  using Value = std::conditional_t<std::is_same_v<typename Values::element_type, double>, One, Three>;
  constexpr bool single = std::is_same_v<Value, One>;
  const std::size_t rows = values.size();
  std::vector<Value> residual(rows, zero<Value>());
  std::vector<Value> solution(rows, zero<Value>());
  std::vector<Value> direction(rows);
  std::vector<Value> preconditioned(rows);
  std::vector<Value> image(rows);
  for_rows(*team_, rows, [&](std::size_t i) {
    if constexpr (single)
      residual[i] = static_cast<float>(values[i]);
    else
      residual[i].template head<3>() = values[i].template cast<float>().array();
  });
  Cycle<Value> cycle(*this);
  std::vector<Value> between;
  Sum<Value> size = wide<Value>(zero<Value>());
  double wanted = enough;
  for (iterations_ = 0; iterations_ < most_iterations; ++iterations_) {
    cycle.apply(residual, preconditioned);
    // What is still missing, as far as one cycle can tell.
    const double missing = greatest<Value>(*team_, preconditioned);
    wanted = std::max(wanted, reduction_ * missing);
    const Sum<Value> next_size = dot<Value>(*team_, residual, preconditioned);
    const Value keep = narrow<Value>(ratio<Value>(next_size, size));
    for_rows(*team_, rows, [&](std::size_t i) {
      direction[i] = iterations_ == 0 ? preconditioned[i] : Value(preconditioned[i] + keep * direction[i]);
    });
    size = next_size;
    if (!(missing > wanted)) {
      // That far it does no harm to believe it.
      for_rows(*team_, rows, [&](std::size_t i) { solution[i] += preconditioned[i]; });
      break;
    }
    multiply<Value>(*team_, levels_.front().matrix, direction, between,
                    [&](std::size_t i, const Value& one) { image[i] = one; });
    const Value share = narrow<Value>(ratio<Value>(size, dot<Value>(*team_, direction, image)));
    for_rows(*team_, rows, [&](std::size_t i) {
      solution[i] += share * direction[i];
      residual[i] -= share * image[i];
    });
  }
  for_rows(*team_, rows, [&](std::size_t i) {
    if constexpr (single)
      values[i] = solution[i];
    else
      values[i] = solution[i].template head<3>().matrix().template cast<double>();
  });
}

}  // namespace vspring
