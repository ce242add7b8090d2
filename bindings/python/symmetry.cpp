// Symmetric surfaces and curves.

#include <string>
#include <vector>

#include "bindings.hpp"

namespace vspring::python {

namespace {

/// Its type in Python; `whole` is of the type of the shape that was given.
template <typename Shape>
void add_symmetric(py::module_& module, const char* name) {
  using Type = Symmetric<Shape>;
  py::class_<Type>(module, name, py::module_local())
      .def_readonly("whole", &Type::whole)
      .def_property_readonly("positions", [](const Type& self) { return array_of(self.whole.positions()); })
      .def_property_readonly("partner", [](const Type& self) { return array_of(self.partner); })
      .def_readonly("is_half", &Type::is_half)
      .def_readonly("pairs", &Type::pairs)
      .def_readonly("on_plane", &Type::on_plane);
  module.def(
      "find_symmetry",
      [](const Shape& shape, const std::string& plane) { return find_symmetry(shape, parse_plane(plane)); },
      py::call_guard<py::gil_scoped_release>());
}

}  // namespace

void add_symmetry(py::module_& module) {
  add_symmetric<PolygonMesh>(module, "SymmetricMesh");
  add_symmetric<PolygonCurve>(module, "SymmetricCurve");
}

}  // namespace vspring::python
