#pragma once

// Halves and wholes about a plane, for tests of symmetry.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "support/curves.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::support {

inline const MirrorPlane x_is_0 = parse_plane("x");

/// Part of the unit sphere about the pole, over a rectangle by stereographic projection: a half, with x from 0 on, or
/// the whole.
inline PolygonMesh sphere_part(generate::Faces faces, bool half, int cells = 10) {
  const PolygonMesh flat =
      generate::plane({.columns = half ? cells : 2 * cells, .rows = 2 * cells, .faces = faces}, half ? 0.6 : 1.2, 1.2);
  std::vector<Vector3> positions;
  for (const Vector3& p : flat.positions()) {
    const double x = half ? p.x() : p.x() - 0.6;
    const double square = x * x + p.y() * p.y();
    positions.push_back(Vector3(2 * x, 2 * p.y(), 1 - square) / (1 + square));
  }
  return with_positions(flat, std::move(positions));
}

/// Moves free nodes by noise; those on the plane in it.
inline PolygonMesh disturbed(const PolygonMesh& mesh, const Constraints& constraints, double noise,
                             const MirrorPlane& plane) {
  Draw draw(5);
  std::vector<Vector3> positions = mesh.positions();
  for (Index i = 0; i < mesh.node_count(); ++i) {
    Vector3& place = positions[static_cast<std::size_t>(i)];
    const bool on_plane = std::abs(plane.distance(place)) < 1e-12;
    const Vector3 move = draw.in_cube(noise);
    if (constraints.position_fixed(i)) continue;
    place += move;
    if (on_plane) place = plane.projected(place);
  }
  return with_positions(mesh, std::move(positions));
}

/// Holds the boundary of the whole, with the sphere's normals.
inline Constraints held_rim(const Symmetric<PolygonMesh>& shape) { return held_boundary(shape.whole, radial); }

template <typename Shape>
void expect_mirror_images(const Symmetric<Shape>& shape, const std::vector<Vector3>& positions) {
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vector3 image = shape.plane.mirrored(positions[i]);
    const Vector3& partner = positions[static_cast<std::size_t>(shape.partner[i])];
    for (int k = 0; k < 3; ++k) EXPECT_EQ(image[k], partner[k]) << "node " << i;
  }
}

/// Nodes of the unit circle from one angle to another, in degrees, with noise inside.
inline PolygonCurve arc(double from, double to, double noise, int edges = 40) {
  Draw draw(3);
  std::vector<Vector3> nodes;
  for (int k = 0; k <= edges; ++k) {
    const double angle = (from + (to - from) * k / edges) * std::numbers::pi / 180;
    const double radius = 1 + (k == 0 || k == edges ? 0 : draw.uniform(-noise, noise));
    nodes.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  return PolygonCurve(std::move(nodes));
}

inline double distance_from_circle(const std::vector<Vector3>& nodes) { return distance_from_unit_sphere(nodes); }

inline void hold_on_circle(Constraints& constraints, const PolygonCurve& curve, Index node) {
  const Vector3& place = curve.position(node);
  constraints.fix_position(node, place);
  constraints.fix_tangent(node, {-place.y(), place.x(), 0});
}

}  // namespace vspring::support
