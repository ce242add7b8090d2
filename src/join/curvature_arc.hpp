#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// A place on a curve in space, and the frame there: its tangent and two normals, which it carries without spin.
struct CurvePose {
  Vector3 place = Vector3::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< tangent, first and second normal

  [[nodiscard]] Vector3 tangent() const { return axes.col(0); }
  [[nodiscard]] Eigen::Matrix<double, 3, 2> normals() const { return axes.rightCols<2>(); }
};

/// A curve whose curvature is of third degree in arc length, by its components along both normals.
class CurvatureArc {
 public:
  static constexpr int degree = 3;
  /// Of the curvature, times the length of the arc: by the powers of u, the share of the length before a place.
  using Turns = Eigen::Matrix<double, 2, degree + 1>;

  CurvePose start;
  Turns turns = Turns::Zero();
  double length = 0;

  using PerTurn = Eigen::Matrix<double, 3, 2 * (degree + 1)>;

  /// A place, and how it follows each entry of the turns, column by column.
  struct Place {
    CurvePose pose;
    PerTurn turned = PerTurn::Zero();  ///< the axis about which the frame turns
    PerTurn lever = PerTurn::Zero();   ///< these axes one by one across the way from the start to where they act

    /// How the place moves. from: the start of the arc.
    [[nodiscard]] PerTurn moved(const Vector3& from) const { return turned.colwise().cross(pose.place - from) - lever; }
  };

  /// In how many steps its places are found so that each turns little.
  [[nodiscard]] int steps() const;
  /// Its places after so many steps of equal length, and at the start.
  [[nodiscard]] std::vector<Place> walk(int steps) const;
  /// The place at u, from those of walk().
  [[nodiscard]] Place at(double u, const std::vector<Place>& walked) const;

 private:
  [[nodiscard]] Vector3 spin(double u) const;
  [[nodiscard]] CurvePose stepped(const CurvePose& from, double u, double step) const;
  [[nodiscard]] Place advanced(const Place& from, double u, double step) const;
};

/// The tangent that the circle through three nodes has at the first of them. It leads to the next.
Vector3 tangent_at_first(const Vector3& first, const Vector3& next, const Vector3& last);

/// The arc of linear curvature that turns as three nodes or more do, in all and more in one half than in the other.
/// plane: the normal of that of a planar curve, which stays in it to the bit.
CurvatureArc linear_arc_near(std::span<const Vector3> nodes, const std::optional<Vector3>& plane);

}  // namespace vspring
