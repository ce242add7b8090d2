#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "vspring/types.hpp"

namespace vspring {

/// Coordinates in which a shape lies about the origin in a box of size between 1 and 2, so that no square overflows
/// or vanishes and one threshold fits shapes of every size. The scale is a power of two and costs no digits.
class Frame {
 public:
  Frame() = default;
  /// Positions must be finite.
  explicit Frame(const Eigen::AlignedBox<double, 3>& box) {
    if (box.isEmpty()) return;
    centre_ = box.min() / 2 + box.max() / 2;
    const double half = (box.max() / 2 - box.min() / 2).maxCoeff();
    // The limits keep the scale and its inverse finite.
    if (half > 0) scale_ = std::ldexp(1.0, -std::clamp(std::ilogb(half), -1001, 999) - 1);
  }

  [[nodiscard]] Vector3 to_local(const Vector3& position) const { return (position - centre_) * scale_; }
  /// The place that is the local origin.
  [[nodiscard]] const Vector3& centre() const noexcept { return centre_; }
  /// The local length of an outside length of 1.
  [[nodiscard]] double scale() const noexcept { return scale_; }

 private:
  Vector3 centre_ = Vector3::Zero();
  double scale_ = 1;
};

}  // namespace vspring
