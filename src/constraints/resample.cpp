#include "vspring/resample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "constraints/sides.hpp"
#include "shape/arcs.hpp"
#include "shape/corners.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

constexpr Index most_nodes = 100'000'000;
// Number of chords that each cubic is measured with: spacing is then even to about a thousandth.
constexpr int steps_per_edge = 16;
// The steepest change of spacing per length.
constexpr double steepest = 0.25;

/// The nodes between two kept ones, both included; a whole closed chain ends with its first node again.
struct Piece {
  std::vector<Index> nodes;
  std::vector<Vector3> tangents;
  std::vector<double> density = {};  ///< of new nodes, at each of the nodes; empty: even
  double length = 0;                 ///< times density
  double furthest = 1;               ///< the share of the length at which it is furthest from its ends
  Index least_edges = 1;
  Index edges = 0;
};

class Resampler {
 public:
  Resampler(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how)
      : curve_(curve),
        constraints_(constraints),
        by_(how.by),
        is_corner_(marked_corners(how.corners, curve.node_count())) {
    for (Index node = 0; node < curve.node_count(); ++node) {
      if (constraints.corner(node)) is_corner_[static_cast<std::size_t>(node)] = 1;
    }
    for (const auto& chain : curve.chains()) {
      for (const Index node : chain.nodes) {
        if (!place(node).allFinite())
          throw Error(ErrorCode::unusable_shape, fmt::format("node {}: its position is not finite", node));
      }
    }
    find_kept();
    for (const auto& chain : curve.chains()) cut(chain);
  }

  void share_out(const Resampling& how) {
    share_out_edges(how);
    space();
  }

  Resampled build() {
    Resampled result{.curve = {}, .constraints = Constraints(0), .from = {}};
    number_.assign(static_cast<std::size_t>(curve_.node_count()), -1);
    std::vector<PolygonCurve::Chain> chains;
    chains.reserve(curve_.chains().size());
    std::size_t at = 0;
    for (std::size_t c = 0; c < curve_.chains().size(); ++c) {
      auto& chain = chains.emplace_back();
      chain.closed = curve_.chains()[c].closed;
      if (pieces_of_[c] == 0) {
        for (const Index node : curve_.chains()[c].nodes) chain.nodes.push_back(add_kept(node, result));
      }
      for (const std::size_t end = at + pieces_of_[c]; at < end; ++at) {
        chain.nodes.push_back(add_kept(pieces_[at].nodes.front(), result));
        add_between(pieces_[at], chain.nodes, result);
        if (at + 1 == end && !chain.closed) chain.nodes.push_back(add_kept(pieces_[at].nodes.back(), result));
      }
    }
    result.constraints = Constraints(static_cast<Index>(positions_.size()));
    for (std::size_t k = 0; k < result.from.size(); ++k) {
      const Index from = result.from[k];
      if (from >= 0) result.constraints.hold_as(static_cast<Index>(k), constraints_, from);
    }
    result.curve = PolygonCurve(std::move(positions_), std::move(chains));
    return result;
  }

 private:
  /// Places the nodes, once each piece's number of edges is known.
  void space() {
    if (by_ == ResamplingBy::curvature) {
      for (Piece& piece : pieces_) follow_curvature(piece);
    }
    if (by_ == ResamplingBy::cosine) {
      for (Piece& piece : pieces_) find_furthest(piece);
    }
  }

  void share_out_edges(const Resampling& how) {
    if (how.spacing) {
      double nodes = 0;
      for (const Piece& piece : pieces_) nodes += piece.length / *how.spacing;
      if (!(nodes < most_nodes))
        throw Error(ErrorCode::invalid_argument,
                    fmt::format("a spacing of {} asks for more than {} nodes", *how.spacing, most_nodes));
      for (Piece& piece : pieces_)
        piece.edges = std::max(piece.least_edges, static_cast<Index>(std::lround(piece.length / *how.spacing)));
    } else {
      share_out(*how.nodes);
    }
  }

  [[nodiscard]] const Vector3& place(Index node) const {
    return constraints_.position_fixed(node) ? constraints_.position(node) : curve_.position(node);
  }

