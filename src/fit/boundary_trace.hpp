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
  std::vector<Index> held;         ///< these, and those beyond which points go on: they stay where they now are
  double smoothing = 0;            ///< the least length with which a loop was smoothed, in units of the input
  BoundaryOfPoints told;
};

/// Draws the boundary to where points end near it: to those with a gap of over 150° around them, within half an edge,
/// on the side where the surface ends; each across the points to the plane that is nearest to those about it. Every
/// loop is a curve with a smoothing length of its own, about what its edges can follow: first all of it, then with
/// corners where that turned. Distances along it stay, without their noise. Nodes beyond which points go on are
/// projected to that plane. Edges: the median of the loop; what is further away than two, or than the reach, in units
/// of the input, has no part in it. Cost: n log n.
TracedBoundary trace_boundary(const PolygonMesh& mesh, const LinesOfSurface& boundary, const ScatteredPoints& points,
                              double reach, Context& context);

}  // namespace vspring
