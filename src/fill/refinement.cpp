// Makes patches as dense as the mesh around (P. Liepa, Filling holes in meshes, 2003, §3).
#include "fill/refinement.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_set>
#include <utility>

#include "base/cancellation.hpp"
#include "shape/direction.hpp"

namespace vspring {

namespace {

// Liepa's α: a triangle is split if its centroid is further than spacing / α from all corners.
constexpr double density = 1.4142135623730951;
// If the sine of the sum of opposite angles is smaller, they sum up to 180°.
constexpr double as_good = 1e-9;
// Limit of swaps per edge, on average: in space edges might be swapped for ever.
constexpr std::size_t most_swaps = 20;

class Refiner {
 public:
  Refiner(Patch& patch, const std::vector<std::vector<Index>>& joined) : patch_(patch) {
    for (std::size_t a = 0; a < joined.size(); ++a) {
      for (const Index b : joined[a]) edges_.insert(key(static_cast<Index>(a), b));
    }
    rim_ = static_cast<Index>(joined.size());
    find_neighbours();
  }

  bool run() {
    const std::size_t count = patch_.places.size();
    // A patch that was refined before has none.
    keeps_off_rim_ = static_cast<Index>(count) > rim_;
    for (std::size_t t = 0; t < triangles().size(); ++t) touched_.push_back(static_cast<Index>(t));
    swap_edges();
    while (split_triangles()) swap_edges();
    if (static_cast<Index>(patch_.places.size()) > rim_) {
      keeps_off_rim_ = true;
      for (Index t = 0; t < static_cast<Index>(triangles().size()); ++t) {
        for (std::size_t c = 0; c < 3; ++c) cut(t, c);
      }
      swap_edges();
    }
    return has_swapped_ || patch_.places.size() > count;
  }

 private:
  using Corners = std::array<Index, 3>;

  [[nodiscard]] std::vector<Corners>& triangles() { return patch_.triangles; }
  [[nodiscard]] Corners& triangle(Index t) { return patch_.triangles[static_cast<std::size_t>(t)]; }
  /// The neighbours of a triangle, beyond the edge opposite to each corner; −1 at the rim.
  [[nodiscard]] Corners& neighbours(Index t) { return neighbours_[static_cast<std::size_t>(t)]; }
  [[nodiscard]] const Vector3& place(Index node) const { return patch_.places[static_cast<std::size_t>(node)]; }
  [[nodiscard]] static std::uint64_t key(Index a, Index b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint64_t>(std::max(a, b));
  }

  void find_neighbours() {
    neighbours_.assign(triangles().size(), {-1, -1, -1});
    std::map<std::pair<Index, Index>, std::pair<Index, std::size_t>> sides;
    for (std::size_t t = 0; t < triangles().size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const Index a = triangles()[t][(c + 1) % 3];
        const Index b = triangles()[t][(c + 2) % 3];
        edges_.insert(key(a, b));
        sides[{a, b}] = {static_cast<Index>(t), c};
        const auto other = sides.find({b, a});
        if (other == sides.end()) continue;
        neighbours_[t][c] = other->second.first;
        neighbours(other->second.first)[other->second.second] = static_cast<Index>(t);
      }
    }
  }

  void replace_neighbour(Index t, Index before, Index now) {
    if (t < 0) return;
    Corners& around = neighbours(t);
    *std::find(around.begin(), around.end(), before) = now;
  }

  [[nodiscard]] bool is_coarse(const Corners& corners, const Vector3& centroid, double spacing) const {
    return std::all_of(corners.begin(), corners.end(), [&](Index node) {
      return density * (place(node) - centroid).norm() >
             std::max(spacing, patch_.spacing[static_cast<std::size_t>(node)]);
    });
  }

  /// Returns whether there were any to split.
  bool split_triangles() {
    const auto count = static_cast<Index>(triangles().size());
    for (Index t = 0; t < count; ++t) {
      end_if_cancelled_at(static_cast<std::size_t>(t));
      const Corners corners = triangle(t);
      if (is_coarse(corners, mean(patch_.places, corners), mean(patch_.spacing, corners))) split(t);
    }
    return static_cast<Index>(triangles().size()) > count;
  }

