#include "io/fresh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/byte_order.hpp"
#include "io/file_normals.hpp"
#include "io/single.hpp"
#include "io/stl_source.hpp"
#include "io/text_rewriter.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

void append_vector(std::string& text, const Vector3& vector) {
  for (int k = 0; k < 3; ++k) {
    if (k > 0) text += ' ';
    append_number(text, vector[k]);
  }
}

void append_index(std::string& text, Index number) {
  const fmt::format_int digits(number);
  text.append(digits.data(), digits.size());
}

template <typename Number>
void append_bytes(std::string& bytes, Number number) {
  std::array<char, sizeof(Number)> room;
  store(room.data(), number, little_swapped);
  bytes.append(room.data(), room.size());
}

std::string fresh_surface_obj(const PolygonMesh& mesh, std::span<const Vector3> positions,
                              std::span<const Vector3> normals) {
  std::string text;
  text.reserve(60 * (positions.size() + normals.size()) + 20 * mesh.corners().size());
  for (const Vector3& position : positions) {
    text += "v ";
    append_vector(text, position);
    text += '\n';
  }
  for (const Vector3& normal : normals) {
    text += "vn ";
    append_vector(text, normal);
    text += '\n';
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    text += 'f';
    for (const Index node : mesh.face(f)) {
      text += ' ';
      append_index(text, node + 1);
      if (normals.empty()) continue;
      text += "//";
      append_index(text, node + 1);
    }
    text += '\n';
  }
  return text;
}

std::string fresh_off(const PolygonMesh& mesh, std::span<const Vector3> positions, std::span<const Vector3> normals) {
  std::string text = fmt::format("{}OFF\n{} {} 0\n", normals.empty() ? "" : "N", positions.size(), mesh.face_count());
  text.reserve(60 * (positions.size() + normals.size()) + 10 * mesh.corners().size());
  for (std::size_t node = 0; node < positions.size(); ++node) {
    append_vector(text, positions[node]);
    if (!normals.empty()) {
      text += ' ';
      append_vector(text, normals[node]);
    }
    text += '\n';
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    append_index(text, static_cast<Index>(mesh.face(f).size()));
    for (const Index node : mesh.face(f)) {
      text += ' ';
      append_index(text, node);
    }
    text += '\n';
  }
  return text;
}

std::string fresh_stl(const PolygonMesh& mesh, std::span<const Vector3> positions, std::vector<std::string>& losses) {
  std::size_t triangles = 0;
  bool larger = false;
  bool smaller = false;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const std::size_t size = mesh.face(f).size();
    triangles += size < 3 ? 0 : size - 2;
    larger = larger || size > 3;
    smaller = smaller || size < 3;
  }
  if (triangles == 0)
    throw Error(ErrorCode::invalid_argument,
                "STL holds nothing but triangles, and the mesh has no face of three nodes; write another format");
  if (larger) losses.emplace_back("faces of more than three nodes: they are cut into triangles from their first node");
  if (smaller) losses.emplace_back("faces of fewer than three nodes");
  std::vector<std::uint8_t> used(positions.size(), 0);
  for (const Index node : mesh.corners()) used[node] = 1;
  if (std::find(used.begin(), used.end(), 0) != used.end()) losses.emplace_back("nodes that no face uses");
  if (std::any_of(positions.begin(), positions.end(), [](const Vector3& position) {
        return position.allFinite() && position != position.cast<float>().cast<double>();
      }))
    losses.emplace_back("precision beyond single");

  std::string bytes(stl::header_size, '\0');
  bytes.replace(0, 7, "vspring");
  bytes.reserve(stl::facets_begin + stl::facet_size * triangles);
  append_bytes(bytes, static_cast<std::uint32_t>(triangles));
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const std::span<const Index> face = mesh.face(f);
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const std::array<Index, 3> nodes = {face[0], face[k], face[k + 1]};
      for (const double value : stl::facet_normal(positions[nodes[0]], positions[nodes[1]], positions[nodes[2]]))
        append_bytes(bytes, static_cast<float>(value));
      for (const Index node : nodes) {
        for (const double value : positions[node]) append_bytes(bytes, single(value, static_cast<std::size_t>(node)));
      }
      append_bytes(bytes, std::uint16_t{0});
    }
  }
  return bytes;
}

}  // namespace

std::string fresh_ply(const PolygonMesh& mesh, std::span<const Vector3> positions, std::span<const Vector3> normals,
                      std::span<const NodeScalar> scalars) {
  std::size_t largest = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) largest = std::max(largest, mesh.face(f).size());
  const bool short_lists = largest <= 255;
  std::string bytes = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", positions.size());
  bytes += "property double x\nproperty double y\nproperty double z\n";
  if (!normals.empty()) bytes += "property double nx\nproperty double ny\nproperty double nz\n";
  for (const NodeScalar& scalar : scalars) bytes += fmt::format("property double {}\n", scalar.name);
  bytes += fmt::format("element face {}\nproperty list {} int vertex_indices\nend_header\n", mesh.face_count(),
                       short_lists ? "uchar" : "int");
  bytes.reserve(bytes.size() + (24 + 8 * scalars.size()) * positions.size() + 24 * normals.size() +
                4 * mesh.face_begin().size() + 4 * mesh.corners().size());
  for (std::size_t node = 0; node < positions.size(); ++node) {
    for (const double value : positions[node]) append_bytes(bytes, value);
    if (!normals.empty()) {
      for (const double value : normals[node]) append_bytes(bytes, value);
    }
    for (const NodeScalar& scalar : scalars) append_bytes(bytes, scalar.values[node]);
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const std::span<const Index> face = mesh.face(f);
    if (short_lists)
      append_bytes(bytes, static_cast<std::uint8_t>(face.size()));
    else
      append_bytes(bytes, static_cast<std::int32_t>(face.size()));
    for (const Index node : face) append_bytes(bytes, node);
  }
  return bytes;
}

std::string fresh_file(SurfaceFormat format, const PolygonMesh& mesh, std::span<const Vector3> positions,
                       std::span<const Vector3> normals, std::vector<std::string>& losses) {
  switch (format) {
    case SurfaceFormat::obj:
      return fresh_surface_obj(mesh, positions, normals);
    case SurfaceFormat::off:
      return fresh_off(mesh, positions, normals);
    case SurfaceFormat::ply:
      return fresh_ply(mesh, positions, normals, {});
    case SurfaceFormat::stl:
      break;
  }
  if (!normals.empty()) losses.emplace_back("normals of nodes");
  return fresh_stl(mesh, positions, losses);
}

}  // namespace vspring
