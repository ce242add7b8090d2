#include "linear/multigrid_solver.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "base/inlined.hpp"

namespace vspring {

namespace {

constexpr std::size_t rows_per_task = 4096;
constexpr int degree = 2;
constexpr int most_iterations = 60;
// The smoother damps eigenvalues from this share of the greatest on.
constexpr double smoothed_from = 1.0 / 12;
constexpr int power_steps = 10;
constexpr int further_power_steps = 2;
// The power iteration stays below the greatest eigenvalue.
constexpr double power_margin = 1.15;

/// The values of a node, for one column or for three.
using One = float;
using Three = Eigen::Array3f;

template <typename Value>
Value zero() {
  if constexpr (std::is_same_v<Value, One>)
    return 0;
  else
    return Three::Zero();
}

template <typename Body>
void for_rows(ThreadTeam& team, std::size_t rows, const Body& body) {
  parallel_each(team, rows, rows_per_task, body);
}

/// The sum in double precision.
template <typename Value>
using Sum = std::conditional_t<std::is_same_v<Value, One>, double, Eigen::Array3d>;

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
VSPRING_INLINE Value row_times(const FloatRows& matrix, std::size_t i, const std::vector<Value>& values) {
  Value sum = zero<Value>();
  for (const FloatRows::Entry& entry : matrix.row(i)) sum += entry.value * values[entry.column];
  return sum;
}

template <typename Value, typename Matrix>
VSPRING_INLINE Value row_times(const Matrix& matrix, std::size_t i, const std::vector<Value>& values) {
  Sum<Value> sum = wide<Value>(zero<Value>());
  matrix.for_row(i, [&](std::size_t column, double value) { sum += value * wide<Value>(values[column]); });
  return narrow<Value>(sum);
}

template <typename Value>
VSPRING_INLINE Value row_times(const GraphLaplacian& matrix, std::size_t i, const std::vector<Value>& values) {
  Value sum = zero<Value>();
  float spokes = 0;
  matrix.for_neighbours(i, [&](std::size_t j) {
    spokes += 1;
    if (j < values.size()) sum += values[j];
  });
  return std::max(spokes, 1.0F) * values[i] - sum;
}

/// Sums in fixed pieces, so the bits do not depend on threads.
template <typename Value>
Sum<Value> dot(ThreadTeam& team, const std::vector<Value>& a, const std::vector<Value>& b) {
  Sum<Value> nothing = wide<Value>(zero<Value>());
  const auto add = [&](std::size_t begin, std::size_t end, Sum<Value>& part) {
    Sum<Value> sum = nothing;
    for (std::size_t i = begin; i < end; ++i) sum += wide<Value>(a[i]) * wide<Value>(b[i]);
    part = sum;
  };
  Sum<Value> total = nothing;
  for (const Sum<Value>& part : parallel_parts(team, a.size(), rows_per_task, nothing, add)) total += part;
  return total;
}

/// The greatest length of a value.
template <typename Value>
double greatest(ThreadTeam& team, const std::vector<Value>& values) {
  const auto find = [&](std::size_t begin, std::size_t end, float& part) {
    float square = 0;
    for (std::size_t i = begin; i < end; ++i) {
      if constexpr (std::is_same_v<Value, One>) {
        square = std::max(square, values[i] * values[i]);
      } else {
        square = std::max(square, values[i].square().sum());
      }
    }
    part = square;
  };
  const std::vector<float> parts = parallel_parts(team, values.size(), rows_per_task, 0.0F, find);
  return std::sqrt(*std::max_element(parts.begin(), parts.end()));
}

template <typename Value>
Sum<Value> ratio(const Sum<Value>& a, const Sum<Value>& b) {
  if constexpr (std::is_same_v<Value, One>)
    return b > 0 ? a / b : 0;
  else
    return (b > 0).select(a / b, Sum<Value>::Zero());
}

/// Calls then(i, y_i) for every i of y = matrix · values. room: a buffer for the product with the first factor.
template <typename Value, typename Then>
void multiply(ThreadTeam& team, const LevelMatrix& matrix, const std::vector<Value>& values, std::vector<Value>& room,
              const Then& then) {
  const auto multiply_by = [&](const auto& one) {
    if constexpr (std::is_same_v<decltype(one), const FactoredMatrix&>) {
      room.resize(one.inner_size());
      for_rows(team, room.size(), [&](std::size_t i) {
        Value sum = zero<Value>();
        one.for_row(i, [&](std::size_t j, float value) { sum += value * values[j]; });
        room[i] = sum;
      });
      for_rows(team, values.size(), [&](std::size_t i) {
        Value sum = zero<Value>();
        one.for_column(i, [&](std::size_t j, float value) { sum += value * room[j]; });
        then(i, sum);
      });
    } else {
      for_rows(team, values.size(), [&](std::size_t i) { then(i, row_times(one, i, values)); });
    }
  };
  std::visit(multiply_by, matrix);
}

std::size_t size_of(const LevelMatrix& matrix) {
  return std::visit([](const auto& one) { return one.size(); }, matrix);
}

}  // namespace

MultigridSolver::MultigridSolver(std::span<const Interpolation> interpolations, ThreadTeam& team)
    : interpolations_(interpolations), team_(&team), coarsest_(team) {}

void MultigridSolver::build(LevelMatrix finest) {
  levels_.clear();
  add_level(std::move(finest));
  for (const Interpolation& between : interpolations_.first(interpolations_.size() - 1))
    add_level(AssembledMatrix(between.down, levels_.back().matrix, between.up, *team_));
  const Interpolation& last = interpolations_.back();
  coarsest_.build(galerkin(last.down, levels_.back().matrix, last.up, *team_));
}

void MultigridSolver::add_level(LevelMatrix matrix) {
  levels_.push_back({.matrix = std::move(matrix)});
  scale(levels_.back());
  // Only the matrix of the finest level is replaced and needs this again.
  if (levels_.size() > 1) levels_.back().rough = std::vector<float>();
}

void MultigridSolver::replace_finest(LevelMatrix matrix) {
  levels_.front().matrix = std::move(matrix);
  scale(levels_.front());
}

void MultigridSolver::scale(Level& level) const {
  const std::size_t rows = size_of(level.matrix);
  level.inverse_diagonal.resize(rows);
  std::visit(
      [&](const auto& matrix) {
        for_rows(*team_, rows, [&](std::size_t i) {
          level.inverse_diagonal[i] = 1 / std::max(static_cast<float>(matrix.diagonal(i)), 1e-30F);
        });
      },
      level.matrix);
  const bool first = level.rough.empty();
  if (first) {
    // A rough vector that is no eigenvector of any shape.
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

/// A V-cycle and its buffers.
template <typename Value>
class MultigridSolver::Cycle {
 public:
  /// first: the level on which it begins.
  explicit Cycle(MultigridSolver& solver, std::size_t first = 0)
      : solver_(&solver), first_(first), levels_(solver.levels_.size() + 1) {
    for (std::size_t k = first; k < levels_.size(); ++k) {
      const std::size_t rows = k == 0 ? size_of(solver.levels_[0].matrix) : solver.interpolations_[k - 1].up.columns();
      levels_[k].solution.resize(rows);
      if (k + 1 == levels_.size()) break;
      levels_[k].residual.resize(rows);
      levels_[k].step.resize(rows);
    }
  }

  /// solution() ≈ matrix⁻¹ right(), a symmetric operator; right() is used up.
  void apply() { descend(first_); }
  std::vector<Value>& right() { return levels_[first_].residual; }
  [[nodiscard]] const std::vector<Value>& solution() const { return levels_[first_].solution; }
  /// Free between cycles.
  std::vector<Value>& spare() { return levels_[first_].step; }
  std::vector<Value>& between() { return between_; }

 private:
  struct Room {
    std::vector<Value> residual;
    std::vector<Value> solution;
    std::vector<Value> step;
  };

  /// Solves for the right side in `residual`; the result is in `solution`.
  void descend(std::size_t k) {
    Room& room = levels_[k];
    ThreadTeam& team = *solver_->team_;
    const Interpolation& interpolation = solver_->interpolations_[k];
    smooth(k, true);
    Room& below = levels_[k + 1];
    const bool coarsest = k + 2 == levels_.size();
    std::vector<Value>& right = coarsest ? below.solution : below.residual;
    for_rows(team, right.size(), [&](std::size_t i) { right[i] = row_times(interpolation.down, i, room.residual); });
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

  /// Chebyshev iteration from the residual; first: from a zero solution. The last residual is computed only before
  /// going down.
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
    solver_->coarsest_.solve(std::span<Wide>(wide_values), {});
    for (std::size_t i = 0; i < values.size(); ++i) {
      if constexpr (std::is_same_v<Value, One>)
        values[i] = static_cast<float>(wide_values[i]);
      else
        values[i].template head<3>() = wide_values[i].template cast<float>().array();
    }
  }

  MultigridSolver* solver_;
  std::size_t first_;
  std::vector<Room> levels_;
  std::vector<Value> between_;
};

namespace {

float narrowed(double value) { return static_cast<float>(value); }
Three narrowed(const Vector3& value) {
  Three result = Three::Zero();
  result.head<3>() = value.cast<float>().array();
  return result;
}

void widen(float value, double& result) { result = static_cast<double>(value); }
void widen(const Three& value, Vector3& result) { result = value.head<3>().matrix().cast<double>(); }

}  // namespace

void MultigridSolver::solve(std::span<double> values, const Accuracy& accuracy) {
  Cycle<One> cycle(*this);
  solve_any(cycle, values, accuracy);
}

void MultigridSolver::solve(std::span<Vector3> values, const Accuracy& accuracy) {
  Cycle<Three> cycle(*this);
  solve_any(cycle, values, accuracy);
}

bool MultigridSolver::solve_coarser(std::span<Vector3> values) {
  if (levels_.size() == 1) {
    coarsest_.solve(values, {});
    return true;
  }
  Cycle<Three> cycle(*this, 1);
  for_rows(*team_, values.size(), [&](std::size_t i) { cycle.right()[i] = narrowed(values[i]); });
  cycle.apply();
  for_rows(*team_, values.size(), [&](std::size_t i) { widen(cycle.solution()[i], values[i]); });
  return true;
}

template <typename Value, typename Values>
void MultigridSolver::solve_any(Cycle<Value>& cycle, Values values, const Accuracy& accuracy) {
  const std::size_t rows = values.size();
  for_rows(*team_, rows, [&](std::size_t i) { cycle.right()[i] = narrowed(values[i]); });
  cycle.apply();
  // The remaining error, as one more cycle estimates it.
  double missing = greatest<Value>(*team_, cycle.solution());
  const double wanted = std::max(accuracy.enough, accuracy.share * missing);
  if (!(missing > wanted)) {
    for_rows(*team_, rows, [&](std::size_t i) { widen(cycle.solution()[i], values[i]); });
    return;
  }
  std::vector<Value> residual(rows);
  std::vector<Value> solution(rows, zero<Value>());
  std::vector<Value> direction(rows, zero<Value>());
  for_rows(*team_, rows, [&](std::size_t i) { residual[i] = narrowed(values[i]); });
  Sum<Value> size = wide<Value>(zero<Value>());
  for (int iteration = 0; iteration < most_iterations && missing > wanted; ++iteration) {
    const Sum<Value> next_size = dot<Value>(*team_, residual, cycle.solution());
    const Value keep = narrow<Value>(ratio<Value>(next_size, size));
    size = next_size;
    for_rows(*team_, rows, [&](std::size_t i) { direction[i] = cycle.solution()[i] + keep * direction[i]; });
    std::vector<Value>& image = cycle.spare();
    multiply<Value>(*team_, levels_.front().matrix, direction, cycle.between(),
                    [&](std::size_t i, const Value& one) { image[i] = one; });
    const Value share = narrow<Value>(ratio<Value>(size, dot<Value>(*team_, direction, image)));
    for_rows(*team_, rows, [&](std::size_t i) {
      solution[i] += share * direction[i];
      residual[i] -= share * image[i];
      cycle.right()[i] = residual[i];
    });
    cycle.apply();
    missing = greatest<Value>(*team_, cycle.solution());
  }
  // At this accuracy the last cycle can be added unchecked.
  for_rows(*team_, rows, [&](std::size_t i) { widen(solution[i] + cycle.solution()[i], values[i]); });
}

}  // namespace vspring
