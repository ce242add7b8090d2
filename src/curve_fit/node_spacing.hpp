#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Sorts values, so that rows out of order exchange places, and moves them, with the least sum of squares, to lie
/// between `least` and `most`, and apart by at least `apart` and a tenth of the mean distance around. Cost: n log n
/// (pool adjacent violators; Barlow, Bartholomew, Bremner and Brunk 1972).
void set_in_order(std::vector<double>& values, double apart, double least, double most);

/// Edges that turn by more between their ends, in radians, get new nodes.
inline constexpr double greatest_turn_of_edge = 0.3;

/// The angle between two vectors, in radians; 0 if one of them is zero.
double turn_between(const Vector3& a, const Vector3& b);

/// The vertices of a way.
struct WayVertices {
  std::vector<Vector3> places;      ///< a closed way repeats the first one at the end
  std::vector<std::uint8_t> fixed;  ///< 1 where nodes must lie
  std::vector<std::uint8_t> sharp;  ///< 1 where the curve need not turn within the tolerance
};

/// The spacing of nodes at each vertex of a way: between twelve nodes it is straight, or evenly bent, within the
/// tolerance.
std::vector<double> spacing_along(const WayVertices& way, bool closed, double tolerance);

/// Evens out spacing: from one vertex to the next it grows by at most a quarter of the edge between them, and it is at
/// least 1e-5 of the length. edges: one fewer than vertices; closed: the last vertex repeats the first.
void even_out_spacing(std::vector<double>& spacing, std::span<const double> edges, bool closed);

/// A share of an edge of a way.
struct PlaceOnWay {
  std::size_t edge;
  double share;
};

/// Places between two vertices, as far apart as their spacing. least: the least number of edges.
std::vector<PlaceOnWay> places_between(std::span<const double> edges, std::span<const double> spacing,
                                       std::size_t first, std::size_t last, double least);

}  // namespace vspring
