#include "checks/new_crossings.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "fairness/self_intersections.hpp"

namespace vspring {

namespace {

/// The faces that meet the box around those that move, with all nodes. numbers: theirs in the mesh.
PolygonMesh around_what_moved(const PolygonMesh& mesh, const std::vector<Vector3>& positions,
                              std::vector<Index>& numbers) {
  const auto moved = [&](Index i) { return positions[static_cast<std::size_t>(i)] != mesh.position(i); };
  Eigen::AlignedBox3d box;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (std::none_of(face.begin(), face.end(), moved)) continue;
    for (const Index i : face) box.extend(positions[static_cast<std::size_t>(i)]).extend(mesh.position(i));
  }
  MeshBuilder builder;
  for (const Vector3& position : positions) builder.add_node(position);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    Eigen::AlignedBox3d own;
    for (const Index i : face) own.extend(positions[static_cast<std::size_t>(i)]);
    if (!own.intersects(box)) continue;
    builder.add_face(face);
    numbers.push_back(f);
  }
  return builder.take();
}

}  // namespace

std::string new_crossings(const PolygonMesh& mesh, const std::vector<Vector3>& positions, const Context& context,
                          ThreadTeam& team) {
  if (context.cancelled()) return {};
  std::vector<Index> numbers;
  PolygonMesh part = around_what_moved(mesh, positions, numbers);
  const auto now = self_intersections(part, context, team);
  if (now.empty() || context.cancelled()) return {};
  part.set_positions(mesh.positions());
  const std::size_t before = self_intersections(part, context, team).size();
  if (now.size() <= before || context.cancelled()) return {};
  const auto number = [&](Index face) { return numbers[static_cast<std::size_t>(face)]; };
  return fmt::format("{} pairs of faces cross each other ({} and {}, for one), {} did before", now.size(),
                     number(now.front().first), number(now.front().second), before);
}

}  // namespace vspring
