#include "fairness/counted.hpp"

#include <algorithm>

namespace vspring {

std::vector<std::uint8_t> counted_faces(const PolygonMesh& mesh, const Constraints* constraints) {
  std::vector<std::uint8_t> counted(static_cast<std::size_t>(mesh.face_count()), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const bool usable = face.size() >= 3 &&
                        std::all_of(face.begin(), face.end(), [&](Index i) { return mesh.position(i).allFinite(); });
    const bool moves = constraints == nullptr ||
                       std::any_of(face.begin(), face.end(), [&](Index i) { return !constraints->position_fixed(i); });
    counted[static_cast<std::size_t>(f)] = usable && moves ? 1 : 0;
  }
  return counted;
}

std::vector<std::uint8_t> counted_nodes(const PolygonMesh& mesh, const std::vector<std::uint8_t>& faces) {
  std::vector<std::uint8_t> counted(static_cast<std::size_t>(mesh.node_count()), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (faces[static_cast<std::size_t>(f)] == 0) continue;
    for (const Index i : mesh.face(f)) counted[static_cast<std::size_t>(i)] = 1;
  }
  return counted;
}

std::vector<std::uint8_t> finite_nodes(const PolygonMesh& mesh) {
  std::vector<std::uint8_t> finite;
  finite.reserve(mesh.positions().size());
  for (const Vector3& position : mesh.positions()) finite.push_back(position.allFinite() ? 1 : 0);
  return finite;
}

Eigen::AlignedBox<double, 3> box_around(const PolygonMesh& mesh, const std::vector<std::uint8_t>& faces) {
  Eigen::AlignedBox<double, 3> box;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (faces[static_cast<std::size_t>(f)] == 0) continue;
    for (const Index i : mesh.face(f)) box.extend(mesh.position(i));
  }
  return box;
}

std::vector<Vector3> placed(std::span<const Vector3> positions, const Frame& frame) {
  std::vector<Vector3> result;
  result.reserve(positions.size());
  for (const Vector3& position : positions) result.push_back(frame.to_local(position));
  return result;
}

}  // namespace vspring
