#include "vspring/curve_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "drawing/svg.hpp"
#include "io/column_names.hpp"
#include "io/curve_formats.hpp"
#include "io/degrees.hpp"
#include "io/formats.hpp"
#include "io/rewriter.hpp"
#include "vspring/error.hpp"
#include "vspring/output_file.hpp"

namespace vspring {
namespace {

constexpr std::array curve_format_names = {"obj", "csv", "dat", "xyz", "gpx", "svg"};
constexpr Formats<CurveFormat> curve_formats(curve_format_names);

void require_plane(std::span<const Vector3> positions) {
  if (const std::size_t node = first_off_plane(positions); node < positions.size())
    throw Error(
        ErrorCode::invalid_argument,
        fmt::format("node {}: it left the plane z = 0, and the file has only x and y; write another format", node));
}

/// The title of a picture.
std::string title_of(const CurveFile& file) {
  if (!file.name.empty()) return file.name;
  if (file.source) return std::filesystem::path(file.source->file.name).filename().string();
  return "curve";
}

void require_all(const CurveFile& file, const std::vector<Vector3>& positions) {
  if (positions.size() != file.curve.positions().size())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} positions given for {} nodes", positions.size(), file.curve.node_count()));
}

void require_order(const CurveFile& file) {
  std::vector<std::uint8_t> seen(file.curve.positions().size(), 0);
  const bool whole = file.row_order.size() == seen.size() &&
                     std::all_of(file.row_order.begin(), file.row_order.end(), [&](Index node) {
                       return node >= 0 && node < file.curve.node_count() &&
                              std::exchange(seen[static_cast<std::size_t>(node)], std::uint8_t{1}) == 0;
                     });
  if (!file.row_order.empty() && !(whole && file.source->has_rows))
    throw Error(
        ErrorCode::invalid_argument,
        fmt::format("{}: the order of its rows is not one of all its nodes; leave it out", file.source->file.name));
}

/// Whether a new table has the names of columns that the file had.
bool writes_names(const CurveFile& file, bool planar) {
  std::vector<std::string> names = {"x", "y", "z"};
  if (file.plane) names = {"lon", "lat", "ele"};
  names.resize(planar ? 2 : 3);
  return file.column_names == names;
}

/// The bytes in a format other than the source's, or of a curve that no file gave or whose nodes are new.
std::string converted(CurveFormat format, const CurveFile& file, const std::vector<Vector3>& positions,
                      std::vector<std::string>& losses) {
  const bool planar = file.planar && first_off_plane(positions) == positions.size();
  for (const std::string& what : file.source ? file.source->carried : file.lost) {
    const bool stays = what == name_carried           ? format == CurveFormat::dat
                       : what == column_names_carried ? format == CurveFormat::csv && writes_names(file, planar)
                                                      : false;
    if (!stays) losses.push_back(what);
  }
  if (!file.source && !file.groups.empty()) losses.emplace_back("groups");
  if (file.plane && format != CurveFormat::gpx && format != CurveFormat::csv)
    losses.push_back("degrees: its x and y are metres east and north of " + origin_of(*file.plane));
  return fresh_curve(format, {file.curve.chains(), positions, planar, file.name, file.plane ? &*file.plane : nullptr},
                     losses);
}

CurveFile curve_of(InputFile file, std::optional<CurveFormat> format, const ColumnChoice& columns,
                   const std::optional<LocalPlane>& plane) {
  require_utf8(file);
  const std::optional<CurveFormat> said = format ? format : curve_format(extension_of(file.name));
  const CurveFormat taken = said ? *said : detect_curve_format(file);
  if (taken != CurveFormat::csv && taken != CurveFormat::xyz && taken != CurveFormat::gpx) refuse_choice(file, columns);
  switch (taken) {
    case CurveFormat::obj:
      return read_obj_curve(std::move(file));
    case CurveFormat::csv:
      return read_csv_curve(std::move(file), columns, plane);
    case CurveFormat::dat:
      return read_dat_curve(std::move(file));
    case CurveFormat::xyz:
      return read_xyz_curve(std::move(file), columns, plane);
    case CurveFormat::gpx:
      return read_gpx_curve(std::move(file), columns, plane);
    case CurveFormat::svg:
      break;
  }
  file.refuse("SVG is a picture, it can only be written; choose a file of OBJ, CSV, DAT, XYZ or GPX");
}

}  // namespace

std::optional<CurveFormat> curve_format(std::string_view extension) { return curve_formats.of_extension(extension); }

