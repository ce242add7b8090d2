#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vspring/fit.hpp"

namespace vspring {

/// For the weights of points and of FitOptions: greater ones are refused.
inline constexpr double largest_weight = 1e50;

/// Throws Error(invalid_argument) naming a point that fit() does not take; Error(unusable_shape) for one that is not
/// finite, or the node if that is the same. nodes: of the shape.
void check_points(const ScatteredPoints& points, const std::vector<Vector3>& nodes);

/// Throws Error(invalid_argument) where options cannot keep the corners of the constraints.
void check_corners_kept(const FitOptions& options, const Constraints& constraints);

/// Whether either of them asks for corners.
bool has_corners(const FitOptions& options, const Constraints& constraints);

/// In standard deviations of the noise: a point that is further off may be an outlier.
constexpr double outlying = 4.5;

/// One entry per point, 0 for those further away than `least`, but at most the share of all that is furthest away,
/// rounded down; of equals the first ones go.
std::vector<std::uint8_t> without_furthest(std::span<const double> distances, double share, double least);

/// The numbers of the points that were counted and are not kept.
std::vector<Index> left_out(std::span<const std::uint8_t> counted, std::span<const std::uint8_t> kept);

/// The numbers of the points that count at that distance from the shape, to 1 %. counted: 1 for these, else 0; without,
/// all count.
std::vector<Index> active_points(std::span<const double> distances, std::span<const std::uint8_t> counted,
                                 double distance);

/// How many of the points that count, as for summary(), are further away than that.
Index count_beyond(std::span<const double> distances, std::span<const std::uint8_t> counted, double distance);

/// Summary of the distances of the points that count: counted is 1 for these, else 0.
PointDistances summary(std::span<const double> distances, std::span<const std::uint8_t> counted);

}  // namespace vspring
