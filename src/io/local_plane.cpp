// The oblique stereographic map of the ellipsoid: to Gauss's sphere, and from there to a plane. Of all conformal maps
// the stereographic one stretches a disc least; a transverse Mercator map stretches twice as much along the parallel.
#include "vspring/local_plane.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vspring/error.hpp"

namespace vspring {
namespace {

// WGS 84.
constexpr double semi_major_axis = 6378137;
constexpr double flattening = 1 / 298.257223563;
constexpr double eccentricity2 = flattening * (2 - flattening);

constexpr double radians = std::numbers::pi / 180;

/// The isometric latitude (that of Mercator's map) on the ellipsoid, or on a sphere if the eccentricity is 0.
double isometric_latitude(double latitude) {
  const double e = std::sqrt(eccentricity2);
  return std::asinh(std::tan(latitude)) - e * std::atanh(e * std::sin(latitude));
}

double latitude_of(double isometric) {
  const double e = std::sqrt(eccentricity2);
  double latitude = std::atan(std::sinh(isometric));
  // Each round divides the error by 150.
  constexpr int rounds = 10;
  for (int k = 0; k < rounds; ++k) latitude = std::atan(std::sinh(isometric + e * std::atanh(e * std::sin(latitude))));
  return latitude;
}

}  // namespace

LocalPlane::LocalPlane(const Place& origin) : origin_(origin) {
  if (!(std::abs(origin.latitude) <= 90) || !std::isfinite(origin.longitude))
    throw Error(ErrorCode::invalid_argument, "the origin of a plane needs a latitude from -90 to 90 and a longitude");
  // At a pole no meridian is north.
  constexpr double most = 90 - 1e-6;
  origin_.latitude = std::clamp(origin.latitude, -most, most);
  const double latitude = origin_.latitude * radians;
  const double sine2 = std::pow(std::sin(latitude), 2);
  const double cosine4 = std::pow(std::cos(latitude), 4);
  exponent_ = std::sqrt(1 + eccentricity2 * cosine4 / (1 - eccentricity2));
  // The geometric mean of the radii of curvature along the meridian and across.
  diameter_ = 2 * semi_major_axis * std::sqrt(1 - eccentricity2) / (1 - eccentricity2 * sine2);
  sine_ = std::sin(latitude) / exponent_;
  cosine_ = std::sqrt(1 - sine_ * sine_);
  isometric_ = isometric_latitude(latitude);
  sphere_isometric_ = std::atanh(sine_);
}

Vector3 LocalPlane::position(const Place& place) const {
  const double isometric = sphere_isometric_ + exponent_ * (isometric_latitude(place.latitude * radians) - isometric_);
  const double turn = exponent_ * std::remainder(place.longitude - origin_.longitude, 360) * radians;
  // On the sphere, with the axis up.
  const double up = std::tanh(isometric);
  const double across = 1 / std::cosh(isometric);
  const double east = across * std::sin(turn);
  const double forward = across * std::cos(turn);
  const double scale = diameter_ / (1 + up * sine_ + forward * cosine_);
  return {scale * east, scale * (up * cosine_ - forward * sine_), 0};
}

LocalPlane::Place LocalPlane::place(const Vector3& position) const {
  const double x = position.x() / diameter_;
  const double y = position.y() / diameter_;
  const double square = x * x + y * y;
  const double east = 2 * x / (1 + square);
  const double north = 2 * y / (1 + square);
  const double outward = (1 - square) / (1 + square);
  const double up = outward * sine_ + north * cosine_;
  const double forward = outward * cosine_ - north * sine_;
  const double isometric = std::asinh(up / std::hypot(forward, east));
  const double turn = std::atan2(east, forward) / (exponent_ * radians);
  return {latitude_of((isometric - sphere_isometric_) / exponent_ + isometric_) / radians,
          std::remainder(origin_.longitude + turn, 360)};
}

double LocalPlane::stretch(const Vector3& position) const {
  return (position.x() * position.x() + position.y() * position.y()) / (diameter_ * diameter_);
}

}  // namespace vspring
