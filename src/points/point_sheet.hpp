#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shape/point_tree.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// The surface on which scattered points lie, as far as those about a place tell, and where it ends.
class PointSheet {
 public:
  /// What the points about one of them say.
  struct About {
    bool ends = false;  ///< in some direction of the surface there are none within 75° of it
    Vector3 out;        ///< that direction, of unit length, where it ends
    Vector3 centre;     ///< of the plane that is nearest to them
    Vector3 normal;
    [[nodiscard]] Vector3 foot(const Vector3& place) const { return place - (place - centre).dot(normal) * normal; }
  };

  /// least_radius: how far around a point others are looked at, at least; further where they are far apart. normals:
  /// one per point, or none; points that face away do not count. Points must be finite and stay where they are. Cost:
  /// n log n.
  PointSheet(std::span<const Vector3> points, std::span<const Vector3> normals, double least_radius);

  /// How far around a point others are looked at: half of all have 24 within that.
  [[nodiscard]] double radius() const noexcept { return radius_; }

  /// None where a point has hardly others about it. Cost: that of the points within the radius, where it is at an end;
  /// else of some 50 of them.
  [[nodiscard]] std::optional<About> about(Index point) const;

 private:
  [[nodiscard]] bool face_alike(Index a, Index b) const;
  [[nodiscard]] std::vector<Index> thinned(double cell) const;
  void look_for_end(Index point, const std::vector<Vector3>& others, About& about) const;

  std::span<const Vector3> points_;
  std::span<const Vector3> normals_;
  PointTree tree_;
  double radius_;
  std::vector<Index> few_;  ///< of the points, some in every place
  std::vector<Vector3> places_of_few_;
  std::optional<PointTree> tree_of_few_;
};

}  // namespace vspring
