#include "fit/found_nodes.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "curve_fit/curve_lengths.hpp"
#include "fit/curve_nodes.hpp"

namespace vspring {

namespace {

// As a share of a chain's length: a row that was left out lies no further from the one before.
constexpr double reach_to_next_row = 0.25;
// As a share of the size.
constexpr double same_place = 1e-7;

PolygonCurve polygon(const CurveFitInput& input, const CurveFound& found) {
  const Constraints& constraints = input.constraints();
  std::vector<Vector3> places;
  std::vector<PolygonCurve::Chain> chains;
  for (std::uint32_t i = 0; i < found.curve.size(); ++i) {
    const auto& node = found.curve.node(i);
    const bool held = node.from >= 0 && constraints.position_fixed(node.from);
    places.push_back(held ? constraints.position(node.from) : input.to_input(node.place));
  }
  for (const auto& chain : found.curve.chains()) {
    auto& made = chains.emplace_back();
    made.closed = chain.closed;
    for (std::uint32_t k = 0; k < chain.count; ++k) made.nodes.push_back(static_cast<Index>(chain.begin + k));
  }
  return {std::move(places), std::move(chains)};
}

std::vector<Vector3> positions_on_curve(const CurveFitInput& input, const CurveFound& found, Distribution spacing) {
  const PolygonCurve& curve = input.curve();
  const Constraints& constraints = input.constraints();
  std::vector<Vector3> places(curve.positions().size());
  std::vector<std::uint8_t> in_chain(places.size(), 0);
  for (const auto& chain : curve.chains()) {
    for (const Index i : chain.nodes) {
      places[static_cast<std::size_t>(i)] = input.to_local(input.place(i));
      in_chain[static_cast<std::size_t>(i)] = 1;
    }
  }
  place_nodes(curve, found, {.own_points = input.own_nodes(), .even = spacing == Distribution::even}, places);
  std::vector<Vector3> positions = curve.positions();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto node = static_cast<Index>(i);
    if (constraints.position_fixed(node))
      positions[i] = constraints.position(node);
    else if (in_chain[i] != 0)
      positions[i] = input.moved(node, places[i]);
  }
  return positions;
}

/// Finds where the curve has the file's values of the coordinates that stay.
std::vector<Vector3> positions_at_stations(const CurveFitInput& input, const CurveFound& found) {
  const PolygonCurve& curve = input.curve();
  const Constraints& constraints = input.constraints();
  std::vector<Vector3> positions = curve.positions();
  std::vector<std::optional<CurvePlace>> places(positions.size());
  for (const CurvePoint& point : found.points) places[static_cast<std::size_t>(point.number)] = point.at;
  const CurveLengths lengths(found.curve);
  for (std::size_t c = 0; c < curve.chains().size(); ++c) {
    const auto& nodes = curve.chains()[c].nodes;
    const DenseCurve::Chain& chain = found.curve.chains()[c];
    // Rows that do not pull are searched for near the row before, or near the first one that pulls.
    CurvePlace about{chain.begin, 0};
    std::optional<Vector3> before;
    for (const Index node : nodes) {
      const auto i = static_cast<std::size_t>(node);
      if (constraints.position_fixed(node)) {
        before = positions[i] = constraints.position(node);
        continue;
      }
      if (!found.curve.is_edge(chain.begin)) continue;
      if (!places[i])
        places[i] = found.curve.nearest(input.to_local(input.place(node)), about, reach_to_next_row * lengths.whole(c));
      about = *places[i];
      positions[i] = input.moved(node, found.curve.at(about));
      // Rows at one station are one place, to the last digit.
      const Vector3 apart = before ? Vector3(positions[i] - *before) : Vector3::Ones();
      const bool same_station = found.curve.station(apart).isZero(0);
      if (same_station && apart.norm() * input.scale() < same_place) positions[i] = *before;
      before = positions[i];
    }
  }
  return positions;
}

}  // namespace

Resampled own_nodes(const CurveFitInput& input, const CurveFound& found, Distribution spacing) {
  Resampled own{input.curve(), input.constraints(), {}};
  const bool free = input.moving() == Vector3::Ones();
  own.curve.set_positions(free ? positions_on_curve(input, found, spacing) : positions_at_stations(input, found));
  return own;
}

Resampled new_nodes(const CurveFitInput& input, const CurveFound& found, const Resampling& how) {
  const Constraints& constraints = input.constraints();
  const DenseCurve& on = found.curve;
  const PolygonCurve dense = polygon(input, found);
  Constraints held(dense.node_count());
  for (std::uint32_t i = 0; i < on.size(); ++i) {
    const Index from = on.node(i).from;
    if (from >= 0) held.hold_as(static_cast<Index>(i), constraints, from);
  }
  for (const Index node : tight_bends(on, how, 1 / input.scale())) held.fix_position(node, dense.position(node));
  Resampling between = how;
  between.corners.clear();
  for (std::uint32_t i = 0; i < on.size(); ++i) {
    if (on.node(i).corner) between.corners.push_back(static_cast<Index>(i));
  }
  Resampled made = resample(dense, held, between);
  for (std::size_t k = 0; k < made.from.size(); ++k) {
    Index& from = made.from[k];
    if (from >= 0) from = on.node(static_cast<std::uint32_t>(from)).from;
    if (from < 0 || !constraints.position_fixed(from)) made.constraints.free_position(static_cast<Index>(k));
  }
  return made;
}

}  // namespace vspring
