#include "fairness/height_field.hpp"

// Seen along a direction that all triangles face, each triangle turns counter-clockwise. So the number of triangles
// over a place of the view is how often their outlines wind around it. Edges along which two triangles run in opposite
// directions cancel; the boundary remains. If it consists of simple curves apart from each other, only one of which is
// counter-clockwise, it winds around no place more than once. Then no place has two triangles over it, while two
// crossing triangles would have one in common.

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <span>

#include "shape/box_tree.hpp"

namespace vspring {

namespace {

// A margin for coordinates of at most 2. Rounding moves a place of the view by less than 16 ε; this is 4,096 ε, and
// still far below the distances of nodes of a mesh.
constexpr double view_margin = 0x1p-40;

class HeightField {
 public:
  HeightField(const std::vector<Triangle>& triangles, const std::vector<Vector3>& positions, ThreadTeam& team)
      : triangles_(triangles), positions_(positions), team_(team) {}

  [[nodiscard]] bool holds() {
    if (triangles_.empty()) return true;
    if (!all_face_one_way()) return false;
    find_boundary();
    return winds_once();
  }

 private:
  using Place = Eigen::Vector2d;

  struct Edge {
    Index from;
    Index to;
  };

  [[nodiscard]] const Vector3& at(Index node) const { return positions_[static_cast<std::size_t>(node)]; }

  /// Sets direction_, the mean of the area normals.
  [[nodiscard]] bool all_face_one_way() {
    const auto two_edges = [&](const Triangle& triangle) {
      return std::pair<Vector3, Vector3>(at(triangle.nodes[1]) - at(triangle.nodes[0]),
                                         at(triangle.nodes[2]) - at(triangle.nodes[0]));
    };
    const auto add = [&](std::size_t begin, std::size_t end, Vector3& sum) {
      for (std::size_t k = begin; k < end; ++k) {
        const auto [u, v] = two_edges(triangles_[k]);
        sum += u.cross(v);
      }
    };
    Vector3 sum = Vector3::Zero();
    for (const Vector3& part : parallel_parts<Vector3>(team_, triangles_.size(), faces_per_task, sum, add)) sum += part;
    direction_ = sum.normalized();
    std::atomic<bool> all = true;
    parallel_ranges(team_, triangles_.size(), faces_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end && all; ++k) {
        const auto [u, v] = two_edges(triangles_[k]);
        // The rounding of the cross product goes with the product of the lengths, which is at most this.
        if (!(u.cross(v).dot(direction_) > view_margin * (u.squaredNorm() + v.squaredNorm()))) all = false;
      }
    });
    return all;
  }

  /// Sets boundary_: the edges that do not cancel, with multiplicity, by their first nodes.
  void find_boundary() {
    // At the lower node of each edge: twice the other node, plus 1 if the triangle runs towards the lower one.
    std::vector<std::size_t> end_of(positions_.size() + 1, 0);
    const auto for_each_edge = [&](const auto& use) {
      for (const Triangle& triangle : triangles_) {
        const auto [a, b, c] = triangle.nodes;
        use(a, b);
        use(b, c);
        use(c, a);
      }
    };
    for_each_edge([&](Index from, Index to) { ++end_of[static_cast<std::size_t>(std::min(from, to)) + 1]; });
    for (std::size_t i = 1; i < end_of.size(); ++i) end_of[i] += end_of[i - 1];
    // Where those of a node begin; advances to their end.
    std::vector<std::uint32_t> uses(3 * triangles_.size());
    for_each_edge([&](Index from, Index to) {
      const auto [low, high] = std::minmax(from, to);
      uses[end_of[static_cast<std::size_t>(low)]++] = 2 * static_cast<std::uint32_t>(high) + (from == low ? 0 : 1);
    });
    const auto cancel = [&](std::size_t first, std::size_t last, std::vector<Edge>& left) {
      for (std::size_t low = first; low < last; ++low) {
        const std::size_t begin = low == 0 ? 0 : end_of[low - 1];
        const auto own = std::span(uses).subspan(begin, end_of[low] - begin);
        std::sort(own.begin(), own.end());
        for (std::size_t k = 0; k < own.size();) {
          const std::uint32_t high = own[k] / 2;
          int away = 0;
          for (; k < own.size() && own[k] / 2 == high; ++k) away += own[k] % 2 == 0 ? 1 : -1;
          const Edge edge = {static_cast<Index>(low), static_cast<Index>(high)};
          for (; away > 0; --away) left.push_back(edge);
          for (; away < 0; ++away) left.push_back({edge.to, edge.from});
        }
      }
    };
    for (const auto& left : parallel_parts(team_, positions_.size(), nodes_per_task, std::vector<Edge>(), cancel))
      boundary_.insert(boundary_.end(), left.begin(), left.end());
    std::sort(boundary_.begin(), boundary_.end(), [](const Edge& a, const Edge& b) { return a.from < b.from; });
  }

