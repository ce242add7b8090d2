#include "levels/surface_slide.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "base/definite3.hpp"
#include "levels/balance.hpp"

namespace vspring {

namespace {

constexpr int longest_walk = 1000;
// Of the squared mean edge, added to squared distances: a node in the very place does not settle it alone.
constexpr double blur = 0.1;

/// The node nearest to a place, on the way down from `from`.
std::size_t walk(const Net& net, std::size_t from, const Vector3& to) {
  double best = (net.positions[from] - to).squaredNorm();
  for (int step = 0; step < longest_walk && from < net.computed; ++step) {
    std::size_t next = from;
    for (const Link link : net.rings.links(from)) {
      const double distance = (net.positions[link.node()] - to).squaredNorm();
      if (distance < best) {
        best = distance;
        next = link.node();
      }
    }
    if (next == from) break;
    from = next;
  }
  return from;
}

struct Neighbour {
  std::size_t node;
  double weight;
};

/// A node and its neighbours, with weights of sum 1 near those of inverse squared distances from a place that put it in
/// its place between them.
void weigh(const Net& net, std::size_t centre, const Vector3& place, std::vector<Neighbour>& neighbours) {
  neighbours.assign(1, {centre, 0});
  double square = 0;
  for (const Link link : net.rings.links(centre)) {
    if (!link.spoke()) continue;
    neighbours.push_back({link.node(), 0});
    square += (net.positions[link.node()] - net.positions[centre]).squaredNorm();
  }
  square *= blur / static_cast<double>(neighbours.size());
  double sum = 0;
  Vector3 mean = Vector3::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  const Vector3& normal = net.normals[centre];
  const auto across = [&](std::size_t j) -> Vector3 {
    const Vector3 d = net.positions[j] - place;
    return d - d.dot(normal) * normal;
  };
  for (Neighbour& one : neighbours) {
    const Vector3 d = across(one.node);
    one.weight = 1 / (d.squaredNorm() + square + net.tiny);
    sum += one.weight;
    mean += one.weight * d;
    spread += one.weight * d * d.transpose();
  }
  const double size = spread.trace();
  if (!(size > 0)) {
    for (Neighbour& one : neighbours) one.weight /= sum;
    return;
  }
  spread += size * normal * normal.transpose() + 1e-9 * size * Eigen::Matrix3d::Identity();
  const Vector3 slope = solve_definite(spread, mean);
  double total = 0;
  for (Neighbour& one : neighbours) {
    one.weight = std::max(0.0, one.weight * (1 - slope.dot(across(one.node))));
    total += one.weight;
  }
  for (Neighbour& one : neighbours) one.weight /= total;
}

}  // namespace

void slide(Net& net, std::span<const Vector3> steps, ThreadTeam& team) {
  std::vector<Place> places(net.moving);
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> neighbours;
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3 to = net.positions[i] + steps[i];
      const std::size_t there = walk(net, i, to);
      // Beside what is held the walk may end there; what lies behind is not known.
      weigh(net, there < net.moving ? there : i, to, neighbours);
      places[i] = balance(net, [&](const auto& use) {
        for (const Neighbour& one : neighbours) use(one.node, one.weight);
      });
    }
  });
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      net.positions[i] = places[i].position;
      if (!net.normal_given(i)) net.normals[i] = places[i].normal;
    }
  });
}

}  // namespace vspring
