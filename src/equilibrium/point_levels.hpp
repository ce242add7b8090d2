#pragma once

#include <memory>
#include <vector>

#include "base/threads.hpp"
#include "equilibrium/hierarchy.hpp"
#include "points/point_clusters.hpp"
#include "points/point_ties.hpp"

namespace vspring {

/// Scattered points (§4.5) on all levels of a shape. Coarser levels have fewer points: those as close together as their
/// nodes are one, which pulls as much as all of them: their pull counts against the bending of the whole shape, not of
/// a node.
class PointLevels {
 public:
  /// ties: of the shape itself; it must outlive this, and so must the hierarchy. smoothing: the smoothing length, if it
  /// determines how strongly points pull; else Eq. 9 does.
  PointLevels(Hierarchy& hierarchy, PointTies& ties, std::shared_ptr<const double> smoothing, const Model& model,
              ThreadTeam& team);

  /// Ties the points of a level to the nodes that are nearest where these are now. Cost: n log n.
  void tie(std::size_t level);
  /// As PointTies::renew(), of the level that was tied last.
  bool renew(double margin) { return tied_->renew(*team_, margin); }

 private:
  Hierarchy* hierarchy_;
  const Model* model_;
  ThreadTeam* team_;
  PointTies* finest_;
  PointTies* tied_;
  std::unique_ptr<PointTies> coarse_;
  std::vector<TiedPoints> points_;  // of the levels below the finest, coarser ones that are left out since too
  PointFactors factors_;            // and how they pull
};

}  // namespace vspring
