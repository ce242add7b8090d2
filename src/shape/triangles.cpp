#include "shape/triangles.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/cancellation.hpp"

namespace vspring {

namespace {

Vector3 corner_product(const PolygonMesh& mesh, Index a, Index b, Index c) {
  return (mesh.position(b) - mesh.position(a)).cross(mesh.position(c) - mesh.position(a));
}

std::size_t fan_place(const PolygonMesh& mesh, std::span<const Index> face) {
  if (face.size() == 3) return 0;
  const auto node = [&](std::size_t k) { return face[k % face.size()]; };
  Vector3 whole = Vector3::Zero();
  for (std::size_t k = 1; k + 1 < face.size(); ++k) whole += corner_product(mesh, face[0], face[k], face[k + 1]);
  for (std::size_t first = 0; first < face.size(); ++first) {
    bool turns_over = false;
    for (std::size_t k = 1; k + 1 < face.size() && !turns_over; ++k)
      turns_over = corner_product(mesh, node(first), node(first + k), node(first + k + 1)).dot(whole) < 0;
    if (!turns_over) return first;
  }
  return 0;
}

}  // namespace

std::vector<Triangle> cut_into_triangles(const PolygonMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.corners().size());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    end_if_cancelled_at(static_cast<std::size_t>(f));
    const auto face = mesh.face(f);
    const bool finite = std::all_of(face.begin(), face.end(), [&](Index i) { return mesh.position(i).allFinite(); });
    if (face.size() < 3 || !finite) continue;
    const std::size_t first = fan_place(mesh, face);
    for (std::size_t k = 1; k + 1 < face.size(); ++k)
      triangles.push_back({{face[first], face[(first + k) % face.size()], face[(first + k + 1) % face.size()]}, f});
  }
  return triangles;
}

}  // namespace vspring
