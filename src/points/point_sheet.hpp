#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shape/point_tree.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Estimates, from the points around a place, the surface on which scattered points lie, and where it ends.
class PointSheet {
 public:
  /// The surface at a point, by the points around it.
  struct About {
    bool ends = false;  ///< no points within 75° of some direction in the surface
    Vector3 out;        ///< that direction, of unit length, if it ends
    Vector3 centre;     ///< of the best plane through them
    Vector3 normal;
    [[nodiscard]] Vector3 foot(const Vector3& place) const { return place - (place - centre).dot(normal) * normal; }
  };

  /// least_radius: least distance up to which other points are used; more if they are far apart. normals: one per
  /// point, or none; points that face away do not count. Points must be finite and outlive this object. Cost: n log n.
  PointSheet(std::span<const Vector3> points, std::span<const Vector3> normals, double least_radius);

  /// The distance up to which other points are used: half of all points have 24 within it.
  [[nodiscard]] double radius() const noexcept { return radius_; }

  /// None if a point has hardly others around it. Cost: linear in the points within the radius at an end, else in about
  /// 50 of them.
  [[nodiscard]] std::optional<About> about(Index point) const;

 private:
  [[nodiscard]] bool face_alike(Index a, Index b) const;
  [[nodiscard]] std::vector<Index> thinned(double cell) const;
  void look_for_end(Index point, const std::vector<Vector3>& others, About& about) const;

  std::span<const Vector3> points_;
  std::span<const Vector3> normals_;
  PointTree tree_;
  double radius_;
  std::vector<Index> few_;  ///< a sparse selection of the points
  std::vector<Vector3> places_of_few_;
  std::optional<PointTree> tree_of_few_;
};

}  // namespace vspring
