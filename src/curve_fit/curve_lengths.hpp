#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "curve_fit/dense_curve.hpp"

namespace vspring {

/// Lengths along the chains of a curve as it is at first, by its chords. Cost: linear.
class CurveLengths {
 public:
  /// curve: must outlive this object.
  explicit CurveLengths(const DenseCurve& curve);

  /// The lengths of a chain up to each node, and in all.
  [[nodiscard]] std::span<const double> of(std::size_t chain) const { return sums_[chain]; }
  [[nodiscard]] double whole(std::size_t chain) const { return sums_[chain].back(); }
  /// The length from the first node of its chain to a place.
  [[nodiscard]] double at(const CurvePlace& place) const;
  /// The place of a chain at a length; its ends for what is beyond them.
  [[nodiscard]] CurvePlace place(std::size_t chain, double length) const;

 private:
  const DenseCurve& curve_;
  std::vector<std::vector<double>> sums_;
};

/// The length of all edges.
double length_of(const DenseCurve& curve);

/// The turn of all edges together, in radians. place(node): where nodes are taken to be. Cost: linear.
template <typename Place>
double total_turn(const DenseCurve& curve, Place place) {
  double sum = 0;
  for (std::uint32_t i = 0; i < curve.size(); ++i) {
    if (!curve.is_edge(i) || curve.before(i) == DenseCurve::none) continue;
    const Vector3 first = place(i) - place(curve.before(i));
    const Vector3 second = place(curve.next(i)) - place(i);
    sum += std::atan2(first.cross(second).norm(), first.dot(second));
  }
  return sum;
}

}  // namespace vspring
