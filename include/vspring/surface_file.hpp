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
#include "vspring/refined_mesh.hpp"

namespace VSPRING_API vspring {

/// Formats of surfaces.
enum class SurfaceFormat { obj, off, ply, stl };

/// "obj", "off", "ply" or "stl" in any case, with or without a dot before it; empty for anything else.
[[nodiscard]] std::optional<SurfaceFormat> surface_format(std::string_view extension);

class SurfaceSource;  // the bytes of a file and where its coordinates and normals are; private to the library

/// Nodes and faces appended to those of a file, such as patches of holes.
struct AddedElements {
  /// Per new node the node of the file from which it takes other values in the file's own format, such as a colour.
  std::vector<Index> node_like;
  /// Per new face the face of the file from which it takes other values. Only numbers: lists, as of texture
  /// coordinates, become empty.
  std::vector<Index> face_like;
  /// OBJ: new faces at which a group begins, ascending, and its name.
  std::vector<std::pair<Index, std::string>> groups;
};

/// A mesh and everything else that its file carried.
struct SurfaceFile {
  /// The nodes and faces of the file, followed by those of `added`.
  PolygonMesh mesh;
  /// Nodes of each named group (OBJ `g` and `o`: all nodes of the faces that follow), ascending. Other formats have
  /// none.
  std::map<std::string, std::vector<Index>> groups;
  /// The file's own normal of every node, unit length; empty where the file gives none, zero where a node has none.
  std::vector<Vector3> normals;
  SurfaceFormat format = SurfaceFormat::obj;  ///< in which the file was read
  /// For people: what was skipped, welded or repaired while reading.
  std::vector<std::string> warnings;
  AddedElements added;  ///< nodes and faces that the file does not have
  /// Keeps what the format carried besides positions, for writing; null for a mesh that no file gave.
  std::shared_ptr<const SurfaceSource> source;
};

/// Reads OBJ, OFF (also its N, C and ST variants), PLY (text, both binary byte orders) or STL (text, binary; corners at
/// equal positions become one node). path: a file, or "-" for standard input. The format is found from the content;
/// `format`, where given, or the extension decide only what the content leaves open.
///
/// Throws Error(unusable_file), naming path and line (or byte), for anything that cannot be read whole and for a file
/// without nodes. Cost: linear; the bytes of the file stay in memory, except for a binary PLY file of positions and
/// faces only.
[[nodiscard]] SurfaceFile read_surface(const std::string& path, std::optional<SurfaceFormat> format = std::nullopt);

/// Reads a surface from the bytes of a file in memory. name: what messages call it; its extension counts as a path's
/// does. bytes: kept for writing, so move them in. Throws and costs what read_surface() does.
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
/// Added nodes and faces follow those of the file, in the file's own style; normals of other nodes stay.
///
/// Returns what the source carried and the output does not, one line each; empty when nothing is lost. The file appears
/// whole or not at all, see write_file().
///
/// Throws Error(unusable_file) when it cannot be written; Error(invalid_argument) unless there is one position per
/// node, for a position that is not finite and not the one that was read, for one out of the range of the file's number
/// type, and for a mesh without triangles as STL; Error(unusable_file) for faces added to a file that has no place for
/// them: triangle strips, OFF without line structure. Cost: linear.
std::vector<std::string> write_surface(const std::string& path, const SurfaceFile& surface,
                                       const std::vector<Vector3>& positions,
                                       std::optional<SurfaceFormat> format = std::nullopt);

/// Writes a mesh that no file gave. format: where not given, the extension's. Throws as write_surface() of a file does;
/// every position must be finite.
void write_surface(const std::string& path, const PolygonMesh& mesh,
                   std::optional<SurfaceFormat> format = std::nullopt);

/// Returns the bytes that write_surface() would write to a file named `name`; touches no file. Throws
/// Error(invalid_argument) as write_surface() does, and Error(unusable_file) if new coordinates would change how an OFF
/// file is read. Cost: linear.
[[nodiscard]] FileBytes surface_bytes(const std::string& name, const SurfaceFile& surface,
                                      const std::vector<Vector3>& positions,
                                      std::optional<SurfaceFormat> format = std::nullopt);
[[nodiscard]] FileBytes surface_bytes(const std::string& name, const PolygonMesh& mesh,
                                      std::optional<SurfaceFormat> format = std::nullopt);

/// The file as it would be with a refined mesh: its nodes and faces keep what they carry, and the parts of a face
/// follow each other in its place. write_surface() then writes it as any file that was read. Positions have the
/// precision of the file.
///
/// - OBJ: new nodes have the mean of colours and weights; corners that of `vt` and of `vn`, at unit length. Parts of a
///   face belong to its group, object, material and smoothing group.
/// - PLY: new nodes have the mean of numbers that are not whole, of colours and of normals, and other whole numbers of
///   one of the nodes around. Parts of a face have its numbers; lists of numbers that are not whole, as many for each
///   corner, such as texture coordinates, are interpolated, and others the same. Other elements stay as they are.
/// - OFF: new nodes have the mean of numbers behind their coordinates; parts of a face its colour.
/// - STL: parts of a triangle have its attributes.
///
/// refined: of file.mesh. Throws Error(invalid_argument) if it is not, or if the file has added elements, and
/// Error(unusable_file) where the file has no room: triangle strips, OFF without a line for each node and face, types
/// too small for the new numbers. Cost: linear.
[[nodiscard]] SurfaceFile refined_file(const SurfaceFile& file, const RefinedMesh& refined);

/// The edges that the file marks, by the numbers of its nodes, in its order: those along lines of OBJ (`l`), and those
/// of the element `edge` of PLY, by `vertex1` and `vertex2`, of which a property `sharp` or `crease`, where there is
/// one, is not 0. Other formats mark none. They need not be edges of the mesh: see as_sharp_edges(). Throws
/// Error(unusable_file), naming line or byte, for a mark that cannot be read and for a node that does not exist. Cost:
/// linear in the file, which is read again.
[[nodiscard]] MeshEdges marked_edges(const SurfaceFile& file);

/// The standard deviation of the rounding of positions in each coordinate, in units of the file, if the file has single
/// precision; else 0. It grows with the distance from the origin. Cost: linear.
[[nodiscard]] double rounding_of(const SurfaceFile& surface);

/// The positions as a file named `name` will hold them: rounded if it has single precision, as binary STL and some PLY
/// do, infinite beyond its range; else unchanged. Cost: linear.
[[nodiscard]] std::vector<Vector3> written_positions(const std::string& name, const SurfaceFile& surface,
                                                     std::vector<Vector3> positions,
                                                     std::optional<SurfaceFormat> format = std::nullopt);

}  // namespace vspring
