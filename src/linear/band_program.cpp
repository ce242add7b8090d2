#include "linear/band_program.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vspring {

namespace {

constexpr int most_interior_steps = 40;
// Of the objective: what may be left of the gap to the optimum.
constexpr double enough_gap = 1e-4;
// Of the objective at the start.
constexpr double next_to_nothing_left = 1e-6;
// Of the bounds.
constexpr double enough_miss = 1e-6;
// Multipliers that grow so far have no bounds to go to.
constexpr double hopeless_gap = 1e4;
constexpr double first_slack = 0.1;
// Of the way to the nearest bound.
constexpr double share_to_bound = 0.99;
// Of the greatest entry, so that no unknown is left without a row.
constexpr double least_diagonal = 1e-9;

/// The triangle R of an orthogonal factorisation of rows that come in the order of their first unknown: Rᵀ R is the sum
/// of their squares, whose condition it does not square.
class BandTriangle {
 public:
  BandTriangle(std::size_t size, std::size_t width) : rows_(size), width_(width) {}

  void clear(double diagonal) {
    for (auto& row : rows_) {
      row.fill(0);
      row[0] = diagonal;
    }
  }

  void add(const BandRow& row, double factor) {
    std::array<double, BandRow::most_width> left = row.entries;
    for (double& entry : left) entry *= factor;
    std::size_t rest = width_;
    for (std::size_t column = row.first; column < rows_.size() && rest > 0; ++column) {
      auto& above = rows_[column];
      if (left[0] != 0) {
        const double length = std::sqrt(above[0] * above[0] + left[0] * left[0]);
        const double cosine = above[0] / length;
        const double sine = left[0] / length;
        above[0] = length;
        for (std::size_t k = 1; k < width_; ++k) {
          const double a = above[k];
          above[k] = cosine * a + sine * left[k];
          left[k] = cosine * left[k] - sine * a;
        }
      } else {
        --rest;
      }
      for (std::size_t k = 0; k + 1 < width_; ++k) left[k] = left[k + 1];
      left[width_ - 1] = 0;
    }
  }

  void solve(std::span<double> right) const {
    const std::size_t size = rows_.size();
    for (std::size_t i = 0; i < size; ++i) {
      right[i] /= rows_[i][0];
      for (std::size_t k = 1; k < width_ && i + k < size; ++k) right[i + k] -= rows_[i][k] * right[i];
    }
    for (std::size_t i = size; i-- > 0;) {
      for (std::size_t k = 1; k < width_ && i + k < size; ++k) right[i] -= rows_[i][k] * right[i + k];
      right[i] /= rows_[i][0];
    }
  }

