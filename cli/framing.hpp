#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring::cli {

/// The view from a direction. Its rows are the directions to the right, up and towards the eye.
[[nodiscard]] Eigen::Matrix3d seen_from(const Vector3& direction, const Vector3& up);

/// The default view: from above and in front, z upwards. Rows as for seen_from().
[[nodiscard]] Eigen::Matrix3d default_view();

/// The view of a curve: along the normal of its best plane; for a curve in the plane of x and y along z.
struct Plane {
  Eigen::Matrix3d rows = Eigen::Matrix3d::Identity();
  bool planar = true;
};

/// points: in a box of side 1. Cost: linear.
[[nodiscard]] Plane plane_of(const std::vector<Vector3>& points);

/// A part of the shapes, with some of its surroundings.
struct ShownPart {
  Vector3 middle;
  double width;   ///< in the view
  double height;  ///< in the view
  double radius;  ///< of the sphere about the middle that contains it
};

/// What a picture looks at.
struct Framing {
  Eigen::Matrix3d view;           ///< see seen_from()
  std::optional<ShownPart> part;  ///< empty: all is shown
};

// For two shapes of the same faces or chains, of size about 1 and with finite positions. If the box of the nodes that
// moved (by more than 1e-6) has at most half the diagonal of the whole, the part shown is that box, enlarged 1.6 times.
// Cost: linear.

/// view: given by the user; empty: along the mean normal of the part's faces, weighted by area, or from the opposite
/// side if other faces would hide it. The default view if the part goes all round the shape, or all is shown.
[[nodiscard]] Framing framing_of(const PolygonMesh& mesh, std::span<const Vector3> before,
                                 std::span<const Vector3> after, const std::optional<Eigen::Matrix3d>& view);
[[nodiscard]] Framing framing_of(const std::vector<PolygonCurve::Chain>& chains, std::span<const Vector3> before,
                                 std::span<const Vector3> after, const Eigen::Matrix3d& view);

/// The box of the part of a curve to show; none if all is to be shown, chains differ or nodes are not finite.
[[nodiscard]] std::optional<Eigen::AlignedBox<double, 3>> moved_part(const PolygonCurve& before,
                                                                     const PolygonCurve& after);

[[nodiscard]] bool same_chains(const PolygonCurve& curve, const PolygonCurve& other);

}  // namespace vspring::cli
