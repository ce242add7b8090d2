#include "fit/point_factors.hpp"

#include <cmath>

namespace vspring {

namespace {

/// The mean length of the edges of a node.
double mean_edge_at(const Net& net, std::size_t i) {
  double sum = 0;
  double edges = 0;
  for (const Link link : net.rings.links(i)) {
    if (!link.spoke()) continue;
    sum += (net.positions[link.node()] - net.positions[i]).norm();
    edges += 1;
  }
  return edges > 0 ? sum / edges : 0;
}

/// factor(node) for every moving node that has points.
template <typename Factor>
void set_factors(Net& net, const Factor& factor) {
  net.points.factors.assign(net.moving, 0);
  if (net.points.empty()) return;
  for (std::size_t i = 0; i < net.moving; ++i) {
    if (!net.points.of(i).empty()) net.points.factors[i] = factor(i);
  }
}

}  // namespace

double pull_power(const Net& net) { return net.tangents.empty() ? 2 : 3; }

PointFactors pull_by_sums() {
  return [](Net& net) {
    const double power = pull_power(net);
    set_factors(net, [&](std::size_t i) {
      return static_cast<double>(net.points.of(i).size()) * std::pow(mean_edge_at(net, i), power);
    });
  };
}

}  // namespace vspring
