#include "span/network.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/threads.hpp"
#include "shape/arcs.hpp"
#include "shape/box_tree.hpp"
#include "shape/segment.hpp"
#include "vspring/constraints.hpp"

namespace vspring {

namespace {

/// An edge of a curve, and the curve's tangents at its ends.
struct Edge {
  Index first;
  Index second;
  Vector3 tangent_first;
  Vector3 tangent_second;
  bool is_sharp;
};

std::vector<Edge> edges_of(const PolygonCurve& curves, std::span<const Index> sharp) {
  std::vector<Edge> edges;
  for (std::size_t c = 0; c < curves.chains().size(); ++c) {
    const auto& chain = curves.chains()[c];
    const bool is_sharp = std::ranges::find(sharp, static_cast<Index>(c)) != sharp.end();
    const std::vector<Vector3> tangents = estimate_tangents(PolygonCurve(curves.positions(), {chain}), chain.nodes);
    const auto add = [&](std::size_t k, std::size_t l) {
      edges.push_back({chain.nodes[k], chain.nodes[l], tangents[k], tangents[l], is_sharp});
    };
    for (std::size_t k = 0; k + 1 < chain.nodes.size(); ++k) add(k, k + 1);
    if (chain.closed && chain.nodes.size() > 2) add(chain.nodes.size() - 1, 0);
  }
  return edges;
}

/// The nearest places of two segments, as shares of the way along each.
std::array<double, 2> nearest_shares(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  std::array<double, 2> best = {0, nearest_share(a, c, d)};
  double least = (a + (b - a) * best[0] - c - (d - c) * best[1]).squaredNorm();
  const auto look = [&](double s, double t) {
    const double distance2 = (a + (b - a) * s - c - (d - c) * t).squaredNorm();
    if (!(distance2 < least)) return;
    least = distance2;
    best = {s, t};
  };
  look(1, nearest_share(b, c, d));
  look(nearest_share(c, a, b), 0);
  look(nearest_share(d, a, b), 1);
  // Within both, where the way between them is perpendicular to both.
  const Vector3 u = b - a;
  const Vector3 v = d - c;
  const double uu = u.squaredNorm();
  const double vv = v.squaredNorm();
  const double uv = u.dot(v);
  const double det = uu * vv - uv * uv;
  if (!(det > 1e-12 * uu * vv)) return best;
  const Vector3 w = c - a;
  const double s = (w.dot(u) * vv - w.dot(v) * uv) / det;
  const double t = (w.dot(u) * uv - w.dot(v) * uu) / det;
  if (s > 0 && s < 1 && t > 0 && t < 1) look(s, t);
  return best;
}

/// Finds where curves meet, and joins them there.
class Joiner {
 public:
  Joiner(const PolygonCurve& curves, double tolerance, std::span<const Index> sharp)
      : tolerance_(tolerance),
        edges_(edges_of(curves, sharp)),
        places_(curves.positions()),
        is_end_(boundary_nodes(curves)),
        cuts_(edges_.size()) {}

  Network take() {
    find_meetings();
    DisjointSets sets(places_.size());
    for (const auto& [a, b] : same_) sets.join(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    settle(sets);
    std::vector<std::vector<Index>> joined(places_.size());
    std::vector<std::pair<Index, Index>> sharp;
    const auto join = [&](Index a, Index b, bool is_sharp) {
      const auto i = static_cast<Index>(sets.find(static_cast<std::size_t>(a)));
      const auto j = static_cast<Index>(sets.find(static_cast<std::size_t>(b)));
      if (i == j) return;
      joined[static_cast<std::size_t>(i)].push_back(j);
      joined[static_cast<std::size_t>(j)].push_back(i);
      if (is_sharp) sharp.emplace_back(std::min(i, j), std::max(i, j));
    };
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      std::sort(cuts_[e].begin(), cuts_[e].end());
      Index before = edges_[e].first;
      for (const auto& [share, node] : cuts_[e]) {
        join(before, node, edges_[e].is_sharp);
        before = node;
      }
      join(before, edges_[e].second, edges_[e].is_sharp);
    }
    for (auto& others : joined) {
      std::sort(others.begin(), others.end());
      others.erase(std::unique(others.begin(), others.end()), others.end());
    }
    std::sort(sharp.begin(), sharp.end());
    Network network{
        .places = std::move(places_), .from = {}, .joined = std::move(joined), .sharp = std::move(sharp), .loose = {}};
    for (std::size_t i = 0; i < network.places.size(); ++i)
      network.from.push_back(i < input_nodes_ ? static_cast<Index>(i) : -1);
    return network;
  }

