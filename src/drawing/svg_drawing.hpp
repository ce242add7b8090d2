#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "vspring/polygon_curve.hpp"

namespace vspring {

using Vector2 = Eigen::Vector2d;

/// A curve at given positions.
struct DrawnCurve {
  const std::vector<PolygonCurve::Chain>& chains;
  std::span<const Vector3> positions;
};

/// Maps positions to the plane of the picture, at a size near one, so squares neither overflow nor vanish.
class CurveView {
 public:
  explicit CurveView(const DrawnCurve& curve);

  [[nodiscard]] Vector3 normalized(const Vector3& position) const { return (position / size_ - centre_) / extent_; }
  [[nodiscard]] Vector2 flat(const Vector3& vector) const { return {across_.dot(vector), up_.dot(vector)}; }
  /// Towards the eye.
  [[nodiscard]] Vector3 normal() const { return across_.cross(up_); }
  /// The length in units of the input that is 1 in the picture.
  [[nodiscard]] double unit() const { return size_ * extent_; }

 private:
  void turn(const Eigen::Matrix3d& spread);

  double size_ = 0;
  Vector3 centre_ = Vector3::Zero();
  double extent_ = 1;
  Vector3 across_ = Vector3::UnitX();
  Vector3 up_ = Vector3::UnitY();
};

/// The drawing of one curve, in the plane of the view.
struct Drawing {
  struct Run {
    std::vector<Vector2> nodes;
    std::vector<Vector2> curvatures;  ///< zero if there is none, as at ends
    std::vector<double> arc;          ///< the arc length from the first node on
    std::vector<double> bends;        ///< curvature, negative where the curve bends to the right
    double begin = 0;                 ///< the total length of earlier runs
    double length = 0;                ///< of the whole run
    bool closed = false;
  };
  std::vector<Run> runs;
  bool planar = true;  ///< whether the curve lies in the plane of the view
  double sharpest = 0;
};

Drawing drawing_of(const DrawnCurve& curve, const CurveView& view);

using Window = Eigen::AlignedBox<double, 2>;

/// The stretches of a drawing inside a window, each extended by one node at either end, so its line reaches the edge.
/// Arc lengths stay, and continue past the beginning of a closed run. Cost: linear.
Drawing part_inside(const Drawing& drawing, const Window& window);

}  // namespace vspring