  void find_kept() {
    kept_ = boundary_nodes(curve_);
    std::vector<std::uint8_t> met(kept_.size(), 0);
    for (const auto& chain : curve_.chains()) {
      for (const Index node : chain.nodes) {
        const auto n = static_cast<std::size_t>(node);
        const bool said =
            constraints_.position_fixed(node) || constraints_.normal_fixed(node) || constraints_.tangent_fixed(node);
        if (met[n] != 0 || said || is_corner_[n] != 0) kept_[n] = 1;
        met[n] = 1;
      }
    }
  }

  void cut(const PolygonCurve::Chain& chain) {
    const std::size_t before = pieces_.size();
    const auto is_kept = [&](Index node) { return kept_[static_cast<std::size_t>(node)] != 0; };
    const auto is_corner = [&](Index node) { return is_corner_[static_cast<std::size_t>(node)] != 0; };
    if (chain.nodes.size() > 1) {
      // A closed chain is followed from a corner or another kept node on.
      std::vector<Index> nodes = chain.nodes;
      bool closed = chain.closed;
      if (chain.closed) {
        auto first = std::find_if(nodes.begin(), nodes.end(), is_corner);
        closed = first == nodes.end();
        if (closed) first = std::find_if(nodes.begin(), nodes.end(), is_kept);
        if (first != nodes.end()) std::rotate(nodes.begin(), first, nodes.end());
        nodes.push_back(nodes.front());
      }
      std::vector<Index> side;
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        side.push_back(nodes[k]);
        if (side.size() < 2 || (k + 1 < nodes.size() && !is_corner(nodes[k]))) continue;
        cut_side(side, closed);
        side = {nodes[k]};
      }
      const std::size_t pieces = pieces_.size() - before;
      if (chain.closed && pieces < 3) pieces_[before].least_edges = static_cast<Index>(4 - pieces);
    }
    pieces_of_.push_back(pieces_.size() - before);
  }

  /// From one corner or end to the next, or a closed chain with its first node again.
  void cut_side(const std::vector<Index>& nodes, bool closed) {
    const std::vector<Vector3> tangents = tangents_along(nodes, closed);
    Piece piece;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      piece.nodes.push_back(nodes[k]);
      piece.tangents.push_back(tangents[k]);
      if (piece.nodes.size() < 2 || kept_[static_cast<std::size_t>(nodes[k])] == 0) continue;
      finish(piece);
      piece = {.nodes = {nodes[k]}, .tangents = {tangents[k]}};
    }
    if (piece.nodes.size() > 1) finish(std::move(piece));
  }

  /// The given tangents, else those of this chain alone, as chains that meet have different ones. `nodes` of a closed
  /// chain repeat the first at the end.
  [[nodiscard]] std::vector<Vector3> tangents_along(const std::vector<Index>& nodes, bool closed) const {
    const std::size_t count = nodes.size() - (closed ? 1 : 0);
    std::vector<Vector3> positions;
    positions.reserve(count);
    for (std::size_t k = 0; k < count; ++k) positions.push_back(place(nodes[k]));
    std::vector<Index> all(count);
    std::iota(all.begin(), all.end(), 0);
    std::vector<Vector3> tangents = estimate_tangents(PolygonCurve(std::move(positions), closed), all);
    for (std::size_t k = 0; k < count; ++k) {
      // A side of a corner begins or ends there.
      const NodeSide side = k > 0 ? NodeSide::before : NodeSide::after;
      if (constraints_.tangent_fixed(nodes[k], side)) tangents[k] = constraints_.tangent(nodes[k], side);
    }
    if (closed) tangents.push_back(tangents.front());
    return tangents;
  }

  void finish(Piece piece) {
    measure(piece);
    pieces_.push_back(std::move(piece));
  }

  void measure(Piece& piece) const {
    piece.length = 0;
    for (std::size_t k = 0; k + 1 < piece.nodes.size(); ++k) piece.length += walk(piece, k, [](double, double) {});
  }

  [[nodiscard]] double edge(const Piece& piece, std::size_t k) const {
    return (place(piece.nodes[k + 1]) - place(piece.nodes[k])).norm();
  }

  /// Spaces nodes by the inverse root of curvature, so arcs rise equally over their chords. Spacing is at most twice
  /// what the curve's mean turn asks for, and changes by at most a quarter from one edge to the next.
  void follow_curvature(Piece& piece) const {
    const std::size_t count = piece.nodes.size();
    std::vector<double> turn(count, 0);
    double turned = 0;
    double length = 0;
    for (std::size_t k = 0; k + 1 < count; ++k) {
      const double cosine = std::clamp(piece.tangents[k].dot(piece.tangents[k + 1]), -1.0, 1.0);
      turn[k] = std::acos(cosine);
      turned += turn[k];
      length += edge(piece, k);
    }
    if (!(turned > 0) || !(length > 0)) return;
    const double floor = 0.5 * turned / length;
    std::vector<double> spacing(count);
    for (std::size_t k = 0; k < count; ++k) {
      const double around = (k > 0 ? edge(piece, k - 1) : 0) + (k + 1 < count ? edge(piece, k) : 0);
      const double bent = (k > 0 ? turn[k - 1] : 0) + turn[k];
      spacing[k] = 1 / std::sqrt(floor + (around > 0 ? bent / around : 0));
    }
    // From nodes to edges of the piece, and back to densities.
    const auto set_density = [&] {
      piece.density.resize(count);
      for (std::size_t k = 0; k < count; ++k) piece.density[k] = 1 / spacing[k];
      measure(piece);
    };
    set_density();
    const double scale = piece.length / static_cast<double>(piece.edges);
    for (double& one : spacing) one *= scale;
    for (std::size_t k = 1; k < count; ++k)
      spacing[k] = std::min(spacing[k], spacing[k - 1] + steepest * edge(piece, k - 1));
    for (std::size_t k = count - 1; k-- > 0;)
      spacing[k] = std::min(spacing[k], spacing[k + 1] + steepest * edge(piece, k));
    set_density();
  }

  void find_furthest(Piece& piece) const {
    const Vector3 ends = (place(piece.nodes.front()) + place(piece.nodes.back())) / 2;
    double furthest = 0;
    double length = 0;
    for (std::size_t k = 0; k + 1 < piece.nodes.size(); ++k) {
      length += walk(piece, k, [](double, double) {});
      const double distance = (place(piece.nodes[k + 1]) - ends).norm();
      if (k + 2 == piece.nodes.size() || !(distance > furthest)) continue;
      furthest = distance;
      piece.furthest = length / piece.length;
    }
    // A piece that goes from one side to the other has no furthest place.
    const double across = (place(piece.nodes.back()) - place(piece.nodes.front())).norm();
    if (!(furthest > across)) piece.furthest = 1;
  }

  /// The place of new node `made` along a piece.
  [[nodiscard]] double place_of(const Piece& piece, Index made) const {
    const double share = static_cast<double>(made) / static_cast<double>(piece.edges);
    if (by_ != ResamplingBy::cosine) return piece.length * share;
    const auto between = [&](double from, double to) {
      return from + (to - from) * (1 - std::cos(std::numbers::pi * (share - from) / (to - from))) / 2;
    };
    return piece.length * (share < piece.furthest ? between(0, piece.furthest) : between(piece.furthest, 1));
  }

  /// Walks along edge k of a piece and calls step(v, length of the edge up to v). Returns the edge's length. Lengths
  /// are multiplied by density.
  template <typename Step>
  double walk(const Piece& piece, std::size_t k, Step step) const {
    double length = 0;
    Vector3 before = on_edge(piece, k, 0);
    for (int s = 1; s <= steps_per_edge; ++s) {
      const double v = static_cast<double>(s) / steps_per_edge;
      const Vector3 here = on_edge(piece, k, v);
      const double middle = v - 0.5 / steps_per_edge;
      const double density =
          piece.density.empty() ? 1 : (1 - middle) * piece.density[k] + middle * piece.density[k + 1];
      length += density * (here - before).norm();
      step(v, length);
      before = here;
    }
    return length;
  }

  [[nodiscard]] Vector3 on_edge(const Piece& piece, std::size_t k, double v) const {
    const Index a = piece.nodes[k];
    const Index b = piece.nodes[k + 1];
    return on_cubic(place(a), place(b) - place(a), piece.tangents[k], piece.tangents[k + 1], v);
  }

  void share_out(Index nodes) {
    // A piece has one new node fewer than edges; the rest of the number are kept nodes.
    std::vector<std::uint8_t> counted(kept_.size(), 0);
    Index kept = 0;
    Index least = 0;
    double length = 0;
    const auto count = [&](Index node) {
      kept += counted[static_cast<std::size_t>(node)] == 0 ? 1 : 0;
      counted[static_cast<std::size_t>(node)] = 1;
    };
    for (std::size_t c = 0; c < curve_.chains().size(); ++c) {
      if (pieces_of_[c] > 0) continue;
      for (const Index node : curve_.chains()[c].nodes) count(node);
    }
    for (const Piece& piece : pieces_) {
      count(piece.nodes.front());
      count(piece.nodes.back());
      least += piece.least_edges;
      length += piece.length;
    }
    const auto edges = static_cast<Index>(nodes - kept + static_cast<Index>(pieces_.size()));
    if (edges < least)
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("{} nodes are too few: {} are ends or held, and pieces between them need {} more", nodes,
                              kept, least - static_cast<Index>(pieces_.size())));
    // As if edges were given one by one to the piece with the longest edges; bisection on the edge length finds that
    // directly.
    const auto edges_of = [&](const Piece& piece, double spacing) {
      return std::max<double>(piece.least_edges, std::ceil(piece.length / spacing));
    };
    double low = 0;
    double high = std::max(length, 1e-300) * 2;
    for (int k = 0; k < 200; ++k) {
      const double spacing = low + (high - low) / 2;
      double needed = 0;
      for (const Piece& piece : pieces_) needed += edges_of(piece, spacing);
      (needed <= edges ? high : low) = spacing;
    }
    Index left = edges;
    for (Piece& piece : pieces_) {
      piece.edges = static_cast<Index>(edges_of(piece, high));
      left -= piece.edges;
    }
    // Pieces of equal length gain an edge together; the first ones get the remaining edges.
    for (std::size_t k = 0; left > 0 && !pieces_.empty(); k = (k + 1) % pieces_.size()) {
      ++pieces_[k].edges;
      --left;
    }
  }

  Index add(const Vector3& position, Index from, Resampled& result) {
    positions_.push_back(position);
    result.from.push_back(from);
    return static_cast<Index>(positions_.size() - 1);
  }

  Index add_kept(Index node, Resampled& result) {
    Index& number = number_[static_cast<std::size_t>(node)];
    if (number < 0) number = add(place(node), node, result);
    return number;
  }

  void add_between(const Piece& piece, std::vector<Index>& nodes, Resampled& result) {
    Index made = 1;
    double passed = 0;
    for (std::size_t k = 0; k + 1 < piece.nodes.size(); ++k) {
      double v_before = 0;
      double before = passed;
      passed += walk(piece, k, [&](double v, double along) {
        const double here = passed + along;
        for (; made < piece.edges; ++made) {
          const double at = place_of(piece, made);
          if (at > here) break;
          const double share = here > before ? (at - before) / (here - before) : 1;
          nodes.push_back(add(on_edge(piece, k, v_before + share * (v - v_before)), -1, result));
        }
        v_before = v;
        before = here;
      });
    }
    // Rounding may leave the last node out.
    for (; made < piece.edges; ++made) nodes.push_back(add(place(piece.nodes.back()), -1, result));
  }

  const PolygonCurve& curve_;
  const Constraints& constraints_;
  ResamplingBy by_;
  std::vector<std::uint8_t> is_corner_;
  std::vector<std::uint8_t> kept_;
  std::vector<Piece> pieces_;
  std::vector<std::size_t> pieces_of_;  // of each chain
  std::vector<Index> number_;           // of kept nodes in the result
  std::vector<Vector3> positions_;
};

void check_resampling(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how) {
  check_corners(curve, constraints);
  if (how.nodes.has_value() == how.spacing.has_value())
    throw Error(ErrorCode::invalid_argument, "resampling needs either a number of nodes or a spacing");
  if (how.nodes && (*how.nodes < 1 || *how.nodes > most_nodes))
    throw Error(ErrorCode::invalid_argument, fmt::format("{} nodes: choose from 1 to {}", *how.nodes, most_nodes));
  if (how.spacing && !(*how.spacing > 0 && std::isfinite(*how.spacing)))
    throw Error(ErrorCode::invalid_argument, fmt::format("spacing must be greater than 0, not {}", *how.spacing));
}

}  // namespace

Resampled resample(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how) {
  check_resampling(curve, constraints, how);
  Resampler resampler(curve, constraints, how);
  resampler.share_out(how);
  return resampler.build();
}

}  // namespace vspring
