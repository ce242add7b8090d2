#pragma once

#include "spring/net.hpp"
#include "vspring/polygon_curve.hpp"

namespace vspring {

/// Adds the rings of nodes 0 … computed − 1 to a net: the node before in the run, then the next.
void add_rings(Net& net);

/// Gathers the net of a curve under constraints; the curve must have passed check_constraints(). A held node that
/// several chains share is one local node for each of them. Cost: linear.
Net gather_net(const PolygonCurve& curve, const Constraints& constraints);

}  // namespace vspring
