#include "vspring/surface_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "io/binary_numbers.hpp"
#include "io/file_normals.hpp"
#include "io/formats.hpp"
#include "io/rewriter.hpp"
#include "io/surface_formats.hpp"
#include "vspring/error.hpp"
#include "vspring/output_file.hpp"

namespace vspring {
namespace {

constexpr std::array surface_format_names = {"obj", "off", "ply", "stl"};
constexpr Formats<SurfaceFormat> surface_formats(surface_format_names);

/// The bytes in a format other than the source's, or of a mesh that no file gave.
std::string converted(SurfaceFormat format, const Rewrite& rewrite, std::vector<std::string>& losses) {
  const SurfaceFile& surface = rewrite.surface;
  std::vector<Vector3> normals;
  const PolygonMesh& given = surface.source ? surface.source->mesh : surface.mesh;
  if (surface.normals.size() == given.positions().size()) {
    normals = surface.normals;
    const NewNormals fresh =
        compute_normals(given, given.corners(), surface.normals, given.positions(), rewrite.positions, rewrite.moved);
    for (std::size_t node = 0; node < normals.size(); ++node) {
      if (fresh.due[node] != 0) normals[node] = fresh.normals[node];
    }
    if (const auto& like = surface.added.node_like; !like.empty()) {
      const std::vector<Vector3> more = normals_of_added(surface.mesh, normals, rewrite.positions, like);
      normals.insert(normals.end(), more.begin(), more.end());
    }
  }
  if (surface.source)
    losses = surface.source->carried;
  else if (!surface.groups.empty())
    losses.emplace_back("groups");
  return fresh_surface(format, surface.mesh, rewrite.positions, normals, losses);
}

SurfaceFile surface_of(InputFile file, std::optional<SurfaceFormat> format) {
  const std::optional<SurfaceFormat> said = format ? format : surface_format(extension_of(file.name));
  const std::optional<SurfaceFormat> shown = detect_format(file.bytes);
  if (!shown && (said == SurfaceFormat::obj || said == SurfaceFormat::off)) require_utf8(file);
  if (!said && !shown)
    file.refuse("its content is not OBJ, OFF, PLY or STL",
                {{Remedy::input, "choose another file"}, {Remedy::format, "name the format if it is one of these"}});
  const SurfaceFormat taken = shown.value_or(said.value_or(SurfaceFormat::obj));
  std::string warning;
  if (said && *said != taken)
    warning = fmt::format("{}: its content is {}, not {}; it is read as {}", file.name, name_of(taken), name_of(*said),
                          name_of(taken));
  constexpr std::array readers = {read_obj, read_off, read_ply, read_stl};
  SurfaceFile surface = readers[static_cast<std::size_t>(taken)](std::move(file));
  if (!warning.empty()) surface.warnings.insert(surface.warnings.begin(), std::move(warning));
  return surface;
}

/// Whether the mesh is that of the source, followed by added elements.
bool is_of(const SurfaceSource& source, const SurfaceFile& surface) {
  const PolygonMesh& given = source.mesh;
  const PolygonMesh& mesh = surface.mesh;
  const AddedElements& added = surface.added;
  return static_cast<std::size_t>(mesh.node_count()) == given.positions().size() + added.node_like.size() &&
         static_cast<std::size_t>(mesh.face_count()) ==
             static_cast<std::size_t>(given.face_count()) + added.face_like.size() &&
         static_cast<std::size_t>(mesh.face_begin(given.face_count())) == given.corners().size();
}

}  // namespace

std::optional<SurfaceFormat> surface_format(std::string_view extension) {
  return surface_formats.of_extension(extension);
}

SurfaceFile read_surface(const std::string& path, std::optional<SurfaceFormat> format) {
  return surface_of(read_input(path), format);
}

SurfaceFile read_surface_bytes(std::string bytes, const std::string& name, std::optional<SurfaceFormat> format) {
  return surface_of(input_of(std::move(bytes), name), format);
}

FileBytes surface_bytes(const std::string& name, const SurfaceFile& surface, const std::vector<Vector3>& positions,
                        std::optional<SurfaceFormat> format) {
  if (positions.size() != surface.mesh.positions().size())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} positions given for {} nodes", positions.size(), surface.mesh.node_count()));
  const SurfaceFormat target = surface_formats.to_write(name, format, surface.format);
  const SurfaceSource* source = surface.source.get();
  if (source != nullptr && !is_of(*source, surface))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("the mesh is not the one that {} gave; reset the source to write it on its own",
                            source->file.name));
  Rewrite rewrite{
      surface, positions, moved_nodes((source != nullptr ? source->mesh : surface.mesh).positions(), positions), {}};
  FileBytes file;
  if (source != nullptr && target == surface.format) {
    file.bytes = source->rewritten(rewrite);
    file.losses = std::move(rewrite.remarks);
  } else {
    file.bytes = converted(target, rewrite, file.losses);
  }
  return file;
}

MeshEdges marked_edges(const SurfaceFile& file) { return file.source ? file.source->marked_edges() : MeshEdges{}; }

