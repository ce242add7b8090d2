#pragma once

#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "vspring/constraints.hpp"
#include "vspring/curve_file.hpp"
#include "vspring/local_plane.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::cli {

using AnyShape = std::variant<SurfaceFile, CurveFile>;
using AnyFormat = std::variant<SurfaceFormat, CurveFormat>;

/// Reads a surface or a curve: by `curve`, else by the format or the extension. An OBJ file without faces is a curve;
/// standard input and files of unknown extensions are surfaces. columns: as in read_curve(); used only if
/// may_be_table(). plane: of degrees, as there.
[[nodiscard]] AnyShape read_shape(const std::string& path, std::optional<AnyFormat> format, bool curve,
                                  const ColumnChoice& columns, const std::optional<LocalPlane>& plane = std::nullopt);

/// Whether read_shape() would take a file for a curve in columns, or must inspect it.
[[nodiscard]] bool may_be_table(const std::string& path, std::optional<AnyFormat> format, bool curve);

/// Whether read_points() would take a file for points in columns, or must inspect it.
[[nodiscard]] bool may_be_point_table(const std::string& path);

/// A format if it is of this kind.
template <typename Format>
std::optional<Format> format_as(const std::optional<AnyFormat>& format) {
  if (!format || !std::holds_alternative<Format>(*format)) return std::nullopt;
  return std::get<Format>(*format);
}

/// Values of --format.
inline const std::map<std::string, AnyFormat> any_formats = {
    {"obj", SurfaceFormat::obj}, {"off", SurfaceFormat::off}, {"ply", SurfaceFormat::ply}, {"stl", SurfaceFormat::stl},
    {"csv", CurveFormat::csv},   {"dat", CurveFormat::dat},   {"xyz", CurveFormat::xyz},   {"gpx", CurveFormat::gpx}};

/// The plane that a shape's degrees were mapped to; surfaces have none.
inline std::optional<LocalPlane> plane_of(const SurfaceFile& /*file*/) { return std::nullopt; }
inline std::optional<LocalPlane> plane_of(const CurveFile& file) { return file.plane; }

inline PolygonMesh& shape_of(SurfaceFile& file) { return file.mesh; }
inline PolygonCurve& shape_of(CurveFile& file) { return file.curve; }

/// The shape of a kind of file.
template <typename File>
using ShapeOf = std::remove_reference_t<decltype(shape_of(std::declval<File&>()))>;

}  // namespace vspring::cli
