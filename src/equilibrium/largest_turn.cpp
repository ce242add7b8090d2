#include "equilibrium/largest_turn.hpp"

namespace vspring {

namespace {

constexpr double stretch_share = 0.4;
constexpr double shortest_share = 0.25;

/// How much of a difference between two ends of an edge counts, squared. Along a surface the equations are nearly
/// linear.
double squared_change(const Net& net, const Vector3& difference, std::size_t i) {
  const double all = difference.squaredNorm();
  if (net.is_curve) return all;
  const double across = difference.dot(net.normals[i]);
  return std::max(across * across, stretch_share * stretch_share * all);
}

}  // namespace

double largest_turn(const Net& net, std::span<const Vector3> step, ThreadTeam& team) {
  return std::sqrt(greatest_over_nodes(net, team, [&](std::size_t i) {
    const auto links = net.rings.links(i);
    double squares = 0;
    double spokes = 0;
    for (const Link link : links) {
      if (!link.spoke()) continue;
      squares += (net.positions[link.node()] - net.positions[i]).squaredNorm();
      spokes += 1;
    }
    // An edge far shorter than its neighbours is out of place, and has to turn.
    const double least_square = spokes > 0 ? shortest_share * shortest_share * squares / spokes : 0;
    double greatest = 0;
    for (const Link link : links) {
      if (!link.spoke()) continue;
      const std::size_t j = link.node();
      const Vector3 difference = (j < net.moving ? step[j] : Vector3(Vector3::Zero())) - step[i];
      const double square = (net.positions[j] - net.positions[i]).squaredNorm();
      greatest = std::max(greatest, squared_change(net, difference, i) / std::max(square, least_square));
    }
    return greatest;
  }));
}

}  // namespace vspring