double rounding_of(const SurfaceFile& surface) {
  if (!surface.source || !surface.source->has_single_precision()) return 0;
  Vector3 greatest = Vector3::Zero();
  for (const Vector3& position : surface.mesh.positions()) {
    // Words of text may have more digits.
    for (const double coordinate : position) {
      if (coordinate != as_single(coordinate)) return 0;
    }
    greatest = greatest.cwiseMax(position.cwiseAbs());
  }
  double squares = 0;
  for (const double coordinate : greatest) {
    if (!(coordinate > 0) || !std::isfinite(coordinate)) continue;
    squares += std::pow(std::ldexp(1.0, std::ilogb(coordinate) + 1 - std::numeric_limits<float>::digits), 2);
  }
  // The rounding error is uniform over the step between two numbers.
  return std::sqrt(squares / 3 / 12);
}

std::vector<Vector3> written_positions(const std::string& name, const SurfaceFile& surface,
                                       std::vector<Vector3> positions, std::optional<SurfaceFormat> format) {
  const SurfaceFormat target = surface_formats.to_write(name, format, surface.format);
  const bool is_single = surface.source && target == surface.format ? surface.source->has_single_precision()
                                                                    : target == SurfaceFormat::stl;
  if (!is_single) return positions;
  for (Vector3& position : positions) {
    for (double& coordinate : position) coordinate = as_single(coordinate);
  }
  return positions;
}

FileBytes surface_bytes(const std::string& name, const PolygonMesh& mesh, std::optional<SurfaceFormat> format) {
  const SurfaceFormat target = surface_formats.to_write(name, format, std::nullopt);
  for (Index node = 0; node < mesh.node_count(); ++node) {
    if (!mesh.position(node).allFinite())
      throw Error(ErrorCode::invalid_argument, fmt::format("node {}: its position is not finite", node));
  }
  std::vector<std::string> losses;
  return {fresh_surface(target, mesh, mesh.positions(), {}, losses)};
}

SurfaceFile refined_file(const SurfaceFile& file, const RefinedMesh& refined) {
  if (!file.added.face_like.empty() || !file.added.node_like.empty())
    throw Error(ErrorCode::invalid_argument, "the file has added elements; write it and read it again to refine it");
  const Index faces = refined.face_from.empty() ? 0 : refined.face_from.back() + 1;
  const bool fits = refined.is_remeshed() ? faces <= file.mesh.face_count() : faces == file.mesh.face_count();
  if (refined.input_node_count() != file.mesh.node_count() || !fits ||
      refined.mesh.face_count() != static_cast<Index>(refined.face_from.size()))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("a refined mesh of {} nodes and {} faces given for a file of {} and {}",
                            refined.input_node_count(), faces, file.mesh.node_count(), file.mesh.face_count()));
  if (file.source) {
    SurfaceFile result = file.source->refined(refined);
    result.warnings = file.warnings;
    if (std::string left_out = file.source->left_out_by(refined); !left_out.empty())
      result.warnings.push_back(std::move(left_out));
    return result;
  }
  SurfaceFile result = file;
  result.mesh = refined.mesh;
  const std::vector<Index> numbers = refined.numbers_in_means();
  for (auto& [name, nodes] : result.groups) {
    // Numbered as in means.
    std::vector<std::uint8_t> inside(static_cast<std::size_t>(file.mesh.node_count() + refined.new_node_count()), 0);
    for (const Index node : nodes) inside[static_cast<std::size_t>(node)] = 1;
    nodes.clear();
    for (Index node = 0; node < refined.mesh.node_count(); ++node) {
      std::uint8_t& own = inside[static_cast<std::size_t>(numbers[static_cast<std::size_t>(node)])];
      if (node >= refined.kept_node_count()) {
        const auto of = refined.means(node);
        const auto is_inside = [&](Index i) { return inside[static_cast<std::size_t>(i)] != 0; };
        own = std::all_of(of.begin(), of.end(), is_inside) ? 1 : 0;
      }
      if (own != 0) nodes.push_back(node);
    }
  }
  if (result.normals.empty()) return result;
  const std::vector<double> means = refined.at_nodes(coordinates(file.normals));
  result.normals = positions_of(means);
  for (Index node = refined.kept_node_count(); node < refined.mesh.node_count(); ++node) {
    Vector3& normal = result.normals[static_cast<std::size_t>(node)];
    normal = unit_or_zero(normal);
  }
  return result;
}

std::vector<std::string> write_surface(const std::string& path, const SurfaceFile& surface,
                                       const std::vector<Vector3>& positions, std::optional<SurfaceFormat> format) {
  FileBytes file = surface_bytes(path, surface, positions, format);
  write_file(path, file.bytes);
  return std::move(file.losses);
}

void write_surface(const std::string& path, const PolygonMesh& mesh, std::optional<SurfaceFormat> format) {
  write_file(path, surface_bytes(path, mesh, format).bytes);
}

std::string fresh_surface(SurfaceFormat format, const PolygonMesh& mesh, std::span<const Vector3> positions,
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