  /// As many boundary edges arrive at a node as leave it. With one of each they form closed curves. With more, only the
  /// first is followed; the others touch the curve and are found by that.
  [[nodiscard]] bool winds_once() {
    const Vector3 across = direction_.unitOrthogonal();
    const Vector3 upwards = direction_.cross(across);
    std::vector<Place> seen;
    std::vector<std::size_t> next;
    for (const Edge& edge : boundary_) {
      seen.emplace_back(across.dot(at(edge.from)), upwards.dot(at(edge.from)));
      const auto found = std::lower_bound(boundary_.begin(), boundary_.end(), edge.to,
                                          [](const Edge& other, Index node) { return other.from < node; });
      next.push_back(static_cast<std::size_t>(found - boundary_.begin()));
    }
    return curves_are_simple(seen, next) && one_is_counter_clockwise(seen, next);
  }

  static double cross(const Place& u, const Place& v) { return u.x() * v.y() - u.y() * v.x(); }

  /// Whether c and d lie clearly on one side of the line ab.
  static bool beside(const Place& a, const Place& b, const Place& c, const Place& d) {
    const Place along = b - a;
    const double nearest = view_margin * along.norm();
    const double at_c = cross(along, c - a);
    const double at_d = cross(along, d - a);
    return std::min(at_c, at_d) > nearest || std::max(at_c, at_d) < -nearest;
  }

  /// An edge that goes back over the one before also touches the one after, except in curves of three nodes, which then
  /// have no area.
  [[nodiscard]] bool curves_are_simple(const std::vector<Place>& seen, const std::vector<std::size_t>& next) {
    std::vector<Box> boxes;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const Place& here = seen[k];
      const Place& there = seen[next[k]];
      const Place reach = Place::Constant(view_margin);
      const Place low = here.cwiseMin(there) - reach;
      const Place high = here.cwiseMax(there) + reach;
      boxes.emplace_back(Vector3(low.x(), low.y(), 0), Vector3(high.x(), high.y(), 0));
    }
    const BoxTree tree(std::move(boxes), team_);
    const auto are_apart = [&](std::size_t k, std::size_t other) {
      if (other == k || other == next[k] || k == next[other]) return true;
      if (!tree.box(static_cast<Index>(k)).intersects(tree.box(static_cast<Index>(other)))) return true;
      return beside(seen[k], seen[next[k]], seen[other], seen[next[other]]) ||
             beside(seen[other], seen[next[other]], seen[k], seen[next[k]]);
    };
    std::atomic<bool> simple = true;
    parallel_ranges(team_, seen.size(), nodes_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end && simple; ++k) {
        tree.for_each_overlapping_leaf(tree.box(static_cast<Index>(k)), 0, [&](std::size_t leaf) {
          for (const Index other : tree.leaf_items(leaf)) {
            if (!are_apart(k, static_cast<std::size_t>(other))) simple = false;
          }
        });
      }
    });
    return simple;
  }

  static bool one_is_counter_clockwise(const std::vector<Place>& seen, const std::vector<std::size_t>& next) {
    std::vector<std::uint8_t> visited(seen.size(), 0);
    int counter_clockwise = 0;
    for (std::size_t first = 0; first < seen.size(); ++first) {
      double area = 0;
      double length = 0;
      double edges = 0;
      for (std::size_t k = first; visited[k] == 0; k = next[k]) {
        visited[k] = 1;
        area += cross(seen[k] - seen[first], seen[next[k]] - seen[first]);
        length += (seen[next[k]] - seen[k]).norm();
        ++edges;
      }
      // Each edge adds rounding to the area of at most its share of the length.
      if (edges > 0 && !(std::abs(area) > view_margin * edges * length)) return false;
      if (area > 0) ++counter_clockwise;
    }
    return counter_clockwise == 1;
  }

  const std::vector<Triangle>& triangles_;
  const std::vector<Vector3>& positions_;
  ThreadTeam& team_;
  Vector3 direction_ = Vector3::Zero();
  std::vector<Edge> boundary_;
};

}  // namespace

bool is_height_field(const std::vector<Triangle>& triangles, const std::vector<Vector3>& positions, ThreadTeam& team) {
  return HeightField(triangles, positions, team).holds();
}

}  // namespace vspring
