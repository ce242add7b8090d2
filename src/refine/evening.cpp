// M. Botsch, L. Kobbelt, A remeshing approach to multiresolution modeling, 2004, §4.
#include "refine/evening.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <queue>
#include <utility>

#include "base/cancellation.hpp"
#include "vspring/error.hpp"
#include "vspring/refine.hpp"

namespace vspring {

namespace {

constexpr int rounds = 10;
// In the first rounds a collapse may make edges that are split in the next one.
constexpr int rounds_of_long_edges = 6;
// In the last rounds edges are flipped for greater angles instead of six triangles at a node.
constexpr int rounds_by_angles = 3;
// Of the length of edges: longer ones are halved, shorter ones collapsed.
constexpr double longest_share = 4.0 / 3;
constexpr double shortest_share = 4.0 / 5;
constexpr double longest_for_collapse = 1.6;
// How far from the middle of an edge its new node may be, in its length.
constexpr double most_rise = 0.1;
// How much the length of edges may change per distance near edges that stay.
constexpr double change_per_distance = 0.5;
// Near edges that stay and are shorter than this share of the length, others need not be so short.
constexpr double least_target = 0.05;
// The cosine of the greatest turn of a face in one step.
constexpr double least_cosine = 0.5;
// Twice the area over the square of the longest edge: flatter triangles have no direction, and are made only in place
// of still flatter ones.
constexpr double sliver = 0.05;
// How many triangles should meet at a node.
constexpr int count_inside = 6;
constexpr int count_at_boundary = 3;

Vector3 twice_area(const std::array<Vector3, 3>& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

double roundness(const std::array<Vector3, 3>& corners) {
  const double longest = std::max({(corners[1] - corners[0]).squaredNorm(), (corners[2] - corners[1]).squaredNorm(),
                                   (corners[0] - corners[2]).squaredNorm()});
  return longest > 0 ? twice_area(corners).norm() / longest : 0;
}

/// Whether a triangle with `area` before turns by at most 60°, and does not come to face away from the surface.
bool keeps_direction(const Vector3& area, bool is_sliver, const Vector3& after, const Vector3& normal) {
  const Vector3& like = is_sliver && !normal.isZero(0) ? normal : area;
  if (!(after.dot(like) >= least_cosine * after.norm() * like.norm()) || after.isZero(0)) return false;
  return after.dot(normal) >= 0 || area.dot(normal) < 0;
}

/// An edge to be changed, in the order of its length.
struct DueEdge {
  double key;
  Index low;
  Index high;
  bool operator<(const DueEdge& other) const {
    if (key != other.key) return key < other.key;
    return low != other.low ? low > other.low : high > other.high;
  }
};

}  // namespace

Evening::Evening(TrianglesOnSurface& shape, const InputSurface& surface, double length, Hold hold)
    : shape_(shape), triangles_(shape.triangles), surface_(surface), length_(length), hold_(std::move(hold)) {}

void Evening::run() {
  for (int round = 0; round < rounds; ++round) {
    find_targets();
    split_long_edges();
    most_excess_ = round < rounds_of_long_edges ? longest_for_collapse : longest_share;
    collapse_short_edges();
    flip_edges(round + rounds_by_angles >= rounds);
    move_nodes();
  }
}

/// Edges between nodes that stay cannot become longer, and those at other faces not shorter: those near them are like
/// them, for otherwise the triangles between would be slivers.
void Evening::find_targets() {
  targets_.assign(shape_.places.size(), length_);
  std::vector<NodePair> edges_that_stay;
  for (const auto& [a, b] : triangles_.edges()) {
    if (stays(a) && stays(b)) edges_that_stay.emplace_back(a, b);
  }
  const auto spread_from = [&](bool upwards) {
    std::vector<Index> from;
    for (const auto& [a, b] : edges_that_stay) {
      if (!upwards && triangles_.line_of(a, b) != EditableTriangles::fixed_line) continue;
      const double own = std::max(length(a, b), least_target * length_);
      for (const Index node : {a, b}) {
        double& target = targets_[static_cast<std::size_t>(node)];
        if (upwards ? own >= target : own <= target) continue;
        target = own;
        from.push_back(node);
      }
    }
    spread(from, upwards);
  };
  spread_from(true);
  spread_from(false);
}

/// Small targets grow with the distance, and large ones shrink, until they meet those that are there.
void Evening::spread(const std::vector<Index>& from, bool upwards) {
  const double sense = upwards ? -1 : 1;
  std::priority_queue<std::pair<double, Index>> due;
  for (const Index node : from) due.emplace(sense * targets_[static_cast<std::size_t>(node)], node);
  while (!due.empty()) {
    const auto [key, node] = due.top();
    due.pop();
    const double size = targets_[static_cast<std::size_t>(node)];
    if (key < sense * size) continue;
    for (const Index number : triangles_.around(node)) {
      for (const Index other : triangles_.triangle(number).nodes) {
        if (other == node) continue;
        double& known = targets_[static_cast<std::size_t>(other)];
        const double next = size - sense * change_per_distance * length(node, other);
        if (!(sense * next > sense * known)) continue;
        known = next;
        due.emplace(sense * next, other);
      }
    }
  }
}

void Evening::split_long_edges() {
  std::priority_queue<DueEdge> due;
  const auto add = [&](Index a, Index b) {
    const auto [low, high] = std::minmax(a, b);
    const double much = excess(a, b);
    if (much > longest_share && triangles_.line_of(a, b) != EditableTriangles::fixed_line) due.push({much, low, high});
  };
  for (const auto& [a, b] : triangles_.edges()) add(a, b);
  for (std::size_t step = 0; !due.empty(); ++step) {
    end_if_cancelled_at(step);
    const DueEdge edge = due.top();
    due.pop();
    if (!triangles_.is_edge(edge.low, edge.high)) continue;
    if (triangles_.node_count() > most_new_nodes)
      throw Error(
          ErrorCode::invalid_argument,
          fmt::format("edges so short need more than {} nodes, which are refused; choose longer ones", most_new_nodes));
    split(edge.low, edge.high);
    const Index middle = triangles_.node_count() - 1;
    for (const Index other : triangles_.neighbours(middle)) add(middle, other);
  }
}

/// The new node lies on the surface, unless a triangle would fold.
void Evening::split(Index a, Index b) {
  const EditableTriangles::Sides sides = triangles_.sides(a, b);
  const Index line_of_edge = triangles_.line_of(a, b);
  const Vector3 mean = place(a) / 2 + place(b) / 2;
  const Index near = line_of_edge < 0 ? std::max(line(a) < 0 ? shape_.origins[static_cast<std::size_t>(a)].item : -1,
                                                 line(b) < 0 ? shape_.origins[static_cast<std::size_t>(b)].item : -1)
                                      : -1;
  SurfacePlace at = on_surface(mean, normal(a) + normal(b), line_of_edge, near);
  const Index middle = triangles_.add_node();
  const bool is_held = sides.count == 1 && hold_(middle, a, b);
  // Nearer to the middle than this, all edges made are shorter than the one that is split.
  bool is_free = !is_held && (at.place - mean).norm() <= most_rise * length(a, b);
  for (std::size_t side = 0; side < sides.count && is_free; ++side) {
    const EditableTriangles::Triangle& triangle = triangles_.triangle(sides.triangle[side]);
    for (const Index end : {a, b}) {
      const Change change = change_of(triangle, end, at.place, normal(a) + normal(b));
      is_free = is_free && keeps_direction(twice_area(change.before), roundness(change.before) < sliver,
                                           twice_area(change.after), change.normal);
    }
  }
  shape_.places.push_back(is_free ? at.place : mean);
  shape_.normals.push_back(surface_.normal_at(at));
  shape_.origins.push_back(at);
  shape_.stays.push_back(is_held ? 1 : 0);
  shape_.lines.push_back(line_of_edge);
  targets_.push_back((targets_[static_cast<std::size_t>(a)] + targets_[static_cast<std::size_t>(b)]) / 2);
  triangles_.split(a, b, middle);
}

void Evening::collapse_short_edges() {
  std::priority_queue<DueEdge> due;
  const auto add = [&](Index a, Index b) {
    const auto [low, high] = std::minmax(a, b);
    const double much = excess(a, b);
    if (much < shortest_share && !(stays(a) && stays(b))) due.push({-much, low, high});
  };
  for (const auto& [a, b] : triangles_.edges()) add(a, b);
  for (std::size_t step = 0; !due.empty(); ++step) {
    end_if_cancelled_at(step);
    const auto [key, low, high] = due.top();
    due.pop();
    if (!triangles_.is_edge(low, high) || -key != excess(low, high)) continue;
    for (const auto& [from, to] : {std::pair(high, low), std::pair(low, high)}) {
      if (!may_collapse(from, to)) continue;
      triangles_.collapse(from, to);
      for (const Index other : triangles_.neighbours(to)) add(to, other);
      break;
    }
  }
}

bool Evening::may_collapse(Index from, Index to) const {
  if (stays(from)) return false;
  if (line(from) >= 0 && triangles_.line_of(from, to) != line(from)) return false;
  if (!triangles_.can_collapse(from, to)) return false;
  for (const Index other : triangles_.neighbours(from)) {
    if (other != to && excess(other, to) > most_excess_) return false;
  }
  const auto around = triangles_.around(from);
  return std::all_of(around.begin(), around.end(), [&](Index number) {
    const EditableTriangles::Triangle& triangle = triangles_.triangle(number);
    if (triangle.place_of(to) < 3) return true;
    const Change change = change_of(triangle, from, place(to), normal(to));
    const double before = roundness(change.before);
    const double after = roundness(change.after);
    return (after >= sliver || after >= before) &&
           keeps_direction(twice_area(change.before), before < sliver, twice_area(change.after), change.normal);
  });
}

void Evening::flip_edges(bool by_angles) {
  std::size_t step = 0;
  for (const auto& [a, b] : triangles_.edges()) {
    end_if_cancelled_at(step++);
    if (!triangles_.is_edge(a, b) || !triangles_.can_flip(a, b)) continue;
    const EditableTriangles::Sides sides = triangles_.sides(a, b);
    const EditableTriangles::Triangle& left = triangles_.triangle(sides.triangle[0]);
    const EditableTriangles::Triangle& right = triangles_.triangle(sides.triangle[1]);
    const std::array<Index, 4> nodes = {left.node(sides.corner[0]), left.node(sides.corner[0] + 1),
                                        left.node(sides.corner[0] + 2), right.node(sides.corner[1] + 2)};
    if (improves(nodes, by_angles) && may_flip(nodes)) triangles_.flip(a, b);
  }
}

/// nodes: the ends of the edge, and those opposite.
bool Evening::improves(const std::array<Index, 4>& nodes, bool by_angles) const {
  const auto& [a, b, c, d] = nodes;
  if (by_angles) {
    // Whether the angles at c and d sum up to more than 180°.
    const auto angle_at = [&](Index node) {
      const Vector3 one = place(nodes[0]) - place(node);
      const Vector3 other = place(nodes[1]) - place(node);
      return std::atan2(one.cross(other).norm(), one.dot(other));
    };
    constexpr double half_turn = 3.14159265358979323846;
    constexpr double rounding = 1e-9;
    return angle_at(c) + angle_at(d) > half_turn + rounding;
  }
  const auto error_at = [&](Index node, int change) {
    const int wanted = is_at_boundary(node) ? count_at_boundary : count_inside;
    const int off = static_cast<int>(triangles_.around(node).size()) + change - wanted;
    return off * off;
  };
  return error_at(a, -1) + error_at(b, -1) + error_at(c, 1) + error_at(d, 1) <
         error_at(a, 0) + error_at(b, 0) + error_at(c, 0) + error_at(d, 0);
}

bool Evening::may_flip(const std::array<Index, 4>& nodes) const {
  const auto& [a, b, c, d] = nodes;
  const std::array<std::array<Vector3, 3>, 2> before = {std::array{place(a), place(b), place(c)},
                                                        std::array{place(b), place(a), place(d)}};
  const std::array<std::array<Vector3, 3>, 2> after = {std::array{place(a), place(d), place(c)},
                                                       std::array{place(d), place(b), place(c)}};
  const double flattest = std::min(roundness(before[0]), roundness(before[1]));
  const Vector3 area = twice_area(before[0]) + twice_area(before[1]);
  const Vector3 outside = normal(a) + normal(b) + normal(c) + normal(d);
  const bool is_good = std::all_of(after.begin(), after.end(), [&](const std::array<Vector3, 3>& corners) {
    return (roundness(corners) >= sliver || roundness(corners) >= flattest) &&
           keeps_direction(area, false, twice_area(corners), outside);
  });
  if (!is_good) return false;
  // Not a sharper edge in place of a blunt one.
  const auto cosine = [](const std::array<std::array<Vector3, 3>, 2>& pair) {
    return twice_area(pair[0]).stableNormalized().dot(twice_area(pair[1]).stableNormalized());
  };
  return cosine(after) >= std::min(least_cosine, cosine(before));
}

void Evening::move_nodes() {
  for (Index node = 0; node < triangles_.node_count(); ++node) {
    end_if_cancelled_at(static_cast<std::size_t>(node));
    if (!stays(node) && !triangles_.around(node).empty()) move_node(node);
  }
}

void Evening::move_node(Index node) {
  const auto i = static_cast<std::size_t>(node);
  const Vector3 whole = line(node) >= 0 ? middle_on_line(node) : middle_around(node);
  const Index near = line(node) >= 0 ? -1 : shape_.origins[i].item;
  // The last attempt leaves it where it is, but on the surface.
  for (const double share : {1.0, 0.5, 0.0}) {
    const Vector3 wanted = place(node) + share * (whole - place(node));
    const SurfacePlace to = on_surface(wanted, normal(node), line(node), near);
    const Vector3 normal_there = surface_.normal_at(to);
    if (!may_move(node, to.place, normal_there)) continue;
    shape_.places[i] = to.place;
    shape_.origins[i] = to;
    shape_.normals[i] = normal_there;
    return;
  }
}

/// The middle of the triangles around, moved along the normal to the height of the node.
Vector3 Evening::middle_around(Index node) const {
  Vector3 sum = Vector3::Zero();
  Vector3 areas = Vector3::Zero();
  double weight = 0;
  for (const Index number : triangles_.around(node)) {
    const auto& nodes = triangles_.triangle(number).nodes;
    const std::array<Vector3, 3> corners = {place(nodes[0]), place(nodes[1]), place(nodes[2])};
    double size = 0;
    for (const Index corner : nodes) size += targets_[static_cast<std::size_t>(corner)] / 3;
    const Vector3 area = twice_area(corners);
    // Where edges should be longer, a triangle counts less.
    const double own = area.norm() / (size * size);
    sum += own * (corners[0] + corners[1] + corners[2]) / 3;
    weight += own;
    areas += area;
  }
  if (!(weight > 0)) return place(node);
  const Vector3 step = sum / weight - place(node);
  const Vector3 up = areas.stableNormalized();
  return place(node) + step - step.dot(up) * up;
}

Vector3 Evening::middle_on_line(Index node) const {
  Vector3 sum = Vector3::Zero();
  int count = 0;
  for (const Index other : triangles_.neighbours(node)) {
    if (triangles_.line_of(node, other) != line(node)) continue;
    sum += place(other);
    ++count;
  }
  return count == 2 ? Vector3(sum / 2) : place(node);
}

bool Evening::may_move(Index node, const Vector3& to, const Vector3& normal_there) const {
  const auto around = triangles_.around(node);
  return std::all_of(around.begin(), around.end(), [&](Index number) {
    const Change change = change_of(triangles_.triangle(number), node, to, normal_there);
    const double before = roundness(change.before);
    const double after = roundness(change.after);
    return (after >= sliver || after >= before) &&
           keeps_direction(twice_area(change.before), before < sliver, twice_area(change.after), change.normal);
  });
}

SurfacePlace Evening::on_surface(const Vector3& place, const Vector3& normal, Index line, Index near) const {
  return line >= 0 ? surface_.nearest_on_line(place, line) : surface_.nearest(place, normal, near);
}

Evening::Change Evening::change_of(const EditableTriangles::Triangle& triangle, Index node, const Vector3& to,
                                   const Vector3& normal_there) const {
  Change change = {{}, {}, normal_there};
  for (std::size_t k = 0; k < 3; ++k) {
    const Index corner = triangle.nodes[k];
    change.before[k] = change.after[k] = place(corner);
    if (corner == node)
      change.after[k] = to;
    else
      change.normal += normal(corner);
  }
  return change;
}

}  // namespace vspring
