#include "fit/curve_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "constraints/sides.hpp"
#include "curve_fit/curve_start.hpp"
#include "curve_fit/polyline_bounds.hpp"
#include "fit/fit_points.hpp"
#include "fit/fit_subject.hpp"
#include "shape/corners.hpp"

namespace vspring {

namespace {

// Distance of sampled places on long edges, as a share of the tolerance.
constexpr double places_apart = 0.1;
constexpr int parts_of_edge = 16;
// Between samples the curve may be further away by this factor.
constexpr double between_samples = 1.002;
constexpr double most_places_on_edge = 32;
// The radius that chords show of an arc, as a share of the least radius.
constexpr double share_of_radius = 0.99;

std::vector<Vector3> held_places(const Resampled& nodes) {
  std::vector<Vector3> places;
  for (const auto& chain : nodes.curve.chains()) {
    for (const Index i : chain.nodes) {
      if (nodes.constraints.position_fixed(i)) places.push_back(nodes.curve.position(i));
    }
  }
  return places;
}

bool is_as_near(const std::vector<Vector3>& places, const Vector3& point, double distance, double as_far) {
  return std::any_of(places.begin(), places.end(),
                     [&](const Vector3& place) { return (place - point).norm() <= as_far * distance; });
}

/// Between two edges. A nose of few nodes may turn by more than a right angle at one of them, a spike by nearly two.
bool is_spike(const Vector3& before, const Vector3& after) {
  constexpr double cosine = -0.5;
  return before.dot(after) < cosine * before.norm() * after.norm();
}

}  // namespace

CurveMeasures::CurveMeasures(const CurveFitInput& input, const CurveFound& found, int threads)
    : input_(input), found_(found) {
  context_.threads = threads;
  before_ = distances(input.curve());
  ThreadTeam team(1);
  const FitCurve subject(input.curve(), input.constraints(), input.points().positions, context_, team);
  counting_.emplace(subject.distances_from_held(), before_);
}

std::vector<double> CurveMeasures::distances(const PolygonCurve& from) const {
  const std::vector<Vector3>& points = input_.points().positions;
  if (!keep_stations(from)) return point_distances(points, from, context_);
  std::vector<double> distances;
  distances.reserve(points.size());
  for (std::size_t j = 0; j < points.size(); ++j) distances.push_back((from.positions()[j] - points[j]).norm());
  return distances;
}

bool CurveMeasures::keep_stations(const PolygonCurve& moved) const {
  const std::vector<Vector3>& points = input_.points().positions;
  if (input_.moving() == Vector3::Ones() || moved.positions().size() != points.size()) return false;
  for (std::size_t j = 0; j < points.size(); ++j) {
    const bool held = input_.constraints().position_fixed(static_cast<Index>(j));
    for (int axis = 0; axis < 3 && !held; ++axis) {
      if (input_.moving()[axis] == 0 && moved.positions()[j][axis] != points[j][axis]) return false;
    }
  }
  return true;
}

DenseCurve CurveMeasures::chords(const PolygonCurve& shape, const Resampled& nodes) const {
  DenseCurve chords(true, input_.moving());
  const Constraints& constraints = nodes.constraints;
  const std::vector<std::uint8_t> corners = this->corners(nodes);
  for (const auto& chain : shape.chains()) {
    std::vector<DenseCurve::Node> along;
    along.reserve(chain.nodes.size());
    for (const Index i : chain.nodes) {
      DenseCurve::Node& node = along.emplace_back();
      node.place = input_.to_local(shape.position(i));
      node.held = constraints.position_fixed(i);
      node.tangents = given_tangents(constraints, i);
      node.corner = corners[static_cast<std::size_t>(i)] != 0;
      node.from = i;
    }
    chords.add_chain(along, chain.closed);
  }
  return chords;
}

std::vector<std::uint8_t> CurveMeasures::corners(const Resampled& nodes) const {
  std::vector<std::uint8_t> of_file(static_cast<std::size_t>(input_.curve().node_count()), 0);
  for (std::uint32_t i = 0; i < found_.curve.size(); ++i) {
    const auto& node = found_.curve.node(i);
    if (node.corner && node.from >= 0) of_file[static_cast<std::size_t>(node.from)] = 1;
  }
  if (nodes.from.empty()) return of_file;
  std::vector<std::uint8_t> corners(nodes.from.size(), 0);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (nodes.from[k] >= 0) corners[k] = of_file[static_cast<std::size_t>(nodes.from[k])];
  }
  return corners;
}