 private:
  std::vector<std::array<double, BandRow::most_width>> rows_;
  std::size_t width_;
};

/// sign · row + constant ≥ 0.
struct Bound {
  double sign;
  double constant;
  double slack = 0;
  double multiplier = 0;
  double miss = 0;
  double slack_step = 0;
  double multiplier_step = 0;
  double target = 0;  ///< of slack · multiplier, less what the predictor makes of their steps
};

class InteriorPoint {
 public:
  explicit InteriorPoint(const BandProgram& program)
      : program_(program),
        width_(program.width),
        x_(program.size, 0),
        step_(program.size, 0),
        triangle_(program.size, program.width) {
    rows_.reserve(program.between.size() + program.positive.size());
    for (const BandRow& row : program.between) rows_.push_back(&row);
    for (const BandRow& row : program.positive) rows_.push_back(&row);
    bounds_of_.resize(rows_.size() + 1);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      bounds_of_[k] = bounds_.size();
      if (k < program.between.size()) {
        bounds_.push_back({1, 1});
        bounds_.push_back({-1, 1});
      } else {
        bounds_.push_back({1, 0});
      }
    }
    bounds_of_[rows_.size()] = bounds_.size();
    order_.resize(program.terms.size() + rows_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return row(a).first < row(b).first; });
  }

  BandSolution run() {
    BandSolution result;
    scale_terms();
    const auto count = static_cast<double>(std::max<std::size_t>(bounds_.size(), 1));
    const double first = 0.1 / count;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const double value = at(*rows_[k], x_) + rows_[k]->offset;
      for (std::size_t b = bounds_of_[k]; b < bounds_of_[k + 1]; ++b) {
        Bound& bound = bounds_[b];
        bound.slack = std::max(bound.sign * value + bound.constant, first_slack);
        bound.multiplier = first / bound.slack;
      }
    }
    for (int step = 0; step < most_interior_steps; ++step) {
      renew_misses();
      const double gap = complementarity();
      const double objective = scale_ * sum_of_terms();
      result.miss = greatest_miss();
      if (result.miss < enough_miss && gap < enough_gap * std::max(objective, next_to_nothing_left) &&
          dual_miss_ < enough_gap) {
        result.found = true;
        break;
      }
      if (!(gap < hopeless_gap)) break;
      factor();
      // The predictor, straight for the optimum.
      for (Bound& bound : bounds_) bound.target = 0;
      find_step();
      const double ahead = std::min(1.0, share_of_step());
      double after = 0;
      for (const Bound& bound : bounds_)
        after += (bound.slack + ahead * bound.slack_step) * (bound.multiplier + ahead * bound.multiplier_step);
      const double centre = gap > 0 ? std::pow(after / gap, 3) * gap / count : 0;
      for (Bound& bound : bounds_) bound.target = centre - bound.slack_step * bound.multiplier_step;
      find_step();
      const double share = std::min(1.0, share_to_bound * share_of_step());
      for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += share * step_[i];
      for (Bound& bound : bounds_) {
        bound.slack += share * bound.slack_step;
        bound.multiplier += share * bound.multiplier_step;
      }
    }
    result.x = x_;
    return result;
  }

 private:
  [[nodiscard]] const BandRow& row(std::size_t k) const {
    return k < program_.terms.size() ? program_.terms[k] : *rows_[k - program_.terms.size()];
  }

  [[nodiscard]] double at(const BandRow& row, const std::vector<double>& x) const {
    double sum = 0;
    const std::size_t end = std::min<std::size_t>(width_, x.size() - row.first);
    for (std::size_t k = 0; k < end; ++k) sum += row.entries[k] * x[row.first + k];
    return sum;
  }

  void add_to(std::vector<double>& right, const BandRow& row, double factor) const {
    const std::size_t end = std::min<std::size_t>(width_, right.size() - row.first);
    for (std::size_t k = 0; k < end; ++k) right[row.first + k] += factor * row.entries[k];
  }

  [[nodiscard]] double sum_of_terms() const {
    double sum = 0;
    for (const BandRow& term : program_.terms) {
      const double value = at(term, x_) + term.offset;
      sum += value * value;
    }
    return sum;
  }

  /// To a sum of 1 at the start, or where there is none of entries.
  void scale_terms() {
    double entries = 0;
    double greatest = 0;
    for (const BandRow& term : program_.terms) {
      for (const double entry : term.entries) {
        entries += entry * entry;
        greatest = std::max(greatest, std::abs(entry));
      }
    }
    const double sum = sum_of_terms();
    scale_ = 1 / (sum > 0 ? sum : std::max(entries, 1e-300));
    root_ = std::sqrt(scale_);
    diagonal_ = least_diagonal * root_ * greatest;
  }

  /// And what is left of the dual: the gradient of the objective less that of the bounds.
  void renew_misses() {
    gradient_.assign(x_.size(), 0);
    for (const BandRow& term : program_.terms) add_to(gradient_, term, scale_ * (at(term, x_) + term.offset));
    for (const double one : gradient_) gradient_size_ = std::max(gradient_size_, std::abs(one));
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const double value = at(*rows_[k], x_) + rows_[k]->offset;
      double pull = 0;
      for (std::size_t b = bounds_of_[k]; b < bounds_of_[k + 1]; ++b) {
        Bound& bound = bounds_[b];
        bound.miss = bound.sign * value + bound.constant - bound.slack;
        pull += bound.sign * bound.multiplier;
      }
      add_to(gradient_, *rows_[k], -pull);
    }
    double left = 0;
    for (const double one : gradient_) left = std::max(left, std::abs(one));
    dual_miss_ = left / std::max(gradient_size_, 1e-300);
  }

  [[nodiscard]] double complementarity() const {
    double sum = 0;
    for (const Bound& bound : bounds_) sum += bound.slack * bound.multiplier;
    return sum;
  }

  [[nodiscard]] double greatest_miss() const {
    double greatest = 0;
    for (const Bound& bound : bounds_) greatest = std::max(greatest, std::abs(bound.miss));
    return greatest;
  }

  void factor() {
    triangle_.clear(diagonal_);
    for (const std::size_t k : order_) {
      if (k < program_.terms.size()) {
        triangle_.add(program_.terms[k], root_);
        continue;
      }
      double weight = 0;
      const std::size_t c = k - program_.terms.size();
      for (std::size_t b = bounds_of_[c]; b < bounds_of_[c + 1]; ++b)
        weight += bounds_[b].multiplier / bounds_[b].slack;
      triangle_.add(*rows_[c], std::sqrt(weight));
    }
  }

  void find_step() {
    for (std::size_t i = 0; i < step_.size(); ++i) step_[i] = -gradient_[i];
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      double pull = 0;
      for (std::size_t b = bounds_of_[k]; b < bounds_of_[k + 1]; ++b) {
        const Bound& bound = bounds_[b];
        pull +=
            bound.sign * (bound.target / bound.slack - bound.multiplier - bound.multiplier / bound.slack * bound.miss);
      }
      add_to(step_, *rows_[k], pull);
    }
    triangle_.solve(step_);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const double change = at(*rows_[k], step_);
      for (std::size_t b = bounds_of_[k]; b < bounds_of_[k + 1]; ++b) {
        Bound& bound = bounds_[b];
        bound.slack_step = bound.sign * change + bound.miss;
        bound.multiplier_step =
            bound.target / bound.slack - bound.multiplier - bound.multiplier / bound.slack * bound.slack_step;
      }
    }
  }

  [[nodiscard]] double share_of_step() const {
    double share = 1 / share_to_bound;
    for (const Bound& bound : bounds_) {
      if (bound.slack_step < 0) share = std::min(share, -bound.slack / bound.slack_step);
      if (bound.multiplier_step < 0) share = std::min(share, -bound.multiplier / bound.multiplier_step);
    }
    return share;
  }

  const BandProgram& program_;
  std::size_t width_;
  std::vector<const BandRow*> rows_;    ///< of bounds
  std::vector<std::size_t> bounds_of_;  ///< where those of each row begin
  std::vector<Bound> bounds_;
  std::vector<std::size_t> order_;  ///< of all rows, by their first unknown
  std::vector<double> x_;
  std::vector<double> step_;
  std::vector<double> gradient_;
  BandTriangle triangle_;
  double scale_ = 1;
  double root_ = 1;
  double diagonal_ = 0;
  double gradient_size_ = 0;
  double dual_miss_ = 0;
};

}  // namespace

BandSolution solve(const BandProgram& program) { return InteriorPoint(program).run(); }

}  // namespace vspring