  template <typename Value>
  static Value mean(const std::vector<Value>& values, std::span<const Index> nodes) {
    Value sum = values[static_cast<std::size_t>(nodes[0])];
    for (const Index node : nodes.subspan(1)) sum += values[static_cast<std::size_t>(node)];
    return sum / static_cast<double>(nodes.size());
  }

  /// Adds a node at the mean of others.
  Index add_node(std::span<const Index> around) {
    const Vector3 middle = mean(patch_.places, around);
    const auto nearer = [&](Index i, Index j) { return (place(i) - middle).norm() < (place(j) - middle).norm(); };
    patch_.like.push_back(
        patch_.like[static_cast<std::size_t>(*std::min_element(around.begin(), around.end(), nearer))]);
    patch_.flat.push_back(mean(patch_.flat, around));
    patch_.spacing.push_back(mean(patch_.spacing, around));
    patch_.places.push_back(middle);
    return static_cast<Index>(patch_.places.size()) - 1;
  }

  /// The triangle beyond the edge opposite to a corner, and its corner there.
  [[nodiscard]] std::pair<Index, std::size_t> beyond(Index t, std::size_t c) {
    const Index s = neighbours(t)[c];
    if (s < 0) return {s, 0};
    const Corners& around = neighbours(s);
    return {s, static_cast<std::size_t>(std::find(around.begin(), around.end(), t) - around.begin())};
  }

  /// Splits the edge opposite to a corner in the middle, if it leads across the patch from rim to rim and is not short.
  /// If it is short, and sharp, and the triangle has all corners at the rim, it is swapped: that triangle could not
  /// become fair.
  void cut(Index t, std::size_t c) {
    const auto [s, d] = beyond(t, c);
    const Index p = triangle(t)[c];
    const Index u = triangle(t)[(c + 1) % 3];
    const Index w = triangle(t)[(c + 2) % 3];
    if (s < 0 || u >= rim_ || w >= rim_) return;
    const Index q = triangle(s)[d];
    if ((place(u) - place(w)).norm() < mean(patch_.spacing, std::array{u, w})) {
      if (p < rim_ && q >= rim_ && is_sharp(p, u, q, w) && is_unfolded(p, u, q, w)) turn(t, c);
      return;
    }
    const Index node = add_node(std::array{u, w});
    const Index beyond_wp = neighbours(t)[(c + 1) % 3];
    const Index beyond_pu = neighbours(t)[(c + 2) % 3];
    const Index beyond_uq = neighbours(s)[(d + 1) % 3];
    const Index beyond_qw = neighbours(s)[(d + 2) % 3];
    const auto third = static_cast<Index>(triangles().size());
    const Index fourth = third + 1;
    triangle(t) = {p, u, node};
    neighbours(t) = {fourth, third, beyond_pu};
    triangles().push_back({p, node, w});
    neighbours_.push_back({s, beyond_wp, t});
    triangle(s) = {q, w, node};
    neighbours(s) = {third, fourth, beyond_qw};
    triangles().push_back({q, node, u});
    neighbours_.push_back({t, beyond_uq, s});
    replace_neighbour(beyond_wp, t, third);
    replace_neighbour(beyond_uq, s, fourth);
    edges_.erase(key(u, w));
    for (const Index corner : {p, u, q, w}) edges_.insert(key(corner, node));
    touched_.insert(touched_.end(), {t, s, third, fourth});
  }

  void split(Index t) {
    const auto [a, b, c] = triangle(t);
    const auto [beyond_a, beyond_b, beyond_c] = neighbours(t);
    const Index node = add_node(std::array{a, b, c});
    const auto second = static_cast<Index>(triangles().size());
    const Index third = second + 1;
    triangle(t) = {a, b, node};
    neighbours(t) = {second, third, beyond_c};
    triangles().push_back({b, c, node});
    neighbours_.push_back({third, t, beyond_a});
    triangles().push_back({c, a, node});
    neighbours_.push_back({t, second, beyond_b});
    replace_neighbour(beyond_a, t, second);
    replace_neighbour(beyond_b, t, third);
    for (const Index corner : {a, b, c}) edges_.insert(key(corner, node));
    touched_.insert(touched_.end(), {t, second, third});
  }

