#pragma once

#include <vector>

#include "solve/lines_of_surface.hpp"
#include "vspring/fit.hpp"

namespace vspring {

/// Where the boundary of a surface is by scattered points.
struct TracedBoundary {
  std::vector<Vector3> positions;  ///< of all nodes; those of the boundary that are free lie at the points
  std::vector<Index> corners;      ///< of the boundary
  std::vector<Index> kept;         ///< free ones without points that show where they belong; they are where they were
  std::vector<Index> held;  ///< these, and those beyond which there are more points: they stay where they now are
  double smoothing = 0;     ///< the least length with which a loop was smoothed, in units of the input
  BoundaryOfPoints told;
};

/// Draws the boundary to where points end near it: to those with a gap of over 150° around them, within half an edge,
/// on the side where the surface ends; each across the points to the plane that is nearest to those about it. Every
/// loop is a curve with a smoothing length of its own, about what its edges can follow: first all of it, then with
/// corners where that turned. Distances along it stay, without their noise. Nodes beyond which there are more points
/// are projected to that plane. Edges: the median of the loop; points further away than two of these, or than the
/// reach, in units of the input, do not count. Cost: n log n.
TracedBoundary trace_boundary(const PolygonMesh& mesh, const LinesOfSurface& boundary, const ScatteredPoints& points,
                              double reach, Context& context);

}  // namespace vspring
