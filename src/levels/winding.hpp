#pragma once

#include <span>

#include "spring/net.hpp"

namespace vspring {

/// Whether a piece between two held nodes with given tangents winds otherwise than in the input: in the plane the sum
/// of its turns tells, and whether it is bent more and far off; in space, where all windings can be undone without a
/// kink, the sum of its turns about their axes and its bending. input: the positions of the nodes. Pieces that turn by
/// less than half a turn do not count, in space those of less than five eighths, nor those that turn by over 100° at a
/// node. Cost: linear.
bool lost_winding(const Net& net, std::span<const Vector3> input);

/// A start that keeps the windings of a curve: such pieces become the curve whose turns, carried along without spin,
/// are linear in its length, as those of a fair curve are, that ends as they do and comes nearest to them; in the
/// plane, the nearest clothoid with as many windings (E. Bertolazzi, M. Frego, "G1 fitting with clothoids", Math.
/// Methods Appl. Sci. 38, 2015, for those with less than one). False, and the curve as it was, where there is no such
/// piece or no such curve was found. Cost: linear, and up to some 10 ms
/// for a piece in the plane, 100 ms in space.
bool wind(Net& net);

}  // namespace vspring
