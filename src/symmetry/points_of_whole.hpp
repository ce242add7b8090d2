#pragma once

#include "symmetry/given_numbers.hpp"
#include "vspring/symmetry.hpp"

namespace vspring {

/// What the whole is fitted to.
struct PointsOfWhole {
  ScatteredPoints points;  ///< the given points, then the mirror images of some
  FitCriterion criterion;
  /// Whether the given points are the nodes of the given shape.
  bool own_nodes = false;
};

/// numbers: gets the points that have a mirror image. Throws Error(invalid_argument) where the nodes of a whole are
/// further from being symmetric than the tolerance allows.
template <typename Shape>
PointsOfWhole points_of_whole(const Symmetric<Shape>& shape, const ScatteredPoints& points,
                              const FitCriterion& criterion, const Context& context, GivenNumbers& numbers);

}  // namespace vspring
