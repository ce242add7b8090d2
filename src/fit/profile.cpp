#include "fit/profile.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <utility>

#include "vspring/error.hpp"

namespace vspring {

namespace {

// As a share of the length: points no further from a line lie on it.
constexpr double aside_of_line = 1e-9;

int moving_axis(const FitOptions& options) {
  return static_cast<int>(std::find(options.moving_axes.begin(), options.moving_axes.end(), true) -
                          options.moving_axes.begin());
}

Vector3 without(Vector3 v, int axis) {
  v[axis] = 0;
  return v;
}

}  // namespace

bool Profile::is_needed(const PolygonCurve& curve, const Constraints& constraints, const FitOptions& options) {
  if (std::count(options.moving_axes.begin(), options.moving_axes.end(), true) != 1) return false;
  const int axis = moving_axis(options);
  std::vector<Vector3> ways;
  Vector3 along = Vector3::Zero();
  for (const auto& chain : curve.chains()) {
    for (const Index node : chain.nodes) {
      const bool held = constraints.position_fixed(node);
      const Vector3 way = without(held ? constraints.position(node) : curve.position(node), axis);
      ways.push_back(ways.empty() ? way : way - ways.front());
      if (ways.size() == 1) continue;
      if (ways.back().norm() > along.norm()) along = ways.back();
    }
  }
  const double length = along.norm();
  if (!(length > 0)) return false;
  for (Index i = 0; i < curve.node_count(); ++i) {
    for (const NodeSide side : node_sides) {
      if (constraints.tangent_fixed(i, side)) ways.emplace_back(length * without(constraints.tangent(i, side), axis));
    }
  }
  return std::any_of(ways.begin() + 1, ways.end(),
                     [&](const Vector3& way) { return way.cross(along / length).norm() > aside_of_line * length; });
}

Profile::Profile(const PolygonCurve& curve, const Constraints& constraints, const FitOptions& options)
    : input_(curve),
      constraints_(constraints),
      options_(options),
      axis_(moving_axis(options)),
      held_(curve.node_count()) {
  options_.moving_axes = {false, true, false};
  std::vector<Vector3> places = curve.positions();
  std::vector<std::uint8_t> seen(places.size(), 0);
  const auto place = [&](Index node) -> const Vector3& {
    return constraints.position_fixed(node) ? constraints.position(node) : curve.position(node);
  };
  for (const auto& chain : curve.chains()) {
    if (chain.closed)
      throw Error(ErrorCode::unusable_shape,
                  fmt::format("node {}: its chain is closed, so there is no length of its way", chain.nodes.front()),
                  {{Remedy::input, "leave it open"}, {Remedy::moving_axes, "let all coordinates move"}});
    double way = 0;
    for (std::size_t k = 0; k < chain.nodes.size(); ++k) {
      const Index node = chain.nodes[k];
      const auto i = static_cast<std::size_t>(node);
      if (std::exchange(seen[i], std::uint8_t{1}) != 0)
        throw Error(ErrorCode::unusable_shape,
                    fmt::format("node {}: the curve comes here twice, so there is no one length of its way", node),
                    {{Remedy::input, "split the node"}, {Remedy::moving_axes, "let all coordinates move"}});
      if (k > 0) way += without(place(node) - place(chain.nodes[k - 1]), axis_).norm();
      places[i] = {way, curve.position(node)[axis_], 0};
      const Vector3 along =
          place(chain.nodes[std::min(k + 1, chain.nodes.size() - 1)]) - place(chain.nodes[k > 0 ? k - 1 : 0]);
      if (constraints.position_fixed(node)) held_.fix_position(node, {way, constraints.position(node)[axis_], 0});
      hold(node, without(along, axis_).stableNormalized());
    }
  }
  profile_ = PolygonCurve(std::move(places), curve.chains());
}

/// What is given of directions. way: of the curve there.
void Profile::hold(Index node, const Vector3& way) {
  const auto in_profile = [&](const Vector3& tangent) {
    return Vector3(without(tangent, axis_).norm(), tangent[axis_], 0);
  };
  if (constraints_.tangent_fixed(node)) held_.fix_tangent(node, in_profile(constraints_.tangent(node)));
  if (constraints_.corner(node)) held_.make_corner(node);
  for (const NodeSide side : node_sides) {
    if (constraints_.corner(node) && constraints_.tangent_fixed(node, side))
      held_.fix_tangent(node, in_profile(constraints_.tangent(node, side)), side);
  }
  if (!constraints_.normal_fixed(node)) return;
  const Vector3& normal = constraints_.normal(node);
  const Vector3 across(normal.dot(way), normal[axis_], 0);
  if (across.norm() > aside_of_line) held_.fix_normal(node, across.normalized());
}

std::vector<Vector3> Profile::lifted(const std::vector<Vector3>& places) const {
  std::vector<Vector3> positions = input_.positions();
  for (const auto& chain : input_.chains()) {
    for (const Index node : chain.nodes) {
      const auto i = static_cast<std::size_t>(node);
      if (constraints_.position_fixed(node))
        positions[i] = constraints_.position(node);
      else
        positions[i][axis_] = places[i].y();
    }
  }
  return positions;
}

void Profile::lift(ResampledFit& made) const {
  std::vector<Vector3> positions = made.fit.positions;
  for (std::size_t c = 0; c < made.resampled.curve.chains().size(); ++c) {
    const auto& old = input_.chains()[c].nodes;
    std::size_t k = 0;
    for (const Index node : made.resampled.curve.chains()[c].nodes) {
      const auto i = static_cast<std::size_t>(node);
      const Vector3 place = made.fit.positions[i];
      const auto way = [&](std::size_t n) { return profile_.position(old[n]).x(); };
      while (k + 2 < old.size() && way(k + 1) < place.x()) ++k;
      const double length = way(k + 1) - way(k);
      const double share = length > 0 ? std::clamp((place.x() - way(k)) / length, 0.0, 1.0) : 0;
      positions[i] = input_.position(old[k]) + share * (input_.position(old[k + 1]) - input_.position(old[k]));
      positions[i][axis_] = place.y();
      if (made.resampled.constraints.position_fixed(node) && made.resampled.from[i] >= 0)
        positions[i] = constraints_.position(made.resampled.from[i]);
    }
  }
  made.fit.positions = positions;
  made.resampled.curve.set_positions(std::move(positions));
  Constraints held(made.resampled.curve.node_count());
  for (Index i = 0; i < held.node_count(); ++i) {
    const Index from = made.resampled.from[static_cast<std::size_t>(i)];
    if (from >= 0) held.hold_as(i, constraints_, from);
  }
  made.resampled.constraints = std::move(held);
}

}  // namespace vspring
