// Constraints.

#include <array>
#include <string>
#include <vector>

#include "bindings.hpp"

namespace vspring::python {

namespace {

using Place = std::array<double, 3>;
Vector3 vector(const Place& place) { return {place[0], place[1], place[2]}; }

void fix_boundary_directions(Constraints& constraints, const PolygonMesh& mesh, const MeshEdges& sharp) {
  fix_boundary_normals(constraints, mesh, sharp);
}
void fix_boundary_directions(Constraints& constraints, const PolygonCurve& curve, const MeshEdges& /*sharp*/) {
  fix_boundary_tangents(constraints, curve);
}

void fix_directions(Constraints& constraints, const PolygonMesh& mesh, const std::vector<Index>& nodes) {
  const std::vector<Vector3> normals = estimate_normals(mesh, nodes);
  for (std::size_t k = 0; k < nodes.size(); ++k) constraints.fix_normal(nodes[k], normals[k]);
}
void fix_directions(Constraints& constraints, const PolygonCurve& curve, const std::vector<Index>& nodes) {
  const std::vector<Vector3> tangents = estimate_tangents(curve, nodes);
  for (std::size_t k = 0; k < nodes.size(); ++k) constraints.fix_tangent(nodes[k], tangents[k]);
}

/// Checks node numbers before the shape is asked about them.
void check(const Constraints& constraints, const std::vector<Index>& nodes) {
  for (const Index node : nodes) (void)constraints.position_fixed(node);
}

/// Returns the sharp edges that rules name.
MeshEdges rules_applied(Constraints& constraints, const PolygonMesh& mesh, const std::string& json,
                        const RuleInput& input) {
  return apply_rules(constraints, mesh, json, input);
}
MeshEdges rules_applied(Constraints& constraints, const PolygonCurve& curve, const std::string& json,
                        const RuleInput& input) {
  apply_rules(constraints, curve, json, input);
  return {};
}

RuleInput input_of(const SurfaceFile* file, const Welded* welded) {
  RuleInput input{.welded = welded};
  if (file != nullptr) {
    input.groups = &file->groups;
    input.normals = &file->normals;
  }
  return input;
}
RuleInput input_of(const CurveFile* file, const Welded* /*of_surfaces*/) {
  return file == nullptr ? RuleInput{} : RuleInput{.groups = &file->groups};
}

/// File: of the kind that the shape was read from; null if no file gave it.
template <typename Shape, typename File>
void add_rules(py::class_<Constraints>& type) {
  type.def(
      "apply_rules",
      [](Constraints& self, const Shape& shape, const std::string& json, const File* file, const Welded* welded,
         Index named_nodes) {
        RuleInput input = input_of(file, welded);
        input.named_nodes = named_nodes;
        return array_of(rules_applied(self, shape, json, input));
      },
      py::arg("shape"), py::arg("json"), py::arg("file").none(true), py::arg("welded").none(true),
      py::arg("named_nodes"));
  type.def(
      "select",
      [](const Constraints& /*self*/, const Shape& shape, const std::string& region, const File* file) {
        return array_of(
            select_region(shape.positions(), parse_region(region), file == nullptr ? Groups{} : file->groups));
      },
      py::arg("shape"), py::arg("region"), py::arg("file").none(true));
  type.def("restrict_to", [](Constraints& self, const Shape& shape, const Array<Index>& region) {
    restrict_to_region(self, shape, span_of(region));
  });
}

template <typename Shape>
void add_holds(py::class_<Constraints>& type) {
  type.def("fix_boundary", [](Constraints& self, const Shape& shape) { fix_boundary_positions(self, shape); });
  type.def("fix_boundary_directions", [](Constraints& self, const Shape& shape, const Array<Index>& sharp) {
    fix_boundary_directions(self, shape, edges_of(sharp));
  });
  type.def("fix", [](Constraints& self, const Shape& shape, const Array<Index>& numbers) {
    const std::vector<Index> nodes = indices_of(numbers);
    check(self, nodes);
    for (const Index node : nodes) self.fix_position(node, shape.position(node));
  });
  type.def("fix_directions", [](Constraints& self, const Shape& shape, const Array<Index>& numbers) {
    const std::vector<Index> nodes = indices_of(numbers);
    check(self, nodes);
    fix_directions(self, shape, nodes);
  });
}

}  // namespace

void add_constraints(py::module_& module) {
  py::class_<Constraints> type(module, "Constraints", py::module_local());
  type.def(py::init<Index>());
  type.def("fix_position", [](Constraints& self, Index node, const Place& at) { self.fix_position(node, vector(at)); });
  type.def("free_position", &Constraints::free_position);
  type.def("fix_normal",
           [](Constraints& self, Index node, const Place& along) { self.fix_normal(node, vector(along)); });
  type.def("free_normal", &Constraints::free_normal);
  type.def("fix_tangent",
           [](Constraints& self, Index node, const Place& along) { self.fix_tangent(node, vector(along)); });
  type.def("free_tangent", py::overload_cast<Index>(&Constraints::free_tangent));
  add_holds<PolygonMesh>(type);
  add_holds<PolygonCurve>(type);
  add_rules<PolygonMesh, SurfaceFile>(type);
  add_rules<PolygonCurve, CurveFile>(type);
  type.def("restrict_boundary_to", [](Constraints& self, const PolygonMesh& mesh, const Array<Index>& region) {
    restrict_to_region(self, boundary_curve(mesh), span_of(region));
  });
}

}  // namespace vspring::python
