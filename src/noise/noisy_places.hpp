#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "vspring/noise.hpp"

namespace vspring {

/// The median distance, across, of noise of standard deviation 1.
inline constexpr double median_of_noise = 0.6745;

/// The polynomial fitted to points: of one principal axis or two, and in how many directions across.
struct HeightForm {
  int axes = 1;
  int degree = 2;  ///< 2 or 4 of one axis, 2 of two
  int directions = 1;
};

/// Heights of points over the best polynomial.
struct Heights {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();  ///< principal axes, in columns, by ascending extents
  Vector3 extents = Vector3::Zero();               ///< root mean squares along them
  double deviation = 0;                            ///< root mean square of the residuals, over the degrees of freedom
  double freedom = 0;                              ///< degrees of freedom, in all directions
  Vector3 squares = Vector3::Zero();               ///< mean square residuals along each axis
};

/// Fits the polynomial; none if points are too few, or all in one place. Cost: linear.
std::optional<Heights> heights_of(std::span<const Vector3> points, const HeightForm& form);

/// Noise as the nodes around a place show it.
struct NoisyPlace {
  double deviation = std::numeric_limits<double>::quiet_NaN();  ///< root mean square height over the best polynomial
  double freedom = 0;                                           ///< its degrees
  double extent = 0;  ///< root mean square extent, in the narrower direction across
};

/// Estimates the deviation of noise from all places. Cost: linear.
double deviation_of(const std::vector<NoisyPlace>& places);

/// The noise of nodes, one place per node, also in median edges. Places narrower across than so many standard
/// deviations of the noise are left out.
NoiseEstimate noise_of_places(std::vector<NoisyPlace> places, std::vector<double> edges, double narrowest);

/// The value at this share (quantile); reorders `values`. Cost: linear.
double value_at_share(std::vector<double>& values, double share);

/// Sets noise below the last digits of coordinates to zero.
void forget_rounding(NoiseEstimate& noise, const std::vector<Vector3>& positions);

}  // namespace vspring
