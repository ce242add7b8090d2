#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Edges that turn by more between their ends, in radians, have nodes between these.
inline constexpr double greatest_turn_of_edge = 0.3;

/// The angle between two vectors, in radians; 0 where one of them is zero.
double turn_between(const Vector3& a, const Vector3& b);

/// The vertices of a way, one entry each.
struct WayVertices {
  std::vector<Vector3> places;      ///< the first one again at the end, where the way is closed
  std::vector<std::uint8_t> fixed;  ///< 1 for those that nodes lie at
  std::vector<std::uint8_t> sharp;  ///< 1 for those where it need not turn within the tolerance
};

/// How far apart nodes should be at each vertex of a way: so that it is as straight, or bent as evenly, between twelve
/// of them as the tolerance allows.
std::vector<double> spacing_along(const WayVertices& way, bool closed, double tolerance);

/// From one vertex to the next spacing grows by no more than a quarter of the edge between them, and no spacing is less
/// than one hundred thousandth of all edges. edges: one less than vertices; closed: the last vertex is the first again.
void even_out_spacing(std::vector<double>& spacing, std::span<const double> edges, bool closed);

/// A share of an edge of a way.
struct PlaceOnWay {
  std::size_t edge;
  double share;
};

/// Places between two vertices, as far apart as spacing says, at both ends of each edge. least: edges between them.
std::vector<PlaceOnWay> places_between(std::span<const double> edges, std::span<const double> spacing,
                                       std::size_t first, std::size_t last, double least);

}  // namespace vspring
