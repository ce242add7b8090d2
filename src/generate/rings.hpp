#pragma once

#include <functional>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring::generate {

/// A point of a curve in the half plane through the z axis.
struct ProfilePoint {
  double radius;  ///< distance from the axis
  double height;
};

/// A curve by its length from the first ring on.
using ProfileCurve = std::function<ProfilePoint(double length)>;

/// Rings of nodes around the z axis along a curve.
struct RingLayout {
  std::vector<Index> counts;  ///< nodes of each ring; 3 or more, or 1 for a first ring on the axis
  std::vector<double> at;     ///< place of each ring on the curve, ascending
};

struct Jitter {
  double share;
  std::uint64_t seed;
};

/// The edge length at which equilateral triangles with that many nodes cover the area; half of each boundary node's
/// share lies outside. nodes: for a disc, one less than it has.
[[nodiscard]] double even_edge(double nodes, double area, double boundary_length);

/// The number of rows of equilateral triangles of this edge that comes closest to the length; from 1 to `most`.
[[nodiscard]] Index even_rows(double length, double edge, Index most);

/// Divides `total` by weights into whole numbers of at least `least` each. Parts and their running sums differ by less
/// than one from the exact ones. total ≥ least × the number of weights; weights not negative, not all 0.
[[nodiscard]] std::vector<Index> share_out(Index total, const std::vector<double>& weights, Index least);

/// Puts the nodes of each ring at equal angles, every second ring turned by half a step, and joins neighbouring rings
/// by triangles. Nodes of rings between the first and the last are shifted along the surface within a disc whose
/// diameter is the jitter's share of the least distance to a neighbour along the ring or the curve. Faces run
/// counter-clockwise seen from +z where the radius grows along the curve.
[[nodiscard]] PolygonMesh revolve(const ProfileCurve& curve, const RingLayout& layout, Jitter jitter);

}  // namespace vspring::generate
