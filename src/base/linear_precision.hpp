#pragma once

#include "base/definite3.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Weights w (1 − g·d) of neighbours at offsets d that reproduce linear functions, nearest to weights w: their first
/// moment Σ w (1 − g·d) d vanishes (moving least squares of first order; P. Lancaster, K. Salkauskas, Math. Comp. 37,
/// 1981).
class LinearPrecision {
 public:
  void add(double weight, const Vector3& offset) {
    sum_ += weight;
    mean_ += weight * offset;
    spread_.add_square(weight, offset);
  }

  /// The sum of the weights w.
  [[nodiscard]] double sum() const { return sum_; }
  /// Zero if all offsets are zero.
  [[nodiscard]] double size() const { return spread_.trace(); }

  /// g, for offsets in the plane across a unit normal.
  [[nodiscard]] Vector3 slope_across(const Vector3& normal) const {
    Symmetric3 spread;
    spread.add_square(size(), normal);
    spread.add_to_diagonal(1e-9 * size());
    spread += spread_;
    return solve_definite(spread, mean_);
  }

  /// g, for offsets that lie roughly in an unknown plane. ridge: regularises the direction across that plane, as a
  /// share of size().
  [[nodiscard]] Vector3 slope(double ridge) const {
    Symmetric3 spread = spread_;
    spread.add_to_diagonal(ridge * size());
    return solve_definite(spread, mean_);
  }

  /// g, shortened so that at least the share `least` of the sum of weights is left; with all neighbours on one side
  /// almost nothing would be.
  [[nodiscard]] Vector3 leaving(double least, Vector3 slope) const {
    const double left = 1 - mean_.dot(slope) / sum_;
    if (left < least) slope *= (1 - least) / (1 - left);
    return slope;
  }

 private:
  double sum_ = 0;
  Vector3 mean_ = Vector3::Zero();
  Symmetric3 spread_;
};

}  // namespace vspring
