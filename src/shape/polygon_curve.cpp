#include "vspring/polygon_curve.hpp"

#include <fmt/format.h>

#include <array>
#include <numeric>

#include "vspring/error.hpp"

namespace vspring {

PolygonCurve::PolygonCurve(std::vector<Vector3> positions, bool closed) : positions_(std::move(positions)) {
  if (positions_.empty()) return;
  chains_.push_back({.nodes = std::vector<Index>(positions_.size()), .closed = closed});
  std::iota(chains_.front().nodes.begin(), chains_.front().nodes.end(), 0);
}

PolygonCurve::PolygonCurve(std::vector<Vector3> positions, std::vector<Chain> chains)
    : positions_(std::move(positions)), chains_(std::move(chains)) {
  for (std::size_t c = 0; c < chains_.size(); ++c) {
    for (const Index node : chains_[c].nodes) {
      if (node < 0 || node >= node_count())
        throw Error(ErrorCode::unusable_shape,
                    fmt::format("chain {}: node {} does not exist, there are {}", c, node, node_count()));
    }
  }
}

void PolygonCurve::set_positions(std::vector<Vector3> positions) {
  if (positions.size() != positions_.size())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} positions given for {} nodes", positions.size(), positions_.size()));
  positions_ = std::move(positions);
}

void PolygonCurve::set_positions(std::span<const double> coordinates) { set_positions(positions_of(coordinates)); }

std::vector<std::uint8_t> boundary_nodes(const PolygonCurve& curve) {
  std::vector<std::uint8_t> boundary(static_cast<std::size_t>(curve.node_count()), 0);
  for (const auto& chain : curve.chains()) {
    if (chain.closed || chain.nodes.empty()) continue;
    boundary[static_cast<std::size_t>(chain.nodes.front())] = 1;
    boundary[static_cast<std::size_t>(chain.nodes.back())] = 1;
  }
  return boundary;
}

std::vector<PolygonCurve::Chain> chains_of_segments(const std::vector<std::pair<Index, Index>>& segments,
                                                    Index node_count) {
  constexpr std::size_t no_segment = static_cast<std::size_t>(-1);
  const auto proper = [&](std::size_t s) { return segments[s].first != segments[s].second; };
  // Two segments at a node follow each other.
  std::vector<std::array<std::size_t, 2>> at(static_cast<std::size_t>(node_count), {no_segment, no_segment});
  std::vector<Index> degree(static_cast<std::size_t>(node_count), 0);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (!proper(s)) continue;
    for (const Index node : {segments[s].first, segments[s].second}) {
      const auto n = static_cast<std::size_t>(node);
      if (degree[n] < 2) at[n][static_cast<std::size_t>(degree[n])] = s;
      ++degree[n];
    }
  }
  std::vector<std::uint8_t> used(segments.size(), 0);
  /// Appends the nodes of the run beyond `node`, an end of segment s; true if the run comes back to segment `first`.
  const auto follow = [&](std::size_t s, Index node, std::size_t first, std::vector<Index>& nodes) {
    for (;;) {
      const auto n = static_cast<std::size_t>(node);
      if (degree[n] != 2) return false;
      s = at[n][0] == s ? at[n][1] : at[n][0];
      if (s == first) return true;
      used[s] = 1;
      node = segments[s].first == node ? segments[s].second : segments[s].first;
      nodes.push_back(node);
    }
  };
  std::vector<PolygonCurve::Chain> chains;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (used[s] != 0 || !proper(s)) continue;
    used[s] = 1;
    std::vector<Index> forward = {segments[s].first, segments[s].second};
    PolygonCurve::Chain chain;
    if (follow(s, segments[s].second, s, forward)) {
      forward.pop_back();
      chain = {.nodes = std::move(forward), .closed = true};
    } else {
      std::vector<Index> backward;
      (void)follow(s, segments[s].first, s, backward);
      chain.nodes.assign(backward.rbegin(), backward.rend());
      chain.nodes.insert(chain.nodes.end(), forward.begin(), forward.end());
    }
    chains.push_back(std::move(chain));
  }
  return chains;
}

}  // namespace vspring
