#pragma once

#include <vector>

#include "constraints/holding.hpp"
#include "vspring/constraints.hpp"
#include "vspring/fair.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Lines of a surface that are faired before it, as curves, and then held.
struct LinesOfSurface {
  /// curve: of nodes of the surface, by their numbers. Nodes where chains meet or end stay. Those that slide are put
  /// on their supports. Throws as PlacesOnSupports.
  LinesOfSurface(const PolygonMesh& mesh, const Constraints& constraints, PolygonCurve curve);

  /// Has the surface hold its lines where they are among these positions, one per node, or nearest to that on what they
  /// slide on.
  void hold(const std::vector<Vector3>& positions);
  /// One node of them.
  void hold(Index node, const Vector3& place);

  /// Holds a node of the lines, for them and for the surface, at a place, or nearest to that on what it slides on.
  void fix(Index node, const Vector3& place);

  /// In how many directions a node may be off across its line: two in space, one on a plane or a cylinder.
  [[nodiscard]] int directions_across(Index node) const;

  /// Moves the lines to these positions, one per node of the surface, or nearest to those on what they slide on.
  void move_to(const std::vector<Vector3>& positions);

  PolygonCurve curve;
  Constraints of_curve;
  Constraints of_surface;   ///< with all of the lines held
  std::vector<Index> free;  ///< nodes that move as those of a curve

 private:
  PlacesOnSupports places_;
};

/// Goes the share `strength` of the way from the input, and tells of that way.
void account_for_moves(const PolygonMesh& mesh, const Constraints& constraints, double strength,
                       std::vector<Vector3>& positions, FairReport& report);

/// Says of the surface what is to be said of its lines.
void join(const FairReport& lines, FairReport& report);

}  // namespace vspring
