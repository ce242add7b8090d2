#include "vspring/support.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "shape/segment.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

// As a share of the radius: for a place this near to the axis or the centre, rounding would choose the nearest one.
constexpr double too_near_to_centre = 1e-9;

Error degenerate(const char* support, const std::string& why) {
  return {ErrorCode::unusable_constraint, fmt::format("a {} to slide on {}", support, why)};
}

Vector3 unit_axis(const char* support, const Vector3& point, const Vector3& axis, const char* what) {
  if (!point.allFinite() || !axis.allFinite()) throw degenerate(support, "has a number that is not finite");
  // Scaled first, as squares of lengths may overflow or vanish.
  const double greatest = axis.cwiseAbs().maxCoeff();
  if (!(greatest > 0))
    throw degenerate(support, fmt::format("has a {} of zero, which has no direction; give one of any length", what));
  return (axis / greatest).normalized();
}

double usable_radius(const char* support, double radius) {
  if (!(radius > 0 && radius <= std::numeric_limits<double>::max()))
    throw degenerate(support, fmt::format("has the radius {}; give a positive one", radius));
  return radius;
}

}  // namespace

Support Support::plane(const Vector3& point, const Vector3& normal) {
  return {Kind::plane, {point}, unit_axis("plane", point, normal, "normal"), 0, false};
}

Support Support::cylinder(const Vector3& point, const Vector3& direction, double radius) {
  const Vector3 axis = unit_axis("cylinder", point, direction, "direction");
  return {Kind::cylinder, {point}, axis, usable_radius("cylinder", radius), false};
}

Support Support::line(const Vector3& point, const Vector3& direction) {
  return {Kind::line, {point}, unit_axis("line", point, direction, "direction"), 0, false};
}

Support Support::circle(const Vector3& centre, const Vector3& normal, double radius) {
  const Vector3 axis = unit_axis("circle", centre, normal, "normal");
  return {Kind::circle, {centre}, axis, usable_radius("circle", radius), false};
}

Support Support::polyline(std::vector<Vector3> points, bool closed) {
  if (points.size() < 2)
    throw degenerate("polyline",
                     fmt::format("has {} point{}; give two or more", points.size(), points.size() == 1 ? "" : "s"));
  if (!std::all_of(points.begin(), points.end(), [](const Vector3& point) { return point.allFinite(); }))
    throw degenerate("polyline", "has a number that is not finite");
  if (std::all_of(points.begin(), points.end(), [&](const Vector3& point) { return point == points.front(); }))
    throw degenerate("polyline", "has all its points in one place");
  return {Kind::polyline, std::move(points), Vector3::Zero(), 0, closed};
}

Support Support::in_frame(const Vector3& origin, double scale) const {
  Support support = *this;
  for (Vector3& point : support.points_) point = (point - origin) * scale;
  support.radius_ *= scale;
  return support;
}

Support Support::mirrored(const Vector3& point, const Vector3& normal) const {
  const auto direction = [&](const Vector3& v) { return Vector3(v - 2 * v.dot(normal) * normal); };
  Support support = *this;
  for (Vector3& p : support.points_) p = point + direction(p - point);
  support.axis_ = direction(axis_);
  support.start_ = direction(start_);
  support.turn_ = -turn_;
  return support;
}

Support::OnPolyline Support::on_polyline(const Vector3& place) const {
  OnPolyline best{points_.front(), Vector3::Zero()};
  double least = std::numeric_limits<double>::infinity();
  const std::size_t segments = points_.size() - (closed_ ? 0 : 1);
  for (std::size_t k = 0; k < segments; ++k) {
    const Vector3& a = points_[k];
    const Vector3& b = points_[(k + 1) % points_.size()];
    if (a == b) continue;
    const Vector3 nearest = a + nearest_share(place, a, b) * (b - a);
    const double square = (place - nearest).squaredNorm();
    if (!(square < least)) continue;
    least = square;
    best = {nearest, b - a};
  }
  return best;
}

std::optional<Support::OnCylinder> Support::on_cylinder(const Vector3& place) const {
  const Vector3 arm = place - points_.front();
  const double ahead = arm.dot(axis_);
  const Vector3 out = arm - ahead * axis_;
  const double length = out.norm();
  if (!(length > too_near_to_centre * radius_)) return std::nullopt;
  return OnCylinder{ahead, out / length};
}

Support::OnCylinder Support::on_helix(const OnCylinder& place) const {
  const Vector3 aside = axis_.cross(start_);
  const double around = std::atan2(place.out.dot(aside), place.out.dot(start_)) * radius_;
  const double along = pitch_ * place.ahead + turn_ * around;
  const double angle = turn_ * along / radius_;
  return {pitch_ * along, std::cos(angle) * start_ + std::sin(angle) * aside};
}

std::optional<Vector3> Support::nearest(const Vector3& place) const {
  const Vector3& origin = points_.front();
  switch (kind_) {
    case Kind::plane:
      return place - (place - origin).dot(axis_) * axis_;
    case Kind::line:
      return origin + (place - origin).dot(axis_) * axis_;
    case Kind::polyline:
      return on_polyline(place).place;
    case Kind::cylinder:
    case Kind::circle:
    case Kind::helix:
      break;
  }
  auto there = on_cylinder(place);
  if (!there) return std::nullopt;
  if (kind_ == Kind::helix) there = on_helix(*there);
  if (kind_ == Kind::circle) there->ahead = 0;
  return origin + radius_ * there->out + there->ahead * axis_;
}

Vector3 Support::axis(const Vector3& place) const {
  if (kind_ == Kind::polyline) return on_polyline(place).way.normalized();
  if (kind_ == Kind::plane || kind_ == Kind::line) return axis_;
  const auto there = on_cylinder(place);
  if (!there) return Vector3::Zero();
  if (kind_ == Kind::cylinder) return there->out;
  if (kind_ == Kind::circle) return axis_.cross(there->out);
  return pitch_ * axis_ + turn_ * axis_.cross(on_helix(*there).out);
}

Support Support::straight_ahead(const Vector3& place, const Vector3& vector) const {
  const auto start = is_curve() ? std::nullopt : nearest(place);
  if (!start) return *this;
  const Vector3 normal = axis(*start);
  const Vector3 way = vector - vector.dot(normal) * normal;
  if (!(way.norm() > 0)) return *this;
  const Vector3 direction = way.normalized();
  if (kind_ == Kind::plane) return line(*start, direction);
  Support helix = *this;
  helix.kind_ = Kind::helix;
  helix.start_ = normal;
  helix.points_.front() = *start - radius_ * normal;
  helix.pitch_ = direction.dot(axis_);
  helix.turn_ = direction.dot(axis_.cross(normal));
  return helix;
}

}  // namespace vspring
