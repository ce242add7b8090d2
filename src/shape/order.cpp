#include "vspring/order.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "shape/point_tree.hpp"
#include "shape/spanning_tree.hpp"
#include "shape/tour.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

/// Number of neighbours of a point to which it may be moved in the order.
constexpr std::size_t nearest_others = 8;

/// Points moved and scaled to a box of half-width 1, so that no squared distance overflows; empty if all points are at
/// one place, or too near to each other to be scaled.
std::vector<Vector3> in_unit_box(std::span<const Vector3> points) {
  Eigen::AlignedBox<double, 3> halves;
  for (const Vector3& point : points) halves.extend(point / 2);
  const double width = halves.isEmpty() ? 0 : (halves.max() - halves.min()).maxCoeff();
  if (!(width > 0)) return {};
  const Vector3 middle = halves.min() / 2 + halves.max() / 2;
  std::vector<Vector3> scaled;
  scaled.reserve(points.size());
  for (const Vector3& point : points) scaled.emplace_back((point / 2 - middle) / width * 2);
  return scaled;
}

/// Points at the same place are one site.
struct Sites {
  std::vector<Vector3> places;
  std::vector<std::vector<Index>> points;  ///< of each site, ascending
};

Sites sites_of(std::span<const Vector3> points) {
  std::vector<Index> sorted(points.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  const auto key = [&](Index k) {
    const Vector3& p = points[static_cast<std::size_t>(k)];
    return std::array{p.x(), p.y(), p.z()};
  };
  std::stable_sort(sorted.begin(), sorted.end(), [&](Index a, Index b) { return key(a) < key(b); });
  std::vector<std::vector<Index>> groups;
  for (const Index point : sorted) {
    if (groups.empty() || key(groups.back().front()) != key(point)) groups.emplace_back();
    groups.back().push_back(point);
  }
  // In the order of the input, so the result does not depend on where the points lie.
  std::sort(groups.begin(), groups.end());
  Sites sites;
  for (const auto& group : groups) sites.places.push_back(points[static_cast<std::size_t>(group.front())]);
  sites.points = std::move(groups);
  return sites;
}

/// A tree of edges between points.
class Branches {
 public:
  Branches(std::size_t count, const std::vector<std::pair<Index, Index>>& edges, std::span<const Vector3> places)
      : begin_(count + 1, 0), places_(places) {
    for (const auto& [a, b] : edges) {
      ++begin_[static_cast<std::size_t>(a) + 1];
      ++begin_[static_cast<std::size_t>(b) + 1];
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    ends_.resize(2 * edges.size());
    std::vector<std::size_t> filled(begin_.begin(), begin_.end() - 1);
    for (const auto& [a, b] : edges) {
      ends_[filled[static_cast<std::size_t>(a)]++] = b;
      ends_[filled[static_cast<std::size_t>(b)]++] = a;
    }
  }

  /// The points of the tree from the roots on, each after its parent.
  struct Walk {
    std::vector<Index> order;
    std::vector<Index> parent;  ///< −1 of roots
    Index furthest = 0;         ///< from the root, along edges
  };

  /// roots: where the walk begins, at length 0.
  [[nodiscard]] Walk walk(std::span<const Index> roots) const {
    constexpr Index unseen = -2;
    Walk walk{{roots.begin(), roots.end()}, std::vector<Index>(places_.size(), unseen), roots.front()};
    std::vector<double> length(places_.size(), 0);
    for (const Index root : roots) walk.parent[static_cast<std::size_t>(root)] = -1;
    for (std::size_t k = 0; k < walk.order.size(); ++k) {
      const Index point = walk.order[k];
      const auto number = static_cast<std::size_t>(point);
      if (length[number] > length[static_cast<std::size_t>(walk.furthest)]) walk.furthest = point;
      for (std::size_t e = begin_[number]; e < begin_[number + 1]; ++e) {
        const auto end = static_cast<std::size_t>(ends_[e]);
        if (walk.parent[end] != unseen) continue;
        walk.parent[end] = point;
        length[end] = length[number] + (places_[end] - places_[number]).norm();
        walk.order.push_back(ends_[e]);
      }
    }
    return walk;
  }

  /// The longest path of the tree.
  [[nodiscard]] std::vector<Index> longest_path() const {
    const Index first = walk(std::array<Index, 1>{0}).furthest;
    const Walk back = walk(std::array{first});
    std::vector<Index> path;
    for (Index point = back.furthest; point >= 0; point = back.parent[static_cast<std::size_t>(point)])
      path.push_back(point);
    return path;
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<Index> ends_;
  std::span<const Vector3> places_;
};

/// A path as a ring of links; in an open one the stop of Tour follows the last point.
class Links {
 public:
  Links(std::span<const Vector3> places, const std::vector<Index>& path, bool closed)
      : places_(places),
        stop_(closed ? -1 : static_cast<Index>(places.size())),
        next_(places.size() + 1, -1),
        before_(places.size() + 1, -1) {
    for (std::size_t k = 0; k + 1 < path.size(); ++k) link(path[k], path[k + 1]);
    if (!closed) link(path.back(), stop_);
    link(closed ? path.back() : stop_, path.front());
    first_ = path.front();
  }

  /// Whether a point is in the path.
  [[nodiscard]] bool has(Index point) const { return next_[static_cast<std::size_t>(point)] >= 0; }

  /// Inserts a point next to the one of the points `beside` where it adds least length.
  void insert(Index point, std::span<const Index> beside) {
    double least = std::numeric_limits<double>::infinity();
    Index behind = beside.front();
    for (const Index other : beside) {
      for (const Index from : {other, before_[static_cast<std::size_t>(other)]}) {
        const Index to = next_[static_cast<std::size_t>(from)];
        const double added = distance(from, point) + distance(point, to) - distance(from, to);
        if (!(added < least)) continue;
        least = added;
        behind = from;
      }
    }
    const Index to = next_[static_cast<std::size_t>(behind)];
    link(behind, point);
    link(point, to);
  }

  [[nodiscard]] std::vector<Index> order() const {
    std::vector<Index> order;
    const Index begin = stop_ < 0 ? first_ : next_[static_cast<std::size_t>(stop_)];
    Index point = begin;
    do {
      order.push_back(point);
      point = next_[static_cast<std::size_t>(point)];
    } while (point != begin && point != stop_);
    return order;
  }

 private:
  void link(Index a, Index b) {
    next_[static_cast<std::size_t>(a)] = b;
    before_[static_cast<std::size_t>(b)] = a;
  }
  [[nodiscard]] double distance(Index a, Index b) const {
    if (a == stop_ || b == stop_) return 0;
    return (places_[static_cast<std::size_t>(a)] - places_[static_cast<std::size_t>(b)]).norm();
  }

  std::span<const Vector3> places_;
  Index stop_;
  Index first_ = 0;
  std::vector<Index> next_;
  std::vector<Index> before_;
};

/// A short path through three or more places, all different.
std::vector<Index> short_way(std::span<const Vector3> places, bool closed) {
  PointTree tree(places);
  const std::size_t count = std::min(nearest_others, places.size() - 1);
  std::vector<Index> neighbours;
  neighbours.reserve(count * places.size());
  std::vector<PointTree::Near> near;
  for (std::size_t k = 0; k < places.size(); ++k) {
    tree.nearest(static_cast<Index>(k), count, near);
    for (const PointTree::Near& other : near) neighbours.push_back(other.point);
  }
  const Branches branches(places.size(), spanning_tree(places, tree), places);
  const std::vector<Index> path = branches.longest_path();
  Links links(places, path, closed);
  const Branches::Walk outward = branches.walk(path);
  std::vector<Index> beside;
  for (const Index point : outward.order) {
    if (links.has(point)) continue;
    beside.assign(1, outward.parent[static_cast<std::size_t>(point)]);
    for (const Index other : std::span(neighbours).subspan(static_cast<std::size_t>(point) * count, count)) {
      if (links.has(other)) beside.push_back(other);
    }
    links.insert(point, beside);
  }
  Tour tour(places, links.order(), closed, std::move(neighbours), count);
  tour.improve();
  tour.open_at_longest_step();
  return tour.order();
}

double length_of(std::span<const Vector3> points, std::span<const Index> order, bool closed) {
  double length = 0;
  for (std::size_t k = closed ? 0 : 1; k < order.size(); ++k) {
    const Index before = order[k > 0 ? k - 1 : order.size() - 1];
    length += (points[static_cast<std::size_t>(order[k])] - points[static_cast<std::size_t>(before)]).norm();
  }
  return length;
}

/// Reverses an order from entry `first` on, unless more numbers rise in it than fall.
void turn_upward(std::vector<Index>& order, std::size_t first) {
  std::ptrdiff_t rising = 0;
  for (std::size_t k = first + 1; k < order.size(); ++k) rising += order[k] > order[k - 1] ? 1 : -1;
  if (rising < 0 || (rising == 0 && order[first] > order.back()))
    std::reverse(order.begin() + static_cast<std::ptrdiff_t>(first), order.end());
}

/// The points of sites in order.
std::vector<Index> points_in_order(const Sites& sites, std::vector<Index> way, bool closed) {
  if (closed) std::rotate(way.begin(), std::find(way.begin(), way.end(), 0), way.end());
  turn_upward(way, closed ? 1 : 0);
  std::vector<Index> order;
  for (const Index site : way) {
    const auto& points = sites.points[static_cast<std::size_t>(site)];
    // A last point that repeats the first of a closed curve stays at its end.
    const bool begins = closed && order.empty();
    order.insert(order.end(), points.begin(), begins ? points.begin() + 1 : points.end());
  }
  if (closed) {
    const auto& first = sites.points[static_cast<std::size_t>(way.front())];
    order.insert(order.end(), first.begin() + 1, first.end());
  }
  return order;
}

}  // namespace

std::vector<Index> order_along_curve(std::span<const Vector3> points, bool closed) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!points[k].allFinite())
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("point {}: its position is not finite, so it has no place in an order; remove it", k));
  }
  std::vector<Index> as_given(points.size());
  std::iota(as_given.begin(), as_given.end(), 0);
  const std::vector<Vector3> scaled = in_unit_box(points);
  const Sites sites = sites_of(scaled);
  if (sites.places.size() < 3) return as_given;
  std::vector<Index> order = points_in_order(sites, short_way(sites.places, closed), closed);
  const bool shorter = length_of(scaled, order, closed) < length_of(scaled, as_given, closed) * (1 - 1e-12);
  return shorter ? order : as_given;
}

}  // namespace vspring
