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

enum class CurveFormat { obj, csv, dat, xyz, gpx, svg };

/// "obj", "csv", "dat", "xyz", "gpx" or "svg" in any case, with or without a dot before it; empty for anything else.
[[nodiscard]] std::optional<CurveFormat> curve_format(std::string_view extension);

class CurveSource;  // the bytes of a file and where its coordinates are; private to the library

/// A curve and everything else that its file carried.
struct CurveFile {
  PolygonCurve curve;
  /// Whether the file gives two coordinates per node; z is then 0.
  bool planar = false;
  /// Where the file gives latitudes and longitudes: the plane in which the curve lies, in metres.
  std::optional<LocalPlane> plane = std::nullopt;
  /// Nodes of each named group (OBJ `g` and `o`: all nodes of the lines that follow), ascending.
  std::map<std::string, std::vector<Index>> groups;
  /// What the header of a table calls the columns of x, y and z; GPX with elevations: "lon", "lat" and "ele". Else
  /// empty.
  std::vector<std::string> column_names = {};
  /// The name that the file gives the curve (first line of DAT); empty if none.
  std::string name;
  CurveFormat format = CurveFormat::obj;
  /// For people: what was skipped or joined while reading.
  std::vector<std::string> warnings;
  /// The nodes in the order in which rows of a table and points of a track are written; empty: as they were read.
  std::vector<Index> row_order = {};
  /// Keeps what the format carried besides positions, for writing; null for a curve that no file gave.
  std::shared_ptr<const CurveSource> source;
};

/// Reads a curve. path: a file, or "-" for standard input. format: where not given, the extension's; for "-" or an
/// unknown extension it is found from the content. columns: of CSV and XYZ, which columns hold x, y and z; empty: the
/// reader finds them. plane: the one that latitudes and longitudes are taken to, such as that of another file; where
/// not given, one about the middle of the box around them.
///
/// OBJ: `l` elements, several curves in one file, segments in any order (chains_of_segments()); nodes are all `v`, in
/// file order; a segment given twice counts once. CSV: one node per row, 2 or 3 columns x, y[, z], separated by commas,
/// semicolons, tabs or spaces: those that a header names, with or without units, else the first that hold numbers;
/// refused where they cannot be told from other columns. Numbers may have decimal commas where semicolons, tabs or
/// quotes part them, and are written so again. An empty row begins another chain. XYZ: the same without
/// header, separated by white space. DAT: aerofoils as Selig (name, then x y around from the trailing edge) or Lednicer
/// (name, numbers of points of upper and lower side, each from the leading edge on) arranged them. Lednicer's become
/// one chain from the trailing edge over the upper side and back; the leading edge is one node where both sides give
/// it. GPX: each segment of a track (trkseg) and each route (rte) is a chain of its points; elevations are kept, and
/// are z only where lon, lat and ele are chosen. All else in the file is kept for writing.
///
/// Degrees: GPX, and CSV of columns named lat or latitude and lon, lng, long or longitude that are chosen, or found
/// where none are named x and y, are taken to metres in a plane, x east and y north; a third column that is chosen
/// stays z. They are written as degrees again.
///
/// A chain whose last node repeats the position of the first stays open; only the same number (OBJ) closes it.
///
/// Throws Error(unusable_file), naming path and line, for anything that cannot be read whole and for a file without a
/// curve; Error(invalid_argument) where `columns` is given and is no choice of columns, or the file is neither CSV, XYZ
/// nor GPX. Cost: linear; the bytes of the file stay in memory.
[[nodiscard]] CurveFile read_curve(const std::string& path, std::optional<CurveFormat> format = std::nullopt,
                                   const ColumnChoice& columns = {},
                                   const std::optional<LocalPlane>& plane = std::nullopt);

/// The same from the bytes of a file in memory. name: what messages call it; its extension decides as a path's does.
/// bytes: kept for writing, so moved in without a copy. Throws and costs what read_curve() does.
[[nodiscard]] CurveFile read_curve_bytes(std::string bytes, const std::string& name,
                                         std::optional<CurveFormat> format = std::nullopt,
                                         const ColumnChoice& columns = {},
                                         const std::optional<LocalPlane>& plane = std::nullopt);

