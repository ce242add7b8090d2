// Surfaces from curves.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "reports.hpp"
#include "run.hpp"

namespace vspring::python {

namespace {

/// The fields of vspring.NetworkCurve.
py::dict fields_of(const NetworkCurve& curve) {
  py::dict fields;
  fields["origin"] = array_of(curve.from);
  fields["nodes"] = array_of(curve.nodes);
  fields["length"] = curve.length;
  fields["sharp"] = curve.is_sharp;
  fields["loops"] = curve.loops;
  return fields;
}

/// The fields of vspring.NetworkLoop.
py::dict fields_of(const NetworkLoop& loop) {
  py::dict fields;
  fields["curves"] = array_of(loop.curves);
  fields["junctions"] = array_of(loop.junctions);
  fields["length"] = loop.length;
  fields["turn"] = loop.turn;
  fields["state"] = name(loop.state);
  fields["grid"] = loop.is_grid;
  fields["first_node"] = loop.first_node;
  fields["node_count"] = loop.node_count;
  fields["first_face"] = loop.first_face;
  fields["face_count"] = loop.face_count;
  return fields;
}

/// Returns the positions, the corners of all faces and where each face begins, the curves, the loops, the sharp edges,
/// the fields of the report, and the exception that ended the call early.
py::tuple span(const PolygonCurve& curves, const py::dict& given, py::object progress) {
  const Settings settings(given);
  SpanOptions options;
  options.fair = fair_options(settings, {.is_curve = false});
  options.edge_length = settings.get<double>("length");
  options.join = settings.get<double>("join");
  options.loops = settings.get<std::vector<Index>>("loops").value_or(std::vector<Index>());
  options.also = settings.get<std::vector<Index>>("also").value_or(std::vector<Index>());
  options.without = settings.get<std::vector<Index>>("without").value_or(std::vector<Index>());
  options.sharp = settings.get<std::vector<Index>>("sharp").value_or(std::vector<Index>());
  options.fair_curves = settings.get<bool>("fair_curves").value_or(false);
  if (const auto plane = settings.get<std::string>("symmetry")) options.symmetry = parse_plane(*plane);
  options.flat = settings.get<bool>("flat").value_or(false);
  Run run(threads_of(settings), std::move(progress));
  SpannedCurves spanned = run([&](Context& context) { return span_curves(curves, options, context); });
  py::list found_curves;
  for (const NetworkCurve& curve : spanned.curves) found_curves.append(fields_of(curve));
  py::list loops;
  for (const NetworkLoop& loop : spanned.loops) loops.append(fields_of(loop));
  std::vector<Index> sharp;
  for (const auto& [a, b] : spanned.sharp_edges) sharp.insert(sharp.end(), {a, b});
  py::dict report = report_of(spanned.report);
  report["usable"] = spanned.usable();
  return py::make_tuple(array_of(std::move(spanned.positions)), array_of(spanned.mesh.corners()),
                        array_of(spanned.mesh.face_begin()), std::move(found_curves), std::move(loops), array_of(sharp),
                        std::move(report), run.stopped_by());
}

}  // namespace

void add_spanning(py::module_& module) { module.def("span", &span); }

}  // namespace vspring::python
