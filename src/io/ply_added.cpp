// PLY with added nodes and faces.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "io/file_normals.hpp"
#include "io/ply.hpp"
#include "io/ply_rows.hpp"
#include "io/rewriter.hpp"

namespace vspring {

std::string PlySource::extended(std::string bytes, const Rewrite& rewrite) const {
  const InputFile grown = {file.name, std::move(bytes)};
  return header.encoding == PlyEncoding::text ? extended_by<PlyText>(grown, rewrite)
                                              : extended_by<PlyBinary>(grown, rewrite);
}

template <typename Data>
std::string PlySource::extended_by(const InputFile& grown, const Rewrite& rewrite) const {
  const PlyHeader now = read_ply_header(grown);
  const PlyElement& nodes = *now.find("vertex");
  const PlyElement* const faces = now.find("face");
  const PlyElement* const strips = now.find("tristrips");
  if (faces == nullptr || (strips != nullptr && strips->count > 0))
    file.refuse(
        "it has faces in strips of triangles, and no place for others; write it in another format, such as OBJ");
  const SurfaceFile& surface = rewrite.surface;
  const AddedElements& added = surface.added;
  std::vector<Vector3> normals;
  if (has_normals() && !any_whole(3))
    normals = normals_of_added(surface.mesh, surface.normals, rewrite.positions, added.node_like);

  const RowMaker<Data> node_rows(grown, now, nodes);
  std::string more_nodes;
  for (std::size_t k = 0; k < added.node_like.size(); ++k) {
    const std::size_t node = mesh.positions().size() + k;
    std::vector<std::string> values = node_rows.like(added.node_like[k]);
    for (std::size_t field = 0; field < (normals.empty() ? 3 : 6); ++field) {
      const auto property = static_cast<std::size_t>(fields[field]);
      const double value =
          field < 3 ? rewrite.positions[node][static_cast<Index>(field)] : normals[k][static_cast<Index>(field) - 3];
      values[property] = node_rows.number(nodes.properties[property].type, value, node);
    }
    (more_nodes += node_rows.separator()) += node_rows.row(values);
  }
  const RowMaker<Data> face_rows(grown, now, *faces);
  const auto corners = static_cast<std::size_t>(std::max(faces->find("vertex_indices"), faces->find("vertex_index")));
  std::string more_faces;
  for (std::size_t k = 0; k < added.face_like.size(); ++k) {
    std::vector<std::string> values = face_rows.like(added.face_like[k]);
    for (std::size_t p = 0; p < values.size(); ++p) {
      const PlyProperty& property = faces->properties[p];
      const auto own = surface.mesh.face(mesh.face_count() + static_cast<Index>(k));
      if (property.count_type) values[p] = face_rows.list(property, p == corners ? own : std::span<const Index>());
    }
    (more_faces += face_rows.separator()) += face_rows.row(values);
  }

  struct Change {
    std::size_t begin;
    std::size_t end;
    std::string text;
  };
  std::vector<Change> changes = {{nodes.count_begin, nodes.count_end, std::to_string(surface.mesh.node_count())},
                                 {faces->count_begin, faces->count_end, std::to_string(surface.mesh.face_count())},
                                 {node_rows.end(), node_rows.end(), std::move(more_nodes)},
                                 {face_rows.end(), face_rows.end(), std::move(more_faces)}};
  std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.begin < b.begin; });
  TextRewriter out(grown.bytes);
  for (const Change& change : changes) out.replace(change.begin, change.end, change.text);
  return out.finish();
}

}  // namespace vspring
