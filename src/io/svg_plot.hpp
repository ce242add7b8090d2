#pragma once

#include <string>

#include "io/curve_drawing.hpp"

namespace vspring {

/// Where a plot stands in a picture, pixels.
struct PlotPlace {
  double top;
  double width;
  double height;
  bool points = false;  ///< whether the picture has points, for the keys
};

/// Curvature against arc length as a group of SVG, with keys to the colours of the picture: of the curve, and of the
/// one before, where it is not null, thin behind it and cut off where it goes far beyond; left out where most of it
/// would be cut off. Units are those of the input: unit is the length that is 1 in the drawings. Planar curves have a
/// sign, positive to the left. Empty where there is no curvature to plot. Cost: linear.
std::string curvature_plot(const Drawing& curve, const Drawing* before, double unit, const PlotPlace& place);

}  // namespace vspring
