#include "equilibrium/point_levels.hpp"

#include <cmath>
#include <utility>

#include "points/point_factors.hpp"

namespace vspring {

PointLevels::PointLevels(Hierarchy& hierarchy, PointTies& ties, std::shared_ptr<const double> smoothing,
                         const Model& model, ThreadTeam& team)
    : hierarchy_(&hierarchy),
      model_(&model),
      team_(&team),
      finest_(&ties),
      tied_(&ties),
      points_(hierarchy.count() - 1) {
  if (points_.empty()) return;
  const Net& net = hierarchy.net(points_.size());
  const double edge = mean_edge(net);
  PointClusters clusters = cluster_points(net.points, edge);
  if (smoothing) {
    factors_ = pull_by_smoothing(std::move(smoothing), net.points.positions.size());
  } else {
    factors_ = pull_by_sums();
    // Of the points of one node, Eq. 9 takes the average.
    for (std::size_t j = 0; j < clusters.counts.size(); ++j)
      clusters.points.weights[j] /= clusters.counts[j] * std::pow(edge, pull_power(net));
  }
  for (std::size_t k = points_.size(); k-- > 0;) {
    const TiedPoints& finer = k + 1 < points_.size() ? points_[k + 1] : clusters.points;
    points_[k] = cluster_points(finer, mean_edge(hierarchy.net(k))).points;
  }
}

void PointLevels::tie(std::size_t level) {
  const std::size_t last = hierarchy_->count() - 1;
  if (!hierarchy_->net(last).points.normals.empty()) update_directions(hierarchy_->net(level), *model_, *team_);
  if (level == last) {
    finest_->tie_anew(*team_);
    tied_ = finest_;
    return;
  }
  coarse_ =
      std::make_unique<PointTies>(hierarchy_->net(level), points_[level + points_.size() - last], factors_, *team_);
  tied_ = coarse_.get();
}

}  // namespace vspring
