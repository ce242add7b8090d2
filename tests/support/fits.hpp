#pragma once

// Shapes and points for tests of fits.

#include <cmath>
#include <numbers>
#include <vector>

#include "support/curves.hpp"
#include "support/methods.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::support {

inline FitOptions to_equilibrium(double weight, double tolerance = 1e-5) {
  FitOptions options;
  options.criterion = Weight{weight};
  options.fair.method = equilibrium_alone(tolerance);
  return options;
}

inline FitOptions by_sweeps(double weight, double step_tolerance = 1e-8, int iterations = 20000) {
  FitOptions options;
  options.criterion = Weight{weight};
  options.fair.method = SweepMethod{.step_tolerance = step_tolerance, .max_iterations = iterations};
  return options;
}

/// Points at random on the unit sphere, not further than 60° from the pole.
inline ScatteredPoints on_the_sphere(int count, double noise = 0) {
  Draw draw(5);
  ScatteredPoints points;
  while (static_cast<int>(points.positions.size()) < count) {
    const Vector3 direction = draw.in_cube(1);
    if (direction.norm() > 1 || direction.z() < 0.5 * direction.norm() || direction.norm() < 0.01) continue;
    points.positions.push_back((1 + draw.uniform(-noise, noise)) * direction.normalized());
  }
  return points;
}

inline PolygonCurve circle(int nodes, double radius, bool tilted = false) {
  std::vector<Vector3> positions;
  for (int i = 0; i < nodes; ++i) {
    const double angle = 2 * std::numbers::pi * i / nodes;
    positions.emplace_back(radius * heading(angle) + Vector3(0, 0, tilted ? 0.3 * std::sin(2 * angle) : 0));
  }
  return PolygonCurve(std::move(positions), true);
}

inline PolygonCurve segment(int edges) {
  return PolygonCurve(straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, edges)));
}

/// A shape, its constraints and the points.
template <typename Shape>
struct FitSpecimen {
  Shape start;
  Constraints held;
  ScatteredPoints points;

  [[nodiscard]] FitResult fit(const FitOptions& options) const { return vspring::fit(start, held, points, options); }
};

/// A wave with noise, its nodes the points.
inline FitSpecimen<PolygonCurve> noisy_wave(int edges, double noise = 0.002) {
  std::vector<Vector3> nodes;
  for (const double x : places(Spacing::even, edges))
    nodes.emplace_back(x, 0.1 * std::sin(2 * std::numbers::pi * x), 0);
  const Constraints held = held_ends(nodes);
  nodes = noisy(nodes, held, noise, 1, true);
  return {PolygonCurve(nodes), held, {.positions = nodes}};
}

/// A cap of the unit sphere pressed flat, its rim held with the normals of the sphere, and points.
inline FitSpecimen<PolygonMesh> flat_cap(Index nodes, const ScatteredPoints& points) {
  const PolygonMesh flat = flattened(generate::cap({.nodes = nodes, .radius = 1, .half_angle = 60}), 60, 0);
  return {flat, held_boundary(flat, radial), points};
}

}  // namespace vspring::support
