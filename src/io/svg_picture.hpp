#pragma once

#include <string>

#include "io/curve_drawing.hpp"

namespace vspring {

/// A picture of a curve with its nodes and its curvature comb; before, where it is not null, thin behind it, and points
/// as dots. The comb
/// stands on the outer side of the bends: from every node a line away from the centre of the circle through the node
/// and its two neighbours, as long as the circle's curvature. Curves in space are drawn as seen along the normal of
/// their best plane. Noise has no comb to see: that of the curve before is left out where most of it would be cut off.
/// Below it stands the plot of curvature against arc length. part: only what is seen in that box, or null. Positions
/// that are not finite are left out. Cost: linear.
std::string svg_picture(const DrawnCurve& curve, const DrawnCurve* before, std::span<const Vector3> points,
                        const Eigen::AlignedBox<double, 3>* part, const std::string& title);

}  // namespace vspring
