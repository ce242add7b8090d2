#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "vspring/error.hpp"
#include "vspring/fill.hpp"

namespace vspring {

namespace {

/// The mesh of the file with the patches of `filled`, whose other nodes may be welded.
PolygonMesh with_patches(const PolygonMesh& file, const FilledHoles& filled) {
  const PolygonMesh& mesh = filled.mesh;
  std::vector<Vector3> positions = file.positions();
  positions.insert(positions.end(), filled.positions.begin() + file.node_count(), filled.positions.end());
  std::vector<Index> face_begin = file.face_begin();
  std::vector<Index> corners = file.corners();
  for (Index f = file.face_count(); f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    corners.insert(corners.end(), face.begin(), face.end());
    face_begin.push_back(static_cast<Index>(corners.size()));
  }
  return {std::move(positions), std::move(face_begin), std::move(corners)};
}

std::string group_of(const Hole& hole, const SurfaceFile& file) {
  const auto& added = file.added.groups;
  const auto is_taken = [&](const std::string& name) {
    return file.groups.contains(name) ||
           std::any_of(added.begin(), added.end(), [&](const auto& group) { return group.second == name; });
  };
  std::string name = fmt::format("hole_{}", hole.rim.front());
  while (is_taken(name)) name += "_";
  return name;
}

}  // namespace

void add_patches(SurfaceFile& file, const FilledHoles& filled) {
  const auto nodes = static_cast<Index>(filled.node_like.size());
  const auto faces = static_cast<Index>(filled.face_like.size());
  if (filled.mesh.node_count() - nodes != file.mesh.node_count() ||
      filled.mesh.face_count() - faces != file.mesh.face_count())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("patches are of a mesh of {} nodes and {} faces, but the file has {} and {}",
                            filled.mesh.node_count() - nodes, filled.mesh.face_count() - faces, file.mesh.node_count(),
                            file.mesh.face_count()));
  file.mesh = with_patches(file.mesh, filled);
  AddedElements& added = file.added;
  for (const Hole& hole : filled.holes) {
    if (hole.face_count > 0) added.groups.emplace_back(hole.first_face, group_of(hole, file));
  }
  added.node_like.insert(added.node_like.end(), filled.node_like.begin(), filled.node_like.end());
  added.face_like.insert(added.face_like.end(), filled.face_like.begin(), filled.face_like.end());
}

}  // namespace vspring
