#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "vspring/vspring.hpp"

namespace vspring::bench {

/// The cap of the unit sphere that the flat start is to become.
inline PolygonMesh exact_cap(Index nodes) { return generate::cap({.nodes = nodes, .half_angle = 60, .jitter = 0.3}); }

/// Holds positions and normals of the rim of a cap of the unit sphere.
inline Constraints hold_rim_on_sphere(const PolygonMesh& cap) {
  Constraints constraints(cap.node_count());
  fix_boundary_positions(constraints, cap);
  for (Index i = 0; i < cap.node_count(); ++i) {
    if (constraints.position_fixed(i)) constraints.fix_normal(i, cap.position(i));
  }
  return constraints;
}

/// The cap pressed flat at the height of its rim, with noise of that length inside. Angles along meridians become
/// radii, so that nothing folds over.
inline PolygonMesh flat_cap(PolygonMesh cap, double noise) {
  const double rim = std::numbers::pi / 3;
  std::vector<Vector3> flat = cap.positions();
  for (Vector3& p : flat) {
    const double radius = std::hypot(p.x(), p.y());
    const double scale = radius > 0 ? std::atan2(radius, p.z()) / rim * std::sin(rim) / radius : 0;
    p = Vector3(scale * p.x(), scale * p.y(), std::cos(rim));
  }
  cap.set_positions(std::move(flat));
  return generate::add_noise(cap, noise, 5);
}

/// The largest distance of a position from the unit sphere.
inline double distance_from_sphere(const std::vector<Vector3>& positions) {
  double greatest = 0;
  for (const Vector3& p : positions) greatest = std::max(greatest, std::abs(p.norm() - 1));
  return greatest;
}

}  // namespace vspring::bench
