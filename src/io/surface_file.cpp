#include "vspring/surface_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstdint>
#include <filesystem>

#include "io/file_normals.hpp"
#include "io/fresh_file.hpp"
#include "io/sniff.hpp"
#include "io/surface_source.hpp"
#include "vspring/error.hpp"
#include "vspring/output_file.hpp"

namespace vspring {
namespace {

std::string extension_of(const std::string& path) {
  return path == "-" ? "" : std::filesystem::path(path).extension().string();
}

/// The format to write: asked for, of the extension, or `own` where there is no extension.
SurfaceFormat format_to_write(const std::string& path, std::optional<SurfaceFormat> asked,
                              std::optional<SurfaceFormat> own) {
  if (asked) return *asked;
  const std::string extension = extension_of(path);
  if (const auto format = surface_format(extension)) return *format;
  if (extension.empty() && own) return *own;
  const std::string name = path == "-" ? "standard output" : path;
  throw Error(ErrorCode::invalid_argument,
              extension.empty()
                  ? fmt::format("{}: without an extension it shows no format; name OBJ, OFF, PLY or STL", name)
                  : fmt::format("{}: {} is no format; use .obj, .off, .ply or .stl, or name one of them", name,
                                in_quotes(extension)));
}

bool same_bits(const Vector3& a, const Vector3& b) {
  using Bits = std::array<std::uint64_t, 3>;
  return std::bit_cast<Bits>(std::array{a.x(), a.y(), a.z()}) == std::bit_cast<Bits>(std::array{b.x(), b.y(), b.z()});
}

/// Marks the nodes whose position is not `before`; refuses those that moved to nowhere.
std::vector<std::uint8_t> moved_nodes(const std::vector<Vector3>& before, const std::vector<Vector3>& positions) {
  std::vector<std::uint8_t> moved(positions.size(), 0);
  for (std::size_t node = 0; node < positions.size(); ++node) {
    if (same_bits(before[node], positions[node])) continue;
    moved[node] = 1;
    if (!positions[node].allFinite())
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("node {}: its position is not finite; only a position that was read so may be", node));
  }
  return moved;
}

/// A file in another format than the source's, or of a mesh that no file gave.
std::string converted(SurfaceFormat format, const Rewrite& rewrite, std::vector<std::string>& losses) {
  const SurfaceFile& surface = rewrite.surface;
  std::vector<Vector3> normals;
  if (surface.normals.size() == rewrite.positions.size()) {
    normals = surface.normals;
    const std::vector<Vector3>& before = surface.source ? surface.source->positions : surface.mesh.positions();
    const NewNormals fresh = compute_normals(surface.mesh, surface.mesh.corners(), surface.normals, before,
                                             rewrite.positions, rewrite.moved);
    for (std::size_t node = 0; node < normals.size(); ++node) {
      if (fresh.due[node] != 0) normals[node] = fresh.normals[node];
    }
  }
  if (surface.source)
    losses = surface.source->carried;
  else if (!surface.groups.empty())
    losses.emplace_back("groups");
  return fresh_file(format, surface.mesh, rewrite.positions, normals, losses);
}

}  // namespace

std::optional<SurfaceFormat> surface_format(std::string_view extension) {
  if (extension.starts_with('.')) extension.remove_prefix(1);
  std::string lower(extension);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  constexpr std::array names = {"obj", "off", "ply", "stl"};
  const auto found = std::find(names.begin(), names.end(), lower);
  if (found == names.end()) return std::nullopt;
  return static_cast<SurfaceFormat>(found - names.begin());
}

SurfaceFile read_surface(const std::string& path, std::optional<SurfaceFormat> format) {
  InputFile file = read_input(path);
  const std::optional<SurfaceFormat> said = format ? format : surface_format(extension_of(path));
  const std::optional<SurfaceFormat> shown = format_of_content(file.bytes);
  if (!said && !shown)
    file.refuse(
        "its content is not OBJ, OFF, PLY or STL; choose another file, or name the format if it is one of these");
  const SurfaceFormat taken = shown.value_or(said.value_or(SurfaceFormat::obj));
  std::string warning;
  if (said && *said != taken)
    warning = fmt::format("{}: its content is {}, not {}; it is read as what it is", file.name, name_of(taken),
                          name_of(*said));
  constexpr std::array readers = {read_obj, read_off, read_ply, read_stl};
  SurfaceFile surface = readers[static_cast<std::size_t>(taken)](std::move(file));
  if (!warning.empty()) surface.warnings.insert(surface.warnings.begin(), std::move(warning));
  return surface;
}

std::vector<std::string> write_surface(const std::string& path, const SurfaceFile& surface,
                                       const std::vector<Vector3>& positions, std::optional<SurfaceFormat> format) {
  if (positions.size() != surface.mesh.positions().size())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} positions given for {} nodes", positions.size(), surface.mesh.node_count()));
  const SurfaceFormat target = format_to_write(path, format, surface.format);
  const SurfaceSource* source = surface.source.get();
  if (source != nullptr &&
      (source->positions.size() != positions.size() || source->corner_count != surface.mesh.corners().size()))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("the mesh is not the one that {} gave; reset the source to write it on its own",
                            source->file.name));
  Rewrite rewrite{
      surface, positions, moved_nodes(source != nullptr ? source->positions : surface.mesh.positions(), positions), {}};
  if (source != nullptr && target == surface.format) {
    write_file(path, source->rewritten(rewrite));
    return std::move(rewrite.remarks);
  }
  std::vector<std::string> losses;
  write_file(path, converted(target, rewrite, losses));
  return losses;
}

void write_surface(const std::string& path, const PolygonMesh& mesh, std::optional<SurfaceFormat> format) {
  const SurfaceFormat target = format_to_write(path, format, std::nullopt);
  for (Index node = 0; node < mesh.node_count(); ++node) {
    if (!mesh.position(node).allFinite())
      throw Error(ErrorCode::invalid_argument, fmt::format("node {}: its position is not finite", node));
  }
  std::vector<std::string> losses;
  write_file(path, fresh_file(target, mesh, mesh.positions(), {}, losses));
}

}  // namespace vspring
