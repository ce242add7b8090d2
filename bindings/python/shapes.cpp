// Surfaces and curves from arrays.

#include <utility>
#include <vector>

#include "bindings.hpp"

namespace vspring::python {

namespace {

/// A curve, and the nodes that follow others as closed chains repeat their first nodes.
py::tuple curve_of(const Array<double>& positions, const std::vector<Array<Index>>& nodes,
                   const std::vector<std::uint8_t>& closed) {
  std::vector<PolygonCurve::Chain> chains;
  chains.reserve(nodes.size());
  for (const Array<Index>& chain : nodes) chains.push_back({.nodes = indices_of(chain)});
  PolygonCurve curve(vectors_of(positions), std::move(chains));
  JoinedEnds ends(curve, closed);
  return py::make_tuple(std::move(curve), std::move(ends));
}

}  // namespace

void add_shapes(py::module_& module) {
  py::class_<PolygonMesh>(module, "Mesh", py::module_local())
      .def(py::init([](const Array<double>& positions, const Array<Index>& corners, const Array<Index>& face_begin) {
        return PolygonMesh::from_arrays(span_of(positions), span_of(face_begin), span_of(corners));
      }))
      .def_static("of_sides",
                  [](const Array<double>& positions, const Array<Index>& corners, Index sides) {
                    return PolygonMesh::from_arrays(span_of(positions), span_of(corners), sides);
                  })
      .def_property_readonly("corners", [](const PolygonMesh& self) { return array_of(self.corners()); })
      .def_property_readonly("face_begin", [](const PolygonMesh& self) { return array_of(self.face_begin()); })
      .def_property_readonly("node_count", &PolygonMesh::node_count);
  py::class_<Welded>(module, "Welded", py::module_local())
      .def_readonly("mesh", &Welded::mesh)
      .def_property_readonly("representative", [](const Welded& self) { return array_of(self.representative); })
      .def("positions", [](const Welded& self, const Array<double>& of_mesh) {
        return array_of(self.positions(vectors_of(of_mesh)));
      });
  module.def("weld", &weld);
  module.def("order_along_curve", [](const Array<double>& points, bool closed) {
    return array_of(order_along_curve(vectors_of(points), closed));
  });
  py::class_<JoinedEnds>(module, "JoinedEnds", py::module_local())
      .def_property_readonly("followers", [](const JoinedEnds& self) { return array_of(self.followers()); })
      .def("hold", &JoinedEnds::hold)
      .def("follow", [](const JoinedEnds& self, const Array<double>& positions) {
        std::vector<Vector3> places = vectors_of(positions);
        self.follow(places);
        return array_of(std::move(places));
      });
  module.def("curve_of", &curve_of);
  py::class_<PolygonCurve>(module, "PlainCurve", py::module_local())
      .def_property_readonly("chains",
                             [](const PolygonCurve& self) {
                               py::list chains;
                               for (const auto& chain : self.chains()) chains.append(array_of(chain.nodes));
                               return chains;
                             })
      .def_property_readonly("closed",
                             [](const PolygonCurve& self) {
                               py::list closed;
                               for (const auto& chain : self.chains()) closed.append(chain.closed);
                               return closed;
                             })
      .def_property_readonly("node_count", &PolygonCurve::node_count);
}

}  // namespace vspring::python
