#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "fairness/curve_runs.hpp"
#include "fairness/extrema.hpp"
#include "fairness/normal_error.hpp"
#include "shape/frame.hpp"
#include "spring/tangent.hpp"
#include "vspring/figures.hpp"
#include "vspring/types.hpp"

namespace vspring {

namespace {

/// Bending of a run of a curve.
struct CurveBending {
  double length = 0;
  double squares = 0;                    ///< ∫ κ² ds
  double rates = 0;                      ///< ∫ |dκ/ds|² ds, in a rotation-minimising frame
  std::vector<double> signed_curvature;  ///< at the inner nodes, all nodes of a closed run; changes sign at inflections
};

/// The circle through three successive nodes.
struct ThreePointCircle {
  double place = 0;  ///< mean arc length of its nodes
  Vector3 tangent;
  Vector3 curvature;
};

/// `vector` after the rotation of least angle from one unit vector to another.
Vector3 transported(const Vector3& vector, const Vector3& from, const Vector3& to) {
  const Vector3 sum = from + to;
  const double square = sum.squaredNorm();
  if (!(square > 1e-12)) return vector;  // a hairpin: any axis will do
  // Two reflections: in the plane across `from`, then across the bisector.
  const Vector3 reflected = vector - 2 * vector.dot(from) * from;
  return reflected - (2 * reflected.dot(sum) / square) * sum;
}

class Run {
 public:
  Run(const std::vector<Vector3>& positions, bool closed) : positions_(positions), closed_(closed) {
    const std::size_t count = positions.size();
    places_.assign(1, 0);
    for (std::size_t k = 0; k + 1 < count + (closed ? 1 : 0); ++k)
      places_.push_back(places_.back() + (positions[(k + 1) % count] - positions[k]).norm());
    const std::size_t inner = closed ? count : count < 2 ? 0 : count - 2;
    stations_.reserve(inner);
    if (count < 3) return;
    for (std::size_t k = 0; k < inner; ++k) stations_.push_back(station(closed ? k : k + 1));
  }

  CurveBending bend(double straight) const {
    CurveBending bending;
    bending.length = places_.back();
    const std::size_t count = stations_.size();
    if (count == 0) return bending;
    for (std::size_t k = 0; k < count; ++k) bending.squares += stations_[k].curvature.squaredNorm() * share(k);
    double first_rate = 0;
    double last_rate = 0;
    for (std::size_t k = 0; k < count; ++k) {
      if (k + 1 == count && !closed_) break;
      const ThreePointCircle& a = stations_[k];
      const ThreePointCircle& b = stations_[(k + 1) % count];
      const double step = distance(k);
      if (!(step > 0)) continue;
      const Vector3 difference = b.curvature - transported(a.curvature, a.tangent, b.tangent);
      const double rate = difference.squaredNorm() / (step * step);
      bending.rates += rate * step;
      if (k == 0) first_rate = rate;
      last_rate = rate;
    }
    if (!closed_)
      bending.rates += first_rate * stations_.front().place + last_rate * (places_.back() - stations_.back().place);
    bending.signed_curvature = sides(straight);
    return bending;
  }

 private:
  [[nodiscard]] ThreePointCircle station(std::size_t k) const {
    const std::size_t count = positions_.size();
    const std::size_t before = (k + count - 1) % count;
    const std::size_t after = (k + 1) % count;
    const std::array<Link, 2> links = {Link{static_cast<std::uint32_t>(before) | Link::spoke_bit | Link::start_bit},
                                       Link{static_cast<std::uint32_t>(after) | Link::spoke_bit}};
    const double to_before = k > 0 ? places_[k - 1] - places_[k] : places_[count - 1] - places_[count];
    const double to_after = places_[k + 1] - places_[k];
    ThreePointCircle station;
    station.place = places_[k] + (to_before + to_after) / 3;
    station.tangent = CircleTangent()(positions_[k], links, positions_);
    station.curvature = circle_curvature(positions_[k], links, positions_, station.tangent);
    return station;
  }

  /// The distance from station k to the next.
  [[nodiscard]] double distance(std::size_t k) const {
    if (k + 1 < stations_.size()) return stations_[k + 1].place - stations_[k].place;
    return stations_.front().place + places_.back() - stations_.back().place;
  }

  /// The length for which station k stands.
  [[nodiscard]] double share(std::size_t k) const {
    const std::size_t count = stations_.size();
    if (closed_) return (distance((k + count - 1) % count) + distance(k)) / 2;
    const double before = k == 0 ? stations_[k].place : distance(k - 1) / 2;
    const double after = k + 1 == count ? places_.back() - stations_[k].place : distance(k) / 2;
    return before + after;
  }

  [[nodiscard]] std::vector<double> sides(double straight) const {
    std::vector<double> curvature;
    curvature.reserve(stations_.size());
    Vector3 left = Vector3::Zero();  // the positive side
    for (std::size_t k = 0; k < stations_.size(); ++k) {
      const ThreePointCircle& station = stations_[k];
      if (k > 0) left = transported(left, stations_[k - 1].tangent, station.tangent);
      const double size = station.curvature.norm();
      const bool right = left.dot(station.curvature) < 0;
      curvature.push_back(right ? -size : size);
      if (!(size > straight)) continue;
      left = (right ? -1 : 1) / size * station.curvature;
    }
    return curvature;
  }

