#pragma once

#include <span>

#include "spring/net.hpp"

namespace vspring {

/// Whether some piece between two held nodes with given tangents has other windings than in the input. In the plane,
/// the sum of its turns differs, or it is bent more and far away. In space, where all windings can be undone without a
/// kink, the sum of its turns about their axes and its bending are compared. input: the positions of the nodes. Pieces
/// of less than half a turn (in space five eighths) do not count, nor pieces that turn by over 100° at a node. Cost:
/// linear.
bool lost_winding(const Net& net, std::span<const Vector3> input);

/// Makes a start that keeps the windings of a curve. Each such piece is replaced by a curve with the same ends whose
/// turns, carried along without spin, are linear in its length, as those of a fair curve: by Levenberg and Marquardt's
/// method from the linear turns nearest to the piece's own. In the plane that is a clothoid with as many windings (E.
/// Bertolazzi, M. Frego, "G1 fitting with clothoids", Math. Methods Appl. Sci. 38, 2015, for less than one). Returns
/// false and changes nothing if there is no such piece or no such curve is found. Cost: linear.
bool wind(Net& net);

}  // namespace vspring
