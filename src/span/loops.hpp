#pragma once

#include <vector>

#include "span/arcs.hpp"

namespace vspring {

/// A closed loop of half-arcs, with the surface on its left.
struct Loop {
  std::vector<Index> halves;
  /// As NetworkLoop::facing.
  double facing = -1;
};

/// Follows the loops of a network. At each junction the arcs are in order around the normal of the plane through the
/// ends of their directions; the sense of normals is carried from junction to junction without rotation about the arcs,
/// over those first at whose end it agrees best. A loop of curves that meet no other is followed once only. Loops that
/// is_outer() holds for were taken away one by one, the one that faces most first. The normals of a
/// component point away from its middle, those of a flat one to the positive side of the coordinate plane from which
/// most of it is seen. Cost: about linear, and quadratic in the arcs at a junction.
std::vector<Loop> find_loops(const Network& network, const Arcs& arcs);

}  // namespace vspring
