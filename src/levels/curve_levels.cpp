#include <algorithm>
#include <cmath>

#include "base/threads.hpp"
#include "levels/levels.hpp"
#include "shape/arcs.hpp"
#include "spring/curve_net.hpp"
#include "spring/spacing.hpp"

namespace vspring {

namespace {

// With fewer edges between two anchors no node is left out: enough for a full turn or two.
constexpr std::size_t enough_edges = 48;
// The least length aimed at for an edge, as a share of the mean edge of its run; the second one with
// Distribution::keep.
constexpr double least_share = 0.01;
constexpr double least_share_kept = 1e-6;
// Turns of up to about 60° belong to the shape; sharper ones are noise, and too far from linear for a start.
constexpr double sharp_cosine = 0.5;
constexpr int most_rounds = 100;

/// A node that coarser levels keep and averages do not move.
bool is_anchor(const Net& net, std::size_t node) { return node >= net.moving || net.given[node] != 0; }

/// A quarter of each neighbour and half of itself for every node that is no anchor.
std::vector<Vector3> averaged(const Net& net) {
  std::vector<Vector3> positions = net.positions;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    if (is_anchor(net, i) || links.size() < 2) continue;
    positions[i] = 0.5 * net.positions[i] + 0.25 * (net.positions[links[0].node()] + net.positions[links[1].node()]);
  }
  return positions;
}

/// Sets the places of nodes along their runs.
void set_places_along(Net& net, Distribution distribution) {
  ThreadTeam alone(1);
  const std::vector<Vector3> nodes_at =
      distribution == Distribution::smooth ? rest_positions(net, alone) : net.positions;
  for (MovingRun& moving_run : net.moving_runs) {
    const std::size_t count = moving_run.nodes.size();
    const std::size_t edges = moving_run.closed ? count : count - 1;
    std::vector<double> lengths(edges, 1);
    if (distribution != Distribution::even) {
      double mean = 0;
      for (std::size_t k = 0; k < edges; ++k) {
        const Vector3 d = nodes_at[moving_run.nodes[(k + 1) % count]] - nodes_at[moving_run.nodes[k]];
        lengths[k] = std::sqrt(d.dot(d) + net.tiny);
        mean += lengths[k] / static_cast<double>(edges);
      }
      const double least = distribution == Distribution::keep ? least_share_kept : least_share;
      for (double& length : lengths) length = std::max(length, least * mean);
    }
    std::vector<double>& at = moving_run.along;
    at.assign(1, 0);
    at.reserve(edges + 1);
    for (const double length : lengths) at.push_back(at.back() + length);
  }
}

/// Sets shares that make the lengths of edges follow the places along the runs.
void set_laplacian_weights(Net& net) {
  net.laplacian_weights.assign(net.rings.link_count(), 0);
  for (const MovingRun& moving_run : net.moving_runs) {
    const auto& nodes = moving_run.nodes;
    const auto& at = moving_run.along;
    for (std::size_t k = 1; k < nodes.size() && k + 1 < at.size(); ++k) {
      if (nodes[k] >= net.moving) continue;
      const std::size_t first = net.rings.begin(nodes[k]);
      net.laplacian_weights[first] = (at[k + 1] - at[k]) / (at[k + 1] - at[k - 1]);
      net.laplacian_weights[first + 1] = 1 - net.laplacian_weights[first];
    }
  }
}

/// The places of a run that the next coarser level keeps.
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
Level coarser(const Net& from, const std::vector<std::vector<std::uint32_t>>& kept) {
  constexpr auto left_out = static_cast<std::uint32_t>(-1);
  Level level;
  Net& net = level.net;
  // Local numbers keep their order, so moving nodes still come first, then held ones with rings.
  std::vector<std::uint32_t> number(from.positions.size(), left_out);
  for (std::size_t s = 0; s < kept.size(); ++s) {
    for (const std::uint32_t k : kept[s]) number[from.moving_runs[s].nodes[k]] = 0;
  }
  const std::vector<Vector3> positions = averaged(from);
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == left_out) continue;
    number[i] = static_cast<std::uint32_t>(net.node.size());
    level.finer.push_back(static_cast<std::uint32_t>(i));
    net.node.push_back(from.node[i]);
    net.positions.push_back(positions[i]);
    net.normals.push_back(from.normals[i]);
    net.tangents.push_back(from.tangents[i]);
    net.given.push_back(from.given[i]);
    if (i < from.moving) net.moving = net.node.size();
    if (i < from.computed) net.computed = net.node.size();
  }
  net.is_curve = true;
  net.frame = from.frame;
  net.tiny = from.tiny;
  for (std::size_t s = 0; s < kept.size(); ++s) {
    const MovingRun& moving_run = from.moving_runs[s];
    MovingRun& coarse = net.moving_runs.emplace_back();
    coarse.closed = moving_run.closed;
    for (const std::uint32_t k : kept[s]) {
      coarse.nodes.push_back(number[moving_run.nodes[k]]);
      coarse.along.push_back(moving_run.along[k]);
    }
    if (moving_run.closed) coarse.along.push_back(moving_run.along.back());
  }
  add_rings(net);
  set_laplacian_weights(net);
  return level;
}

}  // namespace

std::vector<Level> curve_levels(Net net, Distribution distribution) {
  set_places_along(net, distribution);
  if (distribution != Distribution::even) set_laplacian_weights(net);
  std::vector<Level> levels(1);
  levels[0].net = std::move(net);
  for (;;) {
    const Net& fine = levels.back().net;
    std::vector<std::vector<std::uint32_t>> kept;
    bool smaller = false;
    for (const MovingRun& moving_run : fine.moving_runs) {
      kept.push_back(kept_places(moving_run, fine));
      smaller = smaller || kept.back().size() < moving_run.nodes.size();
    }
    if (!smaller) break;
    levels.push_back(coarser(fine, kept));
  }
  std::reverse(levels.begin(), levels.end());
  return levels;
}

void untangle(Net& net) {
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
    net.positions = averaged(net);
  }
}

void start_from_chords(Net& net) {
  for (const MovingRun& moving_run : net.moving_runs) {
    const auto& at = moving_run.along;
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

void prolong_curve(const Level& coarse, Level& fine) {
  const Net& from = coarse.net;
  Net& to = fine.net;
  for (std::size_t i = 0; i < from.moving; ++i) to.positions[coarse.finer[i]] = from.positions[i];
  for (std::size_t s = 0; s < from.moving_runs.size(); ++s) {
    const auto& nodes = from.moving_runs[s].nodes;
    const auto& fine_nodes = to.moving_runs[s].nodes;
    const auto& at = to.moving_runs[s].along;
    std::size_t end = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const std::size_t begin = end;
      const std::size_t next = nodes[(k + 1) % nodes.size()];
      do {
        ++end;
      } while (end < fine_nodes.size() && fine_nodes[end] != coarse.finer[next]);
      if (end - begin < 2) continue;
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
