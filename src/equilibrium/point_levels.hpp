#pragma once

#include <memory>
#include <vector>

#include "base/threads.hpp"
#include "equilibrium/hierarchy.hpp"
#include "points/point_clusters.hpp"
#include "points/point_ties.hpp"

namespace vspring {

/// Scattered points (§4.5) on all levels of a shape. Coarser levels have fewer, drawn together as far as their nodes
/// lie apart, which pull as much as all of them: as against bending, a node's points count for what they are to the
/// whole shape, not to a node.
class PointLevels {
 public:
  /// ties: of the shape itself; it must outlive this, and so must the hierarchy. smoothing: the smoothing length, where
  /// that is what points pull by; else it is Eq. 9.
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
