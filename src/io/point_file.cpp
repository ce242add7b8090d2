#include "vspring/point_file.hpp"

#include <algorithm>
#include <cmath>

#include "io/column_names.hpp"
#include "io/curve_source.hpp"
#include "io/detect_curve_format.hpp"
#include "io/detect_format.hpp"
#include "io/format_choice.hpp"
#include "io/obj_statements.hpp"
#include "io/point_source.hpp"
#include "io/surface_source.hpp"

namespace vspring {
namespace {

class ObjPoints : public ObjStatements {
 public:
  explicit ObjPoints(const InputFile& file) : ObjStatements(file) {
    const auto lines = static_cast<std::size_t>(std::count(file.bytes.begin(), file.bytes.end(), '\n')) + 1;
    // Room that is not used is never touched.
    positions_.reserve(lines);
    node_rows_.reserve(lines);
  }

  ScatteredPoints take() {
    read();
    if (positions_.empty()) file_.refuse("no node (a line that begins with v) is in it; choose another file");
    // Of normals in another order than the nodes nobody knows here which is whose.
    if (normals_.size() != positions_.size() || mixed_) normals_.clear();
    return {.positions = std::move(positions_), .normals = std::move(normals_)};
  }

 protected:
  bool read_element(std::string_view keyword) override {
    if (keyword == "vn") {
      Vector3& normal = normals_.emplace_back();
      for (double& component : normal) {
        cursor_.skip_blanks();
        component = cursor_.number("a component of a normal");
      }
      return true;
    }
    if (keyword != "f") return false;
    for (cursor_.skip_blanks(); !cursor_.at_line_end() && cursor_.peek() != '#'; cursor_.skip_blanks()) {
      const std::string_view corner = cursor_.word();
      const std::size_t normal = corner.rfind('/');
      if (std::count(corner.begin(), corner.end(), '/') == 2)
        mixed_ = mixed_ || corner.substr(0, corner.find('/')) != corner.substr(normal + 1);
    }
    return true;
  }

 private:
  std::vector<Vector3> normals_;
  bool mixed_ = false;
};

ScatteredPoints read_surface_points(InputFile file, SurfaceFormat format) {
  switch (format) {
    case SurfaceFormat::obj:
      return read_obj_points(file);
    case SurfaceFormat::off:
      return {read_off(std::move(file)).mesh.positions()};
    case SurfaceFormat::ply:
      return read_ply_points(file);
    case SurfaceFormat::stl:
      break;
  }
  return {read_stl(std::move(file)).mesh.positions()};
}

}  // namespace

bool is_point_normal(const Vector3& normal) {
  constexpr double tolerance = 0.01;
  return normal.isZero(0) || std::abs(normal.norm() - 1) <= tolerance;
}

bool is_point_weight(double weight) { return std::isfinite(weight) && weight >= 0; }

ScatteredPoints read_obj_points(const InputFile& file) { return ObjPoints(file).take(); }

ScatteredPoints read_points(const std::string& path, const ColumnChoice& columns) {
  InputFile file = read_input(path);
  const std::string extension = extension_of(path);
  std::optional<CurveFormat> curve = curve_format(extension);
  if (!curve || *curve == CurveFormat::obj) {
    std::optional<SurfaceFormat> surface = detect_format(file.bytes);
    if (!surface) surface = surface_format(extension);
    if (surface) {
      refuse_choice(file, columns);
      return read_surface_points(std::move(file), *surface);
    }
    curve = detect_curve_format(file);
  }
  if (*curve != CurveFormat::csv && *curve != CurveFormat::xyz) refuse_choice(file, columns);
  switch (*curve) {
    case CurveFormat::csv:
      return read_csv_points(file, columns);
    case CurveFormat::dat:
      return {read_dat_curve(std::move(file)).curve.positions()};
    case CurveFormat::xyz:
      return read_xyz_points(file, columns);
    default:
      break;
  }
  file.refuse("SVG is a picture; choose a file of points");
}

}  // namespace vspring
