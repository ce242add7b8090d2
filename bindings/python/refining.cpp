// Refining surfaces.

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "bindings.hpp"

namespace vspring::python {

void add_refining(py::module_& module) {
  py::class_<Refined>(module, "Refined", py::module_local())
      .def_property_readonly("positions", [](const Refined& self) { return array_of(self.mesh.positions()); })
      .def_property_readonly("corners", [](const Refined& self) { return array_of(self.mesh.corners()); })
      .def_property_readonly("face_begin", [](const Refined& self) { return array_of(self.mesh.face_begin()); })
      .def_property_readonly("face_from", [](const Refined& self) { return array_of(self.face_from); })
      .def_property_readonly("boundary_reach", [](const Refined& self) { return self.boundary_reach; })
      .def_property_readonly("free",
                             [](const Refined& self) {
                               std::vector<Index> free;
                               for (Index node = 0; node < self.mesh.node_count(); ++node) {
                                 if (!self.constraints.position_fixed(node)) free.push_back(node);
                               }
                               return array_of(std::move(free));
                             })
      .def("parts_of",
           [](const Refined& self, const Array<Index>& edges) { return array_of(self.parts_of(edges_of(edges))); })
      .def("at_nodes",
           [](const Refined& self, const Array<double>& values) { return array_of(self.at_nodes(span_of(values))); });
  py::class_<Remeshed, Refined>(module, "Remeshed", py::module_local())
      .def_property_readonly("length", [](const Remeshed& self) { return self.length; })
      .def_property_readonly("lines", [](const Remeshed& self) { return array_of(self.lines); })
      .def_property_readonly("node_from", [](const Remeshed& self) {
        std::vector<Index> from = self.numbers_in_means();
        std::fill(from.begin() + self.kept_node_count(), from.end(), -1);
        return array_of(std::move(from));
      });
  module.def("remesh", [](const PolygonMesh& mesh, const Constraints& constraints, std::optional<double> length,
                          const Array<Index>& lines) {
    const Remeshing how = {.length = length, .lines = edges_of(lines)};
    const py::gil_scoped_release released;
    return remesh(mesh, constraints, how);
  });
  module.def(
      "refine",
      [](const PolygonMesh& mesh, const Constraints& constraints, std::optional<double> length,
         std::optional<double> turn) { return refine(mesh, constraints, {.length = length, .turn = turn}); },
      py::call_guard<py::gil_scoped_release>());
  module.def("refined_file",
             [](const SurfaceFile& file, const Refined& refined) { return refined_file(file, refined); });
}

}  // namespace vspring::python
