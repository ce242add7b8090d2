#include "levels/curve_levels.hpp"

#include <algorithm>
#include <cmath>

#include "base/threads.hpp"
#include "shape/cubic.hpp"
#include "spring/spacing.hpp"

namespace vspring {

namespace {

// Edges between two anchors below which no node is left out: enough for a full turn or two.
constexpr std::size_t enough_edges = 48;
// An edge is aimed at no less than this share of the mean edge of its strand; with Distribution::keep, of this.
constexpr double least_share = 0.01;
constexpr double least_share_kept = 1e-6;
// Turns of up to about 60° tell the shape; sharper ones are noise, and too far from linear to start with.
constexpr double sharp_cosine = 0.5;
constexpr int most_rounds = 100;

/// A node that coarser levels keep, and that averages leave alone.
bool is_anchor(const Net& net, std::size_t node) { return node >= net.moving || net.given[node] != 0; }

/// A quarter of each neighbour and half of itself for every node that is no anchor.
std::vector<Vector3> averaged(const CurveNet& curve) {
  const Net& net = curve.net;
  std::vector<Vector3> positions = net.positions;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    if (is_anchor(net, i) || links.size() < 2) continue;
    positions[i] = 0.5 * net.positions[i] + 0.25 * (net.positions[links[0].node()] + net.positions[links[1].node()]);
  }
  return positions;
}

std::vector<std::vector<double>> places_along(const CurveNet& curve, Distribution distribution) {
  std::vector<std::vector<double>> along;
  ThreadTeam alone(1);
  const std::vector<Vector3> nodes_at =
      distribution == Distribution::smooth ? rest_positions(curve.net, alone) : curve.net.positions;
  for (const MovingRun& moving_run : curve.moving_runs) {
    const std::size_t count = moving_run.nodes.size();
    const std::size_t edges = moving_run.closed ? count : count - 1;
    std::vector<double> lengths(edges, 1);
    if (distribution != Distribution::even) {
      double mean = 0;
      for (std::size_t k = 0; k < edges; ++k) {
        const Vector3 d = nodes_at[moving_run.nodes[(k + 1) % count]] - nodes_at[moving_run.nodes[k]];
        lengths[k] = std::sqrt(d.dot(d) + curve.net.tiny);
        mean += lengths[k] / static_cast<double>(edges);
      }
      const double least = distribution == Distribution::keep ? least_share_kept : least_share;
      for (double& length : lengths) length = std::max(length, least * mean);
    }
    std::vector<double> at(1, 0);
    at.reserve(edges + 1);
    for (const double length : lengths) at.push_back(at.back() + length);
    along.push_back(std::move(at));
  }
  return along;
}

/// Shares that make the lengths of edges go by the places along the strands.
void set_laplacian_weights(CurveLevel& level) {
  Net& net = level.curve.net;
  net.laplacian_weights.assign(net.rings.link_count(), 0);
  for (std::size_t s = 0; s < level.curve.moving_runs.size(); ++s) {
    const auto& nodes = level.curve.moving_runs[s].nodes;
    const auto& at = level.along[s];
    for (std::size_t k = 1; k < nodes.size() && k + 1 < at.size(); ++k) {
      if (nodes[k] >= net.moving) continue;
      const std::size_t first = net.rings.begin(nodes[k]);
      net.laplacian_weights[first] = (at[k + 1] - at[k]) / (at[k + 1] - at[k - 1]);
      net.laplacian_weights[first + 1] = 1 - net.laplacian_weights[first];
    }
  }
}

/// The places of a strand that the next coarser level keeps.
std::vector<std::uint32_t> kept_places(const MovingRun& moving_run, const Net& net) {
  const std::size_t count = moving_run.nodes.size();
  const auto anchor = [&](std::size_t k) { return k == count || is_anchor(net, moving_run.nodes[k]); };
  std::vector<std::uint32_t> kept = {0};
  const std::size_t end = moving_run.closed ? count : count - 1;
  for (std::size_t from = 0; from < end;) {
    std::size_t to = from + 1;
    while (to < end && !anchor(to)) ++to;
    const std::size_t stride = to - from >= enough_edges ? 2 : 1;
    for (std::size_t k = from + stride; k < to; k += stride) kept.push_back(static_cast<std::uint32_t>(k));
    if (to < count) kept.push_back(static_cast<std::uint32_t>(to));
    from = to;
  }
  return kept;
}

/// The net of the places kept; nodes keep their order.
CurveLevel coarser(const CurveLevel& fine, std::vector<std::vector<std::uint32_t>> kept) {
  const Net& from = fine.curve.net;
  constexpr auto left_out = static_cast<std::uint32_t>(-1);
  CurveLevel level;
  Net& net = level.curve.net;
  // Local numbers keep their order, so moving nodes still come first, then held ones with rings.
  std::vector<std::uint32_t> number(from.positions.size(), left_out);
  for (std::size_t s = 0; s < kept.size(); ++s) {
    for (const std::uint32_t k : kept[s]) number[fine.curve.moving_runs[s].nodes[k]] = 0;
  }
  const std::vector<Vector3> positions = averaged(fine.curve);
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == left_out) continue;
    number[i] = static_cast<std::uint32_t>(net.node.size());
    net.node.push_back(from.node[i]);
    net.positions.push_back(positions[i]);
    net.normals.push_back(from.normals[i]);
    net.tangents.push_back(from.tangents[i]);
    net.given.push_back(from.given[i]);
    if (i < from.moving) net.moving = net.node.size();
    if (i < from.computed) net.computed = net.node.size();
  }
  net.frame = from.frame;
  net.tiny = from.tiny;
  for (std::size_t s = 0; s < kept.size(); ++s) {
    const MovingRun& moving_run = fine.curve.moving_runs[s];
    MovingRun& coarse = level.curve.moving_runs.emplace_back();
    coarse.closed = moving_run.closed;
    std::vector<double>& at = level.along.emplace_back();
    for (const std::uint32_t k : kept[s]) {
      coarse.nodes.push_back(number[moving_run.nodes[k]]);
      at.push_back(fine.along[s][k]);
    }
    if (moving_run.closed) at.push_back(fine.along[s].back());
  }
  add_rings(net, level.curve.moving_runs);
  level.finer = std::move(kept);
  set_laplacian_weights(level);
  return level;
}

}  // namespace