/// Which of x, y and z are named, for FitOptions::moving_axes. names: of columns as the file has them, with units or
/// without and in any case, or letters, such as "yz". Throws Error(invalid_argument) for a name that is neither, and
/// for one of longitude and latitude without the other: a place in metres has both in either of its coordinates.
[[nodiscard]] std::array<bool, 3> choose_axes(const CurveFile& file, const std::vector<std::string>& names);

/// Puts the nodes of every chain in order along the curve, see order_along_curve(). The curve gets other chains, nodes
/// keep their numbers; the rows of the file come out in that order, with all that is in them. closed: every chain joins
/// its last node to its first. Returns how many nodes changed their place along their chain.
///
/// Throws Error(invalid_argument) for files that say themselves in which order nodes come (OBJ; DAT by sides), and
/// Error(unusable_shape) naming a node that is not finite. Cost: of order_along_curve().
Index order_nodes(CurveFile& file, bool closed);

/// What a written picture shows.
struct CurvePicture {
  /// The curve before, drawn thin behind; null draws none. It has chains of its own.
  const PolygonCurve* before = nullptr;
  /// Points that the curve was fitted to, drawn as dots, 20,000 at most.
  std::span<const Vector3> points = {};
  /// The part that is drawn, in units of the curve; where not given, all.
  std::optional<Eigen::AlignedBox<double, 3>> part = std::nullopt;
};

/// Writes the curve with `positions` in place of its own. path: a file, or "-" for standard output. format: where not
/// given, the extension's, and without one the source's own.
///
/// In the source's own format everything but the coordinates of nodes that moved is written as it was read, byte for
/// byte, and in tables and tracks those of their coordinates that did not change; new coordinates are the shortest
/// decimals that read back the same, new degrees have up to 12 decimals. In another format: chains and positions, as
/// degrees in GPX and CSV where the curve has a plane of these. A planar curve keeps two columns while it stays in its
/// plane. CSV, XYZ and DAT have the nodes along the chains, and the first node of a closed chain once more at its end;
/// so has GPX, with a segment for each chain. SVG is a picture: the curve with its nodes and its curvature comb (lines
/// along the curvature vector of the circle through three successive nodes), before and after, and below it curvature
/// against arc length, with a sign for planar curves. Space curves are drawn as seen along the normal of their best
/// plane.
///
/// Returns what the source carried and the output does not, one line each; empty when nothing is lost, and for a
/// picture. The file appears whole or not at all, see write_file().
///
/// Throws Error(unusable_file) when it cannot be written; Error(invalid_argument) unless there is one position per
/// node, finite where it is not the one that was read, for a row_order that is none, for a node that leaves z = 0 in a
/// file of two columns, and for several chains or a space curve as DAT, and for a curve without a plane of degrees as
/// GPX. Cost: linear.
std::vector<std::string> write_curve(const std::string& path, const CurveFile& file,
                                     const std::vector<Vector3>& positions,
                                     std::optional<CurveFormat> format = std::nullopt,
                                     const CurvePicture& picture = {});

/// The picture that write_curve() writes as SVG. Throws Error(invalid_argument) unless there is one position per node.
/// Cost: linear.
[[nodiscard]] std::string draw_curve(const CurveFile& file, const std::vector<Vector3>& positions,
                                     const CurvePicture& picture = {});

/// Writes a curve that no file gave. format: where not given, the extension's. planar: write two coordinates. Throws as
/// above; every position must be finite.
void write_curve(const std::string& path, const PolygonCurve& curve, std::optional<CurveFormat> format = std::nullopt,
                 bool planar = false);

/// What write_curve() would write to a file of that name, in memory; no file is looked at. Throws
/// Error(invalid_argument) as that does. Cost: linear.
[[nodiscard]] FileBytes curve_bytes(const std::string& name, const CurveFile& file,
                                    const std::vector<Vector3>& positions,
                                    std::optional<CurveFormat> format = std::nullopt, const CurvePicture& picture = {});
[[nodiscard]] FileBytes curve_bytes(const std::string& name, const PolygonCurve& curve,
                                    std::optional<CurveFormat> format = std::nullopt, bool planar = false);

}  // namespace vspring
