#pragma once

#include <vector>

#include "solve/lines_of_surface.hpp"
#include "vspring/fit.hpp"

namespace vspring {

/// Where the boundary of a surface is, as scattered points tell.
struct TracedBoundary {
  std::vector<Vector3> positions;  ///< of all nodes; those of the boundary that are free lie at the points
  std::vector<Index> corners;      ///< of the boundary
  std::vector<Index> kept;         ///< free ones of which points tell nothing, and that are where they were
  double smoothing = 0;            ///< the least length with which a loop was smoothed, in units of the input
  BoundaryOfPoints told;
};

/// Draws the boundary to where points end near it: to those with a gap of over 150° around them, within half an edge,
/// each across the points to the plane that is nearest to those about it. Where they go on, to where they are. Every
/// loop is a curve with a smoothing length of its own, about what its edges can follow: first all of it, then with
/// corners where that turned. edges: the median of the loop. Points further away than two of them have no part in it.
/// Distances along a loop stay, without their noise. Cost: n log n.
TracedBoundary trace_boundary(const PolygonMesh& mesh, const LinesOfSurface& boundary, const ScatteredPoints& points,
                              Context& context);

}  // namespace vspring