std::vector<CurveLevel> curve_levels(CurveNet curve, Distribution distribution) {
  std::vector<CurveLevel> levels(1);
  levels[0].along = places_along(curve, distribution);
  levels[0].curve = std::move(curve);
  if (distribution != Distribution::even) set_laplacian_weights(levels[0]);
  for (;;) {
    const CurveLevel& fine = levels.back();
    std::vector<std::vector<std::uint32_t>> kept;
    bool smaller = false;
    for (const MovingRun& moving_run : fine.curve.moving_runs) {
      kept.push_back(kept_places(moving_run, fine.curve.net));
      smaller = smaller || kept.back().size() < moving_run.nodes.size();
    }
    if (!smaller) break;
    levels.push_back(coarser(fine, std::move(kept)));
  }
  std::reverse(levels.begin(), levels.end());
  return levels;
}

void untangle(CurveLevel& level) {
  Net& net = level.curve.net;
  const auto sharp = [&](std::size_t i) {
    const auto links = net.rings.links(i);
    if (is_anchor(net, i) || links.size() < 2) return false;
    const Vector3 before = net.positions[i] - net.positions[links[0].node()];
    const Vector3 after = net.positions[links[1].node()] - net.positions[i];
    return before.dot(after) < sharp_cosine * before.norm() * after.norm();
  };
  for (int pass = 0; pass < most_rounds; ++pass) {
    bool tangled = false;
    for (std::size_t i = 0; i < net.moving && !tangled; ++i) tangled = sharp(i);
    if (!tangled) return;
    net.positions = averaged(level.curve);
  }
}

void start_from_chords(CurveLevel& level) {
  Net& net = level.curve.net;
  for (std::size_t s = 0; s < level.curve.moving_runs.size(); ++s) {
    const MovingRun& moving_run = level.curve.moving_runs[s];
    const auto& at = level.along[s];
    const std::size_t count = moving_run.nodes.size();
    std::vector<std::size_t> anchors;
    for (std::size_t k = 0; k < count; ++k) {
      if (is_anchor(net, moving_run.nodes[k])) anchors.push_back(k);
    }
    if (anchors.size() < 2) continue;
    const std::size_t pieces = moving_run.closed ? anchors.size() : anchors.size() - 1;
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      const std::size_t from = anchors[piece];
      const std::size_t to = anchors[(piece + 1) % anchors.size()];
      const double once_around = to > from ? 0 : at.back();
      const Vector3 start = net.positions[moving_run.nodes[from]];
      const Vector3 chord = net.positions[moving_run.nodes[to]] - start;
      if (!(chord.dot(chord) > net.tiny)) continue;
      const auto after = [&](std::size_t k) { return k + 1 == count ? 0 : k + 1; };
      for (std::size_t k = after(from); k != to; k = after(k)) {
        const double along = at[k] - at[from] + (k > from ? 0 : once_around);
        net.positions[moving_run.nodes[k]] = start + along / (at[to] - at[from] + once_around) * chord;
      }
    }
  }
}

void restrict_shape(const CurveLevel& fine, CurveLevel& coarse) {
  Net& to = coarse.curve.net;
  for (std::size_t s = 0; s < coarse.curve.moving_runs.size(); ++s) {
    const auto& nodes = coarse.curve.moving_runs[s].nodes;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (nodes[k] < to.moving)
        to.positions[nodes[k]] = fine.curve.net.positions[fine.curve.moving_runs[s].nodes[coarse.finer[s][k]]];
    }
  }
}

void prolong(const CurveLevel& coarse, CurveLevel& fine) {
  const Net& from = coarse.curve.net;
  Net& to = fine.curve.net;
  for (std::size_t s = 0; s < coarse.curve.moving_runs.size(); ++s) {
    const auto& nodes = coarse.curve.moving_runs[s].nodes;
    const auto& fine_nodes = fine.curve.moving_runs[s].nodes;
    const auto& places = coarse.finer[s];
    const auto& at = fine.along[s];
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (nodes[k] < from.moving) to.positions[fine_nodes[places[k]]] = from.positions[nodes[k]];
      const std::size_t begin = places[k];
      const std::size_t end = k + 1 < nodes.size() ? places[k + 1] : fine_nodes.size();
      if (end - begin < 2) continue;
      const std::size_t next = nodes[(k + 1) % nodes.size()];
      const Vector3& start = from.positions[nodes[k]];
      const Vector3 chord = from.positions[next] - start;
      for (std::size_t place = begin + 1; place < end; ++place) {
        const double v = (at[place] - at[begin]) / (at[end] - at[begin]);
        to.positions[fine_nodes[place]] = on_cubic(start, chord, from.tangents[nodes[k]], from.tangents[next], v);
      }
    }
  }
}

}  // namespace vspring
