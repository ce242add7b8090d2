#pragma once

#include <Eigen/Geometry>

#include "io/curve_drawing.hpp"

namespace vspring {

using Window = Eigen::AlignedBox<double, 2>;

/// The stretches of a drawing inside a window, each with the next node at either end, so that its line goes on to the
/// edge. Arc lengths stay; through the beginning of a closed run they go on. Cost: linear.
Drawing part_inside(const Drawing& drawing, const Window& window);

}  // namespace vspring
