#include "commands/measure_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "any_shape.hpp"
#include "closed_chains.hpp"
#include "commands/choice.hpp"
#include "commands/fairing_options.hpp"
#include "commands/given_options.hpp"
#include "commands/picture_options.hpp"
#include "exit_status.hpp"
#include "fairing.hpp"
#include "figures.hpp"
#include "fitting.hpp"
#include "framing.hpp"
#include "html_page.hpp"
#include "idle_options.hpp"
#include "measure_table.hpp"
#include "page_scene.hpp"
#include "scalars.hpp"
#include "signals.hpp"
#include "stream_names.hpp"
#include "vspring/vspring.hpp"
#include "welding.hpp"

namespace vspring::cli {

namespace {

struct MeasureArguments : FairingArguments {
  std::optional<AnyFormat> format;
  std::string compare;
  ColumnChoice columns;
  bool curve = false;
  bool closed = false;
};

using Json = nlohmann::ordered_json;

Json counts_of(const PolygonMesh& mesh) { return {{"nodes", mesh.node_count()}, {"faces", mesh.face_count()}}; }
Json counts_of(const PolygonCurve& curve) { return {{"nodes", curve.node_count()}, {"chains", curve.chains().size()}}; }

void close_measured(SurfaceFile& /*file*/) {}
void close_measured(CurveFile& file) { (void)close_chains(file.curve); }

void write_whole(const std::string& path, const std::string& bytes) {
  const UninterruptedWhileWriting guard;
  write_file(path, bytes);
}

/// Whether any option of what holds the shape was given.
bool is_constrained(const MeasureArguments& arguments) {
  return std::ranges::any_of(std::initializer_list<const char*>{"--fix", "--fix-normals", "--constraints", "--region"},
                             [&](const char* option) { return arguments.given.contains(option); });
}

/// How far two shapes lie apart.
struct Apart {
  std::optional<Distance> nodes;  ///< where there are as many
  Distance to_other;
  Distance from_other;
};

Json to_json(const Distance& distance) {
  return {{"greatest", distance.greatest}, {"rms", distance.rms}, {"node", distance.node}};
}

std::string distance_line(const std::string& name, const Distance& distance, const std::string& definition) {
  return fmt::format("{}  greatest {:.4g} at node {}, rms {:.4g} units  {}\n", name, distance.greatest, distance.node,
                     distance.rms, definition);
}

std::string distance_lines(const Apart& apart, const Terminal& terminal) {
  std::string text;
  if (apart.nodes) text += distance_line(terminal.bold("node by node   "), *apart.nodes, "between the same nodes");
  text += distance_line(terminal.bold("to the other   "), apart.to_other, "from the nodes of the first to the second");
  text +=
      distance_line(terminal.bold("from the other "), apart.from_other, "from the nodes of the second to the first");
  return text;
}

/// With the noise that a shape seems to have, which is nobody's measure of fairness.
template <typename Shape>
std::vector<Figure> with_noise(std::vector<Figure> figures, const Shape& shape, const Context& context) {
  const NoiseEstimate noise = noise_of(shape, context);
  figures.push_back({"noise", "noise", "units", "as estimated, standard deviation in each coordinate; see --noise auto",
                     noise.deviation, false});
  figures.push_back({"noise_in_edges", "noise in edges", "", "the same in median edges", noise.edges, false});
  return figures;
}

/// The file's name; both with their folders where they have the same.
std::vector<std::string> titles(const std::string& first, const std::string& second) {
  const std::string a = std::filesystem::path(first).filename().string();
  const std::string b = std::filesystem::path(second).filename().string();
  return a == b ? std::vector{first, second} : std::vector{a, b};
}

/// What is measured of a file.
template <typename File>
struct Measured {
  File file;
  Welding welding;