 private:
  /// Ends of curves go to the curves that they meet, so that these stay as they are; where several curves go on, to the
  /// mean of their places.
  void settle(DisjointSets& sets) {
    struct Sum {
      Vector3 places = Vector3::Zero();
      int count = 0;
      void add(const Vector3& place) {
        places += place;
        ++count;
      }
    };
    std::map<std::size_t, std::array<Sum, 2>> sums;  // of curves that go on, and of ends
    for (const auto& [a, b] : same_) {
      for (const Index node : {a, b}) sums.try_emplace(sets.find(static_cast<std::size_t>(node)));
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      for (const auto& [share, node] : cuts_[e]) {
        const Vector3 there = on_cubic(place(edges_[e].first), place(edges_[e].second) - place(edges_[e].first),
                                       edges_[e].tangent_first, edges_[e].tangent_second, share);
        sums[sets.find(static_cast<std::size_t>(node))][0].add(there);
      }
    }
    for (std::size_t n = 0; n < input_nodes_; ++n) {
      const auto there = sums.find(sets.find(n));
      if (there != sums.end()) there->second[is_end_[n]].add(places_[n]);
    }
    for (const auto& [set, sum] : sums) {
      const Sum& taken = sum[0].count > 0 ? sum[0] : sum[1];
      if (taken.count > 0) places_[set] = taken.places / taken.count;
    }
  }

  void find_meetings() {
    input_nodes_ = places_.size();
    std::vector<Box> boxes;
    boxes.reserve(edges_.size());
    for (const Edge& edge : edges_) {
      Box box(place(edge.first));
      box.extend(place(edge.second));
      boxes.emplace_back(box.min() - Vector3::Constant(tolerance_ / 2), box.max() + Vector3::Constant(tolerance_ / 2));
    }
    ThreadTeam team(1);
    const BoxTree tree(boxes, team);
    std::vector<Index> near;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      near.clear();
      tree.for_each_overlapping_leaf(boxes[e], 0, [&](std::size_t leaf) {
        for (const Index other : tree.leaf_items(leaf)) {
          if (static_cast<std::size_t>(other) > e && tree.box(other).intersects(boxes[e])) near.push_back(other);
        }
      });
      std::sort(near.begin(), near.end());
      for (const Index other : near) meet(e, static_cast<std::size_t>(other));
    }
  }

  void meet(std::size_t e, std::size_t f) {
    const Index a = edges_[e].first;
    const Index b = edges_[e].second;
    const Index c = edges_[f].first;
    const Index d = edges_[f].second;
    if (a == c || a == d || b == c || b == d) return;
    const auto [s, t] = nearest_shares(place(a), place(b), place(c), place(d));
    const Vector3 on_first = place(a) + (place(b) - place(a)) * s;
    const Vector3 on_second = place(c) + (place(d) - place(c)) * t;
    if (!((on_first - on_second).norm() <= tolerance_)) return;
    const Index at_first = end_near(edges_[e], on_first);
    const Index at_second = end_near(edges_[f], on_second);
    if (at_first >= 0 && at_second >= 0) {
      same_.emplace_back(at_first, at_second);
    } else if (at_first >= 0) {
      cuts_[f].emplace_back(t, at_first);
    } else if (at_second >= 0) {
      cuts_[e].emplace_back(s, at_second);
    } else {
      const auto node = static_cast<Index>(places_.size());
      places_.push_back((on_first + on_second) / 2);
      cuts_[e].emplace_back(s, node);
      cuts_[f].emplace_back(t, node);
    }
  }

  [[nodiscard]] const Vector3& place(Index node) const { return places_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] Index end_near(const Edge& edge, const Vector3& place_on) const {
    const double first = (place(edge.first) - place_on).norm();
    const double second = (place(edge.second) - place_on).norm();
    if (std::min(first, second) > tolerance_) return -1;
    return first <= second ? edge.first : edge.second;
  }

  double tolerance_;
  std::vector<Edge> edges_;
  std::vector<Vector3> places_;
  std::vector<std::uint8_t> is_end_;  ///< per node of the input
  std::size_t input_nodes_ = 0;
  std::vector<std::vector<std::pair<double, Index>>> cuts_;  ///< of each edge: where, and the node there
  std::vector<std::pair<Index, Index>> same_;                ///< nodes that are joined
};

/// Takes out edges that lead to a free end.
void prune(Network& network) {
  std::vector<Index> ends;
  for (std::size_t i = 0; i < network.joined.size(); ++i) {
    if (network.joined[i].size() == 1) ends.push_back(static_cast<Index>(i));
  }
  for (const Index end : ends) {
    if (network.from[static_cast<std::size_t>(end)] >= 0) network.loose.push_back(end);
    for (Index node = end; network.neighbours(node).size() == 1;) {
      const Index next = network.neighbours(node).front();
      network.joined[static_cast<std::size_t>(node)].clear();
      std::erase(network.joined[static_cast<std::size_t>(next)], node);
      node = next;
    }
  }
}

}  // namespace

Network join_curves(const PolygonCurve& curves, double tolerance, std::span<const Index> sharp) {
  Network network = Joiner(curves, tolerance, sharp).take();
  prune(network);
  return network;
}

}  // namespace vspring
