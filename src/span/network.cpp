#include "span/network.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/threads.hpp"
#include "shape/arcs.hpp"
#include "shape/box_tree.hpp"
#include "shape/direction.hpp"
#include "shape/segment.hpp"
#include "span/corner.hpp"
#include "vspring/constraints.hpp"

namespace vspring {

namespace {

/// An edge of a curve, and the curve's tangents at its ends.
struct Edge {
  Index first;
  Index second;
  Vector3 tangent_first;
  Vector3 tangent_second;
  std::size_t chain;
  double begin;  ///< the length of the curve before it
  double length;
};

/// Gives the edge the tangents of its curve at its nodes, but at corners those of the arc that meets the other end.
void set_tangents(Edge& edge, const Vector3& chord, std::array<Vector3, 2> tangents, std::array<bool, 2> is_corner) {
  const Vector3 along = chord.normalized();
  const auto of_arc = [&](const Vector3& other) -> Vector3 { return 2 * along.dot(other) * along - other; };
  if (is_corner[0]) tangents[0] = is_corner[1] ? along : of_arc(tangents[1]);
  if (is_corner[1]) tangents[1] = of_arc(tangents[0]);
  edge.tangent_first = tangents[0];
  edge.tangent_second = tangents[1];
}

/// The nodes of a chain without those at the place of the one before.
std::vector<Index> without_repeats(const PolygonCurve& curves, const PolygonCurve::Chain& chain) {
  std::vector<Index> nodes;
  for (const Index node : chain.nodes) {
    if (nodes.empty() || curves.position(node) != curves.position(nodes.back())) nodes.push_back(node);
  }
  while (chain.closed && nodes.size() > 1 && curves.position(nodes.front()) == curves.position(nodes.back()))
    nodes.pop_back();
  return nodes;
}

/// By how many degrees a polyline turns at each node; 0 at its ends.
std::vector<double> turns_of(const std::vector<Vector3>& places, bool closed) {
  const std::size_t count = places.size();
  std::vector<double> turns(count, 0);
  for (std::size_t k = 0; k < count; ++k) {
    if (!closed && (k == 0 || k + 1 == count)) continue;
    turns[k] = degrees_between(places[k] - places[(k + count - 1) % count], places[(k + 1) % count] - places[k]);
  }
  return turns;
}

void add_edges(const PolygonCurve& curves, std::size_t number, std::vector<Edge>& edges) {
  const auto& chain = curves.chains()[number];
  const std::vector<Index> nodes = without_repeats(curves, chain);
  const std::size_t count = nodes.size();
  std::vector<Vector3> places;
  places.reserve(count);
  for (const Index node : nodes) places.push_back(curves.position(node));
  const bool closes = chain.closed && count > 2;
  std::vector<Index> all(count);
  std::iota(all.begin(), all.end(), 0);
  const std::vector<Vector3> tangents = estimate_tangents(PolygonCurve(places, closes), all);
  const std::vector<double> turns = turns_of(places, closes);
  const auto is_corner_at = [&](std::size_t k) {
    return is_corner(turns[k], std::max(turns[(k + count - 1) % count], turns[(k + 1) % count]));
  };
  double begin = 0;
  for (std::size_t k = 0; k + 1 < count + (closes ? 1 : 0); ++k) {
    const std::size_t l = (k + 1) % count;
    const Vector3 chord = places[l] - places[k];
    Edge edge{nodes[k], nodes[l], {}, {}, number, begin, chord.norm()};
    set_tangents(edge, chord, {tangents[k], tangents[l]}, {is_corner_at(k), is_corner_at(l)});
    edges.push_back(edge);
    begin += edge.length;
  }
}

std::vector<Edge> edges_of(const PolygonCurve& curves) {
  std::vector<Edge> edges;
  for (std::size_t c = 0; c < curves.chains().size(); ++c) add_edges(curves, c, edges);
  return edges;
}

/// Places of two edges that are near each other.
struct Meeting {
  std::array<std::size_t, 2> edges;
  std::array<double, 2> shares;  ///< of the way along each edge
  std::array<double, 2> along;   ///< the length of each curve up to there
  double distance;
};

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
        curves_(curves),
        edges_(edges_of(curves)),
        is_sharp_(curves.chains().size(), 0),
        length_(curves.chains().size(), 0),
        places_(curves.positions()),
        is_end_(boundary_nodes(curves)),
        cuts_(edges_.size()) {
    for (const Index chain : sharp) is_sharp_[static_cast<std::size_t>(chain)] = 1;
    for (const Edge& edge : edges_) length_[edge.chain] += edge.length;
    for (const auto& chain : curves.chains()) join_repeats(chain);
  }

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
      const bool is_sharp = is_sharp_[edges_[e].chain] != 0;
      Index before = edges_[e].first;
      for (const auto& [share, node] : cuts_[e]) {
        join(before, node, is_sharp);
        before = node;
      }
      join(before, edges_[e].second, is_sharp);
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
  void join_repeats(const PolygonCurve::Chain& chain) {
    const std::size_t count = chain.nodes.size();
    for (std::size_t k = 0; k + (chain.closed ? 0 : 1) < count; ++k) {
      const Index here = chain.nodes[k];
      const Index next = chain.nodes[(k + 1) % count];
      if (place(here) != place(next)) continue;
      same_.emplace_back(here, next);
      const auto is_end = std::max(is_end_[static_cast<std::size_t>(here)], is_end_[static_cast<std::size_t>(next)]);
      is_end_[static_cast<std::size_t>(here)] = is_end_[static_cast<std::size_t>(next)] = is_end;
    }
  }

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
        sums[sets.find(static_cast<std::size_t>(node))][0].add(on_edge(e, share));
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
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      Box box(place(edges_[e].first));
      for (const double share : {0.25, 0.5, 0.75, 1.0}) box.extend(on_edge(e, share));
      boxes.emplace_back(box.min() - Vector3::Constant(tolerance_ / 2), box.max() + Vector3::Constant(tolerance_ / 2));
    }
    ThreadTeam team(1);
    const BoxTree tree(boxes, team);
    std::map<std::array<std::size_t, 2>, std::vector<Meeting>> meetings;  // of two chains
    std::vector<Index> near;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      near.clear();
      tree.for_each_overlapping_leaf(boxes[e], 0, [&](std::size_t leaf) {
        for (const Index other : tree.leaf_items(leaf)) {
          if (static_cast<std::size_t>(other) > e && tree.box(other).intersects(boxes[e])) near.push_back(other);
        }
      });
      std::sort(near.begin(), near.end());
      for (const Index other : near) {
        const auto f = static_cast<std::size_t>(other);
        const std::optional<Meeting> found = meeting(e, f);
        if (found) meetings[{edges_[e].chain, edges_[f].chain}].push_back(*found);
      }
    }
    for (auto& [chains, found] : meetings) take_nearest(found);
  }

  [[nodiscard]] std::optional<Meeting> meeting(std::size_t e, std::size_t f) const {
    const Edge& first = edges_[e];
    const Edge& second = edges_[f];
    const bool is_shared = first.first == second.first || first.first == second.second ||
                           first.second == second.first || first.second == second.second;
    if (is_shared) return std::nullopt;
    const auto [s, t] =
        nearest_shares(place(first.first), place(first.second), place(second.first), place(second.second));
    const Meeting found = meeting_at(e, s, f, t);
    return found.distance <= tolerance_ ? std::optional(found) : std::nullopt;
  }

  /// Of neighbouring meetings of two curves the nearest one joins them; where they run beside each other for long, all
  /// nodes join the other curve. One curve does not meet itself where it turns back, as at a trailing edge.
  void take_nearest(std::vector<Meeting>& found) {
    constexpr double long_stretch = 10;  // tolerances
    constexpr double gap = 4;            // tolerances
    std::stable_sort(found.begin(), found.end(),
                     [](const Meeting& a, const Meeting& b) { return a.along[0] < b.along[0]; });
    std::vector<std::uint8_t> is_taken(found.size(), 0);
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (is_taken[k] != 0) continue;
      std::vector<std::size_t> cluster = {k};
      is_taken[k] = 1;
      std::array<double, 2> low = found[k].along;
      std::array<double, 2> high = found[k].along;
      const auto extend = [&](const Meeting& at) {
        for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
          low[side] = std::min(low[side], at.along[side]);
          high[side] = std::max(high[side], at.along[side]);
        }
      };
      for (std::size_t l = k + 1; l < found.size() && found[l].along[0] <= high[0] + gap * tolerance_; ++l) {
        const double there = found[l].along[1];
        if (is_taken[l] != 0 || there < low[1] - gap * tolerance_ || there > high[1] + gap * tolerance_) continue;
        is_taken[l] = 1;
        cluster.push_back(l);
        extend(found[l]);
      }
      if (std::any_of(cluster.begin(), cluster.end(),
                      [&](std::size_t l) { return between(found[l]) <= gap * tolerance_; }))
        continue;
      for (const std::size_t l : cluster) {
        for (const Meeting& at : meetings_at_nodes(found[l].edges)) extend(at);
      }
      const bool runs_beside = std::max(high[0] - low[0], high[1] - low[1]) > long_stretch * tolerance_;
      const auto nearest = std::min_element(cluster.begin(), cluster.end(), [&](std::size_t a, std::size_t b) {
        return found[a].distance < found[b].distance;
      });
      for (const std::size_t l : cluster) {
        if (runs_beside) {
          for (const Meeting& at : meetings_at_nodes(found[l].edges)) meet(at);
        } else if (l == *nearest) {
          meet(found[l]);
        }
      }
    }
  }

  /// The length of curve between two places of one curve; infinite for two.
  [[nodiscard]] double between(const Meeting& at) const {
    const std::size_t chain = edges_[at.edges[0]].chain;
    if (chain != edges_[at.edges[1]].chain) return std::numeric_limits<double>::infinity();
    const double length = std::abs(at.along[1] - at.along[0]);
    return curves_.chains()[chain].closed ? std::min(length, length_[chain] - length) : length;
  }

  /// Where the nodes of each of two edges are near the other edge.
  [[nodiscard]] std::vector<Meeting> meetings_at_nodes(const std::array<std::size_t, 2>& edges) const {
    std::vector<Meeting> found;
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      const std::size_t e = edges[side];
      const std::size_t f = edges[1 - side];
      for (const double share : {0.0, 1.0}) {
        const double other = nearest_share(on_edge(e, share), place(edges_[f].first), place(edges_[f].second));
        const Meeting at = side == 0 ? meeting_at(e, share, f, other) : meeting_at(f, other, e, share);
        if (at.distance <= tolerance_) found.push_back(at);
      }
    }
    return found;
  }

  [[nodiscard]] Meeting meeting_at(std::size_t e, double s, std::size_t f, double t) const {
    return {{e, f},
            {s, t},
            {edges_[e].begin + s * edges_[e].length, edges_[f].begin + t * edges_[f].length},
            (on_edge(e, s) - on_edge(f, t)).norm()};
  }

  void meet(const Meeting& at) {
    const auto [e, f] = at.edges;
    const Vector3 on_first = on_edge(e, at.shares[0]);
    const Vector3 on_second = on_edge(f, at.shares[1]);
    const Index at_first = node_near(e, at.along[0], on_first);
    const Index at_second = node_near(f, at.along[1], on_second);
    if (at_first >= 0 && at_second >= 0) {
      same_.emplace_back(at_first, at_second);
    } else if (at_first >= 0) {
      cuts_[f].emplace_back(at.shares[1], at_first);
    } else if (at_second >= 0) {
      cuts_[e].emplace_back(at.shares[0], at_second);
    } else {
      const auto node = static_cast<Index>(places_.size());
      places_.push_back((on_first + on_second) / 2);
      cuts_[e].emplace_back(at.shares[0], node);
      cuts_[f].emplace_back(at.shares[1], node);
    }
  }

  [[nodiscard]] const Vector3& place(Index node) const { return places_[static_cast<std::size_t>(node)]; }
  /// On the curve, which is a cubic between its nodes: edges may be long.
  [[nodiscard]] Vector3 on_edge(std::size_t e, double share) const {
    const Edge& edge = edges_[e];
    return on_cubic(place(edge.first), place(edge.second) - place(edge.first), edge.tangent_first, edge.tangent_second,
                    share);
  }

  /// The node of an edge's curve that is a place: an end of the curve, or else the nearer end of the edge; −1 if none
  /// is within the tolerance.
  [[nodiscard]] Index node_near(std::size_t e, double along, const Vector3& there) const {
    const auto distance = [&](Index node) { return (place(node) - there).norm(); };
    const auto& chain = curves_.chains()[edges_[e].chain];
    if (!chain.closed) {
      // Both ends may be here; this one is.
      const Index end = along < length_[edges_[e].chain] / 2 ? chain.nodes.front() : chain.nodes.back();
      if (distance(end) <= tolerance_) return end;
    }
    const Index end = distance(edges_[e].first) <= distance(edges_[e].second) ? edges_[e].first : edges_[e].second;
    return distance(end) <= tolerance_ ? end : -1;
  }

  double tolerance_;
  const PolygonCurve& curves_;
  std::vector<Edge> edges_;
  std::vector<std::uint8_t> is_sharp_;  ///< per chain
  std::vector<double> length_;          ///< per chain
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
