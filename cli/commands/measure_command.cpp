#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
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
#include "exit_status.hpp"
#include "figures.hpp"
#include "fitting.hpp"
#include "framing.hpp"
#include "holding.hpp"
#include "idle_options.hpp"
#include "interruption.hpp"
#include "measuring.hpp"
#include "outputs.hpp"
#include "scalars.hpp"
#include "terminal.hpp"
#include "vspring/vspring.hpp"
#include "welding.hpp"

namespace vspring::cli {

namespace {

struct MeasureArguments : FairingArguments {
  std::optional<AnyFormat> format;
  std::string compare;
  ColumnChoice columns;
  std::vector<std::string> moving;  ///< names of coordinates to estimate noise in; empty: all
  bool curve = false;
  bool closed = false;
};

/// A file and its welding.
template <typename File>
struct WeldedFile {
  File file;
  Welding welding;

  WeldedFile(File read, const MeasureArguments& arguments) : file(std::move(read)), welding(file, arguments) {}
  [[nodiscard]] const auto& shape() const { return welding.shape(file); }
};

/// The shape, followed by the one that it is compared with, if any.
template <typename File>
using WeldedFiles = std::vector<WeldedFile<File>>;

/// Throws if deviations are to be shown and no second shape has the same nodes.
void refuse_deviation(const WeldedFiles<SurfaceFile>& files) {
  if (files.size() == 1)
    throw Error(ErrorCode::invalid_argument, "--picture-style deviation: from what? give --compare");
  if (!files[0].shape().has_same_faces(files[1].shape()))
    throw Error(ErrorCode::unusable_shape,
                "--picture-style deviation: the two shapes have not the same faces; leave it out, or see --scalars");
}
void refuse_deviation(const WeldedFiles<CurveFile>& /*files*/) {}

/// The constraints, if any option gives some.
template <typename File>
std::optional<Constraints> held_in(const MeasureArguments& arguments, const WeldedFiles<File>& files) {
  const std::initializer_list<const char*> options = {"--fix", "--fix-normals", "--constraints", "--region"};
  if (std::ranges::none_of(options, [&](const char* option) { return arguments.given.contains(option); })) return {};
  // "As in the input" means as in the shape before, if given.
  const bool before = files.size() > 1 && files[1].shape().node_count() == files[0].shape().node_count();
  const WeldedFile<File>& input = files[before ? 1 : 0];
  return make_constraints(arguments, input.shape(), input.welding.rules(input.file));
}

/// The coordinates in which --noise auto and --within auto estimate noise.
std::array<bool, 3> noisy_axes(const MeasureArguments& arguments, const CurveFile& file) {
  return moving_axes(file, arguments.moving);
}
std::array<bool, 3> noisy_axes(const MeasureArguments& /*arguments*/, const SurfaceFile& /*file*/) {
  return {true, true, true};
}

/// The noise of a file's welded nodes.
template <typename File>
NoiseEstimate noise_in(const WeldedFile<File>& file, const MeasureArguments& arguments, const std::array<bool, 3>& axes,
                       const Context& context) {
  PullArguments pull;
  pull.moving_axes = axes;
  double rounding = 0;
  if constexpr (std::is_same_v<File, SurfaceFile>) rounding = rounding_of(file.file);
  return at_least_rounding(noise_of(file.shape(), pull, context,
                                    region_of(arguments, file.shape().positions(), file.welding.rules(file.file))),
                           rounding);
}

/// The names of the files; with their folders if both have the same.
std::vector<std::string> titles(const MeasureArguments& arguments) {
  const std::string first = input_name(arguments.input);
  if (arguments.compare.empty()) return {first};
  const std::string second = input_name(arguments.compare);
  const std::string a = std::filesystem::path(first).filename().string();
  const std::string b = std::filesystem::path(second).filename().string();
  return a == b ? std::vector{first, second} : std::vector{a, b};
}

template <typename File>
std::vector<std::string> warnings_of(const MeasureArguments& arguments, const WeldedFiles<File>& files,
                                     const std::optional<Constraints>& held) {
  std::vector<std::string> warnings;
  for (const WeldedFile<File>& file : files)
    std::ranges::move(file.welding.with_warnings(file.file.warnings), std::back_inserter(warnings));
  RunFacts facts;
  look_at(facts, arguments);
  facts.moves_freely = noisy_axes(arguments, files[0].file) == std::array{true, true, true};
  look_at(facts, files[0].shape(), held.value_or(Constraints(files[0].shape().node_count())));
  std::ranges::move(idle_options(facts), std::back_inserter(warnings));
  return warnings;
}

std::string picture_of(const WeldedFiles<SurfaceFile>& /*files*/) { return {}; }
std::string picture_of(const WeldedFiles<CurveFile>& files) {
  const CurveFile& file = files[0].file;
  CurvePicture picture;
  if (files.size() > 1) {
    const PolygonCurve& before = files[1].shape();
    picture = {.before = &before, .points = {}, .part = moved_part(before, file.curve)};
  }
  return draw_curve(file, file.curve.positions(), picture);
}

template <typename File>
int measure_files(const MeasureArguments& arguments, std::vector<File> read) {
  using Shape = ShapeOf<File>;
  const auto begin = std::chrono::steady_clock::now();
  refuse_views(arguments, std::is_same_v<File, CurveFile>);
  const std::optional<LocalPlane> plane = plane_of(read[0]);
  std::string note;
  WeldedFiles<File> files;
  for (File& file : read) {
    const ClosedChains closed(shape_of(file), arguments.closed);
    if (files.empty()) note = closed.note() + note_of(plane);
    files.emplace_back(std::move(file), arguments);
  }
  if (arguments.picture.shows("deviation")) refuse_deviation(files);

  Context context;
  context.threads = arguments.threads;
  const std::optional<Constraints> held = held_in(arguments, files);
  const std::array<bool, 3> axes = noisy_axes(arguments, files[0].file);
  const std::vector<std::string> names = titles(arguments);
  std::vector<ShownShape<Shape>> shapes;
  for (std::size_t k = 0; k < files.size(); ++k) {
    ShownShape<Shape>& shape = shapes.emplace_back(ShownShape<Shape>{{names[k], {}}, MeasuredShape(files[k].shape())});
    shape.figures = figures_with_noise(shape.measured, held, noise_in(files[k], arguments, axes, context),
                                       arguments.shows_shapes(), context);
  }
  std::optional<Apart> apart;
  if (files.size() > 1) apart = distances_between(files[0].shape(), files[1].shape(), context);
  const std::vector<std::string> warnings = warnings_of(arguments, files, held);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;

  nlohmann::ordered_json json;
  if (!arguments.report.empty() || !arguments.html.empty()) {
    json = report_of<Shape>({arguments.input, arguments.compare}, shapes, apart);
    json.update(files[0].welding.figures());
    json.update(figures_of(plane));
    if (!arguments.moving.empty()) json["moving"] = arguments.moving;
    json["warnings"] = warnings;
    json["seconds"] = seconds.count();
    json["threads"] = context.thread_count();
    json["version"] = version();
  }
  if (!arguments.report.empty()) write_uninterrupted(arguments.report, json.dump(2) + "\n");
  {
    const CancelOnSignal cancelling(context);
    const Shown<Shape> shown = {.shapes = shapes,
                                .reference = apart ? std::optional(1) : std::nullopt,
                                .picture = [&] { return picture_of(files); },
                                .welding = &files[0].welding};
    if (!write_views(arguments, shown, json, context).empty() || context.cancelled()) return exit_interrupted;
  }
  Terminal(2, arguments.colour).warn(warnings);
  if (arguments.quiet) return exit_converged;
  // The summary goes to standard output unless the report itself does.
  const Terminal messages(arguments.report == "-" || arguments.html == "-" ? 2 : 1, arguments.colour);
  const std::vector<FigureColumn> columns(shapes.begin(), shapes.end());
  const std::string distances = apart ? "\n" + distance_lines(*apart, messages) : std::string();
  if (!messages.write(figure_table(columns, messages) + distances + note))
    throw Error(ErrorCode::unusable_file, "standard output: takes no more");
  return exit_converged;
}

int run_measure(MeasureArguments arguments) {
  check_outputs(arguments, {{"--compare", arguments.compare}});
  if (!arguments.columns.empty() && !may_be_table(arguments.input, arguments.format, arguments.curve) &&
      (arguments.compare.empty() || !may_be_table(arguments.compare, std::nullopt, false)))
    throw Error(ErrorCode::invalid_argument, "--columns: no curve of CSV or XYZ is measured; leave it out");
  AnyShape shape = read_shape(arguments.input, arguments.format, arguments.curve, arguments.columns);
  std::optional<AnyShape> other;
  if (!arguments.compare.empty())
    other = read_shape(arguments.compare, std::nullopt, std::holds_alternative<CurveFile>(shape), arguments.columns,
                       std::visit([](const auto& file) { return plane_of(file); }, shape));
  read_rules(arguments);
  if (other && other->index() != shape.index())
    throw Error(ErrorCode::unusable_file, fmt::format("{}: a curve, and {} is a surface; compare shapes of one kind",
                                                      input_name(arguments.compare), input_name(arguments.input)));
  return std::visit(
      [&]<typename File>(File& file) {
        std::vector<File> files;
        files.push_back(std::move(file));
        if (other) {
          File& second = std::get<File>(*other);
          require_same_units(arguments.input, plane_of(files[0]), arguments.compare, plane_of(second));
          files.push_back(std::move(second));
        }
        return measure_files(arguments, std::move(files));
      },
      shape);
}

void add_shape_options(CLI::App& command, MeasureArguments& arguments) {
  command
      .add_option("shape", arguments.input,
                  "The surface (.obj, .off, .ply, .stl) or curve (.obj with l elements and no faces, .csv, .dat, .xyz, "
                  ".gpx) to measure; - for standard input")
      ->required()
      ->type_name("SHAPE");
  command
      .add_option("--compare", arguments.compare,
                  "Measure this shape, too, and the distances between both: node by node if they have equally many "
                  "nodes, and from the nodes of each to the other; connectivity may differ")
      ->type_name("OTHER");
  add_choice(command, "--format", arguments.format, any_formats, "Format of - (default: found from the content)");
  command.add_flag("--curve", arguments.curve, "SHAPE is a curve (default: found from the file; - is a surface)");
  command.add_flag("--closed", arguments.closed,
                   "Curves: join the last node of every chain to the first (default: from the file)");
  add_columns(command, "--columns", arguments.columns, columns_of_curves);
  add_moving(command, arguments.moving,
             "Curves: estimate noise, and the tolerance of --within auto, in these coordinates only, as for vspring "
             "curve --move");
}

}  // namespace

void add_measure_command(CLI::App& app, std::function<int()>& run) {
  const FairingWords words = {.shape = "shape",
                              .input = "",
                              .ends = "Boundary or end nodes",
                              .directions = "normals (curves: tangents)",
                              .rules = "positions and normals"};
  const auto arguments = std::make_shared<MeasureArguments>();
  CLI::App& command = *app.add_subcommand("measure", "Measure the fairness of a surface or curve");
  add_shape_options(command, *arguments);
  add_constraint_options(command, *arguments, words);
  add_weld_option(command, *arguments);
  add_run_options(command, *arguments);
  add_picture_options(command, arguments->picture, true);
  command.footer(
      "With any option of constraints, only faces and edges at moving nodes are measured, and how well given normals "
      "are met; \"as in the input\" means as in OTHER if that has equally many nodes. Definitions: "
      "docs/fairness.md.\n\n"
      "Example: what became of a scan\n"
      "  vspring measure fair.ply --compare scan.ply --report report.json\n\n"
      "Exit status: 0 measured; 1 wrong use; 2 unusable input or output.");
  when_given(command, arguments, run, run_measure);
}

}  // namespace vspring::cli
