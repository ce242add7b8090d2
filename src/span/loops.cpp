#include "span/loops.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <tuple>

#include "base/disjoint_sets.hpp"
#include "shape/direction.hpp"

namespace vspring {

namespace {

/// A direction carried along a half-arc without rotation about it.
Vector3 carried(Vector3 normal, const Network& network, const std::vector<Index>& nodes) {
  Vector3 before = Vector3::Zero();
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const Vector3 edge = network.place(nodes[k + 1]) - network.place(nodes[k]);
    const Vector3 along = direction(edge, edge.norm());
    if (along.isZero(0)) continue;
    normal = before.isZero(0) ? Vector3(normal - along * normal.dot(along))
                              : Vector3(Eigen::Quaterniond::FromTwoVectors(before, along) * normal);
    before = along;
  }
  return direction(normal, 1e-6);
}

/// Directions in order, counterclockwise around a normal.
struct Turned {
  Vector3 normal;
  std::vector<std::size_t> order;
  double least_gap;  ///< between neighbours, radians; 0 if one of them is along the normal
};

// Directions whose part across the normal is shorter than this have no place in the order.
constexpr double least_across = 0.03;
// How long the mean of directions has to be to tell what is ahead, and by what factor gaps must be wider around it.
constexpr double least_mean = 0.05;
constexpr double clearly = 2;

Turned turned_about(const Vector3& normal, const std::vector<Vector3>& directions) {
  const Vector3 x = normal.unitOrthogonal();
  const Vector3 y = normal.cross(x);
  std::vector<std::pair<double, std::size_t>> angles;
  bool is_clear = true;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double along_x = directions[k].dot(x);
    const double along_y = directions[k].dot(y);
    angles.emplace_back(std::atan2(along_y, along_x), k);
    is_clear = is_clear && std::hypot(along_x, along_y) > least_across;
  }
  std::sort(angles.begin(), angles.end());
  Turned result{normal, {}, is_clear ? 2 * std::numbers::pi : 0};
  for (std::size_t k = 0; k < angles.size(); ++k) {
    result.order.push_back(angles[k].second);
    const double gap = k > 0 ? angles[k].first - angles[k - 1].first
                             : 2 * std::numbers::pi - (angles.back().first - angles.front().first);
    result.least_gap = std::min(result.least_gap, gap);
  }
  return result;
}

/// Puts the half-arcs at every junction in order, counterclockwise around a normal whose sense agrees from junction to
/// junction.
class Orders {
 public:
  Orders(const Network& network, const Arcs& arcs)
      : network_(network), arcs_(arcs), around_(network.places.size()), normals_(network.places.size()) {
    for (std::size_t n = 0; n < around_.size(); ++n) {
      around_[n] = arcs.leaving_at(static_cast<Index>(n));
      normals_[n] = Vector3::Zero();
      if (around_[n].size() > 2) order(n);
    }
    agree();
  }

  /// The half-arc that follows `half` around the loop on its left.
  [[nodiscard]] Index next(Index half) const {
    const Index back = Arcs::reversed(half);
    const auto& around = around_[static_cast<std::size_t>(arcs_.first_node(back))];
    const auto place = std::find(around.begin(), around.end(), back);
    return place == around.begin() ? around.back() : *(place - 1);
  }

