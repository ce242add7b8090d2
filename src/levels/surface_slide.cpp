#include "levels/surface_slide.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <vector>

#include "base/linear_precision.hpp"

namespace vspring {

namespace {

constexpr int longest_walk = 1000;
// Added to squared distances, as a share of the squared mean edge, so that a node at the very place does not count
// alone.
constexpr double blur = 0.1;
// How far weights may miss the place, as a share of the length.
constexpr double greatest_miss = 0.05;

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

/// Finds weights of sum 1, near inverse squared distances, of a node and its neighbours whose mean is the place. False
/// if no weights without negative ones do. ways: a buffer for vectors in the tangent plane.
bool weigh(const Net& net, std::size_t centre, const Vector3& place, std::vector<Neighbour>& neighbours,
           std::vector<Vector3>& ways) {
  neighbours.assign(1, {centre, 0});
  double square = 0;
  for (const Link link : net.rings.links(centre)) {
    if (!link.spoke()) continue;
    neighbours.push_back({link.node(), 0});
    square += (net.positions[link.node()] - net.positions[centre]).squaredNorm();
  }
  const std::size_t count = neighbours.size();
  square *= blur / static_cast<double>(count);
  LinearPrecision linear;
  const Vector3& normal = net.normals[centre];
  ways.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Vector3 d = net.positions[neighbours[k].node] - place;
    ways[k] = d - d.dot(normal) * normal;
    neighbours[k].weight = 1 / (ways[k].squaredNorm() + square + net.tiny);
    linear.add(neighbours[k].weight, ways[k]);
  }
  if (!(linear.size() > 0)) {
    for (Neighbour& one : neighbours) one.weight /= linear.sum();
    return true;
  }
  const Vector3 slope = linear.slope_across(normal);
  double total = 0;
  for (std::size_t k = 0; k < count; ++k) {
    double& weight = neighbours[k].weight;
    weight = std::max(0.0, weight * (1 - slope.dot(ways[k])));
    total += weight;
  }
  Vector3 missed = Vector3::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    neighbours[k].weight /= total;
    missed += neighbours[k].weight * ways[k];
  }
  return missed.squaredNorm() <= greatest_miss * greatest_miss * square;
}

/// Finds, from a moving node on, the triangle that a place lies over, and the weights of its corners. Triangles consist
/// of a node and two successive ones in the walk around it, which covers all faces. In wide uneven triangles the node
/// nearest to the place may be no corner. False if the search ends elsewhere.
bool weigh_corners(const Net& net, std::size_t from, const Vector3& place, std::vector<Neighbour>& corners) {
  for (int step = 0; step < longest_walk && from < net.moving; ++step) {
    const Vector3& normal = net.normals[from];
    const Vector3& centre = net.positions[from];
    const Vector3 to = place - centre;
    const auto links = net.rings.links(from);
    std::size_t next = from;
    const auto between = [&](std::size_t j, std::size_t k) {
      const Vector3 a = net.positions[j] - centre;
      const Vector3 b = net.positions[k] - centre;
      const double area = a.cross(b).dot(normal);
      const double of_a = to.cross(b).dot(normal) / area;
      const double of_b = a.cross(to).dot(normal) / area;
      if (!(of_a >= 0 && of_b >= 0)) return false;
      if (of_a + of_b <= 1) {
        corners.assign({{from, 1 - of_a - of_b}, {j, of_a}, {k, of_b}});
      } else {
        next = of_a > of_b ? j : k;
      }
      return true;
    };
    bool is_found = false;
    for (std::size_t k = 0; k < links.size() && !is_found; ++k) {
      if (links[k].start()) continue;
      is_found = between(links[k > 0 ? k - 1 : links.size() - 1].node(), links[k].node());
    }
    if (!is_found) return false;
    if (next == from) return true;
    from = next;
  }
  return false;
}

}  // namespace

void slide(Net& net, std::span<const Vector3> steps, ThreadTeam& team) {
  std::vector<Place> places(net.moving);
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> neighbours;
    std::vector<Neighbour> corners;
    std::vector<Vector3> ways;
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3 to = net.positions[i] + steps[i];
      const std::size_t there = walk(net, i, to);
      // The walk may end at a held node; what lies beyond is unknown.
      const std::size_t centre = there < net.moving ? there : i;
      if (!weigh(net, centre, to, neighbours, ways) && weigh_corners(net, i, to, corners)) neighbours.swap(corners);
      places[i] = balance(net, [&](const auto& use) {
        for (const Neighbour& one : neighbours) use(one.node, one.weight);
      });
    }
  });
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (net.slides(i)) continue;
      net.positions[i] = places[i].position;
      if (!net.normal_given(i)) net.normals[i] = places[i].normal;
    }
  });
}

}  // namespace vspring
