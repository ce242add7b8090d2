#include "linear/ball_program.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>

#include "base/cancellation.hpp"
#include "linear/band_triangle.hpp"

namespace vspring {

namespace {

constexpr int most_steps = 80;
// Relative to the objective.
constexpr double enough_gap = 1e-6;
constexpr double next_to_nothing_left = 1e-5;
// Relative to the bounds.
constexpr double enough_miss = 1e-6;
// Relative to the gradient of the objective at the start.
constexpr double enough_balance = 1e-6;
// As a share of half a bound.
constexpr double first_slack = 0.1;
constexpr double first_gap = 0.1;
// Rows beyond this share of their bound take part in a step, others not yet.
constexpr double near_share = 0.9;
// If bounds are fewer, all take part from the start: that costs little.
constexpr std::size_t few_bounds = 2000;
// Number of successive windows of whose rows the furthest out takes part from the start.
constexpr std::uint32_t windows_together = 8;
// Relative to the objective.
constexpr double hopeless_gap = 1e4;
// Share of the way to where a slack or a multiplier vanishes.
constexpr double share_to_bound = 0.99;
// As a share of the greatest entry, so that no unknown is without a row.
constexpr double least_diagonal = 1e-12;

template <int K>
class InteriorPoint {
  using Row = typename BallProgram<K>::Row;
  using Value = Eigen::Matrix<double, K, 1>;
  using Local = Eigen::Matrix<double, 4 * K, 1>;

  /// The state of a bounded row.
  struct Bound {
    std::size_t row;
    std::size_t first;  ///< block of the row
    double slack = 0;
    double multiplier = 0;
    double slack_step = 0;
    double multiplier_step = 0;
    double target = 0;  ///< of slack · multiplier, less the product of the predictor's steps
    double bend = 0;    ///< the part of the bound that the predictor misses, as it is not linear
    // Of bounds with a price, which is multiplier + spare.
    double beyond = 0;
    double spare = 0;
    double beyond_step = 0;
    double beyond_target = 0;  ///< of beyond · spare, likewise
  };

 public:
  explicit InteriorPoint(const BallProgram<K>& program)
      : program_(program),
        x_(program.blocks * K, 0),
        step_(x_.size()),
        gradient_(x_.size()),
        values_(program.rows.size()),
        objective_triangle_(x_.size(), width_of(program)),
        triangle_(x_.size(), width_of(program)) {
    for (std::size_t r = 0; r < program.rows.size(); ++r) {
      if (program.rows[r].bound > 0) left_out_.push_back(r);
      has_prices_ = has_prices_ || program.rows[r].price > 0;
    }
  }

  BallSolution run() {
    BallSolution result;
    begin();
    begin_triangle();
    for (; result.steps < most_steps; ++result.steps) {
      end_if_cancelled();
      find_gradient();
      const double gap = this->gap();
      if (is_done(gap)) {
        result.found = true;
        break;
      }
      // Multipliers that grow so far mean that bounds cannot be kept; a price limits them.
      if (!has_prices_ && !(gap <= hopeless_gap * std::max(objective_, next_to_nothing_left * first_objective_))) break;
      factor();
      for (Bound& bound : bounds_) bound.target = bound.beyond_target = bound.bend = 0;
      find_step();
      if (!bounds_.empty()) {
        // The predictor goes straight for the optimum; its step decides how far to aim.
        const double ahead = std::min(1.0, share_of_step());
        double after = 0;
        std::size_t products = 0;
        for (const Bound& bound : bounds_) {
          after += (bound.slack + ahead * bound.slack_step) * (bound.multiplier + ahead * bound.multiplier_step);
          after += (bound.beyond + ahead * bound.beyond_step) * (bound.spare - ahead * bound.multiplier_step);
          products += has_price(bound) ? 2 : 1;
        }
        const double centre = gap > 0 ? std::pow(after / gap, 3) * gap / static_cast<double>(products) : 0;
        for (Bound& bound : bounds_) {
          const Row& row = program_.rows[bound.row];
          bound.target = centre - bound.slack_step * bound.multiplier_step;
          bound.beyond_target = centre + bound.beyond_step * bound.multiplier_step;
          bound.bend = change(row).squaredNorm() / (2 * row.bound);
        }
        find_step();
      }
      const double share = bounds_.empty() ? 1 : std::min(1.0, share_to_bound * share_of_step());
      for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += share * step_[i];
      for (Bound& bound : bounds_) {
        bound.slack += share * bound.slack_step;
        bound.multiplier += share * bound.multiplier_step;
        if (!has_price(bound)) continue;
        bound.beyond += share * bound.beyond_step;
        bound.spare -= share * bound.multiplier_step;
      }
      find_values();
      take_in_near();
    }
    result.x = x_;
    for (const Value& value : values_) result.distances.push_back(value.norm());
    result.multipliers.assign(program_.rows.size(), 0);
    for (const Bound& bound : bounds_) result.multipliers[bound.row] = bound.multiplier;
    return result;
  }