CurveFile read_curve(const std::string& path, std::optional<CurveFormat> format, const ColumnChoice& columns,
                     const std::optional<LocalPlane>& plane) {
  return curve_of(read_input(path), format, columns, plane);
}

CurveFile read_curve_bytes(std::string bytes, const std::string& name, std::optional<CurveFormat> format,
                           const ColumnChoice& columns, const std::optional<LocalPlane>& plane) {
  return curve_of(input_of(std::move(bytes), name), format, columns, plane);
}

FileBytes curve_bytes(const std::string& name, const CurveFile& file, const std::vector<Vector3>& positions,
                      std::optional<CurveFormat> format, const CurvePicture& picture) {
  require_all(file, positions);
  const std::optional<CurveFormat> own = file.format == CurveFormat::svg ? std::nullopt : std::optional(file.format);
  const CurveFormat target = curve_formats.to_write(name, format, own);
  const CurveSource* source = file.source.get();
  if (source != nullptr && source->positions.size() != positions.size())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("the curve is not the one that {} gave; reset the source to write it on its own",
                            source->file.name));
  const std::vector<std::uint8_t> moved =
      moved_nodes(source != nullptr ? source->positions : file.curve.positions(), positions);
  FileBytes made;
  if (target == CurveFormat::svg) {
    made.bytes = draw_curve(file, positions, picture);
  } else if (source != nullptr && target == file.format) {
    if (file.planar) require_plane(positions);
    require_order(file);
    made.bytes = source->rewritten({positions, moved, file.row_order});
  } else {
    made.bytes = converted(target, file, positions, made.losses);
  }
  return made;
}

FileBytes curve_bytes(const std::string& name, const PolygonCurve& curve, std::optional<CurveFormat> format,
                      bool planar) {
  CurveFile file;
  file.format = curve_formats.to_write(name, format, std::nullopt);
  file.planar = planar;
  for (Index node = 0; node < curve.node_count(); ++node) {
    if (!curve.position(node).allFinite())
      throw Error(ErrorCode::invalid_argument, fmt::format("node {}: its position is not finite", node));
  }
  if (planar) require_plane(curve.positions());
  file.curve = curve;
  return curve_bytes(name, file, curve.positions(), file.format);
}

void replace_nodes(CurveFile& file, PolygonCurve curve) {
  file.curve = std::move(curve);
  if (file.source) file.lost = file.source->carried;
  file.source = nullptr;
  file.groups.clear();
  file.row_order.clear();
}

std::vector<std::string> write_curve(const std::string& path, const CurveFile& file,
                                     const std::vector<Vector3>& positions, std::optional<CurveFormat> format,
                                     const CurvePicture& picture) {
  FileBytes made = curve_bytes(path, file, positions, format, picture);
  write_file(path, made.bytes);
  return std::move(made.losses);
}

void write_curve(const std::string& path, const PolygonCurve& curve, std::optional<CurveFormat> format, bool planar) {
  write_file(path, curve_bytes(path, curve, format, planar).bytes);
}

std::string draw_curve(const CurveFile& file, const std::vector<Vector3>& positions, const CurvePicture& picture) {
  require_all(file, positions);
  const DrawnCurve after{file.curve.chains(), positions};
  const auto* const part = picture.part ? &*picture.part : nullptr;
  if (picture.before == nullptr) return svg_picture(after, nullptr, picture.points, part, title_of(file));
  const DrawnCurve behind{picture.before->chains(), picture.before->positions()};
  return svg_picture(after, &behind, picture.points, part, title_of(file));
}

std::string fresh_curve(CurveFormat format, const FreshCurve& curve, std::vector<std::string>& losses) {
  switch (format) {
    case CurveFormat::obj:
      return fresh_curve_obj(curve);
    case CurveFormat::csv:
      return fresh_csv(curve, losses);
    case CurveFormat::dat:
      return fresh_dat(curve, losses);
    case CurveFormat::gpx:
      if (curve.plane == nullptr)
        throw Error(ErrorCode::invalid_argument,
                    "GPX has its points in degrees, which this curve does not come from; write another format");
      return fresh_gpx(curve, losses);
    default:
      return fresh_xyz(curve, losses);
  }
}

std::size_t first_off_plane(std::span<const Vector3> positions) {
  const auto found = std::find_if(positions.begin(), positions.end(), [](const Vector3& p) { return p.z() != 0; });
  return static_cast<std::size_t>(found - positions.begin());
}

}  // namespace vspring
