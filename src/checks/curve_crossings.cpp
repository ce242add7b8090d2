#include "checks/curve_crossings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "shape/box_tree.hpp"
#include "shape/planarity.hpp"

namespace vspring {

namespace {

struct Edge {
  std::size_t from;
  std::size_t to;
};

// Edges that follow each other, in one box of the tree.
constexpr std::size_t edges_per_box = 16;
constexpr std::size_t boxes_per_task = 64;
// As a share of the size: at a tail where two ends meet, sides may change places by less than is visible.
constexpr double tail = 0.05;
// Likewise: how near is touching.
constexpr double touching_share = 1e-9;

std::vector<Edge> edges_of(const Net& net) {
  std::vector<Edge> edges;
  edges.reserve(net.computed + 1);
  for (std::size_t i = 0; i < net.computed; ++i) {
    for (const Link link : net.rings.links(i)) {
      const std::size_t j = link.node();
      // Each of them once.
      if (j < i && j < net.computed) continue;
      if (i < net.moving || j < net.moving) edges.push_back({i, j});
    }
  }
  return edges;
}

/// near: nodes that are no further from an edge than this are on both sides of it.
bool cross(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d, const Vector3& normal, double near) {
  const auto are_apart = [&](const Vector3& from, const Vector3& to, const Vector3& one, const Vector3& other) {
    const Vector3 across = normal.cross(to - from);
    const double first = across.dot(one - from);
    const double second = across.dot(other - from);
    return first * second < 0 || std::min(std::abs(first), std::abs(second)) < near * across.norm();
  };
  return are_apart(a, b, c, d) && are_apart(c, d, a, b);
}

/// Whether the edges are successive and none goes back against the direction from the first to the last: then no two
/// cross.
bool goes_one_way(const std::vector<Edge>& edges, std::size_t first, std::size_t last,
                  const std::vector<Vector3>& positions) {
  const Vector3 way = positions[edges[last - 1].to] - positions[edges[first].from];
  for (std::size_t k = first; k < last; ++k) {
    if (k > first && edges[k].from != edges[k - 1].to) return false;
    if (!((positions[edges[k].to] - positions[edges[k].from]).dot(way) > 0)) return false;
  }
  return true;
}

/// Places of the ends of open curves.
std::vector<Vector3> ends_of(const Net& net, const std::vector<Vector3>& positions) {
  std::vector<Vector3> ends;
  for (std::size_t i = 0; i < net.computed; ++i) {
    if (net.rings.links(i).size() == 1) ends.push_back(positions[i]);
  }
  return ends;
}

}  // namespace

std::size_t curve_crossings(const Net& net, const std::vector<Vector3>& positions, ThreadTeam& team,
                            Touching touching) {
  const auto normal = plane_normal(positions);
  if (!normal) return 0;
  const std::vector<Edge> edges = edges_of(net);
  const std::vector<Vector3> ends = ends_of(net, positions);
  Box all;
  for (const Vector3& position : positions) all.extend(position);
  const double near = touching == Touching::counts ? touching_share * all.diagonal().norm() : 0;
  const double reach2 = tail * tail * all.diagonal().squaredNorm();
  const auto is_at_a_tail = [&](const Vector3& place) {
    return std::count_if(ends.begin(), ends.end(),
                         [&](const Vector3& end) { return (end - place).squaredNorm() < reach2; }) > 1;
  };
  const auto box_of = [&](const Edge& edge) { return Box(positions[edge.from]).extend(positions[edge.to]); };
  std::vector<Box> boxes((edges.size() + edges_per_box - 1) / edges_per_box);
  for (std::size_t k = 0; k < edges.size(); ++k) boxes[k / edges_per_box].extend(box_of(edges[k]));
  const BoxTree tree(boxes, team);
  const auto first_of = [&](std::size_t item) { return std::min(item * edges_per_box, edges.size()); };
  const auto crossings_of = [&](std::size_t a, std::size_t b) {
    if (b <= a + 1 && goes_one_way(edges, first_of(a), first_of(b + 1), positions)) return std::size_t{0};
    std::size_t crossing = 0;
    for (std::size_t k = first_of(a); k < first_of(a + 1); ++k) {
      const Edge& edge = edges[k];
      const Box box = box_of(edge);
      if (!boxes[b].intersects(box)) continue;
      for (std::size_t other = std::max(first_of(b), k + 1); other < first_of(b + 1); ++other) {
        const auto& [from, to] = edges[other];
        const bool is_beside = from == edge.from || from == edge.to || to == edge.from || to == edge.to;
        if (!is_beside && box.intersects(box_of(edges[other])) &&
            cross(positions[edge.from], positions[edge.to], positions[from], positions[to], *normal, near) &&
            !is_at_a_tail(positions[edge.from]))
          ++crossing;
      }
    }
    return crossing;
  };
  std::atomic<std::size_t> count = 0;
  parallel_ranges(team, boxes.size(), boxes_per_task, [&](std::size_t begin, std::size_t end) {
    std::size_t crossing = 0;
    for (std::size_t a = begin; a < end; ++a) {
      tree.for_each_overlapping_leaf(boxes[a], 0, [&](std::size_t leaf) {
        for (const Index item : tree.leaf_items(leaf)) {
          const auto b = static_cast<std::size_t>(item);
          if (b >= a && boxes[a].intersects(boxes[b])) crossing += crossings_of(a, b);
        }
      });
    }
    count += crossing;
  });
  return count;
}

}  // namespace vspring
