#include "curve_fit/planar_polygon.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "shape/planarity.hpp"

namespace vspring {

namespace {

using Vector2 = Eigen::Vector2d;

// Four nodes in succession, and the same where nodes of both sides of a closed chain alternate.
constexpr std::size_t width_of_open = 4;
constexpr std::size_t width_of_closed = 7;

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }
Vector2 left_of(const Vector2& v) { return {-v.y(), v.x()}; }

}  // namespace

double CurvatureRun::step(std::size_t k) const {
  return next(k).place - stations[k].place + (k + 1 == stations.size() ? around : 0);
}

std::optional<PlanarPolygon> PlanarPolygon::of(const PolygonCurve& curve, const Constraints& constraints,
                                               std::span<const Vector3> points) {
  const auto count = static_cast<std::size_t>(curve.node_count());
  std::vector<Vector3> all = curve.positions();
  for (std::size_t i = 0; i < count; ++i) {
    const auto node = static_cast<Index>(i);
    if (constraints.normal_fixed(node)) return std::nullopt;
    if (constraints.position_fixed(node)) all[i] = constraints.position(node);
  }
  all.insert(all.end(), points.begin(), points.end());
  const auto plane = plane_normal(all);
  if (!plane) return std::nullopt;
  PlanarPolygon polygon;
  Eigen::AlignedBox<double, 3> box;
  for (const Vector3& place : all) box.extend(place);
  polygon.frame_ = Frame(box);
  polygon.aside_ = plane->unitOrthogonal();
  polygon.ahead_ = plane->cross(polygon.aside_);
  for (std::size_t i = 0; i < count; ++i) polygon.first_.push_back(polygon.flat(all[i]));
  polygon.given_.assign(count, Vector2::Zero());
  polygon.fixed_.assign(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto node = static_cast<Index>(i);
    polygon.fixed_[i] = constraints.position_fixed(node) ? 1 : 0;
    if (!constraints.tangent_fixed(node)) continue;
    const Vector3& tangent = constraints.tangent(node);
    polygon.given_[i] = Vector2(tangent.dot(polygon.aside_), tangent.dot(polygon.ahead_)).normalized();
  }
  polygon.column_.assign(count, held);
  polygon.width_ = width_of_open;
  for (const PolygonCurve::Chain& chain : curve.chains()) {
    const std::size_t nodes = chain.nodes.size();
    if (nodes < 2) continue;
    PolygonCurve::Chain& own = polygon.chains_.emplace_back(chain);
    // Around a closed chain from a given direction on, where runs end.
    const auto is_given = [&](Index node) { return !polygon.given_[static_cast<std::size_t>(node)].isZero(0); };
    const auto begin = std::find_if(own.nodes.begin(), own.nodes.end(), is_given);
    if (own.closed && begin != own.nodes.end()) std::rotate(own.nodes.begin(), begin, own.nodes.end());
    polygon.number(own);
    for (std::size_t k = 0; k + (chain.closed ? 0 : 1) < nodes; ++k) {
      polygon.edges_.push_back(
          {static_cast<std::uint32_t>(chain.nodes[k]), static_cast<std::uint32_t>(chain.nodes[(k + 1) % nodes])});
      const auto [a, b] = polygon.edges_.back();
      if (polygon.first_[a] == polygon.first_[b]) return std::nullopt;
    }
  }
  if (polygon.columns_ == 0) return std::nullopt;
  polygon.set_places(polygon.first_);
  return polygon;
}

Vector2 PlanarPolygon::flat(const Vector3& place) const {
  const Vector3 local = frame_.to_local(place);
  return {local.dot(aside_), local.dot(ahead_)};
}

void PlanarPolygon::number(const PolygonCurve::Chain& chain) {
  const std::size_t count = chain.nodes.size();
  const auto give = [&](std::size_t k) {
    const auto node = static_cast<std::size_t>(chain.nodes[k]);
    if (fixed_[node] == 0 && column_[node] == held) column_[node] = static_cast<std::uint32_t>(columns_++);
  };
  if (!chain.closed) {
    for (std::size_t k = 0; k < count; ++k) give(k);
    return;
  }
  width_ = width_of_closed;
  for (std::size_t k = 0; 2 * k < count; ++k) {
    give(k);
    give(count - 1 - k);
  }
}

void PlanarPolygon::set_places(std::vector<Vector2> places) {
  places_ = std::move(places);
  find_normals();
  runs_.clear();
  for (const PolygonCurve::Chain& chain : chains_) find_stations(chain);
  std::erase_if(runs_, [](const CurvatureRun& run) { return run.stations.empty(); });
}

