#pragma once

#include <cstdint>
#include <vector>

#include "spring/net.hpp"
#include "vspring/polygon_curve.hpp"

namespace vspring {

/// A run of nodes of one chain that hangs together by moving nodes: local numbers, in order. Moving ones ascend.
struct MovingRun {
  std::vector<std::uint32_t> nodes;
  /// The last node joins the first. The first is held, so that what moves is cut there.
  bool closed = false;
};

/// The net of a curve, and the order in which its nodes follow each other.
struct CurveNet {
  Net net;
  std::vector<MovingRun> moving_runs;
};

/// Adds the rings of nodes 0 … computed − 1 to a net: the previous node of their strand, then the next.
void add_rings(Net& net, const std::vector<MovingRun>& moving_runs);

/// Gathers the net of a curve under constraints; the curve must have passed check_constraints(). A held node that
/// several chains share is one local node for each of them. Cost: linear.
CurveNet gather_net(const PolygonCurve& curve, const Constraints& constraints);

}  // namespace vspring
