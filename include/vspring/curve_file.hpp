#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vspring/column_choice.hpp"
#include "vspring/export.hpp"
#include "vspring/local_plane.hpp"
#include "vspring/output_file.hpp"
#include "vspring/polygon_curve.hpp"

namespace VSPRING_API vspring {

/// Formats of curves. SVG is written only.
enum class CurveFormat { obj, csv, dat, xyz, gpx, svg };

/// "obj", "csv", "dat", "xyz", "gpx" or "svg" in any case, with or without a dot before it; empty for anything else.
[[nodiscard]] std::optional<CurveFormat> curve_format(std::string_view extension);

class CurveSource;  // the bytes of a file and where its coordinates are; private to the library

/// A curve and everything else that its file carried.
struct CurveFile {
  PolygonCurve curve;  ///< the nodes and chains of the file
  /// Whether the file gives two coordinates per node; z is then 0.
  bool planar = false;
  /// Set where the file gives latitudes and longitudes: the plane in which the curve lies, in metres.
  std::optional<LocalPlane> plane = std::nullopt;
  /// Nodes of each named group (OBJ `g` and `o`: all nodes of the lines that follow), ascending.
  std::map<std::string, std::vector<Index>> groups;
  /// The header's names of the columns of x, y and z; "lon", "lat" and "ele" for GPX with elevations; else empty.
  std::vector<std::string> column_names = {};
  /// The name that the file gives the curve (first line of DAT); empty if none.
  std::string name;
  CurveFormat format = CurveFormat::obj;  ///< in which the file was read
  /// For people: what was skipped or joined while reading.
  std::vector<std::string> warnings;
  /// The nodes in the order in which rows of a table and points of a track are written; empty: as they were read.
  std::vector<Index> row_order = {};
  /// Keeps what the format carried besides positions, for writing; null for a curve that no file gave.
  std::shared_ptr<const CurveSource> source;
  /// What went with the nodes that replace_nodes() replaced, one line each.
  std::vector<std::string> lost = {};
};

/// Gives a file another curve, of new nodes. What belonged to the old ones goes with them, such as other columns of a
/// table: source, groups and row_order; write_curve() then returns it as lost. Cost: linear.
void replace_nodes(CurveFile& file, PolygonCurve curve);

/// Reads a curve. path: a file, or "-" for standard input. format: where not given, the extension's; for "-" or an
/// unknown extension it is found from the content. columns: of CSV and XYZ, which columns hold x, y and z; empty: the
/// reader finds them. plane: onto which latitudes and longitudes are mapped, such as that of another file; where not
/// given, one about the middle of the box around them.
///
/// OBJ: `l` elements, several curves in one file, segments in any order (chains_of_segments()); nodes are all `v`, in
/// file order; a segment given twice counts once. CSV: one node per row, 2 or 3 columns x, y[, z], separated by commas,
/// semicolons, tabs or spaces. They are the columns that a header names, with or without units, else the first that
/// hold numbers; a file in which that is ambiguous is refused. Numbers may have decimal commas where semicolons, tabs
/// or quotes separate them, and are written so again. An empty row begins another chain. XYZ: rows as in CSV, separated
/// by white space. DAT: aerofoils as Selig (name, then x y around from the trailing edge) or Lednicer
/// (name, numbers of points of upper and lower side, each from the leading edge on) arranged them. Lednicer's become
/// one chain from the trailing edge over the upper side and back; the leading edge is one node where both sides give
/// it. GPX: each segment of a track (trkseg) and each route (rte) is a chain of its points; elevations are kept, and
/// are z only where lon, lat and ele are chosen. All else in the file is kept for writing.
///
/// Degrees are mapped to metres in a plane, x east and y north, and written as degrees again: those of GPX, and of CSV
/// whose columns are named lat or latitude and lon, lng, long or longitude, if these are chosen or no column is named x
/// or y. A third column that is chosen stays z.
///
/// A chain whose last node repeats the position of the first stays open; only the same number (OBJ) closes it.
///
/// Throws Error(unusable_file), naming path and line, for anything that cannot be read whole and for a file without a
/// curve; Error(invalid_argument) for `columns` that are no choice of columns, or that are given for a file that is
/// neither CSV, XYZ nor GPX. Cost: linear; the bytes of the file stay in memory.
[[nodiscard]] CurveFile read_curve(const std::string& path, std::optional<CurveFormat> format = std::nullopt,
                                   const ColumnChoice& columns = {},
                                   const std::optional<LocalPlane>& plane = std::nullopt);

/// Reads a curve from the bytes of a file in memory. name: what messages call it; its extension counts as a path's
/// does. bytes: kept for writing, so move them in. Other arguments as for read_curve(). Throws and costs what
/// read_curve() does.
[[nodiscard]] CurveFile read_curve_bytes(std::string bytes, const std::string& name,
                                         std::optional<CurveFormat> format = std::nullopt,
                                         const ColumnChoice& columns = {},
                                         const std::optional<LocalPlane>& plane = std::nullopt);

/// Tells which of x, y and z are named, for FitOptions::moving_axes. names: column names as in the file, with or
/// without units, in any case; or letters, such as "yz". Throws Error(invalid_argument) for any other name, and for
/// longitude without latitude or the reverse: each coordinate in metres depends on both.
[[nodiscard]] std::array<bool, 3> choose_axes(const CurveFile& file, const std::vector<std::string>& names);

/// Puts the nodes of every chain in order along the curve, see order_along_curve(). Nodes keep their numbers; chains
/// and CurveFile::row_order change, so whole rows are written in that order. closed: every chain joins its last node to
/// its first. Returns how many nodes changed their place along their chain.
///
/// Throws Error(invalid_argument) for files whose format gives the order of nodes (OBJ; DAT by sides), and
/// Error(unusable_shape) naming a node that is not finite. Cost: of order_along_curve().
Index order_nodes(CurveFile& file, bool closed);

/// What a written picture shows.
struct CurvePicture {
  /// The curve before, drawn thin behind; null: none. It may have other chains.
  const PolygonCurve* before = nullptr;
  /// Points that the curve was fitted to, drawn as dots, 20,000 at most.
  std::span<const Vector3> points = {};
  /// The part to draw, in units of the curve; where not given, all.
  std::optional<Eigen::AlignedBox<double, 3>> part = std::nullopt;
};

/// Writes the curve with `positions` in place of its own. path: a file, or "-" for standard output. format: where not
/// given, the extension's, and without one the source's own.
///
/// In the source's own format everything but the coordinates of nodes that moved is written as it was read, byte for
/// byte; tables and tracks also keep each coordinate of these that did not change. New coordinates are the shortest
/// decimals that read back the same; new degrees have up to 12 decimals. In another format: chains and positions, as
/// degrees in GPX and CSV where the curve has a plane of these. A planar curve keeps two columns while it stays in its
/// plane. CSV, XYZ, DAT and GPX get the nodes along the chains, and the first node of a closed chain once more at its
/// end; GPX gets a segment for each chain. SVG is a picture: the curve with its nodes and its curvature comb (lines
/// along the curvature vector of the circle through three successive nodes), before and after, and below it curvature
/// against arc length, with a sign for planar curves. Space curves are drawn as seen along the normal of their best
/// plane.
///
/// Returns what the source carried and the output does not, one line each; empty when nothing is lost, and for a
/// picture. The file appears whole or not at all, see write_file().
///
/// Throws Error(unusable_file) when it cannot be written; Error(invalid_argument) unless there is one position per
/// node, for a position that is not finite and not the one that was read, for a row_order that is no order of the
/// nodes, for a node that leaves z = 0 in a file of two columns, for several chains or a space curve as DAT, and for a
/// curve without CurveFile::plane as GPX. Cost: linear.
std::vector<std::string> write_curve(const std::string& path, const CurveFile& file,
                                     const std::vector<Vector3>& positions,
                                     std::optional<CurveFormat> format = std::nullopt,
                                     const CurvePicture& picture = {});

/// Returns the picture that write_curve() writes as SVG. Throws Error(invalid_argument) unless there is one position
/// per node. Cost: linear.
[[nodiscard]] std::string draw_curve(const CurveFile& file, const std::vector<Vector3>& positions,
                                     const CurvePicture& picture = {});

/// Writes a curve that no file gave. format: where not given, the extension's. planar: write two coordinates. Throws as
/// write_curve() of a file does; every position must be finite.
void write_curve(const std::string& path, const PolygonCurve& curve, std::optional<CurveFormat> format = std::nullopt,
                 bool planar = false);

/// Returns the bytes that write_curve() would write to a file named `name`; touches no file. Throws
/// Error(invalid_argument) as write_curve() does. Cost: linear.
[[nodiscard]] FileBytes curve_bytes(const std::string& name, const CurveFile& file,
                                    const std::vector<Vector3>& positions,
                                    std::optional<CurveFormat> format = std::nullopt, const CurvePicture& picture = {});
[[nodiscard]] FileBytes curve_bytes(const std::string& name, const PolygonCurve& curve,
                                    std::optional<CurveFormat> format = std::nullopt, bool planar = false);

}  // namespace vspring
