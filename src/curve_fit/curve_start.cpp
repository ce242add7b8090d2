#include "curve_fit/curve_start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/cancellation.hpp"
#include "curve_fit/curve_lengths.hpp"
#include "curve_fit/node_spacing.hpp"
#include "shape/segment.hpp"

namespace vspring {

namespace {

using Node = DenseCurve::Node;

/// The nodes of a first curve along the way of a chain, and the places of its points on it.
class Start {
 public:
  Start(const std::vector<ChainNode>& chain, bool closed, const StartScale& scale, Way way)
      : chain_(chain), closed_(closed), way_(std::move(way)) {
    std::vector<Stop>& stops = way_.stops;
    // A closed way begins at a fixed place, if there is one.
    if (closed) {
      const auto fixed = std::find_if(stops.begin(), stops.end(), [](const Stop& stop) { return stop.fixed; });
      if (fixed != stops.end()) std::rotate(stops.begin(), fixed, stops.end());
      stops.push_back(stops.front());
    }
    for (const Stop& stop : stops) {
      vertices_.places.push_back(stop.place);
      vertices_.fixed.push_back(stop.fixed ? 1 : 0);
      vertices_.sharp.push_back(stop.corner || (stop.fixed && chain[stop.node].corner) ? 1 : 0);
    }
    if (!closed) vertices_.fixed.front() = vertices_.fixed.back() = 1;
    length_.assign(stops.size(), 0);
    for (std::size_t k = 1; k < stops.size(); ++k)
      length_[k] = length_[k - 1] + (vertices_.places[k] - vertices_.places[k - 1]).norm();
    spacing_ = spacing_along(vertices_, closed, scale.tolerance);
    add_nodes();
  }

  void add_to(DenseCurve& curve, std::vector<CurvePoint>& points) const {
    const std::uint32_t begin = curve.size();
    curve.add_chain(nodes_, closed_);
    std::vector<std::size_t> stop_of(chain_.size(), 0);
    for (std::size_t k = 0; k + (closed_ ? 1 : 0) < way_.stops.size(); ++k) stop_of[way_.stops[k].node] = k;
    // In the order of the way.
    std::vector<std::pair<std::size_t, std::size_t>> rows;
    for (std::size_t k = 0; k < chain_.size(); ++k) {
      if (chain_[k].point >= 0) rows.emplace_back(stop_of[way_.first_rows[k]], k);
    }
    std::sort(rows.begin(), rows.end());
    for (const auto& [stop, k] : rows) {
      const ChainNode& row = chain_[k];
      CurvePlace at = place_at(length_near(row.place, stop));
      at.edge += begin;
      points.push_back({row.place, row.weight, at, row.point, 0});
    }
  }

 private:
  void add_nodes() {
    std::vector<double> edges;
    for (std::size_t k = 1; k < length_.size(); ++k) edges.push_back(length_[k] - length_[k - 1]);
    const auto between = [](const auto& values, const PlaceOnWay& at) {
      return values[at.edge] + at.share * (values[at.edge + 1] - values[at.edge]);
    };
    std::size_t first = 0;
    add_stop(0);
    for (std::size_t k = 1; k < length_.size(); ++k) {
      if (vertices_.fixed[k] == 0 && k + 1 < length_.size()) continue;
      if (!is_straight(first, k)) {
        for (const PlaceOnWay& at : places_between(edges, spacing_, first, k, 1)) {
          const Vector3& from = vertices_.places[at.edge];
          add(from + at.share * (vertices_.places[at.edge + 1] - from), between(length_, at), between(spacing_, at));
        }
      }
      if (k + 1 < length_.size() || !closed_) add_stop(k);
      first = k;
    }
  }

  Node& add(const Vector3& place, double at, double spacing) {
    Node& node = nodes_.emplace_back();
    node.place = place;
    node.spacing = spacing;
    at_.push_back(at);
    return node;
  }

  void add_stop(std::size_t k) {
    Node& node = add(vertices_.places[k], length_[k], spacing_[k]);
    const Stop& stop = way_.stops[k];
    if (!stop.fixed) return;
    const ChainNode& from = chain_[stop.corner ? way_.middle_row(stop) : stop.node];
    node.tangents = from.tangents;
    node.held = from.held;
    node.corner = vertices_.sharp[k] != 0;
    node.from = from.from;
    node.dense = false;
  }

  /// Whether a piece between two successive fixed rows is straight.
  [[nodiscard]] bool is_straight(std::size_t first, std::size_t last) const {
    const Stop& a = way_.stops[first];
    const Stop& b = way_.stops[last];
    return last == first + 1 && a.fixed && b.fixed && a.node + 1 == b.node;
  }

  /// The place along the way nearest to a row, not beyond the neighbouring stops: the way may come back here.
  [[nodiscard]] double length_near(const Vector3& place, std::size_t stop) const {
    double at = length_[stop];
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t edge = stop > 0 ? stop - 1 : 0; edge <= stop && edge + 1 < length_.size(); ++edge) {
      const Vector3& from = vertices_.places[edge];
      const Vector3& to = vertices_.places[edge + 1];
      const double share = nearest_share(place, from, to);
      const double distance = (from + share * (to - from) - place).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      at = length_[edge] + share * (length_[edge + 1] - length_[edge]);
    }
    return at;
  }