 private:
  static std::size_t width_of(const BallProgram<K>& program) {
    std::int32_t width = 0;
    for (const auto& window : program.windows) {
      for (const std::int32_t a : window) {
        for (const std::int32_t b : window) {
          if (a >= 0 && b >= 0) width = std::max(width, a - b);
        }
      }
    }
    return static_cast<std::size_t>(K) * (static_cast<std::size_t>(width) + 1);
  }

  void begin() {
    find_values();
    take_in_first();
    double objective = 0;
    for (std::size_t r = 0; r < values_.size(); ++r) objective += program_.rows[r].weight * values_[r].squaredNorm();
    const double target = first_gap * objective / static_cast<double>(std::max<std::size_t>(bounds_.size(), 1));
    for (Bound& bound : bounds_) {
      begin(bound, target);
      if (!has_price(bound)) continue;
      const double price = program_.rows[bound.row].price;
      bound.multiplier = std::min(bound.multiplier, price / 2);
      bound.spare = price - bound.multiplier;
      bound.beyond = std::max(excess(bound) + bound.slack, first_slack * program_.rows[bound.row].bound / 2);
    }
  }

  /// target: of slack · multiplier.
  void begin(Bound& bound, double target) const {
    bound.slack = std::max(-excess(bound), first_slack * program_.rows[bound.row].bound / 2);
    bound.multiplier = target / bound.slack;
  }

  /// Takes in the rows that take part from the start: near their bounds, or furthest out among those around.
  void take_in_first() {
    std::vector<std::uint8_t> taken(values_.size(), 0);
    std::array<std::size_t, 1U << K> furthest{};
    std::array<double, 1U << K> shares;
    shares.fill(-1);
    std::uint32_t windows = 0;
    const bool all = has_prices_ || left_out_.size() < few_bounds;
    const auto take_furthest = [&] {
      for (std::size_t s = 0; s < shares.size(); ++s) {
        if (shares[s] >= 0) taken[furthest[s]] = 1;
        shares[s] = -1;
      }
    };
    std::vector<std::size_t> order = left_out_;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return program_.rows[a].window < program_.rows[b].window; });
    for (const std::size_t r : order) {
      const Row& row = program_.rows[r];
      if (row.window / windows_together != windows) take_furthest();
      windows = row.window / windows_together;
      const double share = values_[r].norm() / row.bound;
      if (share >= near_share || all) taken[r] = 1;
      std::size_t sector = 0;
      for (int k = 0; k < K; ++k) sector += values_[r][k] > 0 ? std::size_t{1} << k : 0;
      if (!(share > shares[sector])) continue;
      shares[sector] = share;
      furthest[sector] = r;
    }
    take_furthest();
    std::erase_if(left_out_, [&](std::size_t r) {
      if (taken[r] != 0) bounds_.push_back({r, first_block(program_.rows[r])});
      return taken[r] != 0;
    });
    std::sort(bounds_.begin(), bounds_.end(), is_before);
  }

  /// Takes in the rows that have come near their bounds since.
  void take_in_near() {
    if (left_out_.empty()) return;
    const auto before = static_cast<std::ptrdiff_t>(bounds_.size());
    const double target = gap() / static_cast<double>(before);
    std::erase_if(left_out_, [&](std::size_t r) {
      const Row& row = program_.rows[r];
      if (values_[r].squaredNorm() < std::pow(near_share * row.bound, 2)) return false;
      bounds_.push_back({r, first_block(row)});
      begin(bounds_.back(), target);
      return true;
    });
    std::sort(bounds_.begin() + before, bounds_.end(), is_before);
    std::inplace_merge(bounds_.begin(), bounds_.begin() + before, bounds_.end(), is_before);
  }

  /// In the order of their first unknown, rows need few rotations each.
  static bool is_before(const Bound& a, const Bound& b) {
    return a.first != b.first ? a.first < b.first : a.row < b.row;
  }

  [[nodiscard]] bool has_price(const Bound& bound) const { return program_.rows[bound.row].price > 0; }

