#pragma once

// How nodes move that slide on supports. Springs ask a node for a displacement h along its normal n. On a support with
// tangents T only the part P n of n along T leads across the surface, so the node goes h P n/|P n|², which has the
// component h along n; then to the nearest place on the support. On a plane or a cylinder it may go along the surface,
// too.

#include <span>

#include "spring/net.hpp"

namespace vspring {

/// The direction in which node i, which slides, may go along the surface: that of the line in which the tangent plane
/// of the surface, by this normal, meets that of its support. Not of unit length; zero where it has none.
inline Vector3 way_along(const NetProblem& net, std::size_t i, const Vector3& place, const Vector3& normal) {
  const Support& support = *net.supports[i];
  return support.is_curve() ? Vector3::Zero() : support.axis(place).cross(normal);
}

/// What node i, which slides, goes in place of a displacement: as far across the surface, as far along it as its
/// support allows. Needs its normal. Where the surface lies nearly along the support less: there a node stays.
Vector3 along_support(const Net& net, std::size_t i, const Vector3& displacement);

/// Puts a moving node at a place, one that slides at the nearest one on its support.
void put_at(Net& net, std::size_t i, const Vector3& place);

/// Moves a moving node by a displacement, and to its support where it slides.
inline void displace(Net& net, std::size_t i, const Vector3& displacement) {
  put_at(net, i, net.positions[i] + displacement);
}

/// Puts nodes that slide on their supports. places: of the moving nodes at least.
void put_on_supports(const NetProblem& net, std::span<Vector3> places);

}  // namespace vspring
