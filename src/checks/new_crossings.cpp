#include "checks/new_crossings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "fairness/self_intersections.hpp"
#include "shape/box_tree.hpp"

namespace vspring {

namespace {

/// The faces that meet the box around moving faces. No other face can cross a moving one.
std::vector<Index> faces_around_what_moved(const PolygonMesh& mesh, const std::vector<Vector3>& positions,
                                           ThreadTeam& team) {
  const auto position = [&](Index i) -> const Vector3& { return positions[static_cast<std::size_t>(i)]; };
  const auto moved = [&](Index i) { return position(i) != mesh.position(i); };
  const auto faces = static_cast<std::size_t>(mesh.face_count());
  const auto box_of = [&](std::size_t begin, std::size_t end, Box& box) {
    for (std::size_t f = begin; f < end; ++f) {
      const auto face = mesh.face(static_cast<Index>(f));
      if (std::none_of(face.begin(), face.end(), moved)) continue;
      for (const Index i : face) box.extend(position(i)).extend(mesh.position(i));
    }
  };
  Box box;
  for (const Box& part : parallel_parts(team, faces, faces_per_task, Box(), box_of)) box.extend(part);
  const auto find_near = [&](std::size_t begin, std::size_t end, std::vector<Index>& near) {
    for (std::size_t f = begin; f < end; ++f) {
      Box own;
      for (const Index i : mesh.face(static_cast<Index>(f))) own.extend(position(i));
      if (own.intersects(box)) near.push_back(static_cast<Index>(f));
    }
  };
  std::vector<Index> all;
  for (const auto& near : parallel_parts(team, faces, faces_per_task, std::vector<Index>(), find_near))
    all.insert(all.end(), near.begin(), near.end());
  return all;
}

/// These faces, and all nodes, at `positions`.
PolygonMesh part_of(const PolygonMesh& mesh, const std::vector<Index>& faces, const std::vector<Vector3>& positions) {
  if (faces.size() == static_cast<std::size_t>(mesh.face_count())) {
    PolygonMesh whole = mesh;
    whole.set_positions(positions);
    return whole;
  }
  std::vector<Index> face_begin = {0};
  std::vector<Index> corners;
  for (const Index f : faces) {
    const auto face = mesh.face(f);
    corners.insert(corners.end(), face.begin(), face.end());
    face_begin.push_back(static_cast<Index>(corners.size()));
  }
  return {positions, std::move(face_begin), std::move(corners)};
}

}  // namespace

std::string new_crossings(const PolygonMesh& mesh, const std::vector<Vector3>& positions, const Context& context,
                          ThreadTeam& team) {
  try {
    const CancellationScope cancellation(context);
    end_if_cancelled();
    const std::vector<Index> numbers = faces_around_what_moved(mesh, positions, team);
    PolygonMesh part = part_of(mesh, numbers, positions);
    const auto now = self_intersections(part, context, team);
    if (now.empty() || context.cancelled()) return {};
    part.set_positions(mesh.positions());
    const std::size_t before = self_intersections(part, context, team).size();
    if (now.size() <= before || context.cancelled()) return {};
    const auto number = [&](Index face) { return numbers[static_cast<std::size_t>(face)]; };
    return fmt::format("{} pairs of faces cross each other (faces {} and {}, for one), {} did before", now.size(),
                       number(now.front().first), number(now.front().second), before);
  } catch (const Cancelled&) {
    return {};
  }
}

}  // namespace vspring
