#include "points/point_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/cancellation.hpp"

namespace vspring {

namespace {

// Cells in each direction; points beyond count as in the last one.
constexpr double most_cells = 1 << 20;

/// The number of the cell that a point lies in.
std::uint64_t cell_of(const Vector3& point, double cell) {
  std::uint64_t number = 0;
  for (const double x : point) {
    const double place = std::clamp(std::floor(x / cell), -most_cells, most_cells - 1);
    number = (number << 21) | static_cast<std::uint64_t>(place + most_cells);
  }
  return number;
}

/// Which of six directions a normal has; 0 without a normal.
std::uint32_t way_of(const TiedPoints& points, std::size_t j) {
  if (points.normals.empty() || points.normals[j].isZero(0)) return 0;
  Eigen::Index axis = 0;
  (void)points.normals[j].cwiseAbs().maxCoeff(&axis);
  return static_cast<std::uint32_t>(2 * axis + (points.normals[j][axis] < 0 ? 2 : 1));
}

struct Place {
  std::uint64_t cell;
  std::uint32_t way;
  std::uint32_t point;
};

bool operator<(const Place& a, const Place& b) {
  return std::tie(a.cell, a.way, a.point) < std::tie(b.cell, b.way, b.point);
}

}  // namespace

PointClusters cluster_points(const TiedPoints& points, double cell) {
  std::vector<Place> by_cell(points.positions.size());
  for (std::size_t j = 0; j < by_cell.size(); ++j)
    by_cell[j] = {cell_of(points.positions[j], cell), way_of(points, j), static_cast<std::uint32_t>(j)};
  end_if_cancelled();
  std::sort(by_cell.begin(), by_cell.end());
  PointClusters clusters;
  for (auto begin = by_cell.begin(); begin != by_cell.end();) {
    end_if_cancelled_at(clusters.counts.size());
    const auto end = std::find_if(
        begin, by_cell.end(), [&](const Place& other) { return other.cell != begin->cell || other.way != begin->way; });
    double sum = 0;
    for (auto one = begin; one != end; ++one) sum += points.weights[one->point];
    const auto mean_of = [&](const std::vector<Vector3>& vectors) {
      Vector3 mean = Vector3::Zero();
      for (auto one = begin; one != end; ++one) mean += points.weights[one->point] / sum * vectors[one->point];
      return mean;
    };
    clusters.points.positions.push_back(mean_of(points.positions));
    if (!points.normals.empty()) clusters.points.normals.push_back(mean_of(points.normals).normalized());
    clusters.points.weights.push_back(sum);
    clusters.counts.push_back(static_cast<Index>(end - begin));
    begin = end;
  }
  return clusters;
}

}  // namespace vspring
