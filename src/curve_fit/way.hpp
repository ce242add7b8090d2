#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "curve_fit/dense_curve.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Finds the places of a way at which it turns by more than an angle, in radians, within a few tolerances: two straight
/// stretches that meet there fit the places around better than an even bend. Stretches are eight tolerances long, or so
/// long that a corner of that angle rises by two tolerances over its chord, and at least one edge. Corners are at least
/// four tolerances from each other and from ends. Returned in order. given: one entry per place, 1 for known corners,
/// which are not returned; empty: none. least_edges: least number of edges of a stretch. Cost: linear in the places,
/// times those on a stretch.
std::vector<std::size_t> corners_of_way(std::span<const Vector3> way, bool closed, double angle, double tolerance,
                                        std::span<const std::uint8_t> given = {}, int least_edges = 1);

/// A node of a chain to draw to points, in the fit's coordinates.
struct ChainNode {
  Vector3 place = Vector3::Zero();
  std::array<Vector3, 2> tangents = {Vector3::Zero(), Vector3::Zero()};  ///< as in DenseCurve::Node
  bool held = false;
  bool corner = false;  ///< a given corner; others may be found
  Index from = -1;      ///< its number
  Index point = -1;     ///< the number of the point that it is; −1: none
  double weight = 1;    ///< of that point
};

/// Scales of a start.
struct StartScale {
  double noise = 0;      ///< of points, across
  double tolerance = 0;  ///< how far a curve may go from the polyline of the points
  double sharp = 0;      ///< corners are where the way turns by more than this, in radians; 0: no corners
};

/// Rows that share one place of the way.
struct Stop {
  Vector3 place;
  double rows = 0;
  bool fixed = false;
  std::size_t node = 0;  ///< the first of its rows in the chain
  bool corner = false;   ///< a corner that was found
};

/// The stops of the rows of a chain, in order.
struct Way {
  std::vector<Stop> stops;
  std::vector<std::size_t> first_rows;  ///< per row, the first row of its stop

  /// The middle one of the successive rows that a stop begins with.
  [[nodiscard]] std::size_t middle_row(const Stop& stop) const;
};

/// Finds the way of a chain. Equal rows, and rows closer together than twice the noise, are one stop; a few rows back
/// and forth are reordered. along: for its station().
Way find_way(const std::vector<ChainNode>& chain, bool closed, const StartScale& scale, const DenseCurve& along);

}  // namespace vspring
