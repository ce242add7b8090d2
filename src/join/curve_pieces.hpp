#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "join/curvature_spline.hpp"
#include "vspring/constraints.hpp"
#include "vspring/polygon_curve.hpp"

namespace vspring {

/// A part of a chain that moves, with the held nodes at its ends: beside each of these the next node is held, too, or
/// the chain ends there. Or all of a closed chain, from a held node on and to it again.
struct CurvePiece {
  std::vector<Index> nodes;
  bool closed = false;
  std::vector<std::size_t> held;  ///< which of its nodes
  /// Places of the held nodes at its ends and beside them, from the piece away; one where the chain ends.
  std::array<std::vector<Vector3>, 2> beside;
  /// One for each held node; of a closed piece the last is the first. Left to the caller.
  std::vector<CurveJoint> joints;
};

/// The pieces of a curve that has passed check_constraints(), chain by chain. places: of its nodes. Cost: linear.
std::vector<CurvePiece> moving_pieces(const PolygonCurve& curve, const Constraints& constraints,
                                      const std::vector<Vector3>& places);

}  // namespace vspring