SharpestNode CurveMeasures::sharpest(const PolygonCurve& shape, const Resampled& nodes) const {
  SharpestNode most;
  if (!(input_.options().least_radius > 0)) return most;
  const DenseCurve chords = this->chords(shape, nodes);
  for (std::uint32_t i = 0; i < chords.size(); ++i) {
    const double radius = 1 / (chords.greatest_curvature(i) * input_.scale());
    if (radius < most.radius) most = {chords.node(i).from, radius};
  }
  return most;
}

double CurveMeasures::radius_kept(const SharpestNode& most) const {
  const double least = share_of_radius * input_.options().least_radius;
  return most.radius < least ? most.radius / least : 1;
}

std::vector<double> CurveMeasures::movable_distances(const Resampled& nodes, double as_far) const {
  std::vector<double> distances = this->distances(nodes.curve);
  const auto within = input_.options().within();
  const std::vector<Vector3> held = held_places(nodes);
  for (std::size_t j = 0; j < distances.size(); ++j) {
    if (within && distances[j] > *within && is_as_near(held, input_.points().positions[j], distances[j], as_far))
      distances[j] = 0;
  }
  return distances;
}

bool CurveMeasures::is_at_held(std::size_t point, double distance, const Resampled& nodes) const {
  return is_as_near(held_places(nodes), input_.points().positions[point], distance, about_held);
}

double CurveMeasures::figure(const std::vector<double>& distances) const {
  const Distance all = summary(distances, counting(distances, input_.kept())).all;
  return input_.options().within() ? all.greatest : all.rms;
}

MeasuredNodes CurveMeasures::measured(Resampled nodes) const {
  MeasuredNodes found{std::move(nodes)};
  const PolygonCurve& shape = found.nodes.curve;
  found.figure = figure(movable_distances(found.nodes));
  found.way_off = way_off(shape).greatest;
  if (const auto within = input_.options().within(); within && between_samples * found.way_off > *within) {
    found.way_beyond = way_beyond(found.nodes);
    found.figure = std::max(found.figure, found.way_beyond * *within);
  }
  found.radius_kept = radius_kept(sharpest(shape, found.nodes));
  found.new_folds = std::max<Index>(0, folds(found.nodes) - folds({input_.curve(), input_.constraints(), {}}));
  found.figures = measure_curve(cut_at_corners(shape, corners(found.nodes)), &found.nodes.constraints);
  return found;
}

Index CurveMeasures::folds(const Resampled& nodes) const {
  Index count = 0;
  const PolygonCurve sides = cut_at_corners(nodes.curve, corners(nodes));
  // Over stations that stay a curve may step straight up.
  const Vector3 seen = input_.moving() == Vector3::Ones() ? input_.moving() : Vector3::Ones() - input_.moving();
  for (const auto& chain : sides.chains()) {
    const std::size_t size = chain.nodes.size();
    const auto place = [&](std::size_t k) -> Vector3 {
      return seen.cwiseProduct(sides.position(chain.nodes[k % size]));
    };
    for (std::size_t k = chain.closed ? 0 : 1; k + (chain.closed ? 0 : 1) < size; ++k)
      count += is_spike(place(k) - place(k + size - 1), place(k + 1) - place(k)) ? 1 : 0;
  }
  return count;
}

