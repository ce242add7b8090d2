#include "fit/chains_at_one_place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

namespace vspring {

ChainsAtOnePlace::ChainsAtOnePlace(const PolygonCurve& curve, const Constraints& constraints)
    : curve_(curve), held_(constraints) {
  if (constraints.node_count() != curve.node_count()) (void)check_constraints(curve, constraints);
  std::vector<PolygonCurve::Chain> others;
  std::vector<std::uint8_t> is_of_others(curve.positions().size(), 0);
  for (const auto& chain : curve.chains()) {
    if (is_at_one_place(chain)) {
      first_.push_back(chain.nodes.front());
      continue;
    }
    others.push_back(chain);
    for (const Index node : chain.nodes) is_of_others[static_cast<std::size_t>(node)] = 1;
  }
  for (const auto& chain : curve.chains()) {
    if (!is_at_one_place(chain)) continue;
    for (const Index node : chain.nodes) {
      if (std::exchange(is_of_others[static_cast<std::size_t>(node)], std::uint8_t{1}) == 0) nodes_.push_back(node);
    }
  }
  for (const Index node : nodes_) held_.fix_position(node, place(node));
  rest_ = PolygonCurve(curve.positions(), std::move(others));
}

bool ChainsAtOnePlace::is_at_one_place(const PolygonCurve::Chain& chain) const {
  return !chain.nodes.empty() && std::all_of(chain.nodes.begin() + 1, chain.nodes.end(),
                                             [&](Index node) { return place(node) == place(chain.nodes.front()); });
}

Resampling ChainsAtOnePlace::for_rest(const Resampling& how) const {
  Resampling rest = how;
  if (rest.nodes) *rest.nodes -= static_cast<Index>(nodes_.size());
  return rest;
}

FitResult ChainsAtOnePlace::unchanged() const {
  FitResult result;
  result.positions = curve_.positions();
  for (const Index node : nodes_) result.positions[static_cast<std::size_t>(node)] = place(node);
  result.distances.assign(result.positions.size(), 0);
  FairReport& fair = result.report.fair;
  fair.method = Method::equilibrium;
  fair.outcome = Outcome::converged;
  fair.nodes = curve_.node_count();
  for (Index i = 0; i < fair.nodes; ++i) ++(held_.position_fixed(i) ? fair.fixed_positions : fair.moving_nodes);
  return result;
}

ResampledFit ChainsAtOnePlace::unchanged_nodes() const {
  ResampledFit made{{PolygonCurve({}, std::vector<PolygonCurve::Chain>{}), Constraints(0), {}}, unchanged()};
  made.fit.positions.clear();
  made.fit.report.fair.nodes = made.fit.report.fair.fixed_positions = made.fit.report.fair.moving_nodes = 0;
  return made;
}

void ChainsAtOnePlace::add_to(FitResult& result, const ScatteredPoints& points) const {
  if (points.positions == curve_.positions()) measure_own(result);
  warn(result.report);
}

void ChainsAtOnePlace::add_to(ResampledFit& made) const {
  if (first_.empty()) return;
  Resampled& nodes = made.resampled;
  std::vector<Vector3> positions = nodes.curve.positions();
  const auto number_of = [&](Index node) {
    const auto known = std::find(nodes.from.begin(), nodes.from.end(), node);
    const auto number = static_cast<Index>(known - nodes.from.begin());
    if (known != nodes.from.end()) return number;
    nodes.from.push_back(node);
    positions.push_back(place(node));
    made.fit.positions.push_back(place(node));
    ++made.fit.report.fair.nodes;
    ++made.fit.report.fair.fixed_positions;
    return number;
  };
  const Index before = nodes.curve.node_count();
  std::vector<PolygonCurve::Chain> chains;
  auto other = nodes.curve.chains().begin();
  for (const auto& chain : curve_.chains()) {
    if (!is_at_one_place(chain)) {
      chains.push_back(*other++);
      continue;
    }
    chains.push_back(chain);
    for (Index& node : chains.back().nodes) node = number_of(node);
  }
  Constraints constraints(static_cast<Index>(positions.size()));
  for (Index i = 0; i < constraints.node_count(); ++i) {
    if (i < before)
      constraints.hold_as(i, nodes.constraints, i);
    else
      constraints.hold_as(i, held_, nodes.from[static_cast<std::size_t>(i)]);
  }
  nodes.constraints = std::move(constraints);
  nodes.curve = PolygonCurve(std::move(positions), std::move(chains));
  measure_own(made.fit);
  warn(made.fit.report);
}

/// Distances of their points: from the nodes, not from other chains.
void ChainsAtOnePlace::measure_own(FitResult& result) const {
  if (result.distances.empty()) return;
  for (const Index node : nodes_)
    result.distances[static_cast<std::size_t>(node)] = (place(node) - curve_.position(node)).norm();
}

void ChainsAtOnePlace::warn(FitReport& report) const {
  if (first_.empty()) return;
  const std::string others = first_.size() > 1 ? fmt::format(", and {} more", first_.size() - 1) : "";
  report.fair.warnings.push_back(
      {WarningCode::chain_at_one_place,
       fmt::format("all nodes of the chain at node {} lie at one place{}, so it has no direction: it stays, and its "
                   "points do not count",
                   first_.front(), others),
       {{Remedy::input, "leave it out"}}});
}

}  // namespace vspring