 private:
  void order(std::size_t n) {
    std::vector<Vector3> tips;
    Vector3 mean = Vector3::Zero();
    for (const Index half : around_[n]) {
      tips.push_back(arcs_.leaving(half));
      mean += tips.back() / static_cast<double>(around_[n].size());
    }
    for (Vector3& tip : tips) tip -= mean;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vector3& tip : tips) spread += tip * tip.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    Turned order = turned_about(axes.eigenvectors().col(0), tips);
    if (tips.size() > 3 && mean.norm() > least_mean) {
      // On a ridge two curves may leave it nearly alike, one on each side.
      Turned from_ahead = turned_about(mean.normalized(), tips);
      if (from_ahead.least_gap > clearly * order.least_gap) order = std::move(from_ahead);
    }
    std::vector<Index> ordered;
    ordered.reserve(tips.size());
    for (const std::size_t k : order.order) ordered.push_back(around_[n][k]);
    around_[n] = std::move(ordered);
    normals_[n] = order.normal;
  }

  void reverse(std::size_t n) {
    std::reverse(around_[n].begin(), around_[n].end());
    normals_[n] = -normals_[n];
  }

  /// A maximum spanning tree by how well carried normals agree (R. C. Prim 1957).
  void agree() {
    std::vector<std::uint8_t> is_reached(around_.size(), 0);
    std::priority_queue<std::tuple<double, Index, Index>> open;  // agreement, − number, half-arc
    const auto reach = [&](std::size_t n) {
      is_reached[n] = 1;
      for (const Index half : around_[n]) {
        const auto end = static_cast<std::size_t>(arcs_.last_node(half));
        if (is_reached[end] != 0) continue;
        const Vector3 there = carried(normals_[n], network_, arcs_.nodes_along(half));
        open.emplace(normals_[end].isZero(0) ? 1 : std::abs(there.dot(normals_[end])), -half, half);
      }
    };
    const auto spread = [&] {
      while (!open.empty()) {
        const Index half = std::get<2>(open.top());
        open.pop();
        const auto n = static_cast<std::size_t>(arcs_.last_node(half));
        if (is_reached[n] != 0) continue;
        const Vector3 there =
            carried(normals_[static_cast<std::size_t>(arcs_.first_node(half))], network_, arcs_.nodes_along(half));
        if (normals_[n].isZero(0))
          normals_[n] = there;
        else if (there.dot(normals_[n]) < 0)
          reverse(n);
        reach(n);
      }
    };
    // First from junctions, which have normals of their own.
    for (const std::size_t least : {std::size_t{3}, std::size_t{1}}) {
      for (std::size_t n = 0; n < around_.size(); ++n) {
        if (is_reached[n] != 0 || around_[n].size() < least) continue;
        reach(n);
        spread();
      }
    }
  }

  const Network& network_;
  const Arcs& arcs_;
  std::vector<std::vector<Index>> around_;  ///< half-arcs that leave each node
  std::vector<Vector3> normals_;            ///< at each node; zero: not known
};

/// Twice the area vector of a loop, about a point.
Vector3 area_vector(const Network& network, const Arcs& arcs, const Loop& loop, const Vector3& about) {
  Vector3 sum = Vector3::Zero();
  for (const Index half : loop.halves) {
    const std::vector<Index> nodes = arcs.nodes_along(half);
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
      sum += (network.place(nodes[k]) - about).cross(network.place(nodes[k + 1]) - about);
  }
  return sum;
}

/// A loop's centre: the mean of its edges' middles, weighted by their lengths.
Vector3 centre(const Network& network, const Arcs& arcs, const Loop& loop) {
  Vector3 sum = Vector3::Zero();
  double length = 0;
  for (const Index half : loop.halves) {
    const std::vector<Index>& nodes = arcs.of(half).nodes;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
      const Vector3& a = network.place(nodes[k]);
      const Vector3& b = network.place(nodes[k + 1]);
      sum += (a + b) / 2 * (b - a).norm();
      length += (b - a).norm();
    }
  }
  return length > 0 ? Vector3(sum / length) : network.place(arcs.first_node(loop.halves.front()));
}

/// The loops of a network and which of them lie beside each other.
class LoopFinder {
 public:
  LoopFinder(const Network& network, const Arcs& arcs)
      : network_(network), arcs_(arcs), loop_of_(2 * arcs.all().size(), none), part_(arcs.all().size()) {
    join_parts();
    trace();
    const Vector3& about = network.place(arcs.all().front().nodes.front());
    for (const Loop& loop : loops_) {
      const Vector3 area = area_vector(network, arcs, loop, about);
      areas_.push_back(area);
      normals_.push_back(direction(area, 0));
    }
    find_outer();
    turn_outwards();
  }

  std::vector<Loop> take() { return std::move(loops_); }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// Arcs that meet are of one part.
  void join_parts() {
    std::vector<std::size_t> arc_at(network_.places.size(), none);
    for (std::size_t a = 0; a < arcs_.all().size(); ++a) {
      for (const Index node : {arcs_.all()[a].nodes.front(), arcs_.all()[a].nodes.back()}) {
        std::size_t& there = arc_at[static_cast<std::size_t>(node)];
        if (there == none) there = a;
        part_.join(a, there);
      }
    }
  }

