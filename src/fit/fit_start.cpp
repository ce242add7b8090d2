#include "fit/fit_start.hpp"

#include <algorithm>

#include "points/nearest_nodes.hpp"

namespace vspring {

namespace {

// Points that the sense of all is found from.
constexpr std::size_t most_points_asked = 500;
// By how much the other sense must be better, in squares of distances.
constexpr double clearly_better = 0.5;
// Normals tell no side if in either sense they lead more than this share of the points to nodes that are further than
// the nearest by more than this factor.
constexpr double most_led_away = 0.25;
constexpr double further = 3;

/// How well the sense of the normals goes with the faces.
struct Misfit {
  double squares = 0;        ///< of distances from nodes that face alike
  std::size_t led_away = 0;  ///< points of which these are far further than others
};

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
  const std::vector<Index> nearest_of_all = nearest_nodes(asked, places, usable, team);
  const auto misfit = [&](int sense) {
    const auto normal_of = [&](std::size_t j) -> Vector3 { return sense * points.normals[j * stride]; };
    const std::vector<Index> found = nearest(asked, normal_of);
    Misfit sum;
    for (std::size_t j = 0; j < asked.size(); ++j) {
      if (found[j] < 0) continue;
      const auto from = [&](Index node) { return (places[static_cast<std::size_t>(node)] - asked[j]).norm(); };
      const double distance = from(found[j]);
      const bool alike = face_alike(normal_of(j), sides.normals[static_cast<std::size_t>(found[j])]);
      const double none = alike ? 0 : distance + reach;
      sum.squares += (distance + none) * (distance + none);
      if (distance > further * from(nearest_of_all[j])) ++sum.led_away;
    }
    return sum;
  };
  const Misfit as_given = misfit(1);
  const Misfit turned = misfit(-1);
  FitStart start{.nearest = {}, .normals = points.normals};
  if (turned.squares < clearly_better * as_given.squares) start.sense = -1;
  const auto led_away = static_cast<double>(std::min(as_given.led_away, turned.led_away));
  if (led_away > most_led_away * static_cast<double>(asked.size())) start.sense = 0;
  for (Vector3& normal : start.normals) normal *= start.sense;
  start.nearest = nearest(points.positions, [&](std::size_t j) -> const Vector3& { return start.normals[j]; });
  if (start.sense == 0) start.normals.clear();
  return start;
}

}  // namespace vspring
