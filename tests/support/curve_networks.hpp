#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "vspring/vspring.hpp"

namespace vspring::support::networks {

inline constexpr double pi = std::numbers::pi;

/// Curves that share no node: where they meet has to be found.
class Curves {
 public:
  void add(const std::function<Vector3(double)>& at, int nodes = 25) {
    PolygonCurve::Chain chain;
    for (int k = 0; k < nodes; ++k) {
      chain.nodes.push_back(static_cast<Index>(places_.size()));
      places_.push_back(at(static_cast<double>(k) / (nodes - 1)));
    }
    chains_.push_back(std::move(chain));
  }
  void add_line(const Vector3& a, const Vector3& b) {
    add([=](double t) { return Vector3(a + t * (b - a)); }, 2);
  }
  /// Lines of constant u and v of a surface.
  void add_grid(const std::function<Vector3(double, double)>& at, int nu, int nv, int nodes = 25) {
    for (int i = 0; i <= nu; ++i) add([&](double t) { return at(static_cast<double>(i) / nu, t); }, nodes);
    for (int j = 0; j <= nv; ++j) add([&](double t) { return at(t, static_cast<double>(j) / nv); }, nodes);
  }
  [[nodiscard]] PolygonCurve take() const { return {places_, chains_}; }

 private:
  std::vector<Vector3> places_;
  std::vector<PolygonCurve::Chain> chains_;
};

inline Vector3 on_sphere(double u, double v) {
  const double a = 1.6 * (u - 0.5);
  const double b = 1.6 * (v - 0.5);
  return {std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b)};
}

inline Vector3 on_torus(double u, double v) {
  const double a = 0.9 * pi * u;
  const double b = 0.8 * pi * v + 0.3;
  return {(3 + std::cos(b)) * std::cos(a), (3 + std::cos(b)) * std::sin(a), std::sin(b)};
}

inline double from_unit_sphere(const std::vector<Vector3>& positions) {
  double most = 0;
  for (const Vector3& place : positions) most = std::max(most, std::abs(place.norm() - 1));
  return most;
}

inline double from_torus(const std::vector<Vector3>& positions) {
  double most = 0;
  for (const Vector3& place : positions)
    most = std::max(most, std::abs(std::hypot(std::hypot(place.x(), place.y()) - 3, place.z()) - 1));
  return most;
}

inline SpanOptions exact() {
  SpanOptions options;
  options.fair.method = EquilibriumMethod{.tolerance = 1e-9};
  return options;
}

inline Index count(const SpannedCurves& spanned, LoopState state) {
  return static_cast<Index>(std::ranges::count(spanned.loops, state, &NetworkLoop::state));
}

inline void expect_no_defects(const PolygonMesh& mesh) {
  for (const Defect& defect : check(mesh)) ADD_FAILURE() << defect.message();
}

inline double volume(const SpannedCurves& spanned) {
  double sum = 0;
  for (Index f = 0; f < spanned.mesh.face_count(); ++f) {
    const auto face = spanned.mesh.face(f);
    const auto at = [&](std::size_t k) { return spanned.positions[static_cast<std::size_t>(face[k])]; };
    for (std::size_t k = 1; k + 1 < face.size(); ++k) sum += at(0).dot(at(k).cross(at(k + 1))) / 6;
  }
  return sum;
}

/// Three great circles.
inline Curves octahedron() {
  Curves curves;
  for (int axis = 0; axis < 3; ++axis)
    curves.add(
        [=](double t) {
          Vector3 place = Vector3::Zero();
          place[axis] = std::cos(2 * pi * t);
          place[(axis + 1) % 3] = std::sin(2 * pi * t);
          return place;
        },
        49);
  return curves;
}

/// Meridians and parallels of a cylinder of radius 1.
inline Curves cylinder(int meridians, int parallels) {
  Curves curves;
  for (int k = 0; k < meridians; ++k) {
    const double a = 2 * pi * k / meridians;
    curves.add_line({std::cos(a), std::sin(a), 0}, {std::cos(a), std::sin(a), 3});
  }
  for (int k = 0; k < parallels; ++k)
    curves.add([=](double t) { return Vector3(std::cos(2 * pi * t), std::sin(2 * pi * t), 3.0 * k / (parallels - 1)); },
               49);
  return curves;
}

inline Curves cube() {
  Curves curves;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 4; ++side) {
      Vector3 from = Vector3::Zero();
      from[(axis + 1) % 3] = side % 2;
      from[(axis + 2) % 3] = side < 2 ? 0 : 1;
      Vector3 to = from;
      to[axis] = 1;
      curves.add_line(from, to);
    }
  }
  return curves;
}

}  // namespace vspring::support::networks