  void trace() {
    const Orders orders(network_, arcs_);
    for (Index half = 0; half < static_cast<Index>(loop_of_.size()); ++half) {
      if (loop_of_[static_cast<std::size_t>(half)] != none) continue;
      Loop loop;
      Index here = half;
      do {
        loop.halves.push_back(here);
        loop_of_[static_cast<std::size_t>(here)] = loops_.size();
        here = orders.next(here);
      } while (here != half);
      // The other side of a single loop is the same loop.
      const bool is_single = std::all_of(loop.halves.begin(), loop.halves.end(),
                                         [&](Index h) { return arcs_.leaving_at(arcs_.first_node(h)).size() == 2; });
      if (is_single) {
        for (const Index h : loop.halves) loop_of_[static_cast<std::size_t>(Arcs::reversed(h))] = loops_.size();
      }
      loops_.push_back(std::move(loop));
    }
  }

  [[nodiscard]] double facing(std::size_t number, const std::vector<std::uint8_t>& is_away) const {
    double sum = 0;
    double length = 0;
    for (const Index half : loops_[number].halves) {
      const std::size_t beside = loop_of_[static_cast<std::size_t>(Arcs::reversed(half))];
      if (beside == number || is_away[beside] != 0) continue;
      sum -= arcs_.of(half).length * normals_[number].dot(normals_[beside]);
      length += arcs_.of(half).length;
    }
    return length > 0 ? sum / length : -1;
  }

  void find_outer() {
    std::vector<std::uint8_t> is_away(loops_.size(), 0);
    for (std::size_t k = 0; k < loops_.size(); ++k) loops_[k].facing = facing(k, is_away);
    while (true) {
      std::size_t most = none;
      for (std::size_t k = 0; k < loops_.size(); ++k) {
        if (is_away[k] != 0 || !(loops_[k].facing > 0.5)) continue;
        // Of equal ones the largest: two loops that lie on each other have one outer rim.
        const auto rank = [&](std::size_t l) {
          return std::pair(std::round(loops_[l].facing * 1e3), areas_[l].squaredNorm());
        };
        if (most == none || rank(k) > rank(most)) most = k;
      }
      if (most == none) return;
      is_away[most] = 1;
      for (std::size_t k = 0; k < loops_.size(); ++k) {
        if (is_away[k] == 0) loops_[k].facing = facing(k, is_away);
      }
    }
  }

  void turn_outwards() {
    struct Part {
      Vector3 area = Vector3::Zero();
      Vector3 centre = Vector3::Zero();  ///< times total area
      double total = 0;
      double volume = 0;  ///< six times, about the centre
    };
    std::vector<Part> parts(arcs_.all().size());
    const auto part_of = [&](const Loop& loop) -> Part& {
      return parts[part_.find(static_cast<std::size_t>(loop.halves[0] / 2))];
    };
    const auto for_each_inner = [&](const auto& use) {
      for (std::size_t k = 0; k < loops_.size(); ++k) {
        if (!(loops_[k].facing > 0.5)) use(part_of(loops_[k]), areas_[k], centre(network_, arcs_, loops_[k]));
      }
    };
    for_each_inner([](Part& part, const Vector3& area, const Vector3& at) {
      part.area += area;
      part.centre += area.norm() * at;
      part.total += area.norm();
    });
    for_each_inner([](Part& part, const Vector3& area, const Vector3& at) {
      if (part.total > 0) part.volume += area.dot(at - part.centre / part.total);
    });
    for (Loop& loop : loops_) {
      const Part& part = part_of(loop);
      constexpr double flat = 1e-3;
      Eigen::Index axis = 0;
      part.area.cwiseAbs().maxCoeff(&axis);
      const bool is_flat = std::abs(part.volume) <= flat * std::pow(part.total, 1.5);
      if (!((is_flat ? part.area[axis] : part.volume) < 0)) continue;
      std::reverse(loop.halves.begin(), loop.halves.end());
      for (Index& half : loop.halves) half = Arcs::reversed(half);
      std::rotate(loop.halves.begin(), std::min_element(loop.halves.begin(), loop.halves.end()), loop.halves.end());
    }
  }

  const Network& network_;
  const Arcs& arcs_;
  std::vector<Loop> loops_;
  std::vector<std::size_t> loop_of_;  ///< per half-arc
  DisjointSets part_;                 ///< of arcs
  std::vector<Vector3> areas_;
  std::vector<Vector3> normals_;
};

}  // namespace

std::vector<Loop> find_loops(const Network& network, const Arcs& arcs) {
  if (arcs.all().empty()) return {};
  return LoopFinder(network, arcs).take();
}

}  // namespace vspring
