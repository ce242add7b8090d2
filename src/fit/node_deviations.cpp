#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "points/nearest_nodes.hpp"
#include "vspring/error.hpp"
#include "vspring/fit.hpp"

namespace vspring {

std::vector<double> node_deviations(std::span<const Vector3> nodes, std::span<const Vector3> points,
                                    std::span<const double> distances, const Context& context) {
  const auto refuse = [](const std::string& message) { throw Error(ErrorCode::invalid_argument, message); };
  if (points.size() != distances.size())
    refuse(
        fmt::format("{} distances are given for {} points: one for each is needed", distances.size(), points.size()));
  for (std::size_t j = 0; j < points.size(); ++j) {
    if (!points[j].allFinite() || !std::isfinite(distances[j]))
      refuse(fmt::format("point {} or its distance is not finite; leave it out", j));
  }
  std::vector<std::uint8_t> usable;
  for (const Vector3& node : nodes) usable.push_back(node.allFinite() ? 1 : 0);
  ThreadTeam team(context.thread_count());
  const std::vector<Index> nearest = nearest_nodes(points, nodes, usable, team);
  std::vector<double> greatest(nodes.size(), 0);
  for (std::size_t j = 0; j < nearest.size(); ++j) {
    if (nearest[j] < 0) continue;
    double& at = greatest[static_cast<std::size_t>(nearest[j])];
    at = std::max(at, distances[j]);
  }
  return greatest;
}

}  // namespace vspring
