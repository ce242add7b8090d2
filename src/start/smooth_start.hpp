#pragma once

#include "spring/curve_net.hpp"

namespace vspring {

/// A start for a curve that points pull at: the smoothing spline of the points' means over the lengths that its edges
/// have now, each coordinate by itself, which works with any noise. pull: the k of every moving node (Eq. 9); no node
/// smooths by more than some thirty edges. Given tangents are kept. Cost: linear.
void start_smooth(Net& net, const std::vector<double>& pull);

/// Moves the nodes of a curve to where ∫ κ² ds + ∫ |x − x₀|²/L⁴ ds is least, x₀ their places in `home`, L the smoothing
/// length, lengths those of the present edges: so waves much longer than 2πL stay, and much shorter ones vanish. Held
/// nodes stay, and given directions are kept. False, and nothing is changed, if rounding prevents that, as with L of
/// some 10,000 edges. Cost: linear.
[[nodiscard]] bool smooth_near(Net& net, const std::vector<Vector3>& home, double smoothing_length);

}  // namespace vspring
