#include "solve/even_residuals.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace vspring {

namespace {

// Of what noise leaves of a mean where the shape has followed none of it: that it follows some is in this.
constexpr double left = 0.75;
// Of that, in a turn.
constexpr double least_excess = 0.5;
constexpr double greatest_excess = 4;
// Of the noise: what is further away is an outlier.
constexpr double most_of_noise = 3;
// Of the weight, a power of the excess.
constexpr double weight_power = 0.8;

// Around a hub of many faces everybody is everybody's neighbour of second order.
constexpr std::size_t most_links = 200;

/// Distances of the points across the shape, of nodes that have one; else not a number.
std::vector<double> residuals_of(const Net& net) {
  std::vector<double> residual(net.positions.size(), std::nan(""));
  for (std::size_t i = 0; i < net.moving; ++i) {
    for (const std::uint32_t k : net.points.of(i)) {
      if (net.points.weights[k] > 0) residual[i] = (net.points.positions[k] - net.positions[i]).dot(net.normals[i]);
    }
  }
  return residual;
}

}  // namespace

double rms_residual(const Net& net) {
  double squares = 0;
  double count = 0;
  for (const double residual : residuals_of(net)) {
    if (std::isnan(residual)) continue;
    squares += residual * residual;
    count += 1;
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

void even_residuals(Net& net, double noise, ThreadTeam& team) {
  std::vector<double> residual = residuals_of(net);
  for (double& one : residual) one = std::clamp(one, -most_of_noise * noise, most_of_noise * noise);
  // Squares of the means, and 1 where there is only noise: over the node and its neighbours, and with theirs too.
  std::vector<double> excess(net.moving, 0);
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    std::vector<std::size_t> around;
    const auto excess_of = [&] {
      double sum = 0;
      double count = 0;
      for (const std::size_t j : around) {
        if (std::isnan(residual[j])) continue;
        sum += residual[j] / noise;
        count += 1;
      }
      return sum * sum / std::max(count, 1.0);
    };
    for (std::size_t i = begin; i < end; ++i) {
      around.assign(1, i);
      for (const Link link : net.rings.links(i)) {
        if (link.spoke()) around.push_back(link.node());
      }
      const double near = excess_of();
      const std::size_t neighbours = around.size();
      for (std::size_t k = 1; k < neighbours; ++k) {
        if (around[k] >= net.computed || net.rings.links(around[k]).size() > most_links) continue;
        for (const Link next : net.rings.links(around[k])) {
          if (next.spoke()) around.push_back(next.node());
        }
      }
      std::sort(around.begin(), around.end());
      around.erase(std::unique(around.begin(), around.end()), around.end());
      excess[i] = (near + excess_of()) / 2;
    }
  });
  // Weights that go their own ways from node to node draw the shape after noise.
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double sum = excess[i];
      double count = 1;
      for (const Link link : net.rings.links(i)) {
        if (!link.spoke() || link.node() >= net.moving) continue;
        sum += excess[link.node()];
        count += 1;
      }
      const double now = std::clamp(std::sqrt(sum / count) / left, least_excess, greatest_excess);
      for (const std::uint32_t k : net.points.of(i)) net.points.weights[k] *= std::pow(now, weight_power);
    }
  });
}

}  // namespace vspring
