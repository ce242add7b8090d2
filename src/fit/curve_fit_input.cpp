#include "fit/curve_fit_input.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/degrees.hpp"
#include "base/threads.hpp"
#include "constraints/holding.hpp"
#include "constraints/sides.hpp"
#include "curve_fit/outliers.hpp"
#include "fit/fit_points.hpp"
#include "points/nearest_nodes.hpp"
#include "shape/corners.hpp"
#include "shape/planarity.hpp"
#include "vspring/error.hpp"
#include "vspring/noise.hpp"

namespace vspring {

namespace {

// The noise as a share of a tolerance, where only that is known.
constexpr double noise_of_bound = 1.0 / 3;
// In standard deviations, of the distance of a row from the middle between two: three rows have noise.
constexpr double outlying_aside = 1.225 * outlying;
constexpr std::size_t most_named = 10;
// As a share of the size: points no further from a line lie on it.
constexpr double on_a_line = 1e-9;
// Turns back, along a chain, of the coordinates that stay: there and back round a nose, and nodes that are out of
// order.
constexpr std::size_t fewest_turns = 4;
constexpr std::size_t rows_for_a_turn = 10;
constexpr std::size_t rows_for_an_outlier = 20;

std::string names_of(const std::vector<Index>& points) {
  std::string names;
  for (std::size_t k = 0; k < std::min(points.size(), most_named); ++k)
    names += fmt::format("{}{}", k > 0 ? ", " : "", points[k]);
  return names + (points.size() > most_named ? " and others" : "");
}

}  // namespace

CurveFitInput::CurveFitInput(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                             const FitOptions& options, const Context& context)
    : curve_(curve),
      constraints_(constraints),
      points_(points),
      options_(options),
      own_nodes_(points.positions == curve.positions()),
      counted_(points.positions.size(), own_nodes_ ? 0 : 1) {
  if (own_nodes_) {
    for (const auto& chain : curve.chains()) {
      for (const Index node : chain.nodes) counted_[static_cast<std::size_t>(node)] = 1;
    }
  }
  kept_ = counted_;
  if (!options.moves_freely() && !own_nodes_)
    throw Error(ErrorCode::invalid_argument, "coordinates can be kept only where the points are the curve's own nodes",
                {{Remedy::moving_axes, "let all of them move"}});
  check(context);
  make_frame();
  check_stations();
}

bool CurveFitInput::pulls() const {
  if (options_.weight() && *options_.weight() == 0) return false;
  for (std::size_t j = 0; j < kept_.size(); ++j) {
    if (kept_[j] != 0 && weight(j) > 0) return true;
  }
  return false;
}

void CurveFitInput::check(const Context& context) {
  if (constraints_.node_count() != curve_.node_count()) (void)check_constraints(curve_, constraints_);
  std::vector<std::uint8_t> pulled(static_cast<std::size_t>(curve_.node_count()), 0);
  std::vector<Index> most(pulled.size(), 0);
  if (own_nodes_) {
    for (std::size_t j = 0; j < pulled.size(); ++j) {
      pulled[j] = kept_[j] != 0 && weight(j) > 0 ? 1 : 0;
      count_point(pulled[j] != 0 ? static_cast<Index>(j) : -1, most);
    }
  } else {
    std::vector<Vector3> places = curve_.positions();
    std::vector<std::uint8_t> usable(places.size(), 0);
    for (const auto& chain : curve_.chains()) {
      for (const Index node : chain.nodes) usable[static_cast<std::size_t>(node)] = 1;
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (constraints_.position_fixed(static_cast<Index>(i))) places[i] = constraints_.position(static_cast<Index>(i));
      if (!places[i].allFinite()) usable[i] = 0;
    }
    ThreadTeam team(context.thread_count());
    const std::vector<Index> nearest = nearest_nodes(points_.positions, places, usable, team);
    for (std::size_t j = 0; j < nearest.size(); ++j) {
      if (nearest[j] < 0 || !(weight(j) > 0)) continue;
      pulled[static_cast<std::size_t>(nearest[j])] = 1;
      count_point(nearest[j], most);
    }
  }
  warnings_ = check_constraints(curve_, constraints_, pulled);
}

/// For the report on points: finds the moving node nearest to each.
void CurveFitInput::count_point(Index node, std::vector<Index>& points_of) {
  if (node < 0 || constraints_.position_fixed(node)) return;
  const Index count = ++points_of[static_cast<std::size_t>(node)];
  ++pulling_points_;
  pulled_nodes_ += count == 1 ? 1 : 0;
  most_points_ = std::max(most_points_, count);
}

std::vector<Index> CurveFitInput::spikes(std::size_t most) const {
  std::vector<Index> found;
  // In rows denser than their noise every row lies aside of its neighbours.
  const double least = outlying_aside * frame_.scale() * estimate_noise(curve_, options_.moving_axes).deviation;
  for (const auto& chain : curve_.chains()) {
    std::vector<Vector3> rows;
    for (const Index node : chain.nodes) rows.push_back(frame_.to_local(place(node)));
    const std::vector<std::uint8_t> spikes =
        find_spikes(rows, chain.closed, most - std::min(most, found.size()), least);
    for (std::size_t k = 0; k < spikes.size(); ++k) {
      if (spikes[k] != 0 && !is_said(chain.nodes[k])) found.push_back(chain.nodes[k]);
    }
  }
  return found;
}

std::vector<Index> CurveFitInput::deviating() const {
  std::vector<std::pair<Index, double>> deviations = robust_deviations(task());
  std::stable_sort(deviations.begin(), deviations.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<Index> found;
  for (const auto& [point, deviation] : deviations) {
    if (!(deviation > outlying)) break;
    if (!own_nodes_ || !is_said(point)) found.push_back(point);
  }
  return found;
}

void CurveFitInput::leave_outliers_out() {
  const auto count = static_cast<std::size_t>(std::count(counted_.begin(), counted_.end(), 1));
  auto most = static_cast<std::size_t>(options_.outliers * static_cast<double>(count));
  if (own_nodes_) {
    const std::vector<Index> off = spikes(most);
    for (const Index node : off) kept_[static_cast<std::size_t>(node)] = 0;
    most -= off.size();
    make_frame();
  }
  std::vector<Index> beyond = deviating();
  const auto left_out = static_cast<std::ptrdiff_t>(std::min(most, beyond.size()));
  std::for_each(beyond.begin(), beyond.begin() + left_out,
                [&](Index point) { kept_[static_cast<std::size_t>(point)] = 0; });
  beyond.erase(beyond.begin(), beyond.begin() + left_out);
  if (beyond.empty()) return;
  warnings_.push_back(
      {WarningCode::outliers_left,
       fmt::format("more points than {:g} of all seem to be off: {} too", options_.outliers, names_of(beyond)),
       {{Remedy::outliers, "leave out a larger share"}, {Remedy::input, "correct them"}}});
}

void CurveFitInput::name_outliers() {
  const auto count = static_cast<std::size_t>(std::count(counted_.begin(), counted_.end(), 1));
  const auto most = std::max<std::size_t>(1, count / rows_for_an_outlier);
  // A robust curve cuts tips off.
  const std::vector<Index> off = own_nodes_ ? spikes(most) : deviating();
  if (off.empty() || off.size() > most) return;
  warnings_.push_back(
      {WarningCode::outliers_left,
       off.size() > 1 ? fmt::format("points {} seem to be off", names_of(off))
                      : fmt::format("point {} seems to be off", off.front()),
       {{Remedy::input, "correct what is wrong"},
        {Remedy::outliers,
         fmt::format("leave out a share of {:g}",
                     std::ceil(1000 * static_cast<double>(off.size()) / static_cast<double>(count)) / 1000)}}});
}

void CurveFitInput::make_frame() {
  Eigen::AlignedBox<double, 3> box;
  std::vector<Vector3> all;
  for (const auto& chain : curve_.chains()) {
    for (const Index node : chain.nodes) {
      if (place(node).allFinite()) all.push_back(place(node));
    }
  }
  for (std::size_t j = 0; j < kept_.size(); ++j) {
    if (kept_[j] != 0 && weight(j) > 0) all.push_back(points_.positions[j]);
  }
  for (const Vector3& one : all) box.extend(one);
  frame_ = Frame(box);
  centre_ = Vector3::Zero();
  centre_ = -frame_.to_local(Vector3::Zero()) / frame_.scale();
  std::vector<Vector3> local;
  local.reserve(all.size());
  for (const Vector3& one : all) local.push_back(frame_.to_local(one));
  for (Index i = 0; i < curve_.node_count(); ++i) {
    for (const NodeSide side : node_sides) {
      if (constraints_.tangent_fixed(i, side)) local.push_back(local.front() + constraints_.tangent(i, side));
    }
  }
  plane_ = plane_normal(local);
  if (!plane_) {
    // On a line every plane will do.
    Vector3 along = Vector3::Zero();
    for (const Vector3& one : local) {
      if ((one - local.front()).norm() > along.norm()) along = one - local.front();
    }
    double aside = 0;
    for (const Vector3& one : local)
      aside = std::max(aside, (one - local.front()).cross(along).norm() / std::max(along.norm(), 1e-300));
    if (aside < on_a_line) plane_ = Vector3(along.unitOrthogonal());
  }
  if (!options_.moves_freely()) find_moving(local);
}

void CurveFitInput::find_moving(std::span<const Vector3> places) {
  Vector3 axes = Vector3::Zero();
  for (int axis = 0; axis < 3; ++axis) axes[axis] = options_.moving_axes[static_cast<std::size_t>(axis)] ? 1 : 0;
  Vector3 kept = Vector3::Zero();
  for (const Vector3& one : places) {
    const Vector3 away = (Vector3::Ones() - axes).cwiseProduct(one - places.front());
    if (away.norm() > kept.norm()) kept = away;
  }
  moving_ = kept.norm() > 0 ? axes : Vector3::Ones();
  if (!(kept.norm() > 0)) return;
  if (axes.sum() > 1)
    plane_.reset();
  else
    plane_ = kept.cross(axes).normalized();
}

Vector3 CurveFitInput::moved(Index node, const Vector3& place) const {
  const Vector3 position = to_input(place);
  Vector3 result = curve_.position(node);
  for (int axis = 0; axis < 3; ++axis) {
    if (options_.moving_axes[static_cast<std::size_t>(axis)]) result[axis] = position[axis];
  }
  return result;
}

void CurveFitInput::check_stations() const {
  if (moving_ == Vector3::Ones()) return;
  for (const auto& chain : curve_.chains()) {
    Vector3 last = Vector3::Zero();
    std::size_t turns = 0;
    Index first = -1;
    for (std::size_t k = 1; k < chain.nodes.size(); ++k) {
      const Vector3 step = (Vector3::Ones() - moving_).cwiseProduct(place(chain.nodes[k]) - place(chain.nodes[k - 1]));
      if (step.dot(last) < 0 && turns++ == 0) first = chain.nodes[k - 1];
      if (!step.isZero(0)) last = step;
    }
    if (turns <= std::max(fewest_turns, chain.nodes.size() / rows_for_a_turn)) continue;
    throw Error(ErrorCode::unusable_shape,
                fmt::format("node {}: the coordinates that are to stay turn back there and {} times more along the "
                            "curve, so they do not show its way",
                            first, turns - 1),
                {{Remedy::order, "put the nodes in order"}, {Remedy::moving_axes, "let all coordinates move"}});
  }
}

CurveFitTask CurveFitInput::task() const {
  CurveFitTask task;
  const double scale = frame_.scale();
  task.plane = plane_;
  task.moving = moving_;
  task.in_order = own_nodes_;
  task.within = options_.within().value_or(0) * scale;
  task.rms = options_.rms().value_or(0) * scale;
  task.noise = task.within > 0 ? noise_of_bound * task.within : task.rms;
  if (options_.noise()) task.noise = *options_.noise() * scale;
  if (task.noise == 0) task.noise = estimate_noise(curve_, options_.moving_axes).deviation * scale;
  task.least_radius = options_.least_radius * scale;
  task.sharp = options_.sharp / degrees_per_radian;
  const std::vector<std::uint8_t> is_corner = marked_corners(options_.fair.corners, curve_.node_count());
  const auto& method = std::get<EquilibriumMethod>(options_.fair.method);
  task.tolerance = method.tolerance;
  double edges = 0;
  for (const auto& chain : curve_.chains()) {
    auto& made = task.chains.emplace_back();
    made.closed = chain.closed;
    for (const Index node : chain.nodes) {
      const auto i = static_cast<std::size_t>(node);
      const bool held = constraints_.position_fixed(node);
      if (own_nodes_ && kept_[i] == 0 && !held) continue;
      ChainNode& one = made.nodes.emplace_back();
      one.place = frame_.to_local(place(node));
      one.held = held;
      one.from = node;
      one.corner = is_corner[i] != 0 || constraints_.corner(node);
      one.tangents = given_tangents(constraints_, node);
      if (constraints_.normal_fixed(node) && plane_ && one.tangents[1].isZero(0))
        one.tangents.fill(tangent_across(chain, node));
      if (own_nodes_ && weight(i) > 0 && kept_[i] != 0) {
        one.point = node;
        one.weight = weight(i);
        // Its place in the input, also if it is held elsewhere.
        if (held && constraints_.position(node) != curve_.position(node)) one.point = -1;
      }
    }
    edges += static_cast<double>(chain.nodes.size()) - (chain.closed ? 0 : 1);
  }
  if (!own_nodes_) {
    for (std::size_t j = 0; j < points_.positions.size(); ++j) {
      if (kept_[j] == 0 || !(weight(j) > 0)) continue;
      CurvePoint& point = task.scattered.emplace_back();
      point.place = frame_.to_local(points_.positions[j]);
      point.weight = weight(j);
      point.number = static_cast<Index>(j);
    }
  }
  if (options_.smoothing_length()) task.smoothing = *options_.smoothing_length() * scale;
  if (options_.weight()) {
    // k = (ℓ/λ)⁴/8 of even edges ℓ.
    task.edges = edges;
    task.weight = *options_.weight();
  }
  return task;
}

/// At right angles to a normal, in the plane, in the sense of the chain.
Vector3 CurveFitInput::tangent_across(const PolygonCurve::Chain& chain, Index node) const {
  Vector3 tangent = plane_->cross(constraints_.normal(node)).normalized();
  const auto at = std::find(chain.nodes.begin(), chain.nodes.end(), node) - chain.nodes.begin();
  const auto count = static_cast<std::ptrdiff_t>(chain.nodes.size());
  const auto wrap = [&](std::ptrdiff_t k) {
    return static_cast<std::size_t>(chain.closed ? (k + count) % count : std::clamp<std::ptrdiff_t>(k, 0, count - 1));
  };
  const Vector3 way = place(chain.nodes[wrap(at + 1)]) - place(chain.nodes[wrap(at - 1)]);
  return tangent.dot(way) < 0 ? Vector3(-tangent) : tangent;
}

}  // namespace vspring
