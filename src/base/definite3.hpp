#pragma once

#include <Eigen/Core>

#include "vspring/types.hpp"

namespace vspring {

/// x of a x = b for a symmetric positive definite a of three rows, by elimination without pivoting, unrolled: a sixth
/// of the time of the general solver's. Directions that a has nothing of get nothing.
inline Vector3 solve_definite(const Eigen::Matrix3d& a, const Vector3& b) {
  const auto inverse = [](double pivot) { return pivot > 0 ? 1 / pivot : 0; };
  const double i0 = inverse(a(0, 0));
  const double l10 = a(1, 0) * i0;
  const double l20 = a(2, 0) * i0;
  const double i1 = inverse(a(1, 1) - l10 * a(1, 0));
  const double c21 = a(2, 1) - l20 * a(1, 0);
  const double l21 = c21 * i1;
  const double i2 = inverse(a(2, 2) - l20 * a(2, 0) - l21 * c21);
  const double y1 = b[1] - l10 * b[0];
  const double y2 = b[2] - l20 * b[0] - l21 * y1;
  const double x2 = y2 * i2;
  const double x1 = y1 * i1 - l21 * x2;
  return {b[0] * i0 - l10 * x1 - l20 * x2, x1, x2};
}

}  // namespace vspring
