#pragma once

#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/fair.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Lines of a surface that are faired before it, as curves, and then held.
struct LinesOfSurface {
  /// curve: of nodes of the surface, by their numbers. Nodes where chains meet or end stay.
  LinesOfSurface(const PolygonMesh& mesh, const Constraints& constraints, PolygonCurve curve);

  /// Has the surface hold its lines where they are among these positions, one per node.
  void hold(const std::vector<Vector3>& positions);

  PolygonCurve curve;
  Constraints of_curve;
  Constraints of_surface;   ///< with all of the lines held
  std::vector<Index> free;  ///< nodes that move as those of a curve
};

/// Goes the share `strength` of the way from the input, and tells of that way.
void account_for_moves(const PolygonMesh& mesh, const Constraints& constraints, double strength,
                       std::vector<Vector3>& positions, FairReport& report);

/// Says of the surface what is to be said of its lines.
void join(const FairReport& lines, FairReport& report);

}  // namespace vspring
