#include "fit/fit_start.hpp"

#include <algorithm>

#include "points/nearest_nodes.hpp"

namespace vspring {

namespace {

// Points that the sense of all is found from.
constexpr std::size_t most_points_asked = 500;
// By how much the other sense must be better, in squares of distances.
constexpr double clearly_better = 0.5;

}  // namespace

FitStart fit_start(const ScatteredPoints& points, const std::vector<Vector3>& places,
                   std::span<const std::uint8_t> usable, const SurfaceSides& sides, ThreadTeam& team) {
  if (points.normals.empty() || sides.normals.empty())
    return {.nearest = nearest_nodes(points.positions, places, usable, team), .normals = {}};
  const double reach = reach_in_edges * sides.mean_edge;
  const auto nearest = [&](std::span<const Vector3> positions, const auto& normal_of) {
    return nearest_nodes(
        positions, places, usable, team,
        {[&](std::size_t j, std::size_t node) { return face_alike(normal_of(j), sides.normals[node]); }, reach});
  };
  // With the right sense of the normals, points are nearer to nodes that face alike.
  const std::size_t stride = (points.positions.size() + most_points_asked - 1) / most_points_asked;
  std::vector<Vector3> asked;
  for (std::size_t j = 0; j < points.positions.size(); j += stride) asked.push_back(points.positions[j]);
  const auto misfit = [&](double sense) {
    const auto normal_of = [&](std::size_t j) -> Vector3 { return sense * points.normals[j * stride]; };
    const std::vector<Index> found = nearest(asked, normal_of);
    double sum = 0;
    for (std::size_t j = 0; j < asked.size(); ++j) {
      if (found[j] < 0) continue;
      const auto node = static_cast<std::size_t>(found[j]);
      const double distance = (places[node] - asked[j]).norm();
      const double none = face_alike(normal_of(j), sides.normals[node]) ? 0 : distance + reach;
      sum += (distance + none) * (distance + none);
    }
    return sum;
  };
  FitStart start{.nearest = {}, .normals = points.normals, .turned = misfit(-1) < clearly_better * misfit(1)};
  if (start.turned) {
    for (Vector3& normal : start.normals) normal = -normal;
  }
  start.nearest = nearest(points.positions, [&](std::size_t j) -> const Vector3& { return start.normals[j]; });
  return start;
}

}  // namespace vspring