void PlanarPolygon::find_normals() {
  normals_.assign(places_.size(), Vector2::Zero());
  for (const PolygonCurve::Chain& chain : chains_) {
    const std::size_t count = chain.nodes.size();
    for (std::size_t k = 0; k < count; ++k) {
      const auto node = static_cast<std::size_t>(chain.nodes[k]);
      if (column_[node] == held) continue;
      Vector2 tangent = given_[node];
      if (tangent.isZero(0)) {
        // Of the circle through the three nodes.
        const Vector2 before = places_[node] - places_[static_cast<std::size_t>(chain.nodes[(k + count - 1) % count])];
        const Vector2 after = places_[static_cast<std::size_t>(chain.nodes[(k + 1) % count])] - places_[node];
        tangent = (before / before.squaredNorm() + after / after.squaredNorm()).normalized();
      }
      normals_[node] = left_of(tangent);
    }
  }
}

void PlanarPolygon::find_stations(const PolygonCurve::Chain& chain) {
  const std::size_t count = chain.nodes.size();
  const auto node_at = [&](std::size_t k) { return static_cast<std::uint32_t>(chain.nodes[k % count]); };
  runs_.emplace_back();
  double place = 0;
  const bool ends_where_it_begins = chain.closed && !given_[node_at(0)].isZero(0);
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t node = node_at(k);
    const std::uint32_t before = node_at(k + count - 1);
    const std::uint32_t after = node_at(k + 1);
    const bool has_before = k > 0 || chain.closed;
    const bool has_after = k + 1 < count || chain.closed;
    const double length_before = has_before ? (places_[node] - places_[before]).norm() : 0;
    const double length_after = has_after ? (places_[after] - places_[node]).norm() : 0;
    const auto add = [&](CurvatureStation one, double from_node) {
      one.place = place + from_node;
      runs_.back().stations.push_back(one);
    };
    if (!given_[node].isZero(0)) {
      // Curvature may jump there.
      if (k > 0) add(station_beside(node, before, false), -length_before / 3);
      if (k > 0 && has_after) runs_.emplace_back();
      if (has_after) add(station_beside(node, after, true), length_after / 3);
    } else if (has_before && has_after) {
      add(station(before, node, after), (length_after - length_before) / 3);
    }
    place += length_after;
  }
  if (ends_where_it_begins) {
    const double length = (places_[node_at(0)] - places_[node_at(count - 1)]).norm();
    runs_.back().stations.push_back(station_beside(node_at(0), node_at(count - 1), false));
    runs_.back().stations.back().place = place - length / 3;
  }
  runs_.back().closed = chain.closed && !ends_where_it_begins && runs_.back().stations.size() > 2;
  runs_.back().around = place;
}

CurvatureStation PlanarPolygon::station(std::uint32_t before, std::uint32_t node, std::uint32_t after) const {
  const Vector2 a = places_[node] - places_[before];
  const Vector2 b = places_[after] - places_[node];
  const Vector2 c = a + b;
  const double product = a.norm() * b.norm() * c.norm();
  CurvatureStation one;
  one.nodes = {before, node, after};
  one.length = (a.norm() + b.norm()) / 2;
  if (!(product > 0)) return one;
  one.curvature = 2 * cross(a, b) / product;
  const auto slope = [&](const Vector2& da, const Vector2& db) {
    return 2 * (cross(da, b) + cross(a, db)) / product -
           one.curvature *
               (da.dot(a) / a.squaredNorm() + db.dot(b) / b.squaredNorm() + (da + db).dot(c) / c.squaredNorm());
  };
  one.slopes = {slope(-normals_[before], Vector2::Zero()), slope(normals_[node], -normals_[node]),
                slope(Vector2::Zero(), normals_[after])};
  return one;
}

/// By the edge from or to a node with a given direction.
CurvatureStation PlanarPolygon::station_beside(std::uint32_t node, std::uint32_t other, bool after) const {
  const double sense = after ? 1 : -1;
  const Vector2 edge = sense * (places_[other] - places_[node]);
  const Vector2& tangent = given_[node];
  const double square = edge.squaredNorm();
  CurvatureStation one;
  one.nodes = {node, other, other};
  one.length = std::sqrt(square);
  if (!(square > 0)) return one;
  one.curvature = sense * 2 * cross(tangent, edge) / square;
  const auto slope = [&](const Vector2& change) {
    return (sense * 2 * cross(tangent, change) - one.curvature * 2 * change.dot(edge)) / square;
  };
  one.slopes = {slope(-sense * normals_[node]), slope(sense * normals_[other]), 0};
  return one;
}

std::vector<Vector3> PlanarPolygon::lifted(const std::vector<Vector3>& input) const {
  std::vector<Vector3> result = input;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (column_[i] == held) continue;
    const Vector2 way = (places_[i] - first_[i]) / scale();
    result[i] += way.x() * aside_ + way.y() * ahead_;
  }
  return result;
}

}  // namespace vspring
