#include "span/curve_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "solve/outcomes.hpp"
#include "vspring/constraints.hpp"
#include "vspring/resample.hpp"

namespace vspring {

namespace {

/// Whether an arc is a closed curve without a corner that meets no other.
bool is_ring(const Arcs& arcs, const Arc& arc) {
  return arc.nodes.front() == arc.nodes.back() && arcs.leaving_at(arc.nodes.front()).size() == 2 && arc.goes_on[0] >= 0;
}

/// The first node of the input along a half-arc, in words.
std::string name_of(const Network& network, const Arcs& arcs, Index half) {
  for (const Index node : arcs.nodes_along(half)) {
    const Index from = network.from[static_cast<std::size_t>(node)];
    if (from >= 0) return fmt::format("node {}", from);
  }
  return "a crossing";
}

/// Places along an arc; of a ring, without its first one again at the end.
std::vector<Vector3> divided(const Network& network, const Arc& arc, bool ring, Index edges) {
  std::vector<Vector3> places;
  for (const Index node : arc.nodes) places.push_back(network.place(node));
  if (ring) places.pop_back();
  Constraints ends(static_cast<Index>(places.size()));
  if (!ring) {
    if (!arc.tangents[0].isZero(0)) ends.fix_tangent(0, arc.tangents[0]);
    if (!arc.tangents[1].isZero(0)) ends.fix_tangent(ends.node_count() - 1, arc.tangents[1]);
  }
  const Resampled result = resample(PolygonCurve(std::move(places), ring), ends, {.nodes = edges + (ring ? 0 : 1)});
  std::vector<Vector3> along;
  for (const Index node : result.curve.chains().front().nodes) along.push_back(result.curve.position(node));
  return along;
}

}  // namespace

CurveNodes divide_curves(const Network& network, const Arcs& arcs, const std::vector<Index>& edges) {
  CurveNodes nodes;
  std::vector<Index> number(network.places.size(), -1);  // of nodes where arcs end
  const auto add = [&](const Vector3& place) {
    nodes.places.push_back(place);
    return static_cast<Index>(nodes.places.size() - 1);
  };
  const auto end_at = [&](Index node) {
    Index& there = number[static_cast<std::size_t>(node)];
    if (there < 0) there = add(network.place(node));
    return there;
  };
  for (std::size_t a = 0; a < arcs.all().size(); ++a) {
    auto& along = nodes.of_arc.emplace_back();
    if (edges[a] == 0) continue;
    const Arc& arc = arcs.all()[a];
    const bool ring = is_ring(arcs, arc);
    const std::vector<Vector3> places = divided(network, arc, ring, edges[a]);
    along.push_back(end_at(arc.nodes.front()));
    for (std::size_t k = 1; k + (ring ? 0 : 1) < places.size(); ++k) along.push_back(add(places[k]));
    along.push_back(end_at(arc.nodes.back()));
  }
  return nodes;
}

std::vector<Index> CurveNodes::along(Index half) const {
  std::vector<Index> nodes = of_arc[static_cast<std::size_t>(half / 2)];
  if (half % 2 != 0) std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

FairReport fair_curves(CurveNodes& nodes, const Network& network, const Arcs& arcs, const FairingMethod& method,
                       Context& context) {
  FairReport report;
  std::vector<std::uint8_t> is_done(arcs.all().size(), 0);
  const auto after = [&](Index half) {
    const Index next = arcs.of(half).goes_on[static_cast<std::size_t>(Arcs::reversed(half) % 2)];
    return next >= 0 && !nodes.of_arc[static_cast<std::size_t>(next / 2)].empty() ? next : -1;
  };
  for (std::size_t a = 0; a < arcs.all().size(); ++a) {
    if (is_done[a] != 0 || nodes.of_arc[a].empty()) continue;
    // Back to where the curve begins, or around it.
    Index first = static_cast<Index>(2 * a);
    for (Index back = after(first + 1); back >= 0 && back / 2 != static_cast<Index>(a); back = after(back))
      first = Arcs::reversed(back);
    std::vector<Index> chain;
    std::vector<std::size_t> held;
    Index here = first;
    for (; here >= 0 && is_done[static_cast<std::size_t>(here / 2)] == 0; here = after(here)) {
      is_done[static_cast<std::size_t>(here / 2)] = 1;
      const std::vector<Index> along = nodes.along(here);
      held.push_back(chain.empty() ? 0 : chain.size() - 1);
      chain.insert(chain.end(), along.begin() + (chain.empty() ? 0 : 1), along.end());
    }
    const bool closed = here >= 0;
    if (closed)
      chain.pop_back();
    else
      held.push_back(chain.size() - 1);
    std::vector<Vector3> places;
    places.reserve(chain.size());
    for (const Index node : chain) places.push_back(nodes.places[static_cast<std::size_t>(node)]);
    const PolygonCurve curve(std::move(places), closed);
    Constraints constraints(curve.node_count());
    for (const std::size_t k : held)
      constraints.fix_position(static_cast<Index>(k), curve.position(static_cast<Index>(k)));
    fix_boundary_tangents(constraints, curve);
    const FairResult faired = fair(curve, constraints, {.method = method}, context);
    for (std::size_t k = 0; k < chain.size(); ++k)
      nodes.places[static_cast<std::size_t>(chain[k])] = faired.positions[k];
    worsen(report.outcome, faired.report.outcome);
    // Its words name nodes of this curve alone.
    for (const Warning& warning : faired.report.warnings)
      report.warnings.emplace_back(warning.code,
                                   fmt::format("the curve at {} was faired by itself with the warning {}",
                                               name_of(network, arcs, first), name(warning.code)),
                                   warning.advice);
  }
  return report;
}

}  // namespace vspring
