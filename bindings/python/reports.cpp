#include "reports.hpp"

namespace vspring::python {

namespace {

py::dict level_of(const LevelReport& level) {
  using namespace pybind11::literals;
  return py::dict("moving_nodes"_a = level.moving_nodes, "iterations"_a = level.iterations,
                  "outcome"_a = name(level.outcome), "strategy"_a = level.strategy, "kept_nodes"_a = level.kept_nodes,
                  "seconds"_a = level.seconds);
}

/// None if they were not measured.
py::object distances_of(const PointDistances& distances) {
  using namespace pybind11::literals;
  if (distances.all.count == 0) return py::none();
  return py::dict("greatest"_a = distances.all.greatest, "point"_a = distances.all.node, "rms"_a = distances.all.rms,
                  "median"_a = distances.median, "percentile90"_a = distances.percentile90,
                  "percentile99"_a = distances.percentile99);
}

}  // namespace

py::dict report_of(const FairReport& report) {
  py::dict fields;
  fields["outcome"] = name(report.outcome);
  fields["usable"] = report.usable();
  fields["method"] = name(report.method);
  fields["springs"] = name(report.springs);
  fields["fair_by"] = name(report.fair_by);
  fields["continuity"] = name(report.continuity);
  fields["iterations"] = report.iterations;
  fields["residual"] = report.residual;
  fields["expected_error"] = report.expected_error;
  fields["nodes"] = report.nodes;
  fields["faces"] = report.faces;
  fields["moving_nodes"] = report.moving_nodes;
  fields["fixed_positions"] = report.fixed_positions;
  fields["sliding_nodes"] = report.sliding_nodes;
  fields["fixed_normals"] = report.fixed_normals;
  fields["fixed_tangents"] = report.fixed_tangents;
  fields["corners"] = report.corners;
  fields["sharp_edges"] = report.sharp_edges;
  fields["rounded_edges"] = array_of(report.rounded_edges);
  fields["greatest_move"] = report.greatest_move;
  fields["rms_move"] = report.rms_move;
  fields["seconds"] = report.seconds;
  fields["threads"] = report.threads;
  fields["history"] = report.history;
  fields["node_iterations"] = report.work;
  fields["node_iteration_limit"] = report.most_work > 0 ? py::object(py::float_(report.most_work)) : py::none();
  py::list levels;
  for (const LevelReport& level : report.levels) levels.append(level_of(level));
  fields["levels"] = std::move(levels);
  py::list warnings;
  for (const Warning& warning : report.warnings) warnings.append(py::make_tuple(name(warning.code), warning.text));
  fields["warnings"] = std::move(warnings);
  fields["origin"] = py::none();
  fields["chains"] = py::none();
  fields["boundary"] = report.boundary ? py::object(report_of(*report.boundary)) : py::none();
  return fields;
}

py::dict report_of(const FitReport& report) {
  py::dict fields = report_of(report.fair);
  fields["points"] = report.points;
  fields["pulling_points"] = report.pulling_points;
  fields["pulled_nodes"] = report.pulled_nodes;
  fields["most_points"] = report.most_points;
  fields["outliers"] = report.outliers;
  fields["outlying_points"] = array_of(report.outlying_points);
  fields["outside_points"] = report.outside_points;
  fields["points_at_held"] = report.at_held.count;
  fields["greatest_at_held"] = report.at_held.greatest;
  fields["active_points"] = array_of(report.active_points);
  fields["noise_leaves"] = report.noise_leaves;
  fields["smoothing_length"] = report.smoothing_length;
  fields["least_radius"] = report.least_radius;
  fields["sharpest_node"] = report.sharpest_node;
  fields["greatest_slide"] = report.greatest_slide;
  fields["boundary_of_points"] = py::none();
  if (const auto& boundary = report.boundary) {
    using namespace pybind11::literals;
    fields["boundary_of_points"] = py::dict("points"_a = boundary->points, "ends"_a = boundary->ends,
                                            "inside"_a = boundary->inside, "kept"_a = boundary->kept);
  }
  fields["before"] = distances_of(report.before);
  fields["after"] = distances_of(report.after);
  return fields;
}

}  // namespace vspring::python
