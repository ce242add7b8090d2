#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring::cli {

/// The rows are the directions to the right, up and towards the eye, which is that way.
[[nodiscard]] Eigen::Matrix3d seen_from(const Vector3& direction, const Vector3& up);

/// The rows are the directions to the right, up and towards the eye: from above and in front, z upwards.
[[nodiscard]] Eigen::Matrix3d default_view();

/// From where a curve is seen: along the normal of its best plane, which is that of x and y for what lies there.
struct Plane {
  Eigen::Matrix3d rows = Eigen::Matrix3d::Identity();
  bool planar = true;
};

/// points: in a box of side 1. Cost: linear.
[[nodiscard]] Plane plane_of(const std::vector<Vector3>& points);

/// A part of what is shown, with some of its surroundings.
struct ShownPart {
  Vector3 middle;
  double width;   ///< as it is seen
  double height;  ///< as it is seen
  double radius;  ///< of the sphere about the middle around all of it
};

/// Where a picture looks.
struct Framing {
  Eigen::Matrix3d view;           ///< see seen_from()
  std::optional<ShownPart> part;  ///< empty: all is shown
};

// Two shapes of the same faces or chains, whose size is about 1. Where the box of what moved (by more than a millionth)
// has at most half the diagonal of the box of all, that is the part: 1.6 times as large. Positions are finite. Cost:
// linear.

/// view: given by the user, or empty: then a part is seen along the mean normal of its faces, weighted by area (from
/// the other side where the rest would hide it there; as by default where it goes all round the shape, or all is
/// shown).
[[nodiscard]] Framing framing_of(const PolygonMesh& mesh, std::span<const Vector3> before,
                                 std::span<const Vector3> after, const std::optional<Eigen::Matrix3d>& view);
[[nodiscard]] Framing framing_of(const std::vector<PolygonCurve::Chain>& chains, std::span<const Vector3> before,
                                 std::span<const Vector3> after, const Eigen::Matrix3d& view);

/// The box of that part of a curve; none where all is to be shown, chains are not the same or nodes not finite.
[[nodiscard]] std::optional<Eigen::AlignedBox<double, 3>> moved_part(const PolygonCurve& before,
                                                                     const PolygonCurve& after);

[[nodiscard]] bool same_chains(const PolygonCurve& curve, const PolygonCurve& other);

}  // namespace vspring::cli
