#include "fit/point_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vspring {

namespace {

// Cells in each direction: beyond, a point counts as in the last one.
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

}  // namespace

PointClusters cluster_points(const TiedPoints& points, double cell) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> by_cell(points.positions.size());
  for (std::size_t j = 0; j < by_cell.size(); ++j)
    by_cell[j] = {cell_of(points.positions[j], cell), static_cast<std::uint32_t>(j)};
  std::sort(by_cell.begin(), by_cell.end());
  PointClusters clusters;
  for (auto begin = by_cell.begin(); begin != by_cell.end();) {
    const auto end = std::find_if(begin, by_cell.end(), [&](const auto& other) { return other.first != begin->first; });
    double sum = 0;
    for (auto one = begin; one != end; ++one) sum += points.weights[one->second];
    Vector3 mean = Vector3::Zero();
    for (auto one = begin; one != end; ++one) mean += points.weights[one->second] / sum * points.positions[one->second];
    clusters.points.positions.push_back(mean);
    clusters.points.weights.push_back(sum);
    clusters.counts.push_back(static_cast<Index>(end - begin));
    begin = end;
  }
  return clusters;
}

double mean_edge(const Net& net) {
  double sum = 0;
  double edges = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    for (const Link link : net.rings.links(i)) {
      if (!link.spoke()) continue;
      sum += (net.positions[link.node()] - net.positions[i]).norm();
      edges += 1;
    }
  }
  return edges > 0 ? sum / edges : 0;
}

}  // namespace vspring
