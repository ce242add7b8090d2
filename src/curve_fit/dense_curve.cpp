#include "curve_fit/dense_curve.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "shape/segment.hpp"

namespace vspring {

namespace {

using Matrix3 = Eigen::Matrix3d;

constexpr int newton_steps = 3;
constexpr int newton_steps_to_station = 8;
constexpr int halvings_to_station = 4;
// The weight of moving coordinates when a place is sought by the others: small, but decides where the curve runs along
// them.
constexpr double share_of_moving = 1e-4;

/// The inverse e/|e|² of an edge.
Vector3 inverted(const Vector3& e) { return e / e.squaredNorm(); }
Matrix3 inversion_slope(const Vector3& e) {
  const double square = e.squaredNorm();
  return (Matrix3::Identity() - 2 / square * e * e.transpose()) / square;
}

Vector3 mirrored(const Vector3& v, const Vector3& across) { return v - 2 * v.dot(across) * across; }

}  // namespace

// Inversion takes the circle to a line at half its curvature from the origin.
Vector3 circle_curvature(const Vector3& to_next, const Vector3& to_before) {
  const Vector3 a = inverted(to_next);
  const Vector3 d = inverted(to_before) - a;
  const double square = d.squaredNorm();
  if (!(square > 0)) return Vector3::Zero();
  return 2 * (a - a.dot(d) / square * d);
}

std::size_t DenseCurve::chain_of(std::uint32_t edge) const {
  const auto above = std::upper_bound(chains_.begin(), chains_.end(), edge,
                                      [](std::uint32_t one, const Chain& chain) { return one < chain.begin; });
  return static_cast<std::size_t>(above - chains_.begin()) - 1;
}

void DenseCurve::add_chain(const std::vector<Node>& nodes, bool closed) {
  const std::uint32_t begin = size();
  const auto count = static_cast<std::uint32_t>(nodes.size());
  ++version_;
  chains_.push_back({begin, count, closed});
  nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
  for (std::uint32_t k = 0; k < count; ++k) {
    next_.push_back(k + 1 < count ? begin + k + 1 : closed ? begin : none);
    before_.push_back(k > 0 ? begin + k - 1 : closed ? begin + count - 1 : none);
  }
}

DenseCurve::CurvatureRow DenseCurve::curvature_row(std::uint32_t node, bool after) const {
  CurvatureRow row;
  const Vector3& here = place(node);
  if (is_smooth(node)) {
    const Vector3 f = place(next_[node]) - here;
    const Vector3 g = place(before_[node]) - here;
    const Vector3 a = inverted(f);
    const Vector3 d = inverted(g) - a;
    const double square = d.squaredNorm();
    if (!(square > 0) || !std::isfinite(square)) return row;
    const double share = a.dot(d) / square;
    row.curvature = 2 * (a - share * d);
    row.count = 3;
    row.nodes = {node, next_[node], before_[node]};
    const Matrix3 by_a =
        2 * ((1 + share) * Matrix3::Identity() - d * ((d - a) / square + 2 * share * d / square).transpose());
    const Matrix3 by_b = -2 * (share * Matrix3::Identity() + d * (a / square - 2 * share * d / square).transpose());
    row.slopes[1] = by_a * inversion_slope(f);
    row.slopes[2] = by_b * inversion_slope(g);
    row.slopes[0] = -row.slopes[1] - row.slopes[2];
    return row;
  }
  const Vector3& tangent = this->tangent(node, after);
  const std::uint32_t other = after ? next_[node] : before_[node];
  if (tangent.isZero(0) || other == none) return row;
  // From the circle with that tangent through the other node.
  const Vector3 e = place(other) - here;
  const double square = e.squaredNorm();
  if (!(square > 0)) return row;
  const Vector3 aside = e - e.dot(tangent) * tangent;
  row.curvature = 2 / square * aside;
  row.count = 2;
  row.nodes = {node, other, node};
  row.slopes[1] =
      2 / square * (Matrix3::Identity() - tangent * tangent.transpose() - 2 / square * aside * e.transpose());
  row.slopes[0] = -row.slopes[1];
  return row;
}

double DenseCurve::greatest_curvature(std::uint32_t node) const {
  return std::max(curvature_row(node, false).curvature.norm(), curvature_row(node, true).curvature.norm());
}

DenseCurve::Bend DenseCurve::bend(std::uint32_t node, bool after) const {
  const Vector3& here = place(node);
  if (is_smooth(node)) {
    const Vector3 f = place(next_[node]) - here;
    const Vector3 g = place(before_[node]) - here;
    const Vector3 along = inverted(f) - inverted(g);
    return {along.normalized(), circle_curvature(f, g)};
  }
  const Vector3& tangent = this->tangent(node, after);
  if (!tangent.isZero(0)) return {tangent, curvature_row(node, after).curvature};
  // Curvature continues from the other end of the edge.
  const std::uint32_t other = after ? next_[node] : before_[node];
  const Vector3 edge = (after ? 1 : -1) * (place(other) - here).normalized();
  const std::uint32_t beyond = after ? next_[other] : before_[other];
  const bool goes_on = beyond != none && (is_smooth(other) || !this->tangent(other, !after).isZero(0));
  if (!goes_on) return {edge, Vector3::Zero()};
  const Bend there = bend(other, !after);
  return {-mirrored(there.tangent, edge), mirrored(there.curvature, edge)};
}

// If curvature changes by k' per length, the direction at a node is that of the circle through it and its neighbours,
// at distances a and b, turned back by k' a b / 6.
DenseCurve::Bend DenseCurve::exact_bend(std::uint32_t node, bool after) const {
  Bend found = bend(node, after);
  if (!is_smooth(node)) return found;
  const std::uint32_t next = next_[node];
  const std::uint32_t before = before_[node];
  const Vector3 ahead = place(next) - place(node);
  const Vector3 behind = place(node) - place(before);
  // Vectors carried here as on a circle.
  const auto here = [](const Vector3& there, const Vector3& way) { return mirrored(there, way.normalized()); };
  Vector3 first = found.curvature;
  Vector3 last = found.curvature;
  double way = 0;
  if (is_smooth(before)) {
    first = here(bend(before, true).curvature, behind);
    way += behind.norm();
  }
  if (is_smooth(next)) {
    last = here(bend(next, false).curvature, ahead);
    way += ahead.norm();
  }
  if (!(way > 0)) return found;
  const Vector3 change = (last - first) / way;
  const Vector3 back = ahead.norm() * behind.norm() / 6 * (change - change.dot(found.tangent) * found.tangent);
  found.tangent = (found.tangent - back).normalized();
  return found;
}

const DenseCurve::Quintic& DenseCurve::quintic(std::uint32_t edge) const {
  if (quintics_.size() != nodes_.size()) {
    quintics_.resize(nodes_.size());
    versions_.assign(nodes_.size(), 0);
  }
  if (versions_[edge] != version_) {
    quintics_[edge] = new_quintic(edge);
    versions_[edge] = version_;
  }
  return quintics_[edge];
}

DenseCurve::Quintic DenseCurve::new_quintic(std::uint32_t edge) const {
  const std::uint32_t end = next_[edge];
  const Vector3 chord = place(end) - place(edge);
  const Bend a = exact_bend(edge, true);
  const Bend b = exact_bend(end, false);
  // An arc is longer than its chord.
  const double cosine = std::clamp(a.tangent.dot(b.tangent), -1.0, 1.0);
  const double half = std::acos(cosine) / 2;
  const double length = chord.norm() * (half > 1e-4 ? half / std::sin(half) : 1);
  const Vector3 start = length * a.tangent;
  const Vector3 finish = length * b.tangent;
  const Vector3 bent_start = length * length / 2 * a.curvature;
  const Vector3 bent_finish = length * length / 2 * b.curvature;
  const Vector3 rest = chord - start - bent_start;
  const Vector3 slope = finish - start - 2 * bent_start;
  const Vector3 bend = bent_finish - bent_start;
  return {{place(edge), start, bent_start, 10 * rest - 4 * slope + bend, -15 * rest + 7 * slope - 2 * bend,
           6 * rest - 3 * slope + bend}};
}

Vector3 DenseCurve::Quintic::at(double share) const {
  Vector3 sum = terms[5];
  for (int k = 4; k >= 0; --k) sum = share * sum + terms[static_cast<std::size_t>(k)];
  return sum;
}

Vector3 DenseCurve::Quintic::slope(double share) const {
  Vector3 sum = 5 * terms[5];
  for (int k = 4; k >= 1; --k) sum = share * sum + k * terms[static_cast<std::size_t>(k)];
  return sum;
}

Vector3 DenseCurve::at(const CurvePlace& at) const {
  if (at.share == 0) return place(at.edge);
  if (at.share == 1) return place(next_[at.edge]);
  if (straight_) return place(at.edge) + at.share * (place(next_[at.edge]) - place(at.edge));
  return quintic(at.edge).at(at.share);
}

Vector3 DenseCurve::direction(const CurvePlace& at) const {
  if (straight_) {
    // At a node: midway between both edges, like the direction to nearest points.
    if (at.share == 0) return bend(at.edge, true).tangent;
    if (at.share == 1) return bend(next_[at.edge], false).tangent;
    return (place(next_[at.edge]) - place(at.edge)).normalized();
  }
  const Vector3 slope = quintic(at.edge).slope(at.share);
  const double length = slope.norm();
  return length > 0 ? Vector3(slope / length) : (place(next_[at.edge]) - place(at.edge)).normalized();
}

DenseCurve::PlaceRow DenseCurve::place_row(const CurvePlace& at) const {
  PlaceRow row;
  const std::uint32_t b = at.edge;
  const std::uint32_t c = next_[b];
  const std::uint32_t a = is_smooth(b) ? before_[b] : none;
  const std::uint32_t d = is_smooth(c) ? next_[c] : none;
  row.nodes = {a, b, c, d};
  const double length = edge_length(b);
  const double t = at.share;
  if (straight_) {
    row.weights = {0, 1 - t, t, 0};
    return row;
  }
  // A cubic from b to c whose slopes are those of parabolas through three nodes.
  row.weights = {0, (1 - t) * (1 - t) * (1 + 2 * t), t * t * (3 - 2 * t), 0};
  const auto add_slope = [&](double factor, std::uint32_t node, std::uint32_t outer, int here, int other, int beyond,
                             double sense) {
    const Vector3& given = tangent(node, sense > 0);
    if (!given.isZero(0)) {
      row.rest += factor * length * given;
    } else if (outer != none) {
      const double outside = (place(outer) - place(node)).norm();
      const double sum = length + outside;
      // Weights of (other − here) by the outer length, and of (here − beyond) by the inner one.
      const double near = outside / sum;
      const double far = length * length / (outside * sum);
      row.weights[static_cast<std::size_t>(other)] += sense * factor * near;
      row.weights[static_cast<std::size_t>(here)] += sense * factor * (far - near);
      row.weights[static_cast<std::size_t>(beyond)] -= sense * factor * far;
    } else {
      row.weights[static_cast<std::size_t>(other)] += sense * factor;
      row.weights[static_cast<std::size_t>(here)] -= sense * factor;
    }
  };
  add_slope(t * (1 - t) * (1 - t), b, a, 1, 2, 0, 1);
  add_slope(-t * t * (1 - t), c, d, 2, 1, 3, -1);
  return row;
}

Vector3 DenseCurve::sought(const Vector3& v) const {
  return moves_freely() ? v : Vector3(v - (1 - share_of_moving) * moving_.cwiseProduct(v));
}

CurvePlace DenseCurve::nearest(const Vector3& point, const CurvePlace& about, double reach) const {
  CurvePlace best = about;
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](std::uint32_t edge) {
    const Vector3 chord = sought(place(next_[edge]) - place(edge));
    const Vector3 away = sought(point - place(edge));
    const double share = nearest_share(away, Vector3::Zero(), chord);
    const double distance = (share * chord - away).squaredNorm();
    if (distance < least) {
      least = distance;
      best = {edge, share};
    }
  };
  look(about.edge);
  double way = (1 - about.share) * edge_length(about.edge);
  for (std::uint32_t edge = next_[about.edge]; way < reach && edge != none && is_edge(edge) && edge != about.edge;
       edge = next_[edge]) {
    look(edge);
    way += edge_length(edge);
  }
  way = about.share * edge_length(about.edge);
  for (std::uint32_t edge = before_[about.edge]; way < reach && edge != none && edge != about.edge;
       edge = before_[edge]) {
    look(edge);
    way += edge_length(edge);
  }
  if (straight_) return best;
  // From the chord to the curve over it.
  const int steps = moves_freely() ? newton_steps : newton_steps_to_station;
  for (int step = 0; step < steps; ++step) {
    const Quintic& curve = quintic(best.edge);
    const Vector3 slope = sought(curve.slope(best.share));
    const double square = slope.squaredNorm();
    if (!(square > 0)) break;
    const Vector3 away = sought(point - curve.at(best.share));
    double share = best.share + away.dot(slope) / square;
    // Where the curve turns back, a step may go too far.
    const auto is_further = [&] {
      return sought(point - curve.at(std::clamp(share, 0.0, 1.0))).squaredNorm() > away.squaredNorm();
    };
    for (int half = 0; !moves_freely() && half < halvings_to_station && is_further(); ++half)
      share = (share + best.share) / 2;
    if (share > 1 && step + 1 < steps && next_[best.edge] != none && is_edge(next_[best.edge])) {
      best = {next_[best.edge], 0};
    } else if (share < 0 && step + 1 < steps && before_[best.edge] != none) {
      best = {before_[best.edge], 1};
    } else {
      best.share = std::clamp(share, 0.0, 1.0);
    }
  }
  return best;
}

}  // namespace vspring
