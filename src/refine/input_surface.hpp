#pragma once

#include <array>
#include <span>
#include <vector>

#include "shape/box_tree.hpp"
#include "shape/triangles.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// A place on a surface or on one of its lines.
struct SurfacePlace {
  Vector3 place = Vector3::Zero();
  Index item = -1;  ///< the triangle or segment that has it
  Index face = -1;  ///< a face of the mesh that has it
  /// The nodes around, and their shares in the place; 0 for those that have none.
  std::array<Index, 3> nodes = {0, 0, 0};
  std::array<double, 3> shares = {0, 0, 0};
};

/// A straight piece of a line on a surface.
struct LineSegment {
  Index first;
  Index second;
  Index face;  ///< of the mesh, at the line
  Index line;
};

/// A surface that stays while another one on it changes.
class InputSurface {
 public:
  /// Triangles, segments and positions must outlive it. Cost: n log n.
  InputSurface(std::span<const Triangle> triangles, std::span<const LineSegment> segments,
               const std::vector<Vector3>& positions);

  /// The nearest place whose triangle does not face away from `normal`; of all triangles if each does. near: a triangle
  /// nearby, to save time, or −1.
  [[nodiscard]] SurfacePlace nearest(const Vector3& point, const Vector3& normal, Index near) const;
  /// The nearest place of a line that there is.
  [[nodiscard]] SurfacePlace nearest_on_line(const Vector3& point, Index line) const;
  /// The normal there: the mean of those at the nodes around, which weigh triangles by their area.
  [[nodiscard]] Vector3 normal_at(const SurfacePlace& place) const;
  [[nodiscard]] const Vector3& normal_at(Index node) const { return normals_[static_cast<std::size_t>(node)]; }

 private:
  [[nodiscard]] SurfacePlace place_of_triangle(const Vector3& point, Index triangle) const;
  [[nodiscard]] SurfacePlace place_of_segment(const Vector3& point, Index segment) const;

  std::span<const Triangle> triangles_;
  std::span<const LineSegment> segments_;
  const std::vector<Vector3>& positions_;
  std::vector<Vector3> areas_;    ///< per triangle, twice its vector area
  std::vector<Vector3> normals_;  ///< per node, unit or zero
  ThreadTeam team_;
  BoxTree triangle_tree_;
  BoxTree segment_tree_;
};

}  // namespace vspring
