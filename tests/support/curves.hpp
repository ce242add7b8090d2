#pragma once

// Shared by tests of curves: spacings, noise, starts, and distances from known curves.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "support/clothoid.hpp"
#include "support/positions.hpp"
#include "vspring/vspring.hpp"

namespace vspring::support {

/// Random numbers by splitmix64: the same everywhere.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(seed) {}

  double uniform(double low, double high) {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t word = state_;
    word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9U;
    word = (word ^ (word >> 27)) * 0x94d049bb133111ebU;
    word ^= word >> 31;
    return low + (high - low) * static_cast<double>(word >> 11) * 0x1p-53;
  }

  Vector3 in_cube(double half) {
    const double x = uniform(-half, half);
    const double y = uniform(-half, half);
    return {x, y, uniform(-half, half)};
  }

 private:
  std::uint64_t state_;
};

enum class Spacing { even, random, alternating, graded, jump };

/// Places from 0 to 1 of edges + 1 nodes. ratio: of the longest edge to the shortest, about; random ones come from the
/// seed.
inline std::vector<double> places(Spacing spacing, int edges, double ratio = 3, std::uint64_t seed = 1) {
  Draw draw(seed);
  std::vector<double> at(1, 0);
  for (int k = 0; k < edges; ++k) {
    double length = 1;
    switch (spacing) {
      case Spacing::even:
        break;
      case Spacing::random:
        length = draw.uniform(1, ratio);
        break;
      case Spacing::alternating:
        length = k % 2 == 0 ? 1 : ratio;
        break;
      case Spacing::graded:
        length = std::pow(ratio, static_cast<double>(k) / std::max(1, edges - 1));
        break;
      case Spacing::jump:
        length = k < edges / 2 ? 1 : ratio;
        break;
    }
    at.push_back(at.back() + length);
  }
  for (double& place : at) place /= at.back() == 0 ? 1 : at[static_cast<std::size_t>(edges)];
  at.back() = 1;
  return at;
}

inline std::vector<Vector3> straight(const Vector3& from, const Vector3& to, const std::vector<double>& at) {
  std::vector<Vector3> nodes;
  for (const double place : at) nodes.emplace_back(from + place * (to - from));
  nodes.back() = to;
  return nodes;
}

inline Vector3 lifted(const Eigen::Vector2d& point) { return {point.x(), point.y(), 0}; }
inline Vector3 heading(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

inline std::vector<Vector3> sampled(const reference::Clothoid& curve, const std::vector<double>& at) {
  std::vector<Vector3> nodes;
  for (const double place : at) nodes.push_back(lifted(curve.at(place * curve.length)));
  return nodes;
}

/// Moves the nodes without a fixed position by up to `amplitude` along every axis; planar: not along z.
inline std::vector<Vector3> noisy(std::vector<Vector3> nodes, const Constraints& constraints, double amplitude,
                                  std::uint64_t seed, bool planar) {
  Draw draw(seed);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Vector3 offset = draw.in_cube(amplitude);
    if (planar) offset.z() = 0;
    if (!constraints.position_fixed(static_cast<Index>(i))) nodes[i] += offset;
  }
  return nodes;
}

inline void hold(Constraints& constraints, const std::vector<Vector3>& nodes, Index node) {
  constraints.fix_position(node, nodes[static_cast<std::size_t>(node)]);
}

/// The ends held where they are.
inline Constraints held_ends(const std::vector<Vector3>& nodes) {
  Constraints constraints(static_cast<Index>(nodes.size()));
  hold(constraints, nodes, 0);
  hold(constraints, nodes, constraints.node_count() - 1);
  return constraints;
}

/// The ends held where they are, with these tangents.
inline Constraints held_ends(const std::vector<Vector3>& nodes, const Vector3& start, const Vector3& end) {
  Constraints constraints = held_ends(nodes);
  constraints.fix_tangent(0, start);
  constraints.fix_tangent(constraints.node_count() - 1, end);
  return constraints;
}

inline FairOptions to_the_end(Distribution distribution = Distribution::even, double tolerance = 1e-13) {
  FairOptions options;
  options.distribution = distribution;
  options.method = EquilibriumMethod{.tolerance = tolerance};
  return options;
}

inline std::vector<Vector3> faired(const std::vector<Vector3>& nodes, const Constraints& constraints,
                                   const FairOptions& options = to_the_end()) {
  return fair(PolygonCurve(nodes), constraints, options).positions;
}

/// The largest distance of a node from the clothoid in the plane z = 0; nodes follow each other along it.
inline double distance_from(const reference::Clothoid& curve, const std::vector<Vector3>& nodes) {
  double greatest = 0;
  double s = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i > 0) s += (nodes[i] - nodes[i - 1]).norm();
    Eigen::Vector2d point = curve.at(s);
    for (int pass = 0; pass < 6; ++pass) {
      const double angle = curve.angle_at(s);
      const Eigen::Vector2d away = nodes[i].head<2>() - point;
      const Eigen::Vector2d tangent(std::cos(angle), std::sin(angle));
      const double bent = 1 - curve.curvature_at(s) * (tangent.x() * away.y() - tangent.y() * away.x());
      const double step = away.dot(tangent) / std::max(0.5, bent);
      s = std::clamp(s + step, 0.0, curve.length);
      point = curve.at(s);
      if (std::abs(step) < 1e-15) break;
    }
    greatest = std::max(greatest, std::hypot((nodes[i].head<2>() - point).norm(), nodes[i].z()));
  }
  return greatest;
}

/// The order in which errors fall from one refinement by two to the next.
inline double order(double coarse, double fine) { return std::log2(coarse / fine); }

/// A motion that changes every axis, with a scale.
struct Motion {
  Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3(1, -2, 3).normalized()).toRotationMatrix();
  double scale = 1;
  Vector3 shift = Vector3(5, -3, 2);

  [[nodiscard]] Vector3 point(const Vector3& p) const { return scale * (turn * p) + shift; }
  [[nodiscard]] std::vector<Vector3> points(const std::vector<Vector3>& all) const {
    std::vector<Vector3> moved;
    for (const Vector3& p : all) moved.push_back(point(p));
    return moved;
  }
  [[nodiscard]] Constraints constraints(const Constraints& all) const {
    Constraints moved(all.node_count());
    for (Index i = 0; i < all.node_count(); ++i) {
      if (all.position_fixed(i)) moved.fix_position(i, point(all.position(i)));
      if (all.tangent_fixed(i)) moved.fix_tangent(i, turn * all.tangent(i));
      if (all.normal_fixed(i)) moved.fix_normal(i, turn * all.normal(i));
    }
    return moved;
  }
};

/// The profile of an aerofoil.
struct Profile {
  double camber;
  double camber_at;
  double thickness;
};

/// A point of a NACA profile of four digits; angle: from 0 at the tail over the upper side to 2π at the tail again.
inline Vector3 on_profile(const Profile& profile, double angle) {
  const double x = (1 + std::cos(angle)) / 2;
  const double height =
      5 * profile.thickness *
      (0.2969 * std::sqrt(x) - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1015 * x * x * x * x);
  const double p = profile.camber_at;
  const double m = profile.camber;
  const double front = x < p ? p : 1 - p;
  const double middle = m / (front * front) * ((1 - 2 * p) * (x < p ? 0 : 1) + 2 * p * x - x * x);
  const double slope = std::atan(2 * m / (front * front) * (p - x));
  const double side = angle < std::numbers::pi ? 1 : -1;
  return {x - side * height * std::sin(slope), middle + side * height * std::cos(slope), 0};
}

}  // namespace vspring::support
