#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// The greatest of what value() has for the moving nodes, 0 without any; infinite where one is not finite. value() is
/// called on all threads of the team.
template <typename Value>
double greatest_over_nodes(const Net& net, ThreadTeam& team, const Value& value) {
  const auto find = [&](std::size_t begin, std::size_t end, double& of_range) {
    bool finite = true;
    for (std::size_t i = begin; i < end; ++i) {
      const double one = value(i);
      finite = finite && std::isfinite(one);
      of_range = std::max(of_range, one);
    }
    if (!finite) of_range = std::numeric_limits<double>::infinity();
  };
  const std::vector<double> greatest = parallel_parts(team, net.moving, nodes_per_task, 0.0, find);
  return greatest.empty() ? 0 : *std::max_element(greatest.begin(), greatest.end());
}

/// The largest turn or stretch of an edge by a step of the moving nodes, as a share of its length: how far from linear
/// the equations are over it. Cost: linear.
double largest_turn(const Net& net, std::span<const Vector3> step, ThreadTeam& team);

}  // namespace vspring
