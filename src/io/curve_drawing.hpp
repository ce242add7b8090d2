#pragma once

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

/// Shows positions in the plane of the picture, at a size near one so that squares neither overflow nor vanish.
class CurveView {
 public:
  explicit CurveView(const DrawnCurve& curve);

  [[nodiscard]] Vector3 normalized(const Vector3& position) const { return (position / size_ - centre_) / extent_; }
  [[nodiscard]] Vector2 flat(const Vector3& vector) const { return {across_.dot(vector), up_.dot(vector)}; }

 private:
  void turn(const Eigen::Matrix3d& spread);

  double size_ = 0;
  Vector3 centre_ = Vector3::Zero();
  double extent_ = 1;
  Vector3 across_ = Vector3::UnitX();
  Vector3 up_ = Vector3::UnitY();
};

/// What is drawn of one curve, in the plane of the view.
struct Drawing {
  struct Run {
    std::vector<Vector2> nodes;
    std::vector<Vector2> curvatures;  ///< zero where there is none, as at ends
    bool closed;
  };
  std::vector<Run> runs;
  double sharpest = 0;
};

Drawing drawing_of(const DrawnCurve& curve, const CurveView& view);

}  // namespace vspring
