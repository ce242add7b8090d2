#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "curve_fit/dense_curve.hpp"

namespace vspring {

/// A node of a chain that is to be drawn to points, in the fit's coordinates.
struct ChainNode {
  Vector3 place = Vector3::Zero();
  std::array<Vector3, 2> tangents = {Vector3::Zero(), Vector3::Zero()};  ///< as those of DenseCurve::Node
  bool held = false;
  bool corner = false;  ///< given; others may be found
  Index from = -1;      ///< its number
  Index point = -1;     ///< the point that it is; −1: none
  double weight = 1;    ///< of that
};

/// Lengths that a start goes by.
struct StartScale {
  double noise = 0;      ///< of points, across
  double tolerance = 0;  ///< how far a curve may go from the polyline of the points
  double sharp = 0;      ///< places where the way turns by more than this are corners, in radians; 0: none are
};

/// Rows that are one place of the way.
struct Stop {
  Vector3 place;
  double rows = 0;
  bool fixed = false;
  std::size_t node = 0;  ///< of the chain: the first of its rows
  bool corner = false;   ///< that was found
};

/// The places that the rows of a chain go along, in order.
struct Way {
  std::vector<Stop> stops;
  std::vector<std::size_t> first_rows;  ///< of every row, the first one of the stop that it belongs to

  /// Of those that a stop begins with, one after the other.
  [[nodiscard]] std::size_t middle_row(const Stop& stop) const;
};

/// Equal rows and those closer together than twice the noise are one stop; a few rows back and forth are brought into
/// order. along: for its station().
Way find_way(const std::vector<ChainNode>& chain, bool closed, const StartScale& scale, const DenseCurve& along);

}  // namespace vspring
