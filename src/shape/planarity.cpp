#include "shape/planarity.hpp"

#include <algorithm>
#include <cmath>

#include "base/dense_algebra.hpp"
#include "shape/frame.hpp"

namespace vspring {

std::optional<Vector3> plane_normal(std::span<const Vector3> positions) {
  constexpr double flat = 1e-9;
  constexpr double unseen = 1e-12;
  Eigen::AlignedBox<double, 3> box;
  for (const Vector3& position : positions) box.extend(position);
  const Frame frame(box);
  Vector3 mean = Vector3::Zero();
  for (const Vector3& position : positions) mean += frame.to_local(position) / static_cast<double>(positions.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3& position : positions) {
    const Vector3 from_mean = frame.to_local(position) - mean;
    spread += from_mean * from_mean.transpose();
  }
  const Eigen::Matrix3d axes = principal_axes(spread);
  Vector3 normal = axes.col(0).normalized();
  const Vector3 across = axes.col(1).normalized();
  // The square roots of eigenvalues are too inexact for thickness and width, so both are measured.
  double width = 0;
  for (const Vector3& position : positions) {
    const Vector3 from_mean = frame.to_local(position) - mean;
    if (std::abs(from_mean.dot(normal)) > flat) return std::nullopt;
    width = std::max(width, std::abs(from_mean.dot(across)));
  }
  if (!(width > flat)) return std::nullopt;
  // Shapes in a coordinate plane stay there to the bit.
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (std::abs(normal[k]) < unseen) normal[k] = 0;
  }
  normal.normalize();
  Eigen::Index greatest = 0;
  normal.cwiseAbs().maxCoeff(&greatest);
  return normal[greatest] < 0 ? Vector3(-normal) : normal;
}

}  // namespace vspring