  Measured(File read, const MeasureArguments& arguments) : file(std::move(read)), welding(file, arguments) {}
  [[nodiscard]] const auto& shape() const { return welding.shape(file); }
};

template <typename File>
Constraints constraints_for(const MeasureArguments& arguments, const Measured<File>& file,
                            const Measured<File>* other) {
  // "As in the input" is as in the shape before, where it is given.
  const bool before = other != nullptr && other->shape().node_count() == file.shape().node_count();
  const Measured<File>& input = before ? *other : file;
  return make_constraints(arguments, input.shape(), input.welding.rules(input.file));
}

std::string picture_of_measured(const MeasureArguments& arguments, const Measured<SurfaceFile>& /*file*/,
                                const Measured<SurfaceFile>* /*other*/, const Json& scene, const Context& context) {
  return surface_picture(arguments.picture, "vspring: " + input_name(arguments.input), scene, context);
}

std::string picture_of_measured(const MeasureArguments& arguments, const Measured<CurveFile>& file,
                                const Measured<CurveFile>* other, const Json& /*scene*/, const Context& context) {
  CurvePicture picture;
  if (other != nullptr)
    picture = {.before = &other->shape(), .points = {}, .part = moved_part(other->shape(), file.shape())};
  return curve_picture(arguments.picture, draw_curve(file.file, file.shape().positions(), picture), context);
}

/// Page, picture and scalars, as far as they are asked for. False where Ctrl-C prevented one.
template <typename File, typename Shape>
bool write_views(const MeasureArguments& arguments, const Measured<File>& file, const Measured<File>* other,
                 std::vector<MeasuredShape<Shape>>& measured, const std::vector<FigureColumn>& columns,
                 const Json& report, Context& context) {
  const CancelOnSignal cancelling(context);
  Json scene;
  if (!arguments.html.empty() || (std::is_same_v<File, SurfaceFile> && !arguments.picture.path.empty())) {
    std::vector<PageShape<Shape>> shapes;
    for (std::size_t k = 0; k < measured.size(); ++k)
      shapes.push_back({columns[k].title, &measured[k], columns[k].figures});
    const PageRoles roles = {.leading = 0,
                             .reference = other != nullptr ? std::optional(1) : std::nullopt,
                             .deviation = !arguments.html.empty() || arguments.picture.shows("deviation"),
                             .view = arguments.picture.view};
    scene = scene_of(std::span<const PageShape<Shape>>(shapes), roles, context);
  }
  const auto write = [&](const std::string& path, const auto& bytes_of) {
    if (path.empty() || context.cancelled()) return;
    const std::string bytes = bytes_of();
    if (!context.cancelled()) write_whole(path, bytes);
  };
  write(arguments.html, [&] { return html_page("vspring: " + input_name(arguments.input), report, scene); });
  write(arguments.picture.path, [&] { return picture_of_measured(arguments, file, other, scene, context); });
  if (arguments.scalars.empty() || context.cancelled()) return !context.cancelled();
  const std::vector<NodeScalar> scalars = scalars_of(measured[0], other != nullptr ? &measured[1] : nullptr, context);
  if (context.cancelled()) return false;
  const UninterruptedWhileWriting guard;
  file.welding.write_scalars(arguments.scalars, file.shape(), scalars);
  return true;
}

/// Throws where deviations are to be shown and there is nothing that they could be from, node by node.
void refuse_deviation(const PolygonMesh& mesh, const PolygonMesh* other) {
  if (other == nullptr)
    throw Error(ErrorCode::invalid_argument, "--picture-style deviation: from what? give --compare");
  if (!same_faces(mesh, *other))
    throw Error(ErrorCode::unusable_shape,
                "--picture-style deviation: the two shapes have not the same faces; leave it out, or see --scalars");
}
void refuse_deviation(const PolygonCurve& /*curve*/, const PolygonCurve* /*other*/) {}

template <typename File>
int measure_file(const MeasureArguments& arguments, File first, std::optional<File> second_file) {
  const auto begin = std::chrono::steady_clock::now();
  refuse_views(arguments, std::is_same_v<File, CurveFile>);
  std::string note;
  if constexpr (std::is_same_v<File, CurveFile>) note = arguments.closed ? "" : note_of_repeats(first.curve);
  if (arguments.closed) {
    close_measured(first);
    if (second_file) close_measured(*second_file);
  }
  const Measured<File> file(std::move(first), arguments);
  std::optional<Measured<File>> other;
  if (second_file) other.emplace(std::move(*second_file), arguments);
  if (arguments.picture.shows("deviation")) refuse_deviation(file.shape(), other ? &other->shape() : nullptr);
  Context context;
  context.threads = arguments.threads;
  std::optional<Constraints> constraints;
  if (is_constrained(arguments)) constraints = constraints_for(arguments, file, other ? &*other : nullptr);
  const auto held = [&](const Measured<File>& measured) {
    const bool fits = constraints && constraints->node_count() == measured.shape().node_count();
    return fits ? &*constraints : nullptr;
  };

  const bool shown = arguments.shows_shapes();
  std::vector measured = {MeasuredShape(file.shape())};
  if (other) measured.emplace_back(other->shape());
  std::vector<FigureColumn> columns;
  columns.push_back({input_name(arguments.input),
                     with_noise(figures_of(measured[0], held(file), shown, context), file.shape(), context)});
  std::optional<Apart> apart;
  std::vector<std::string> warnings = file.welding.with_warnings(file.file.warnings);
  if (other) {
    const auto& shape = file.shape();
    const auto& second = other->shape();
    const auto names = titles(input_name(arguments.input), input_name(arguments.compare));
    columns.front().title = names[0];
    columns.push_back({names[1], with_noise(figures_of(measured[1], held(*other), shown, context), second, context)});
    apart.emplace();
    if (shape.node_count() == second.node_count()) apart->nodes = node_distance(second.positions(), shape.positions());
    apart->to_other = distance(shape.positions(), second, context);
    apart->from_other = distance(second.positions(), shape, context);
    const std::vector<std::string> of_other = other->welding.with_warnings(other->file.warnings);
    warnings.insert(warnings.end(), of_other.begin(), of_other.end());
  }
  RunFacts facts;
  look_at(facts, arguments);
  look_at(facts, file.shape(), constraints.value_or(Constraints(file.shape().node_count())));
  std::ranges::move(idle_options(facts), std::back_inserter(warnings));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;

  Json json;
  if (!arguments.report.empty() || !arguments.html.empty()) {
    json = {{"shape", arguments.input}, {"kind", std::is_same_v<File, SurfaceFile> ? "surface" : "curve"}};
    json.update(counts_of(file.shape()));
    json["figures"] = values_of(columns.front().figures);
    if (other) {
      json["compared_with"] = counts_of(other->shape());
      json["compared_with"]["shape"] = arguments.compare;
      json["compared_with"]["figures"] = values_of(columns.back().figures);
      json["distance"] = {{"nodes", apart->nodes ? to_json(*apart->nodes) : Json()},
                          {"to_other", to_json(apart->to_other)},
                          {"from_other", to_json(apart->from_other)}};
    }
    json["definitions"] = definitions_of(columns.front().figures);
    json.update(file.welding.figures());
    json["warnings"] = warnings;
    json["seconds"] = seconds.count();
    json["threads"] = context.thread_count();
    json["version"] = version();
    if (!arguments.report.empty()) write_whole(arguments.report, json.dump(2) + "\n");
  }
  if (!write_views(arguments, file, other ? &*other : nullptr, measured, columns, json, context))
    return exit_interrupted;
  Terminal(2, arguments.colour).warn(warnings);
  if (arguments.quiet) return exit_converged;
  // What people read goes to standard output unless the report itself goes there.
  const Terminal messages(arguments.report == "-" || arguments.html == "-" ? 2 : 1, arguments.colour);
  const std::string text =
      figure_table(columns, messages) + (apart ? "\n" + distance_lines(*apart, messages) : std::string()) + note;
  if (!messages.write(text)) throw Error(ErrorCode::unusable_file, "standard output: takes no more");
  return exit_converged;
}

int run_measure(const MeasureArguments& arguments) {
  check_outputs(arguments, {{"--compare", arguments.compare}});
  if (!arguments.columns.empty() && !may_be_table(arguments.input, arguments.format, arguments.curve) &&
      (arguments.compare.empty() || !may_be_table(arguments.compare, std::nullopt, false)))
    throw Error(ErrorCode::invalid_argument, "--columns: no curve of CSV or XYZ is measured; leave it out");
  AnyShape shape = read_shape(arguments.input, arguments.format, arguments.curve, arguments.columns);
  std::optional<AnyShape> other;
  if (!arguments.compare.empty())
    other = read_shape(arguments.compare, std::nullopt, std::holds_alternative<CurveFile>(shape), arguments.columns);
  if (other && other->index() != shape.index())
    throw Error(ErrorCode::unusable_file, fmt::format("{}: a curve, and {} is a surface; compare shapes of one kind",
                                                      input_name(arguments.compare), input_name(arguments.input)));
  return std::visit(
      [&]<typename File>(File& file) {
        std::optional<File> second;
        if (other) second = std::move(std::get<File>(*other));
        return measure_file<File>(arguments, std::move(file), std::move(second));
      },
      shape);
}

void add_shape_options(CLI::App& command, MeasureArguments& arguments) {
  command
      .add_option("shape", arguments.input,
                  "The surface (.obj, .off, .ply, .stl) or curve (.obj with l elements and no faces, .csv, .dat, .xyz) "
                  "to measure; - for standard input")
      ->required()
      ->type_name("SHAPE");
  command
      .add_option("--compare", arguments.compare,
                  "Measure this shape beside it, and how far they lie apart: node by node where they have as many "
                  "nodes, and from the nodes of each to the other; connectivity may differ")
      ->type_name("OTHER");
  add_choice(command, "--format", arguments.format, any_formats, "Format of - (default: found from the content)");
  command.add_flag("--curve", arguments.curve, "SHAPE is a curve (default: found from the file; - is a surface)");
  command.add_flag("--closed", arguments.closed,
                   "Curves: the last node of every chain joins the first (default: from the file)");
  add_columns(command, "--columns", arguments.columns, columns_of_curves);
}

}  // namespace

void add_measure_command(CLI::App& app, std::function<int()>& run) {
  const FairingWords words = {.shape = "shape",
                              .input = "",
                              .ends = "Boundary or end nodes",
                              .directions = "normals (curves: tangents)",
                              .rules = "positions and normals"};
  const auto arguments = std::make_shared<MeasureArguments>();
  CLI::App& command = *app.add_subcommand("measure", "Figures of fairness of a surface or curve, nothing changed");
  add_shape_options(command, *arguments);
  add_constraint_options(command, *arguments, words);
  add_weld_option(command, *arguments);
  add_run_options(command, *arguments);
  add_picture_options(command, arguments->picture, true);
  command.footer(
      "With any option of what holds the shape, only what lies at moving nodes is measured, and how well given normals "
      "are met; \"as in the input\" is as in OTHER where that has as many nodes. Definitions: docs/fairness.md.\n\n"
      "Example: what became of a scan\n"
      "  vspring measure fair.ply --compare scan.ply --report report.json\n\n"
      "Exit status: 0 measured; 1 wrong use; 2 unusable input or output.");
  command.callback([arguments, &run, &command] {
    arguments->given = given_options(command);
    run = [arguments] { return run_measure(*arguments); };
  });
}

}  // namespace vspring::cli