  /// (|value|² − bound²) / (2 bound) plus its slack, less what is paid for; must vanish.
  [[nodiscard]] double miss(const Bound& bound) const {
    return excess(bound) + bound.slack - bound.beyond + bound.bend;
  }

  /// How fast the multiplier grows with the value.
  [[nodiscard]] double steepness(const Bound& bound) const {
    return 1 / (bound.slack / bound.multiplier + (has_price(bound) ? bound.beyond / bound.spare : 0));
  }

  /// The growth of the multiplier at a fixed value, over its steepness.
  [[nodiscard]] double pull(const Bound& bound) const {
    const double paid = has_price(bound) ? bound.beyond_target / bound.spare - bound.beyond : 0;
    return miss(bound) + bound.target / bound.multiplier - bound.slack - paid;
  }

  [[nodiscard]] Value product(const Row& row, const std::vector<double>& x) const {
    Value sum = Value::Zero();
    const auto& window = program_.windows[row.window];
    for (int b = 0; b < 4; ++b) {
      if (window[b] < 0) continue;
      const auto first = static_cast<std::size_t>(window[b]) * K;
      for (int k = 0; k < K; ++k) sum += row.entries.col(b * K + k) * x[first + k];
    }
    return sum;
  }

  [[nodiscard]] Value change(const Row& row) const { return product(row, step_); }

  void find_values() {
    for (std::size_t r = 0; r < values_.size(); ++r)
      values_[r] = program_.rows[r].offset + product(program_.rows[r], x_);
  }

  /// (|value|² − bound²) / (2 bound), which must be negative.
  [[nodiscard]] double excess(const Bound& bound) const {
    const double most = program_.rows[bound.row].bound;
    return (values_[bound.row].squaredNorm() - most * most) / (2 * most);
  }

  /// The derivative of excess() by the value.
  [[nodiscard]] Value slope(const Bound& bound) const { return values_[bound.row] / program_.rows[bound.row].bound; }

  void add_to(std::vector<double>& right, const Row& row, const Value& factor) const {
    const Local product = row.entries.transpose() * factor;
    const auto& window = program_.windows[row.window];
    for (int b = 0; b < 4; ++b) {
      if (window[b] < 0) continue;
      for (int k = 0; k < K; ++k) right[static_cast<std::size_t>(window[b]) * K + k] += product[b * K + k];
    }
  }

  /// Finds the gradient of the Lagrangian, and its size without the bounds.
  void find_gradient() {
    std::fill(gradient_.begin(), gradient_.end(), 0);
    objective_ = 0;
    for (std::size_t r = 0; r < values_.size(); ++r) {
      const Row& row = program_.rows[r];
      if (row.weight == 0) continue;
      add_to(gradient_, row, row.weight * values_[r]);
      objective_ += row.weight * values_[r].squaredNorm();
    }
    first_objective_ = std::max(first_objective_, objective_);
    for (const double one : gradient_) size_ = std::max(size_, std::abs(one));
    for (const Bound& bound : bounds_) add_to(gradient_, program_.rows[bound.row], bound.multiplier * slope(bound));
  }

  [[nodiscard]] double gap() const {
    double sum = 0;
    for (const Bound& bound : bounds_) sum += bound.slack * bound.multiplier + bound.beyond * bound.spare;
    return sum;
  }

  [[nodiscard]] bool is_done(double gap) const {
    double left = 0;
    for (const double one : gradient_) left = std::max(left, std::abs(one));
    if (!(left <= enough_balance * size_)) return false;
    if (!(gap <= enough_gap * std::max(objective_, next_to_nothing_left * first_objective_))) return false;
    return std::all_of(bounds_.begin(), bounds_.end(), [&](const Bound& bound) {
      return excess(bound) - bound.beyond <= enough_miss * program_.rows[bound.row].bound;
    });
  }

  /// Rows of the objective are the same in every step.
  void begin_triangle() {
    double greatest = 0;
    // Per block the first row that begins with it, with rows in the order of their first unknown.
    std::vector<std::size_t> begins(program_.blocks + 2, 0);
    for (const Row& row : program_.rows) {
      if (!(row.weight > 0)) continue;
      greatest = std::max(greatest, std::sqrt(row.weight) * row.entries.cwiseAbs().maxCoeff());
      ++begins[first_block(row) + 1];
    }
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<std::size_t> order(begins.back());
    for (std::size_t r = 0; r < program_.rows.size(); ++r) {
      if (program_.rows[r].weight > 0) order[begins[first_block(program_.rows[r])]++] = r;
    }
    objective_triangle_.clear(least_diagonal * greatest);
    for (const std::size_t r : order) add(objective_triangle_, program_.rows[r], std::sqrt(program_.rows[r].weight));
  }

