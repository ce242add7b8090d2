#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "vspring/export.hpp"
#include "vspring/types.hpp"

namespace VSPRING_API vspring {

/// What nodes slide on: a plane, the outside of a cylinder, a line, a circle or a polyline. In units of the shape. See
/// Constraints::slide_on().
class Support {
 public:
  /// What it is.
  enum class Kind : std::uint8_t { plane, cylinder, line, circle, polyline, helix };

  /// The plane through a point, with a normal of any length but zero. Throws Error(unusable_constraint) for a normal of
  /// zero, and for numbers that are not finite.
  [[nodiscard]] static Support plane(const Vector3& point, const Vector3& normal);
  /// The cylinder around an axis, which goes through a point in a direction of any length but zero. Throws as plane(),
  /// and for a radius that is not positive.
  [[nodiscard]] static Support cylinder(const Vector3& point, const Vector3& direction, double radius);
  /// The line through a point, in a direction of any length but zero; it has no ends. Throws as plane().
  [[nodiscard]] static Support line(const Vector3& point, const Vector3& direction);
  /// The circle around a centre, in the plane across a normal of any length but zero. Throws as cylinder().
  [[nodiscard]] static Support circle(const Vector3& centre, const Vector3& normal, double radius);
  /// The polyline through points, at least two, in their order; it ends with the first and the last of them unless it
  /// is closed, when the last one joins the first. Throws Error(unusable_constraint) for fewer points, for points that
  /// all lie in one place, and for numbers that are not finite.
  [[nodiscard]] static Support polyline(std::vector<Vector3> points, bool closed = false);

  /// The curve on a plane or a cylinder that goes straight ahead along it, in the direction that a vector has there,
  /// through the place that is nearest to `place`: a line, or on a cylinder mostly a helix. Itself where it is a curve,
  /// or the vector has no direction along it.
  [[nodiscard]] Support straight_ahead(const Vector3& place, const Vector3& vector) const;

  /// What it is.
  [[nodiscard]] Kind kind() const noexcept { return kind_; }
  /// Whether nodes have one way along it only, as on a line, a circle or a polyline.
  [[nodiscard]] bool is_curve() const noexcept { return kind_ != Kind::plane && kind_ != Kind::cylinder; }

  /// The place on it that is nearest to `place`; none where all are as near, as from the centre of a circle or the axis
  /// of a cylinder. Cost: constant; of a polyline linear in its points.
  [[nodiscard]] std::optional<Vector3> nearest(const Vector3& place) const;
  /// At the place on it that is nearest to `place`, of unit length: the normal of a plane or a cylinder, the direction
  /// of a curve. Zero where there is no nearest place. Cost: that of nearest().
  [[nodiscard]] Vector3 axis(const Vector3& place) const;

  /// The support where each place p has become (p − origin) × scale.
  [[nodiscard]] Support in_frame(const Vector3& origin, double scale) const;

  /// Its mirror image in the plane through a point with a normal of unit length.
  [[nodiscard]] Support mirrored(const Vector3& point, const Vector3& normal) const;

  /// Whether both are the same, to the last bit.
  bool operator==(const Support& other) const = default;

 private:
  Support(Kind kind, std::vector<Vector3> points, const Vector3& axis, double radius, bool closed)
      : kind_(kind), closed_(closed), points_(std::move(points)), axis_(axis), radius_(radius) {}

  /// A place on a cylinder around axis_, by what lies between it and points_[0].
  struct OnCylinder {
    double ahead;
    Vector3 out;  ///< from the axis, of unit length
  };
  [[nodiscard]] std::optional<OnCylinder> on_cylinder(const Vector3& place) const;
  /// The place on the helix nearest to one on its cylinder, which is unrolled for this.
  [[nodiscard]] OnCylinder on_helix(const OnCylinder& place) const;

  struct OnPolyline {
    Vector3 place;
    Vector3 way;  ///< of the segment, not zero
  };
  [[nodiscard]] OnPolyline on_polyline(const Vector3& place) const;

  Kind kind_;
  bool closed_;                  ///< of a polyline
  std::vector<Vector3> points_;  ///< of a polyline; of all others one: a point of it, of its axis, or its centre
  Vector3 axis_;                 ///< the normal or the direction, of unit length
  double radius_;
  // Of a helix: where it begins, straight out from points_[0], and how far it then goes ahead and around per length.
  Vector3 start_ = Vector3::Zero();
  double pitch_ = 0;
  double turn_ = 0;
};

}  // namespace vspring
