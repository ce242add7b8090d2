#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/output_file.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

enum class SurfaceFormat { obj, off, ply, stl };

/// "obj", "off", "ply" or "stl" in any case, with or without a dot before it; empty for anything else.
[[nodiscard]] std::optional<SurfaceFormat> surface_format(std::string_view extension);

class SurfaceSource;  // the bytes of a file and where its coordinates and normals are; private to the library

/// What came to a surface behind the nodes and faces that its file gave, such as patches of holes.
struct AddedElements {
  /// Per new node the one of the file whose other values it gets in the file's own format, such as a colour.
  std::vector<Index> node_like;
  /// The same of new faces: numbers alone; lists, as of texture coordinates, are empty.
  std::vector<Index> face_like;
  /// OBJ: groups that begin at new faces, by these, ascending.
  std::vector<std::pair<Index, std::string>> groups;
};

/// A mesh and everything else that its file carried.
struct SurfaceFile {
  /// The nodes and faces of the file, and behind them those of `added`.
  PolygonMesh mesh;
  /// Nodes of each named group (OBJ `g` and `o`: all nodes of the faces that follow), ascending. Other formats have
  /// none.
  std::map<std::string, std::vector<Index>> groups;
  /// The file's own normal of every node, unit length; empty where the file gives none, zero where a node has none.
  std::vector<Vector3> normals;
  SurfaceFormat format = SurfaceFormat::obj;
  /// For people: what was skipped, welded or repaired while reading.
  std::vector<std::string> warnings;
  AddedElements added;
  /// Keeps what the format carried besides positions, for writing; null for a mesh that no file gave.
  std::shared_ptr<const SurfaceSource> source;
};

/// Reads OBJ, OFF (also its N, C and ST variants), PLY (text, both binary byte orders) or STL (text, binary; corners at
/// equal positions become one node). path: a file, or "-" for standard input. The format is found from the content;
/// `format`, where given, or the extension decide only what the content leaves open.
///
/// Throws Error(unusable_file), naming path and line (or byte), for anything that cannot be read whole and for a file
/// without nodes. Cost: linear; the bytes of the file stay in memory, but for those of a binary
/// PLY file of nothing but positions and faces.
[[nodiscard]] SurfaceFile read_surface(const std::string& path, std::optional<SurfaceFormat> format = std::nullopt);

/// The same from the bytes of a file in memory. name: what messages call it; its extension decides as a path's does.
/// bytes: kept for writing, so moved in without a copy. Throws and costs what read_surface() does.
[[nodiscard]] SurfaceFile read_surface_bytes(std::string bytes, const std::string& name,
                                             std::optional<SurfaceFormat> format = std::nullopt);

/// Writes the surface with `positions` in place of its own. path: a file, or "-" for standard output. format: where not
/// given, the extension's, and without one the source's own.
///
/// In the source's own format everything but the coordinates of nodes that moved is written as it was read, byte for
/// byte. Normals that the file gave are computed anew, with Max's weights, at nodes that moved and their neighbours.
/// Single precision stays single; whole-number coordinates of PLY become doubles once a node moves. In another format:
/// nodes and faces, and node normals where the source has them; PLY is then binary in double precision, STL binary, of
/// triangles cut from the first node of each face.
///
/// Nodes and faces that were added come behind those of the file, in its own way; its normals at other nodes stay.
///
/// Returns what the source carried and the output does not, one line each; empty when nothing is lost. The file appears
/// whole or not at all, see write_file().
///
/// Throws Error(unusable_file) when it cannot be written; Error(invalid_argument) unless there is one position per
/// node, finite where it is not the one that was read, and within the range of the number type of the file; also for a
/// mesh without triangles as STL, and Error(unusable_file) where faces were added to a file that has no place for them:
/// strips of triangles, OFF whose lines have no say. Cost: linear.
std::vector<std::string> write_surface(const std::string& path, const SurfaceFile& surface,
                                       const std::vector<Vector3>& positions,
                                       std::optional<SurfaceFormat> format = std::nullopt);

/// Writes a mesh that no file gave. format: where not given, the extension's. Throws as above; every position must be
/// finite.
void write_surface(const std::string& path, const PolygonMesh& mesh,
                   std::optional<SurfaceFormat> format = std::nullopt);

/// What write_surface() would write to a file of that name, in memory; no file is looked at. Throws
/// Error(invalid_argument) as that does, and Error(unusable_file) where new coordinates would make an OFF file that
/// reads in another way. Cost: linear.
[[nodiscard]] FileBytes surface_bytes(const std::string& name, const SurfaceFile& surface,
                                      const std::vector<Vector3>& positions,
                                      std::optional<SurfaceFormat> format = std::nullopt);
[[nodiscard]] FileBytes surface_bytes(const std::string& name, const PolygonMesh& mesh,
                                      std::optional<SurfaceFormat> format = std::nullopt);

/// The standard deviation, in each coordinate, of what was rounded off positions so far from the origin, in units of
/// the file, where that has single precision; else 0. Cost: linear.
[[nodiscard]] double rounding_of(const SurfaceFile& surface);

/// The positions that write_surface() leaves in a file of that name: rounded where that has single precision, as binary
/// STL and some PLY do, infinite beyond its range; else as they are. Cost: linear.
[[nodiscard]] std::vector<Vector3> written_positions(const std::string& name, const SurfaceFile& surface,
                                                     std::vector<Vector3> positions,
                                                     std::optional<SurfaceFormat> format = std::nullopt);

}  // namespace vspring
