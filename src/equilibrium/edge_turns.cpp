#include "equilibrium/edge_turns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vspring {

namespace {

constexpr double stretch_share = 0.4;
constexpr double shortest_share = 0.25;

/// The square of the difference between the steps of an edge's ends, as far as it counts. Along a surface the equations
/// are nearly linear.
double squared_change(const Net& net, const Vector3& difference, std::size_t i) {
  const double all = difference.squaredNorm();
  if (net.is_curve) return all;
  const double across = difference.dot(net.normals[i]);
  return std::max(across * across, stretch_share * stretch_share * all);
}

}  // namespace

EdgeTurns edge_turns(const Net& net, std::span<const Vector3> step, ThreadTeam& team) {
  const auto find = [&](std::size_t begin, std::size_t end, EdgeTurns& of_range) {
    double greatest = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = begin; i < end; ++i) {
      const auto links = net.rings.links(i);
      double squares = 0;
      double spokes = 0;
      for (const Link link : links) {
        if (!link.spoke()) continue;
        const double square = (net.positions[link.node()] - net.positions[i]).squaredNorm();
        squares += square;
        shortest = std::min(shortest, square);
        spokes += 1;
      }
      // An edge far shorter than its neighbours is out of place, and has to turn.
      const double least_square = spokes > 0 ? shortest_share * shortest_share * squares / spokes : 0;
      for (const Link link : links) {
        if (!link.spoke()) continue;
        const std::size_t j = link.node();
        const Vector3 difference = (j < net.moving ? step[j] : Vector3(Vector3::Zero())) - step[i];
        const double square = (net.positions[j] - net.positions[i]).squaredNorm();
        greatest = std::max(greatest, squared_change(net, difference, i) / std::max(square, least_square));
      }
    }
    of_range = {greatest, shortest};
  };
  EdgeTurns squares = {0, std::numeric_limits<double>::infinity()};
  for (const EdgeTurns& part : parallel_parts(team, net.moving, nodes_per_task, EdgeTurns(), find)) {
    squares.largest = std::max(squares.largest, part.largest);
    squares.shortest = std::min(squares.shortest, part.shortest);
  }
  return {std::sqrt(squares.largest), std::sqrt(squares.shortest)};
}

double TurnLimit::turn(std::span<const Vector3> step, double longest) {
  // Both ends of an edge may go as far.
  const double bound = 2 * longest / shortest_;
  if (shortest_ > 0 && bound <= limit_) return bound;
  const EdgeTurns turns = edge_turns(*net_, step, *team_);
  shortest_ = turns.shortest;
  return turns.largest;
}

}  // namespace vspring
