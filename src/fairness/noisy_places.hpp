#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "vspring/noise.hpp"

namespace vspring {

/// Which polynomial is laid through points: of one principal axis or two, and in how many directions across.
struct HeightForm {
  int axes = 1;
  int degree = 2;  ///< of one axis 2 or 4, of two 2
  int directions = 1;
};

/// How points lie to the best polynomial.
struct Heights {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();  ///< principal, in columns, in the order of rising extents
  Vector3 extents = Vector3::Zero();               ///< root mean squares along them
  double deviation = 0;               ///< root mean square of what the polynomial leaves, over its degrees of freedom
  double freedom = 0;                 ///< these, in all directions
  Vector3 squares = Vector3::Zero();  ///< the mean square of that along each axis
};

/// None where points are too few, or in one place. Cost: linear.
std::optional<Heights> heights_of(std::span<const Vector3> points, const HeightForm& form);

/// What nodes around a place say of noise.
struct NoisyPlace {
  double deviation = std::numeric_limits<double>::quiet_NaN();  ///< root mean square height over the best polynomial
  double freedom = 0;                                           ///< its degrees
  double extent = 0;  ///< root mean square, in the direction across in which it is less
};

/// The noise that explains what places say. Cost: linear.
double deviation_of(const std::vector<NoisyPlace>& places);

/// The same, of nodes that all have a place, with median edges. What is narrower across than so many standard
/// deviations of the noise is left out.
NoiseEstimate noise_of_places(std::vector<NoisyPlace> places, std::vector<double> edges, double narrowest);

/// What that share of values is below; orders them. Cost: linear.
double value_at_share(std::vector<double>& values, double share);

/// What is less than the last digits of coordinates tell is no noise.
void forget_rounding(NoiseEstimate& noise, const std::vector<Vector3>& positions);

}  // namespace vspring