  void swap_edges() {
    std::size_t swaps_left = most_swaps * triangles().size();
    for (std::size_t step = 0; !touched_.empty() && swaps_left > 0; ++step) {
      end_if_cancelled_at(step);
      const Index t = touched_.back();
      touched_.pop_back();
      for (std::size_t c = 0; c < 3; ++c) {
        if (!swap(t, c)) continue;
        --swaps_left;
        break;
      }
    }
    touched_.clear();
  }

  /// Swaps the edge opposite to a corner for the other diagonal of its quad, if that is better.
  bool swap(Index t, std::size_t c) {
    const auto [s, d] = beyond(t, c);
    if (s < 0) return false;
    const Index p = triangle(t)[c];
    const Index u = triangle(t)[(c + 1) % 3];
    const Index w = triangle(t)[(c + 2) % 3];
    const Index q = triangle(s)[d];
    if (keeps_off_rim_ && p < rim_ && q < rim_) return false;
    return is_better(p, u, q, w) && turn(t, c);
  }

  /// Returns whether it could be done: not if the other diagonal is an edge already.
  bool turn(Index t, std::size_t c) {
    const auto [s, d] = beyond(t, c);
    const Index p = triangle(t)[c];
    const Index u = triangle(t)[(c + 1) % 3];
    const Index w = triangle(t)[(c + 2) % 3];
    const Index q = triangle(s)[d];
    if (!edges_.insert(key(p, q)).second) return false;
    has_swapped_ = true;
    edges_.erase(key(u, w));
    const Index beyond_pu = neighbours(t)[(c + 2) % 3];
    const Index beyond_wp = neighbours(t)[(c + 1) % 3];
    const Index beyond_qw = neighbours(s)[(d + 2) % 3];
    const Index beyond_uq = neighbours(s)[(d + 1) % 3];
    triangle(t) = {p, u, q};
    neighbours(t) = {beyond_uq, s, beyond_pu};
    triangle(s) = {q, w, p};
    neighbours(s) = {beyond_wp, t, beyond_qw};
    replace_neighbour(beyond_uq, s, t);
    replace_neighbour(beyond_wp, t, s);
    touched_.insert(touched_.end(), {s, t});
    return true;
  }

  /// Twice the vector area of a triangle.
  [[nodiscard]] Vector3 vector(Index a, Index b, Index c) const {
    return (place(b) - place(a)).cross(place(c) - place(a));
  }

  /// Whether the edge from p to q is better than that from u to w.
  [[nodiscard]] bool is_better(Index p, Index u, Index q, Index w) const {
    const auto angle_at = [&](Index tip) {
      const Vector3 to_u = (place(u) - place(tip)).normalized();
      const Vector3 to_w = (place(w) - place(tip)).normalized();
      return std::pair(to_u.dot(to_w), to_u.cross(to_w).norm());
    };
    const auto [cos_p, sin_p] = angle_at(p);
    const auto [cos_q, sin_q] = angle_at(q);
    return sin_p * cos_q + cos_p * sin_q < -as_good && is_unfolded(p, u, q, w);
  }

  /// Whether the triangles at the edge from u to w turn by more than 60°.
  [[nodiscard]] bool is_sharp(Index p, Index u, Index q, Index w) const {
    const Vector3 first = vector(p, u, w);
    const Vector3 second = vector(q, w, u);
    return first.dot(second) < 0.5 * first.norm() * second.norm();
  }

  /// Whether the triangles at the edge from p to q face the way of those at the edge from u to w.
  [[nodiscard]] bool is_unfolded(Index p, Index u, Index q, Index w) const {
    const Vector3 before = vector(p, u, w) + vector(q, w, u);
    const Vector3 first = vector(p, u, q);
    const Vector3 second = vector(q, w, p);
    return first.dot(before) > 0 && second.dot(before) > 0 && first.dot(second) > 0;
  }

  Patch& patch_;
  Index rim_ = 0;  ///< nodes of the rim
  bool has_swapped_ = false;
  bool keeps_off_rim_ = false;  ///< whether no more edges from rim to rim are made
  std::vector<Corners> neighbours_;
  std::unordered_set<std::uint64_t> edges_;  ///< all edges, also those outside between nodes of the rim
  std::vector<Index> touched_;               ///< triangles whose edges may need swaps
};

}  // namespace

bool refine(Patch& patch, const std::vector<std::vector<Index>>& joined) { return Refiner(patch, joined).run(); }

}  // namespace vspring
