// Filling holes.

#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "reports.hpp"
#include "run.hpp"

namespace vspring::python {

namespace {

/// The fields of vspring.Hole.
py::dict fields_of(const Hole& hole) {
  py::dict fields;
  fields["rim"] = array_of(hole.rim);
  fields["length"] = hole.length;
  fields["state"] = name(hole.state);
  fields["fault"] = fault_message(hole);
  fields["first_node"] = hole.first_node;
  fields["node_count"] = hole.node_count;
  fields["first_face"] = hole.first_face;
  fields["face_count"] = hole.face_count;
  fields["outcome"] = hole.outcome ? py::object(py::str(name(*hole.outcome))) : py::none();
  return fields;
}

/// Returns the new positions, the corners of all faces and where each face begins, the holes, the fields of the report,
/// and the exception that ended the call early.
py::tuple fill_surface(const PolygonMesh& mesh, const py::dict& given, py::object progress) {
  const Settings settings(given);
  FillOptions options;
  options.fair = fair_options(settings, {.is_curve = false});
  options.at = settings.get<std::vector<Index>>("at").value_or(std::vector<Index>());
  options.outer_rims = settings.get<bool>("outer_rims").value_or(false);
  options.most_length = settings.get<double>("max_size").value_or(options.most_length);
  options.most_edges = settings.get<Index>("max_edges").value_or(options.most_edges);
  options.flat = settings.get<bool>("flat").value_or(false);
  Run run(threads_of(settings), std::move(progress));
  FilledHoles filled = run([&](Context& context) { return fill_holes(mesh, options, context); });
  py::list holes;
  for (const Hole& hole : filled.holes) holes.append(fields_of(hole));
  py::dict report = report_of(filled.report);
  report["usable"] = filled.usable();
  return py::make_tuple(array_of(std::move(filled.positions)), array_of(filled.mesh.corners()),
                        array_of(filled.mesh.face_begin()), std::move(holes), std::move(report), run.stopped_by());
}

}  // namespace

void add_filling(py::module_& module) { module.def("fill", &fill_surface); }

}  // namespace vspring::python
