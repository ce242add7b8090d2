// Fairing and measuring.

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "reports.hpp"
#include "run.hpp"

namespace vspring::python {

namespace {

/// The shape that was given.
template <typename Shape>
const Shape& given_of(const Shape& shape) {
  return shape;
}
template <typename Shape>
const Shape& given_of(const Symmetric<Shape>& shape) {
  return shape.given;
}

template <typename Shape>
constexpr bool is_curve = std::is_same_v<std::decay_t<decltype(given_of(std::declval<const Shape&>()))>, PolygonCurve>;

/// Shape: a surface or curve, or a symmetric one. Returns the new positions, the fields of the report, and the
/// exception that ended the call early.
template <typename Shape>
py::tuple fair_shape(const Shape& shape, const Constraints& constraints, const py::dict& given, py::object progress) {
  const Settings settings(given);
  FairOptions options = fair_options(settings, {.is_curve = is_curve<Shape>});
  if constexpr (is_curve<Shape>) {
    if (const auto angle = settings.get<double>("sharp")) options.corners = find_corners(given_of(shape), *angle);
  }
  Run run(threads_of(settings), std::move(progress));
  FairResult result = run([&](Context& context) { return fair(shape, constraints, options, context); });
  return py::make_tuple(array_of(std::move(result.positions)), report_of(result.report), run.stopped_by());
}

/// Adds, for a curve with new nodes, their numbers in the input and its chains.
void tell_of_nodes(py::dict& fields, const Resampled& resampled) {
  fields["origin"] = array_of(resampled.from);
  py::list chains;
  for (const PolygonCurve::Chain& chain : resampled.curve.chains()) chains.append(array_of(chain.nodes));
  fields["chains"] = std::move(chains);
}

/// Fairs a curve with new nodes.
py::tuple fair_with_new_nodes(const PolygonCurve& curve, const Constraints& constraints, const py::dict& given,
                              py::object progress) {
  const Settings settings(given);
  const FairOptions options = fair_options(settings, {.is_curve = true});
  Resampling how = resampling_of(settings).value();
  if (const auto angle = settings.get<double>("sharp")) how.corners = find_corners(curve, *angle);
  Run run(threads_of(settings), std::move(progress));
  ResampledFair made = run([&](Context& context) { return fair_resampled(curve, constraints, how, options, context); });
  py::dict fields = report_of(made.fair.report);
  tell_of_nodes(fields, made.resampled);
  return py::make_tuple(array_of(std::move(made.fair.positions)), std::move(fields), run.stopped_by());
}

void settle_moving(FitOptions& /*options*/, const Settings& /*settings*/, const SurfaceFile* /*file*/) {}

/// file: its columns are named.
void settle_moving(FitOptions& options, const Settings& settings, const CurveFile* file) {
  const auto names = settings.get<std::vector<std::string>>("move");
  if (!names) return;
  CurveFile nameless;
  nameless.planar = settings.get<bool>("planar").value_or(false);
  const CurveFile& named = file == nullptr ? nameless : *file;
  options.moving_axes = choose_axes(named, *names);
  // In a plane no coordinate is left to keep then.
  if (named.planar && options.moving_axes[0] && options.moving_axes[1]) options.moving_axes[2] = true;
}

/// Fits a shape, or a symmetric one; returns distances of the points, too. positions: of the points; empty: the shape's
/// own nodes. weights, normals: of each, or empty.
template <typename Shape, typename File>
py::tuple fit_shape(const Shape& shape, const Constraints& constraints, const std::optional<Array<double>>& positions,
                    const std::optional<Array<double>>& weights, const std::optional<Array<double>>& normals,
                    const py::dict& given, const File* file, py::object progress) {
  const Settings settings(given);
  FitOptions options = fit_options(settings, {.is_curve = is_curve<Shape>, .own_nodes_pull = !positions.has_value()});
  settle_moving(options, settings, file);
  ScatteredPoints points{.positions = positions ? vectors_of(*positions) : given_of(shape).positions()};
  if (weights) points.weights = {weights->data(), weights->data() + weights->size()};
  if (normals) points.normals = vectors_of(*normals);
  Run run(threads_of(settings), std::move(progress));
  FitResult result = run([&](Context& context) { return fit(shape, constraints, points, options, context); });
  py::dict fields = report_of(result.report);
  fields["distances"] = array_of(std::move(result.distances));
  return py::make_tuple(array_of(std::move(result.positions)), std::move(fields), run.stopped_by());
}

/// Fits a curve to its own nodes and puts new nodes on it.
py::tuple fit_with_new_nodes(const PolygonCurve& curve, const Constraints& constraints, const py::dict& given,
                             const CurveFile* file, py::object progress) {
  const Settings settings(given);
  FitOptions options = fit_options(settings, {.is_curve = true, .own_nodes_pull = true});
  settle_moving(options, settings, file);
  const Resampling how = resampling_of(settings).value();
  Run run(threads_of(settings), std::move(progress));
  ResampledFit made = run([&](Context& context) { return fit_resampled(curve, constraints, how, options, context); });
  py::dict fields = report_of(made.fit.report);
  fields["distances"] = array_of(std::move(made.fit.distances));
  tell_of_nodes(fields, made.resampled);
  return py::make_tuple(array_of(std::move(made.fit.positions)), std::move(fields), run.stopped_by());
}

NoiseEstimate noise_of(const PolygonMesh& mesh, std::span<const Index> region, const FitOptions& /*options*/,
                       const Context& context) {
  return region.empty() ? estimate_noise(mesh, context) : estimate_noise(mesh, region, context);
}
NoiseEstimate noise_of(const PolygonCurve& curve, std::span<const Index> region, const FitOptions& options,
                       const Context& /*context*/) {
  return region.empty() ? estimate_noise(curve, options.moving_axes)
                        : estimate_noise(curve, region, options.moving_axes);
}

/// Returns the deviation of the noise, how far it moves the furthest node, and the size of voxels or None. region:
/// numbers of nodes; empty: everywhere.
template <typename Shape, typename File>
py::tuple estimate(const Shape& shape, const Array<Index>& region, const py::dict& given, const File* file) {
  const Settings settings(given);
  FitOptions options;
  settle_moving(options, settings, file);
  Run run(threads_of(settings), py::none());
  const NoiseEstimate noise =
      run([&](const Context& context) { return noise_of(shape, span_of(region), options, context); });
  run.raise_if_stopped();
  const py::object voxel =
      noise.voxel ? py::object(py::make_tuple(noise.voxel->x(), noise.voxel->y(), noise.voxel->z())) : py::none();
  return py::make_tuple(noise.deviation, greatest_of_noise(noise), voxel);
}

std::vector<Figure> figures_of(const PolygonMesh& mesh, const Constraints* constraints, const Context& context) {
  return list_figures(measure_surface(mesh, constraints, context));
}
std::vector<Figure> figures_of(const PolygonCurve& curve, const Constraints* constraints, const Context& /*context*/) {
  return list_figures(measure_curve(curve, constraints));
}

/// Returns for each figure its key, name, unit, definition and value.
template <typename Shape>
py::list measure_shape(const Shape& shape, const Constraints* constraints, int threads) {
  check_measurable(shape, constraints);
  Run run(threads, py::none());
  const std::vector<Figure> figures =
      run([&](const Context& context) { return figures_of(shape, constraints, context); });
  run.raise_if_stopped();
  py::list list;
  for (const Figure& figure : figures) {
    const py::object value =
        figure.whole ? py::object(py::int_(static_cast<Index>(figure.value))) : py::object(py::float_(figure.value));
    list.append(py::make_tuple(std::string(figure.key), std::string(figure.name), std::string(figure.unit),
                               std::string(figure.definition), value));
  }
  return list;
}

/// Returns k1 and k2 of every node, its normal, and the directions of k1 and k2.
py::tuple curvatures_of_surface(const PolygonMesh& mesh, int threads) {
  check_measurable(mesh);
  Run run(threads, py::none());
  const std::vector<NodeCurvature> found = run([&](const Context& context) { return curvatures(mesh, context); });
  run.raise_if_stopped();
  const auto each = [&](const auto& part) {
    std::vector<std::decay_t<decltype(found.front().*part)>> values(found.size());
    std::ranges::transform(found, values.begin(), part);
    return array_of(std::move(values));
  };
  return py::make_tuple(each(&NodeCurvature::k1), each(&NodeCurvature::k2), each(&NodeCurvature::normal),
                        each(&NodeCurvature::direction1), each(&NodeCurvature::direction2));
}

/// Shape: a surface or curve.
template <typename Shape, typename File>
void add_calls(py::module_& module) {
  const auto add_fit = [&](auto fit) {
    module.def("fit", fit, py::arg("shape"), py::arg("constraints"), py::arg("positions").none(true),
               py::arg("weights").none(true), py::arg("normals").none(true), py::arg("given"),
               py::arg("file").none(true), py::arg("progress"));
  };
  module.def("fair", &fair_shape<Shape>);
  module.def("fair", &fair_shape<Symmetric<Shape>>);
  add_fit(&fit_shape<Shape, File>);
  add_fit(&fit_shape<Symmetric<Shape>, File>);
  module.def("estimate_noise", &estimate<Shape, File>, py::arg("shape"), py::arg("region"), py::arg("given"),
             py::arg("file").none(true));
  module.def("measure", &measure_shape<Shape>, py::arg("shape"), py::arg("constraints").none(true), py::arg("threads"));
}

}  // namespace

void add_fairing(py::module_& module) {
  add_calls<PolygonMesh, SurfaceFile>(module);
  add_calls<PolygonCurve, CurveFile>(module);
  module.def("fair_resampled", &fair_with_new_nodes);
  module.def("fit_resampled", &fit_with_new_nodes, py::arg("curve"), py::arg("constraints"), py::arg("given"),
             py::arg("file").none(true), py::arg("progress"));
  module.def("curvatures", &curvatures_of_surface);
}

}  // namespace vspring::python
