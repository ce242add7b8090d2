#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "any_shape.hpp"
#include "closed_chains.hpp"
#include "commands/commands.hpp"
#include "commands/option_kinds.hpp"
#include "commands/shared_options.hpp"
#include "degrees.hpp"
#include "fairing.hpp"
#include "fitting.hpp"
#include "framing.hpp"
#include "idle_options.hpp"
#include "outputs.hpp"
#include "precision.hpp"
#include "prepared_shape.hpp"
#include "terminal.hpp"
#include "vspring/vspring.hpp"
#include "welding.hpp"

namespace vspring::cli {

namespace {

struct FitArguments : FairingArguments {
  std::optional<AnyFormat> format;
  std::string points;
  ColumnChoice columns;
  ColumnChoice point_columns;
  PullArguments pull;
  bool ignore_normals = false;
  bool curve = false;
  bool closed = false;
};

std::vector<std::string> write(const FitArguments& arguments, const SurfaceFile& file,
                               const std::vector<Vector3>& positions) {
  return write_surface(arguments.output, file, positions, format_as<SurfaceFormat>(arguments.format));
}
std::vector<std::string> write(const FitArguments& arguments, const CurveFile& file,
                               const std::vector<Vector3>& positions) {
  return write_curve(arguments.output, file, positions, format_as<CurveFormat>(arguments.format));
}

using Positions = std::vector<Vector3>;

std::string picture_of_fit(const SurfaceFile& /*file*/, const PolygonMesh& /*after*/, const Positions& /*points*/) {
  return {};
}
std::string picture_of_fit(const CurveFile& file, const PolygonCurve& after, const Positions& points) {
  return draw_curve(file, after.positions(),
                    {.before = &file.curve, .points = points, .part = moved_part(file.curve, after)});
}

/// The columns of POINTS; none if it is no table.
ColumnChoice columns_of_points(const FitArguments& arguments) {
  if (!arguments.point_columns.empty()) return arguments.point_columns;
  return may_be_point_table(arguments.points) ? arguments.columns : ColumnChoice{};
}

template <typename File>
int fit_file(FitArguments arguments, File file, Fairing& fairing) {
  using Shape = ShapeOf<File>;
  refuse_views(arguments, std::is_same_v<File, CurveFile>);
  const ClosedChains closed(shape_of(file), arguments.closed);
  Welding welding(file, arguments);
  const PreparedShape<File> prepared(file, welding, closed, arguments, arguments.pull, false, fairing.context());
  const Shape& shape = prepared.shape();
  const std::optional<LocalPlane> plane = plane_of(file);
  ScatteredPoints points = read_points(arguments.points, columns_of_points(arguments), plane);
  require_same_units(arguments.input, plane, arguments.points, points.plane);
  std::vector<std::string> warnings = file.warnings;
  std::ranges::copy(points.warnings, std::back_inserter(warnings));
  std::ranges::move(prepared.warnings(), std::back_inserter(warnings));
  const bool points_face = !points.normals.empty();
  if (arguments.ignore_normals) points.normals.clear();
  fairing.input_is_read();

  FitOptions options = fit_options(arguments.pull, arguments.options);
  options.boundary_reach = prepared.boundary_reach();
  FitResult result = prepared.mirrored().fit(prepared.constraints(), points, options, fairing.context());
  const Constraints constraints = prepared.mirrored().of_shape(prepared.constraints());
  const FitAccount account(result.report, arguments.pull, arguments.points, points);
  const PolygonMesh cloud(std::move(points.positions), {0}, {});
  closed.follow(result.positions);
  Shape after = shape;
  after.set_positions(result.positions);
  if constexpr (std::is_same_v<Shape, PolygonMesh>) {
    const auto format = format_as<SurfaceFormat>(arguments.format);
    take_written(after, written_positions(arguments.output, file, result.positions, format), warnings);
  }
  const std::vector<Vector3> nodes = welding.positions(result.positions);

  // If a time limit prevented measuring them they are measured now, once, unless the run was interrupted.
  const auto distances = [&]() -> const std::vector<double>& {
    if (result.distances.empty() && !fairing.context().cancelled())
      result.distances = point_distances(cloud.positions(), after, fairing.context());
    return result.distances;
  };
  const auto write_shape = [&] {
    std::vector<std::string> lost = written_without(arguments.output, write(arguments, file, nodes));
    if (arguments.deviation.empty()) return lost;
    const std::vector<double>& deviations = distances();
    if (deviations.empty())
      lost.push_back(not_written(arguments.deviation));
    else
      write_scalars(arguments.deviation, cloud, std::vector<NodeScalar>{{"deviation", deviations}});
    return lost;
  };
  const auto point_deviation = [&]() -> std::vector<NodeScalar> {
    return {{"point_deviation",
             welding.greatest(node_deviations(nodes, cloud.positions(), distances(), fairing.context()))}};
  };
  auto figures = account.figures();
  figures.update(prepared.figures());
  figures.update(figures_of(plane));
  RunFacts facts = prepared.facts();
  facts.points_face = points_face;
  return fairing.finish<Shape>({shape, after, constraints, result.report.fair},
                               welding.with_warnings(std::move(warnings)),
                               {.write = write_shape,
                                .picture = [&] { return picture_of_fit(file, after, cloud.positions()); },
                                .points = cloud.positions(),
                                .scalars = point_deviation,
                                .welding = &welding,
                                .figures = std::move(figures),
                                .lines = prepared.lines() + account.lines() + closed.note() + note_of(plane),
                                .facts = std::move(facts)});
}

/// Throws Error(invalid_argument) for incompatible options.
void check_options(const FitArguments& arguments) {
  if (!arguments.deviation.empty() &&
      scalar_format(std::filesystem::path(arguments.deviation).extension().string()) != ScalarFormat::ply)
    throw Error(ErrorCode::invalid_argument,
                output_name(arguments.deviation) + ": deviations of points go to PLY; name a file .ply");
  if (!asks_to_fit(arguments.pull))
    throw Error(ErrorCode::invalid_argument, "one of --weight, --smoothing-length, --within and --rms has to be given");
  if (!arguments.pull.automatic.empty())
    throw Error(ErrorCode::invalid_argument,
                arguments.pull.automatic + " auto is for shapes whose own nodes are the points (vspring fair, curve)");
  if (arguments.points == "-" && arguments.input == "-")
    throw Error(ErrorCode::invalid_argument, "--points: standard input is the shape already");
  if (!arguments.columns.empty() && !may_be_table(arguments.input, arguments.format, arguments.curve) &&
      (!arguments.point_columns.empty() || !may_be_point_table(arguments.points)))
    throw Error(ErrorCode::invalid_argument, "--columns: neither shape nor points are CSV or XYZ; leave it out");
}

int run_fit(FitArguments arguments) {
  // The last steps of a fit are about k times their distance.
  const double weight = arguments.pull.weight.value_or(0);
  if (!arguments.step_tolerance && weight > 0)
    arguments.step_tolerance = std::min(SweepMethod().step_tolerance, weight / 10);
  check_outputs(arguments, {{"--points", arguments.points}});
  check_options(arguments);
  Fairing fairing(arguments);
  auto shape = read_shape(arguments.input, arguments.format, arguments.curve, arguments.columns);
  const bool is_curve = std::holds_alternative<CurveFile>(shape);
  settle_options(arguments, is_curve, false);
  // Boundaries without constraints follow the points; the paper's own methods refuse them.
  if (!is_curve && !arguments.paper && arguments.options.method_kind() == Method::equilibrium)
    arguments.options.fair_boundary = arguments.options.method;
  return std::visit([&](auto&& file) { return fit_file(arguments, std::forward<decltype(file)>(file), fairing); },
                    std::move(shape));
}

void add_fit_options(CLI::App& command, FitArguments& arguments) {
  command
      .add_option("--points", arguments.points,
                  "The points: the nodes of a file of any of the formats, connectivity ignored. They may have weights: "
                  "PLY's property or CSV's column weight or confidence, the fourth or seventh number in XYZ; and "
                  "normals: nx, ny, nz, numbers four to six in XYZ, OBJ's vn")
      ->required()
      ->type_name("POINTS");
  command.add_flag(
      "--ignore-point-normals", arguments.ignore_normals,
      "Ignore normals of points (default: points with normals pull only at nodes of a surface that face the same way)");
  add_pull_options(command, arguments.pull, "How points pull: one of");
  add_curve_bounds(command, arguments.pull, "How points pull: one of", true);
  add_sharp_curves(command, arguments);
  add_choice(
      command, "--method", arguments.method, methods,
      "The accelerated solver that goes to the true equilibrium, the paper's V-cycle over coarser levels, or its "
      "plain iteration (default: equilibrium)")
      ->group(fairing_group);
  add_stopping_options(command, arguments, "0.001, or K/10 if that is less");
  command
      .add_flag(
          "--paper", arguments.paper,
          "The paper's own choices throughout, its equations as printed: plain average of normals, on curves in space "
          "the principal one; weights 1/length; nodes at the mean of their neighbours; points' displacements in full; "
          "and the method sweep unless --method says another, node after node in the order of the file (on one "
          "thread), with the last iteration as the result (default: off)")
      ->group(fairing_group);
  command
      .add_option("--deviation", arguments.deviation,
                  "Write the points with their distances from the shape, as property deviation (units of the input); "
                  "--scalars has them at nodes, as point_deviation")
      ->type_name("OUT.ply")
      ->group(run_group);
  add_choice(command, "--format", arguments.format, any_formats,
             "Format of - (default: found from the content; the input's)");
  command.add_flag("--curve", arguments.curve, "SHAPE is a curve (default: found from the file; - is a surface)");
  command.add_flag("--closed", arguments.closed,
                   "Curves: join the last node of every chain to the first (default: from the file)");
  add_columns(command, "--columns", arguments.columns, columns_of_curves);
  add_columns(command, "--point-columns", arguments.point_columns,
              "--columns of POINTS, if they differ (default: those of --columns)");
}

}  // namespace

void add_fit_command(CLI::App& app, std::function<int()>& run) {
  const FairingWords words = {.shape = "shape",
                              .input =
                                  "a surface (.obj, .off, .ply, .stl) or a curve (.obj with l elements and no "
                                  "faces, .csv, .dat, .xyz, .gpx)",
                              .ends = "Boundary or end nodes",
                              .unfixed = "; none: they go to where the points end",
                              .directions = "normals (curves: tangents)",
                              .rules = "positions and normals"};
  const auto arguments = std::make_shared<FitArguments>();
  CLI::App& command = *app.add_subcommand("fit", "Fair a surface or curve and fit it to scattered points");
  add_files(command, *arguments, words);
  add_constraint_options(command, *arguments, words);
  add_slide_option(command, *arguments);
  add_symmetry_option(command, *arguments, words);
  add_weld_option(command, *arguments);
  add_refine_options(command, *arguments);
  add_fit_options(command, *arguments);
  add_shaping_options(command, *arguments, words);
  add_run_options(command, *arguments);
  add_picture_options(command, arguments->picture, true);
  command.footer(
      "Examples: a mesh drawn onto a scan, its boundary held; its boundary drawn to where the scan ends\n"
      "  vspring fit mesh.obj --points scan.ply -o fitted.obj --weight 0.01 --report report.json\n"
      "  vspring fit mesh.obj --points scan.ply -o fitted.obj --within 0.1 --fix none\n\n"
      "Exit status: 0 converged; 1 wrong use; 2 unusable input or output; 3 written, but not converged; 130 "
      "interrupted.");
  when_given(command, arguments, run, run_fit);
}

}  // namespace vspring::cli
