#pragma once

#include <string>

#include "io/svg_drawing.hpp"

namespace vspring {

/// A picture of a curve with its nodes and its curvature comb; before, where it is not null, thin behind it, and points
/// as dots. The comb stands on the outer side of the bends: from every node a line away from the centre of the circle
/// through the node and its two neighbours, as long as the circle's curvature. Curves in space are drawn as seen along
/// the normal of their best plane. Noise has no comb to see: that of the curve before is left out where most of it
/// would be cut off. Below it stands the plot of curvature against arc length. part: only what is seen in that box, or
/// null. Positions that are not finite are left out. Cost: linear.
std::string svg_picture(const DrawnCurve& curve, const DrawnCurve* before, std::span<const Vector3> points,
                        const Eigen::AlignedBox<double, 3>* part, const std::string& title);

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
