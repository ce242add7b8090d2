#pragma once

#include "spring/net.hpp"

namespace vspring {

/// Points drawn together, for versions of a shape too coarse to tell them apart: those in one cell of a cubic grid
/// become one in their mean place, weighted and with the sum of their weights. Points with normals become one only with
/// those that face the same way: up, down or to one of four sides.
struct PointClusters {
  TiedPoints points;          ///< not tied to anything
  std::vector<Index> counts;  ///< how many points each stands for
};

/// cell: the edge of a cell, in the coordinates of the points. Cost: n log n.
PointClusters cluster_points(const TiedPoints& points, double cell);

}  // namespace vspring