Distance CurveMeasures::way_off(const PolygonCurve& moved) const {
  if (!input_.own_nodes()) return {};
  const auto within = input_.options().within();
  const std::optional<PolygonCurve> way = this->way();
  if (!way) return {};
  std::vector<Vector3> places;
  for (const auto& chain : moved.chains()) {
    const std::size_t count = chain.nodes.size();
    for (std::size_t k = 0; k < count; ++k) {
      const Vector3& here = moved.position(chain.nodes[k]);
      const Vector3& next = moved.position(chain.nodes[(k + 1) % count]);
      places.push_back(here);
      if (k + 1 == count && !chain.closed) continue;
      const double apart = within ? (next - here).norm() / (places_apart * *within) : 0;
      const int parts = static_cast<int>(std::clamp(apart, 2.0, most_places_on_edge));
      for (int part = 1; part < parts; ++part) places.emplace_back(here + (next - here) * part / parts);
    }
  }
  return distance(places, *way, context_);
}

std::optional<PolygonCurve> CurveMeasures::way() const {
  constexpr std::size_t unknown = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> order(input_.kept().size(), unknown);
  for (std::size_t j = 0; j < found_.points.size(); ++j) order[static_cast<std::size_t>(found_.points[j].number)] = j;
  std::vector<PolygonCurve::Chain> chains = input_.curve().chains();
  for (auto& chain : chains) {
    std::erase_if(chain.nodes, [&](Index i) { return input_.kept()[static_cast<std::size_t>(i)] == 0; });
    if (chain.nodes.size() < 2) return std::nullopt;
    const auto rank = [&](Index i) { return order[static_cast<std::size_t>(i)]; };
    // What is no point comes after the one before it.
    for (std::size_t k = 1; k < chain.nodes.size(); ++k) {
      std::size_t& own = order[static_cast<std::size_t>(chain.nodes[k])];
      if (own == unknown) own = rank(chain.nodes[k - 1]);
    }
    if (rank(chain.nodes.front()) != unknown)
      std::stable_sort(chain.nodes.begin(), chain.nodes.end(), [&](Index a, Index b) { return rank(a) < rank(b); });
  }
  return PolygonCurve(input_.curve().positions(), std::move(chains));
}

/// The greatest distance from the polyline as a multiple of the allowed one, where that is exceeded.
double CurveMeasures::way_beyond(const Resampled& nodes) const {
  const DenseCurve chords = this->chords(nodes.curve, nodes);
  std::vector<CurvePoint> points = found_.points;
  carry_places(found_.curve, chords, points);
  std::vector<Vector3> places;
  std::vector<double> beyond;
  for (const PolylineBound& one : polyline_bounds(chords, points, *input_.options().within() * input_.scale(),
                                                  {.everywhere = true, .parts = parts_of_edge})) {
    const double share = between_samples * one.distance(chords.at(one.at)) / one.bound;
    if (!(share > 1)) continue;
    places.push_back(input_.to_input(chords.at(one.at)));
    beyond.push_back(share);
  }
  // Another piece of the way may be nearer.
  const std::optional<PolygonCurve> way = this->way();
  if (!way || places.empty()) return 0;
  const std::vector<double> distances = point_distances(places, *way, context_);
  double greatest = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (between_samples * distances[k] > *input_.options().within()) greatest = std::max(greatest, beyond[k]);
  }
  return greatest;
}

double CurveMeasures::greatest_slide(const PolygonCurve& moved) const {
  double greatest = 0;
  for (const auto& chain : moved.chains()) {
    const std::size_t count = chain.nodes.size();
    for (std::size_t k = 0; k < count && count > 1; ++k) {
      const std::size_t before = k > 0 ? k - 1 : chain.closed ? count - 1 : 0;
      const std::size_t after = k + 1 < count ? k + 1 : chain.closed ? 0 : k;
      const Vector3 along = (moved.position(chain.nodes[after]) - moved.position(chain.nodes[before])).normalized();
      if (input_.kept()[static_cast<std::size_t>(chain.nodes[k])] == 0) continue;
      const Vector3 way = moved.position(chain.nodes[k]) - input_.curve().position(chain.nodes[k]);
      greatest = std::max(greatest, std::abs(along.dot(way)));
    }
  }
  return greatest;
}

}  // namespace vspring
