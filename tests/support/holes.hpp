#pragma once

// Meshes with holes, for tests of filling.

#include <algorithm>
#include <functional>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring::support {

/// The mesh without the nodes cut out and their faces.
inline PolygonMesh without(const PolygonMesh& mesh, const std::function<bool(const Vector3&)>& cut) {
  std::vector<Index> number(mesh.positions().size(), -1);
  MeshBuilder builder;
  std::vector<Index> corners;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (std::any_of(face.begin(), face.end(), [&](Index i) { return cut(mesh.position(i)); })) continue;
    corners.clear();
    for (const Index i : face) {
      Index& here = number[static_cast<std::size_t>(i)];
      if (here < 0) here = builder.add_node(mesh.position(i));
      corners.push_back(here);
    }
    builder.add_face(corners);
  }
  return builder.take();
}

/// The mesh without the nodes in a ball and their faces.
inline PolygonMesh without_ball(const PolygonMesh& mesh, const Vector3& centre, double radius) {
  return without(mesh, [&](const Vector3& p) { return (p - centre).norm() < radius; });
}

}  // namespace vspring::support
