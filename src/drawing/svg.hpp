#pragma once

#include <string>

#include "drawing/svg_drawing.hpp"

namespace vspring {

/// Draws a curve with its nodes and its curvature comb; if not null, `before` thin behind it; points as dots. The comb
/// is on the outer side of bends: each tooth points from a node away from the centre of the circle through it and its
/// two neighbours, its length in proportion to the circle's curvature. Space curves are drawn as seen along the normal
/// of their best plane. The comb of the curve before is left out if most of it would be cut off, as with noise. Below
/// is a plot of curvature against arc length. part: the box to draw; null: all. Positions that are not finite are left
/// out. Cost: linear.
std::string svg_picture(const DrawnCurve& curve, const DrawnCurve* before, std::span<const Vector3> points,
                        const Eigen::AlignedBox<double, 3>* part, const std::string& title);

/// The place of a plot in a picture, in pixels.
struct PlotPlace {
  double top;
  double width;
  double height;
  bool points = false;  ///< whether the picture has points, for the keys
};

/// Plots curvature against arc length as a group of SVG, with keys to the colours of the picture. `before`, if not
/// null, is thin behind the curve, cut off where it goes far beyond, and left out if most of it would be. Units are
/// those of the input; unit: the length that is 1 in the drawings. For planar curves curvature has a sign, positive to
/// the left. Empty if there is no curvature to plot. Cost: linear.
std::string curvature_plot(const Drawing& curve, const Drawing* before, double unit, const PlotPlace& place);

}  // namespace vspring
