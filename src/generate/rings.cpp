#include "generate/rings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.hpp"

namespace vspring::generate {

namespace {

constexpr double full_turn = 2 * std::numbers::pi;

struct Ring {
  Index first;
  Index count;
  double shift;  // of its first node, in steps

  [[nodiscard]] Index node(Index k) const { return count > 1 ? first + k % count : first; }
  /// Middle of the edge from node k to the next, in turns. Equal fractions give equal bits.
  [[nodiscard]] double middle(Index k) const { return (k + 0.5 + shift) / count; }
};

Ring ring_at(const RingLayout& layout, std::size_t k, Index first) {
  return {first, layout.counts[k], k % 2 == 0 ? 0.0 : 0.5};
}

void place_ring(MeshBuilder& builder, const ProfileCurve& curve, const RingLayout& layout, std::size_t k,
                const Ring& ring, double share, Random& random) {
  const bool inside = k > 0 && k + 1 < layout.counts.size();
  double room = 0;
  if (inside && share > 0)
    room = std::min({layout.at[k] - layout.at[k - 1], layout.at[k + 1] - layout.at[k],
                     full_turn * curve(layout.at[k]).radius / ring.count});
  for (Index j = 0; j < ring.count; ++j) {
    double angle = full_turn * ((j + ring.shift) / ring.count);
    double at = layout.at[k];
    if (room > 0) {
      const double distance = 0.5 * share * room * std::sqrt(random.uniform());
      const double direction = full_turn * random.uniform();
      angle += distance * std::cos(direction) / curve(at).radius;
      at += distance * std::sin(direction);
    }
    const ProfilePoint point = curve(at);
    builder.add_node({point.radius * std::cos(angle), point.radius * std::sin(angle), point.height});
  }
}

/// Joins two rings by triangles: walks around both, next to the edge whose middle comes first. Both rings begin within
/// half a step of angle 0, so their first nodes are joined.
void zip(MeshBuilder& builder, const Ring& inner, const Ring& outer) {
  Index i = 0;
  Index o = 0;
  const Index inner_edges = inner.count > 1 ? inner.count : 0;
  while (i < inner_edges || o < outer.count) {
    if (o < outer.count && (i == inner_edges || outer.middle(o) <= inner.middle(i))) {
      builder.add_face({inner.node(i), outer.node(o), outer.node(o + 1)});
      ++o;
    } else {
      builder.add_face({inner.node(i), outer.node(o), inner.node(i + 1)});
      ++i;
    }
  }
}

}  // namespace

double even_edge(double nodes, double area, double boundary_length) {
  // 2 nodes − boundary_length / edge triangles of area √3/4 edge² each.
  const double half = boundary_length / 4;
  return (half + std::sqrt(half * half + nodes * area * 2 / std::numbers::sqrt3)) / nodes;
}

Index even_rows(double length, double edge, Index most) {
  const double rows = std::round(length / (edge * std::numbers::sqrt3 / 2));
  return static_cast<Index>(std::clamp(rows, 1.0, std::max<double>(1, most)));
}

std::vector<Index> share_out(Index total, const std::vector<double>& weights, Index least) {
  // Shares below the least are raised to it, and the others divide the rest, until no share is below.
  std::vector<double> shares(weights.size(), 0.0);
  std::size_t raised = 0;
  for (;;) {
    double rest = total;
    double weight = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      if (shares[k] == least) {
        rest -= least;
      } else {
        weight += weights[k];
      }
    }
    std::size_t now_raised = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      if (shares[k] != least) shares[k] = std::max<double>(least, rest * (weights[k] / weight));
      now_raised += shares[k] == least ? 1 : 0;
    }
    if (now_raised == raised || now_raised == weights.size()) break;
    raised = now_raised;
  }
  std::vector<Index> parts;
  parts.reserve(weights.size());
  double sum = 0;
  Index given = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    sum += shares[k];
    const Index up_to = k + 1 == weights.size() ? total : static_cast<Index>(std::lround(sum));
    parts.push_back(up_to - given);
    given = up_to;
  }
  return parts;
}

PolygonMesh revolve(const ProfileCurve& curve, const RingLayout& layout, Jitter jitter) {
  Random random(jitter.seed);
  MeshBuilder builder;
  Index first = 0;
  std::vector<Ring> rings;
  for (std::size_t k = 0; k < layout.counts.size(); ++k) {
    rings.push_back(ring_at(layout, k, first));
    place_ring(builder, curve, layout, k, rings.back(), jitter.share, random);
    first += rings.back().count;
  }
  for (std::size_t k = 1; k < rings.size(); ++k) zip(builder, rings[k - 1], rings[k]);
  return builder.take();
}

}  // namespace vspring::generate
