#include "fairness/curve_bending.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "spring/tangent.hpp"

namespace vspring {

namespace {

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

}  // namespace

CurveBending curve_bending(const std::vector<Vector3>& positions, bool closed, double straight) {
  return Run(positions, closed).bend(straight);
}

}  // namespace vspring
