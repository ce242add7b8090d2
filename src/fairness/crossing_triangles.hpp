#pragma once

#include <optional>
#include <vector>

#include "shape/box_tree.hpp"
#include "shape/triangles.hpp"

namespace vspring {

/// The triangles of a mesh, and which of them cross each other.
class CrossingTriangles {
 public:
  explicit CrossingTriangles(const PolygonMesh& mesh);

  [[nodiscard]] const std::vector<Triangle>& triangles() const noexcept { return triangles_; }
  /// The positions of the nodes, scaled so that the coordinates of triangles are at most 2.
  [[nodiscard]] const std::vector<Vector3>& positions() const noexcept { return positions_; }
  [[nodiscard]] Box box(const Triangle& triangle) const;

  /// Whether two triangles pass through each other along some length. Two that share an edge do not cross.
  [[nodiscard]] bool cross(const Triangle& a, const Triangle& b) const;

 private:
  /// The corners of a triangle, first the one that is alone on its side of another's plane.
  struct Corners {
    Vector3 alone;
    Vector3 second;
    Vector3 third;
  };

  [[nodiscard]] const Vector3& at(Index node) const { return positions_[static_cast<std::size_t>(node)]; }
  /// None unless it has corners on both sides of the plane of `other`.
  [[nodiscard]] std::optional<Corners> straddling(const Triangle& triangle, const Triangle& other) const;

  std::vector<Triangle> triangles_;
  std::vector<Vector3> positions_;
};

}  // namespace vspring