  const std::vector<Vector3>& positions_;
  bool closed_;
  std::vector<double> places_;  // arc lengths of the nodes; a closed run has its first node again at the end
  std::vector<ThreePointCircle> stations_;
};

/// Measures the polygon through `positions`, of which no two in succession may be equal. The circle through three nodes
/// has the curve's curvature at the mean of their arc lengths, to second order for any spacing. The difference of two
/// such curvatures over the distance of their places is the derivative at the mean of the four nodes. So both integrals
/// are of second order. The outermost values extend to the ends.
///
/// A curvature vector is compared with the next one after the rotation of least angle that takes the one tangent to the
/// other (a rotation-minimising frame: W. Wang et al., "Computation of rotation minimizing frames", ACM Trans. Graph.
/// 27, 2008). `straight`: curvature up to this is taken for rounding and has no side.
CurveBending curve_bending(const std::vector<Vector3>& positions, bool closed, double straight) {
  return Run(positions, closed).bend(straight);
}

/// In a frame of size 1; lengths go back to units of the input at the end.
class CurveMeasurement {
 public:
  CurveMeasurement(const PolygonCurve& curve, const Constraints* constraints) {
    const std::vector<CurveRun> runs = curve_runs(curve, constraints);
    for (const CurveRun& run : runs) {
      for (const Index i : run.nodes) box_.extend(curve.position(i));
    }
    frame_ = Frame(box_);
    for (const CurveRun& run : runs) {
      closed_.push_back(run.closed);
      figures_.zero_length_edges += run.zero_length_edges;
      std::vector<Vector3>& positions = positions_.emplace_back();
      positions.reserve(run.nodes.size());
      for (const Index i : run.nodes) positions.push_back(frame_.to_local(curve.position(i)));
    }
  }

  CurveFigures measure() {
    if (box_.isEmpty()) return figures_;
    measure_edges();
    measure_bending();
    figures_.length = length_ / frame_.scale();
    figures_.diagonal = (frame_.to_local(box_.max()) - frame_.to_local(box_.min())).norm() / frame_.scale();
    return figures_;
  }

 private:
  void measure_edges() {
    double shortest = std::numeric_limits<double>::infinity();
    double longest = 0;
    for (std::size_t r = 0; r < positions_.size(); ++r) {
      const auto& positions = positions_[r];
      const std::size_t count = positions.size();
      if (count < 2) continue;
      const auto edge = [&](std::size_t k) { return (positions[(k + 1) % count] - positions[k % count]).norm(); };
      const std::size_t edges = closed_[r] ? count : count - 1;
      for (std::size_t k = 0; k < edges; ++k) {
        length_ += edge(k);
        shortest = std::min(shortest, edge(k));
        longest = std::max(longest, edge(k));
        if (k + 1 == edges && !closed_[r]) continue;
        const double ratio = edge(k) / edge(k + 1);
        figures_.neighbouring_edge_spread = std::max({figures_.neighbouring_edge_spread, ratio, 1 / ratio});
      }
    }
    if (longest > 0) figures_.edge_spread = longest / shortest;
  }

  void measure_bending() {
    if (!(length_ > 0)) return;
    const double least_visible = visible_curvature / length_;
    double squares = 0;
    double rates = 0;
    double greatest = 0;
    std::vector<CurveBending> bent;
    bent.reserve(positions_.size());
    for (std::size_t r = 0; r < positions_.size(); ++r) {
      bent.push_back(curve_bending(positions_[r], closed_[r], least_visible));
      squares += bent[r].squares;
      rates += bent[r].rates;
      for (const double curvature : bent[r].signed_curvature) greatest = std::max(greatest, std::abs(curvature));
    }
    figures_.bending_energy = length_ * squares;
    figures_.curvature_variation = length_ * length_ * length_ * rates;
    figures_.greatest_curvature = length_ * greatest;
    const double visible = std::max(visible_share * std::sqrt(squares / length_), least_visible);
    for (std::size_t r = 0; r < positions_.size(); ++r) {
      figures_.curvature_extrema += count_extrema(bent[r].signed_curvature, closed_[r], visible);
      figures_.inflections += count_sign_changes(bent[r].signed_curvature, closed_[r], visible);
    }
  }

  Eigen::AlignedBox<double, 3> box_;
  Frame frame_;
  std::vector<std::vector<Vector3>> positions_;  // of each run
  std::vector<bool> closed_;
  double length_ = 0;
  CurveFigures figures_;
};

}  // namespace

CurveFigures measure_curve(const PolygonCurve& curve, const Constraints* constraints) {
  CurveFigures figures = CurveMeasurement(curve, constraints).measure();
  static_cast<Fairness&>(figures) = measure(curve, constraints);
  if (constraints != nullptr) figures.normal_error = normal_error(curve, *constraints);
  return figures;
}

}  // namespace vspring
