// Files of surfaces, curves and points.

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"

namespace vspring::python {

namespace {

using Path = std::string;

/// The format of a name; empty for none.
template <typename Format>
std::optional<Format> format_of(const std::string& word, std::optional<Format> (*known)(std::string_view)) {
  if (word.empty()) return std::nullopt;
  const std::optional<Format> format = known(word);
  if (!format) throw Error(ErrorCode::invalid_argument, "format: \"" + word + "\" is none of a shape of this kind");
  return format;
}

const char* name(SurfaceFormat format) {
  constexpr const char* names[] = {"obj", "off", "ply", "stl"};
  return names[static_cast<int>(format)];
}
const char* name(CurveFormat format) {
  constexpr const char* names[] = {"obj", "csv", "dat", "xyz", "gpx", "svg"};
  return names[static_cast<int>(format)];
}

py::dict groups_of(const Groups& groups) {
  py::dict made;
  for (const auto& [group, nodes] : groups) made[py::str(group)] = array_of(nodes);
  return made;
}

/// A row per face if all have equally many nodes; else all corners, and where each face begins.
py::object faces_of(const py::object& self) {
  const PolygonMesh& mesh = self.cast<const SurfaceFile&>().mesh;
  const std::vector<Index>& corners = mesh.corners();
  const py::ssize_t faces = mesh.face_count();
  const auto corner_count = static_cast<py::ssize_t>(corners.size());
  const std::vector<Index> begin = mesh.face_begin();
  const Index sides = faces > 0 ? begin[1] : 3;
  bool uniform = true;
  for (std::size_t face = 0; face < begin.size(); ++face) uniform &= begin[face] == static_cast<Index>(face) * sides;
  if (uniform) return view_of(corners.data(), {faces, sides}, self);
  return py::make_tuple(view_of(corners.data(), {corner_count}, self), array_of(begin));
}

void add_surface(py::module_& module) {
  py::class_<SurfaceFile>(module, "Surface", py::module_local(),
                          "A surface and everything else that its file carried, from vspring.read().")
      .def_property_readonly(
          "vertices",
          [](const py::object& self) {
            const PolygonMesh& mesh = self.cast<const SurfaceFile&>().mesh;
            return view_of(coordinates(mesh.positions()).data(), {mesh.node_count(), 3}, self);
          },
          "(n, 3) float64, in units of the file; read only, as nothing is copied.")
      .def_property_readonly("faces", &faces_of,
                             "(m, k) node numbers where all faces have k nodes; else a tuple of all corners and m + 1 "
                             "offsets. Read only.")
      .def_property_readonly(
          "groups", [](const SurfaceFile& file) { return groups_of(file.groups); },
          "Node numbers by the names that the file gives groups of faces.")
      .def_property_readonly(
          "normals",
          [](const SurfaceFile& file) {
            return file.normals.empty() ? py::object(py::none()) : array_of(file.normals);
          },
          "The file's own, (n, 3), unit length, zero where a node has none; None where the file gives none.")
      .def_property_readonly(
          "marked_edges", [](const SurfaceFile& file) { return array_of(marked_edges(file)); },
          "(k, 2) node numbers: edges that the file marks, by lines of OBJ or the element edge of PLY, for sharp_edges "
          "of fair() and fit(). Raises vspring.Error for marks that cannot be read. Cost: linear, each time.")
      .def_property_readonly(
          "format", [](const SurfaceFile& file) { return name(file.format); }, "obj, off, ply or stl.")
      .def_property_readonly("_core", [](const SurfaceFile& file) { return file.mesh; })
      .def_property_readonly("_warnings", [](const SurfaceFile& file) { return file.warnings; })
      .def("__repr__", [](const SurfaceFile& file) {
        return "Surface: " + std::to_string(file.mesh.node_count()) + " nodes, " +
               std::to_string(file.mesh.face_count()) + " faces, from " + name(file.format);
      });
}

void add_curve(py::module_& module) {
  py::class_<CurveFile>(module, "Curve", py::module_local(),
                        "A curve and everything else that its file carried, from vspring.read().")
      .def_property_readonly(
          "vertices",
          [](const py::object& self) {
            const auto& file = self.cast<const CurveFile&>();
            return view_of(coordinates(file.curve.positions()).data(), {file.curve.node_count(), file.planar ? 2 : 3},
                           self, 3);
          },
          "(n, 2) or (n, 3) float64, in units of the file, of latitudes and longitudes metres; read only.")
      .def_property_readonly(
          "chains",
          [](const CurveFile& file) {
            py::list chains;
            for (const auto& chain : file.curve.chains()) chains.append(array_of(chain.nodes));
            return chains;
          },
          "Node numbers of each chain, in order.")
      .def_property_readonly(
          "closed",
          [](const CurveFile& file) {
            py::list closed;
            for (const auto& chain : file.curve.chains()) closed.append(chain.closed);
            return closed;
          },
          "Whether the last node of each chain joins the first.")
      .def_property_readonly(
          "groups", [](const CurveFile& file) { return groups_of(file.groups); },
          "Node numbers by the names that the file gives groups of lines.")
      .def_property_readonly(
          "format", [](const CurveFile& file) { return name(file.format); }, "obj, csv, dat, xyz or gpx.")
      .def_property_readonly("_core", [](const CurveFile& file) { return file.curve; })
      .def_property_readonly("_warnings", [](const CurveFile& file) { return file.warnings; })
      .def("__repr__", [](const CurveFile& file) {
        return "Curve: " + std::to_string(file.curve.node_count()) + " nodes, " +
               std::to_string(file.curve.chains().size()) + " chains, from " + name(file.format);
      });
}

/// Returns positions, weights or None, and normals or None.
py::tuple points_of(const Path& path, const ColumnChoice& columns) {
  ScatteredPoints points = [&] {
    const py::gil_scoped_release unlocked;
    return read_points(path, columns);
  }();
  if (points.plane)
    throw Error(ErrorCode::unusable_file,
                path + ": gives latitudes and longitudes, which points cannot have here; fit them on the command line");
  const auto or_none = [](auto& values) {
    return values.empty() ? py::object(py::none()) : array_of(std::move(values));
  };
  py::object weights = or_none(points.weights);
  py::object normals = or_none(points.normals);
  return py::make_tuple(array_of(std::move(points.positions)), weights, normals, points.warnings);
}

}  // namespace

void add_files(py::module_& module) {
  using Unlocked = py::call_guard<py::gil_scoped_release>;
  add_surface(module);
  add_curve(module);
  module.def("read_file", [](const Path& path) { return py::bytes(read_file(path)); });
  module.def("read_points", &points_of);
  module.def(
      "read_surface",
      [](const Path& path, const std::string& format) {
        return read_surface(path, format_of(format, &surface_format));
      },
      Unlocked());
  module.def(
      "read_curve",
      [](const Path& path, const std::string& format, const ColumnChoice& columns) {
        return read_curve(path, format_of(format, &curve_format), columns);
      },
      Unlocked());
  // Returns what the file carried and the output does not.
  module.def(
      "write_surface",
      [](const Path& path, const SurfaceFile& file, const Array<double>& positions, const std::string& format) {
        return write_surface(path, file, vectors_of(positions), format_of(format, &surface_format));
      },
      Unlocked());
  module.def(
      "write_curve",
      [](const Path& path, const CurveFile& file, const Array<double>& positions, const std::string& format) {
        return write_curve(path, file, vectors_of(positions), format_of(format, &curve_format),
                           {.before = &file.curve});
      },
      Unlocked());
  module.def(
      "write_mesh",
      [](const Path& path, const PolygonMesh& mesh, const std::string& format) {
        write_surface(path, mesh, format_of(format, &surface_format));
      },
      Unlocked());
  module.def(
      "write_plain_curve",
      [](const Path& path, const PolygonCurve& curve, bool planar, const std::string& format) {
        write_curve(path, curve, format_of(format, &curve_format), planar);
      },
      Unlocked());
}

}  // namespace vspring::python