  [[nodiscard]] CurvePlace place_at(double length) const {
    const auto edges = static_cast<std::ptrdiff_t>(nodes_.size()) - (closed_ ? 0 : 1);
    const auto above = std::upper_bound(at_.begin(), at_.end(), length);
    const auto node = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - at_.begin() - 1, 0, edges - 1));
    const double end = node + 1 < at_.size() ? at_[node + 1] : length_.back();
    const double edge = end - at_[node];
    return {static_cast<std::uint32_t>(node), edge > 0 ? std::clamp((length - at_[node]) / edge, 0.0, 1.0) : 0};
  }

  const std::vector<ChainNode>& chain_;
  bool closed_;
  Way way_;
  WayVertices vertices_;
  std::vector<double> length_;  // up to each vertex
  std::vector<double> spacing_;
  std::vector<Node> nodes_;
  std::vector<double> at_;  // the places of nodes along the way
};

/// Adds a chain that cannot bend.
void add_held(const std::vector<ChainNode>& chain, bool closed, DenseCurve& curve) {
  std::vector<Node> nodes;
  for (const ChainNode& one : chain) {
    Node& node = nodes.emplace_back();
    node.place = one.place;
    node.held = true;
    node.dense = false;
    node.from = one.from;
  }
  curve.add_chain(nodes, closed);
}

/// A chain of the same curve with other nodes.
std::vector<Node> new_nodes(const DenseCurve& curve, const DenseCurve::Chain& chain, double least) {
  std::vector<std::uint32_t> way;
  way.reserve(chain.count + 1);
  for (std::uint32_t k = 0; k < chain.count; ++k) way.push_back(chain.begin + k);
  if (chain.closed) way.push_back(chain.begin);
  std::vector<double> spacing;
  spacing.reserve(way.size());
  for (const std::uint32_t i : way) spacing.push_back(curve.node(i).spacing);
  std::vector<double> edges;
  for (std::size_t k = 0; k + 1 < way.size(); ++k) {
    edges.push_back(curve.edge_length(way[k]));
    const double turn = turn_between(curve.bend(way[k], true).tangent, curve.bend(way[k + 1], false).tangent);
    if (!(turn > greatest_turn_of_edge)) continue;
    const double most = std::max(least, edges.back() * greatest_turn_of_edge / turn);
    spacing[k] = std::min(spacing[k], most);
    spacing[k + 1] = std::min(spacing[k + 1], most);
  }
  even_out_spacing(spacing, edges, chain.closed);
  std::vector<Node> nodes;
  const auto add_old = [&](std::size_t k) {
    nodes.push_back(curve.node(way[k]));
    nodes.back().spacing = spacing[k];
  };
  std::size_t first = 0;
  add_old(0);
  for (std::size_t k = 1; k < way.size(); ++k) {
    if (curve.node(way[k]).dense && k + 1 < way.size()) continue;
    if (k > first + 1) {
      for (const PlaceOnWay& at : places_between(edges, spacing, first, k, 2)) {
        Node& node = nodes.emplace_back();
        node.place = curve.at({way[at.edge], at.share});
        node.spacing = spacing[at.edge] + at.share * (spacing[at.edge + 1] - spacing[at.edge]);
      }
    }
    if (k + 1 < way.size() || !chain.closed) add_old(k);
    first = k;
  }
  return nodes;
}

}  // namespace

void add_start(const std::vector<ChainNode>& chain, bool closed, const StartScale& scale, DenseCurve& curve,
               std::vector<CurvePoint>& points) {
  Way way = find_way(chain, closed, scale, curve);
  if (way.stops.size() < (closed ? 3U : 2U)) {
    add_held(chain, closed, curve);
    return;
  }
  Start start(chain, closed, scale, std::move(way));
  start.add_to(curve, points);
}

DenseCurve with_new_nodes(const DenseCurve& curve, double least) {
  DenseCurve result(false, curve.moving());
  for (const auto& chain : curve.chains()) result.add_chain(new_nodes(curve, chain, least), chain.closed);
  return result;
}

void find_places(const DenseCurve& curve, std::vector<CurvePoint>& points) {
  for (std::size_t j = 0; j < points.size(); ++j) {
    end_if_cancelled_at(j);
    CurvePoint& point = points[j];
    const double away = curve.offset(point.at, point.place).norm();
    point.at = curve.nearest(point.place, point.at, 2 * away + 2 * curve.edge_length(point.at.edge));
  }
}

void carry_places(const DenseCurve& before, const DenseCurve& curve, std::vector<CurvePoint>& points) {
  // Ends and held nodes are on both curves; places between are found by length.
  const CurveLengths from(before);
  const CurveLengths to(curve);
  for (CurvePoint& point : points) {
    const std::size_t c = before.chain_of(point.at.edge);
    const double scale = from.whole(c) > 0 ? to.whole(c) / from.whole(c) : 1;
    point.at = to.place(c, scale * from.at(point.at));
  }
  find_places(curve, points);
}

}  // namespace vspring