  [[nodiscard]] std::size_t first_block(const Row& row) const {
    std::size_t first = program_.blocks;
    for (const std::int32_t block : program_.windows[row.window]) {
      if (block >= 0) first = std::min(first, static_cast<std::size_t>(block));
    }
    return first;
  }

  void factor() {
    triangle_.clear(0);
    std::size_t next = 0;
    for (std::size_t column = 0; column < triangle_.size(); ++column) {
      triangle_.add(column, objective_triangle_.row(column), 1);
      if (column % K != 0) continue;
      for (; next < bounds_.size() && bounds_[next].first * K <= column; ++next) add(bounds_[next]);
    }
  }

  void add(const Bound& bound) {
    const Row& row = program_.rows[bound.row];
    const Value across = slope(bound);
    const auto& window = program_.windows[row.window];
    const double alike = bound.multiplier / row.bound;
    const double steep = steepness(bound);
    if constexpr (K == 1) {
      // Both are multiples of the same row.
      add_row(triangle_, window, row.entries, std::sqrt(alike + steep * across.squaredNorm()));
    } else {
      add(triangle_, row, std::sqrt(alike));
      add_row(triangle_, window, across.transpose() * row.entries, std::sqrt(steep));
    }
  }

  void add(BandTriangle& triangle, const Row& row, double factor) const {
    for (int k = 0; k < K; ++k) add_row(triangle, program_.windows[row.window], row.entries.row(k), factor);
  }

  void add_row(BandTriangle& triangle, const typename BallProgram<K>::Window& window,
               const Eigen::Matrix<double, 1, 4 * K>& entries, double factor) const {
    std::int32_t first = std::numeric_limits<std::int32_t>::max();
    for (const std::int32_t block : window) {
      if (block >= 0) first = std::min(first, block);
    }
    if (first == std::numeric_limits<std::int32_t>::max() || !(factor > 0)) return;
    BandTriangle::Row row{};
    for (int b = 0; b < 4; ++b) {
      const std::int32_t block = window[static_cast<std::size_t>(b)];
      if (block < 0) continue;
      for (int k = 0; k < K; ++k)
        row[static_cast<std::size_t>(block - first) * K + static_cast<std::size_t>(k)] += entries[b * K + k];
    }
    triangle.add(static_cast<std::size_t>(first) * K, row, factor);
  }

  void find_step() {
    for (std::size_t i = 0; i < step_.size(); ++i) step_[i] = -gradient_[i];
    for (const Bound& bound : bounds_)
      add_to(step_, program_.rows[bound.row], -steepness(bound) * pull(bound) * slope(bound));
    triangle_.solve(std::span(step_));
    for (Bound& bound : bounds_) {
      const double rise = slope(bound).dot(change(program_.rows[bound.row]));
      bound.multiplier_step = steepness(bound) * (rise + pull(bound));
      bound.slack_step = (bound.target - bound.slack * bound.multiplier_step) / bound.multiplier - bound.slack;
      if (has_price(bound))
        bound.beyond_step = (bound.beyond_target + bound.beyond * bound.multiplier_step) / bound.spare - bound.beyond;
    }
  }

  [[nodiscard]] double share_of_step() const {
    double share = 1 / share_to_bound;
    for (const Bound& bound : bounds_) {
      if (bound.slack_step < 0) share = std::min(share, -bound.slack / bound.slack_step);
      if (bound.multiplier_step < 0) share = std::min(share, -bound.multiplier / bound.multiplier_step);
      if (!has_price(bound)) continue;
      if (bound.beyond_step < 0) share = std::min(share, -bound.beyond / bound.beyond_step);
      if (bound.multiplier_step > 0) share = std::min(share, bound.spare / bound.multiplier_step);
    }
    return share;
  }

  const BallProgram<K>& program_;
  std::vector<double> x_;
  std::vector<double> step_;
  std::vector<double> gradient_;
  std::vector<Value> values_;
  std::vector<Bound> bounds_;
  std::vector<std::size_t> left_out_;  // rows with bounds that do not take part yet
  BandTriangle objective_triangle_;
  BandTriangle triangle_;
  bool has_prices_ = false;
  double objective_ = 0;
  double first_objective_ = 0;
  double size_ = 0;
};

}  // namespace

template <int K>
BallSolution solve(const BallProgram<K>& program) {
  return InteriorPoint<K>(program).run();
}

template BallSolution solve<1>(const BallProgram<1>&);
template BallSolution solve<2>(const BallProgram<2>&);

}  // namespace vspring
