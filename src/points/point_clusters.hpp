#pragma once

#include "spring/net.hpp"

namespace vspring {

/// Points merged for coarse levels: those in one cell of a cubic grid become one at their weighted mean, with the sum
/// of their weights. Points with normals merge only with points that face the same of six directions.
struct PointClusters {
  TiedPoints points;          ///< not tied to nodes
  std::vector<Index> counts;  ///< how many points each represents
};

/// cell: the edge of a cell, in the coordinates of the points. Cost: n log n.
PointClusters cluster_points(const TiedPoints& points, double cell);

}  // namespace vspring
