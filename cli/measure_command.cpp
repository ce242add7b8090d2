#include "measure_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "any_shape.hpp"
#include "choice.hpp"
#include "closed_chains.hpp"
#include "exit_status.hpp"
#include "fairing.hpp"
#include "html_page.hpp"
#include "measure_table.hpp"
#include "page_scene.hpp"
#include "signals.hpp"
#include "vspring/vspring.hpp"

namespace vspring::cli {

namespace {

struct MeasureArguments : FairingArguments {
  std::optional<AnyFormat> format;
  std::string compare;
  bool curve = false;
  bool closed = false;
  bool constrained = false;  // any option of what holds the shape was given
};

using Json = nlohmann::ordered_json;

const PolygonMesh& shape_of(const SurfaceFile& file) { return file.mesh; }
const PolygonCurve& shape_of(const CurveFile& file) { return file.curve; }

RuleInput rule_input(const SurfaceFile& file) { return {.groups = &file.groups, .normals = &file.normals}; }
RuleInput rule_input(const CurveFile& file) { return {.groups = &file.groups}; }

std::vector<Figure> figures_of(const PolygonMesh& mesh, const Constraints* constraints, const Context& context) {
  return list_figures(measure_surface(mesh, constraints, context));
}
std::vector<Figure> figures_of(const PolygonCurve& curve, const Constraints* constraints, const Context&) {
  return list_figures(measure_curve(curve, constraints));
}

Json counts_of(const PolygonMesh& mesh) { return {{"nodes", mesh.node_count()}, {"faces", mesh.face_count()}}; }
Json counts_of(const PolygonCurve& curve) { return {{"nodes", curve.node_count()}, {"chains", curve.chains().size()}}; }

void close(SurfaceFile& /*file*/) {}
void close(CurveFile& file) { (void)close_chains(file.curve); }

Json to_json(const std::vector<Figure>& figures) {
  Json json = Json::object();
  for (const Figure& figure : figures) {
    if (figure.whole)
      json[std::string(figure.key)] = static_cast<Index>(figure.value);
    else
      json[std::string(figure.key)] = figure.value;
  }
  return json;
}

Json definitions_of(const std::vector<Figure>& figures) {
  Json json = Json::object();
  for (const Figure& figure : figures)
    json[std::string(figure.key)] = {{"name", figure.name}, {"unit", figure.unit}, {"definition", figure.definition}};
  return json;
}

void write_whole(const std::string& path, const std::string& bytes) {
  const UninterruptedWhileWriting guard;
  write_file(path, bytes);
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

/// The file's name; both with their folders where they have the same.
std::vector<std::string> titles(const std::string& first, const std::string& second) {
  const std::string a = std::filesystem::path(first).filename().string();
  const std::string b = std::filesystem::path(second).filename().string();
  return a == b ? std::vector{first, second} : std::vector{a, b};
}

template <typename File>
Constraints constraints_for(const MeasureArguments& arguments, const File& file, const File* other) {
  // "As in the input" is as in the shape before, where it is given.
  const bool before = other != nullptr && shape_of(*other).node_count() == shape_of(file).node_count();
  const File& input = before ? *other : file;
  return make_constraints(arguments, shape_of(input), rule_input(input));
}

template <typename File>
int measure_file(const MeasureArguments& arguments, File file, std::optional<File> other) {
  const auto begin = std::chrono::steady_clock::now();
  if (arguments.closed) {
    close(file);
    if (other) close(*other);
  }
  Context context;
  context.threads = arguments.threads;
  std::optional<Constraints> constraints;
  if (arguments.constrained) constraints = constraints_for(arguments, file, other ? &*other : nullptr);
  const auto held = [&](const File& measured) {
    const bool fits = constraints && constraints->node_count() == shape_of(measured).node_count();
    return fits ? &*constraints : nullptr;
  };

  std::vector<FigureColumn> columns;
  columns.push_back({arguments.input, figures_of(shape_of(file), held(file), context)});
  std::optional<Apart> apart;
  std::vector<std::string> warnings = file.warnings;
  if (other) {
    const auto& shape = shape_of(file);
    const auto& second = shape_of(*other);
    const auto names = titles(arguments.input, arguments.compare);
    columns.front().title = names[0];
    columns.push_back({names[1], figures_of(second, held(*other), context)});
    apart.emplace();
    if (shape.node_count() == second.node_count()) apart->nodes = node_distance(second.positions(), shape.positions());
    apart->to_other = distance(shape.positions(), second, context);
    apart->from_other = distance(second.positions(), shape, context);
    warnings.insert(warnings.end(), other->warnings.begin(), other->warnings.end());
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;

  if (!arguments.report.empty() || !arguments.html.empty()) {
    Json json = {{"shape", arguments.input}, {"kind", std::is_same_v<File, SurfaceFile> ? "surface" : "curve"}};
    json.update(counts_of(shape_of(file)));
    json["figures"] = to_json(columns.front().figures);
    if (other) {
      json["compared_with"] = counts_of(shape_of(*other));
      json["compared_with"]["shape"] = arguments.compare;
      json["compared_with"]["figures"] = to_json(columns.back().figures);
      json["distance"] = {{"nodes", apart->nodes ? to_json(*apart->nodes) : Json()},
                          {"to_other", to_json(apart->to_other)},
                          {"from_other", to_json(apart->from_other)}};
    }
    json["definitions"] = definitions_of(columns.front().figures);
    json["warnings"] = warnings;
    json["seconds"] = seconds.count();
    json["threads"] = context.thread_count();
    json["version"] = version();
    if (!arguments.report.empty()) write_whole(arguments.report, json.dump(2) + "\n");
    if (!arguments.html.empty()) {
      using Shape = std::remove_cvref_t<decltype(shape_of(file))>;
      std::vector<PageShape<Shape>> shapes = {{columns[0].title, &shape_of(file), columns[0].figures}};
      if (other) shapes.push_back({columns[1].title, &shape_of(*other), columns[1].figures});
      const PageRoles roles = {.leading = 0, .reference = other ? std::optional(1) : std::nullopt};
      write_whole(arguments.html, html_page("vspring: " + arguments.input, json,
                                            scene_of(std::span<const PageShape<Shape>>(shapes), roles, context)));
    }
  }
  const Terminal errors(2, arguments.colour);
  for (const std::string& warning : warnings) (void)errors.write(errors.yellow("warning: ") + warning + "\n");
  if (arguments.quiet) return exit_converged;
  // What people read goes to standard output unless the report itself goes there.
  const Terminal messages(arguments.report == "-" || arguments.html == "-" ? 2 : 1, arguments.colour);
  const std::string text =
      figure_table(columns, messages) + (apart ? "\n" + distance_lines(*apart, messages) : std::string());
  if (!messages.write(text)) throw Error(ErrorCode::unusable_file, "standard output: takes no more");
  return exit_converged;
}

int run_measure(const MeasureArguments& arguments) {
  refuse_shared_page(arguments, {{"--compare", arguments.compare}});
  AnyShape shape = read_shape(arguments.input, arguments.format, arguments.curve);
  std::optional<AnyShape> other;
  if (!arguments.compare.empty())
    other = read_shape(arguments.compare, std::nullopt, std::holds_alternative<CurveFile>(shape));
  if (other && other->index() != shape.index())
    throw Error(ErrorCode::unusable_file, fmt::format("{}: a curve, and {} is a surface; compare shapes of one kind",
                                                      arguments.compare, arguments.input));
  return std::visit(
      [&]<typename File>(File& file) {
        std::optional<File> second;
        if (other) second = std::move(std::get<File>(*other));
        return measure_file<File>(arguments, std::move(file), std::move(second));
      },
      shape);
}

const std::map<std::string, AnyFormat> formats = {
    {"obj", SurfaceFormat::obj}, {"off", SurfaceFormat::off}, {"ply", SurfaceFormat::ply}, {"stl", SurfaceFormat::stl},
    {"csv", CurveFormat::csv},   {"dat", CurveFormat::dat},   {"xyz", CurveFormat::xyz}};

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
  add_choice(command, "--format", arguments.format, formats, "Format of - (default: found from the content)");
  command.add_flag("--curve", arguments.curve, "SHAPE is a curve (default: found from the file; - is a surface)");
  command.add_flag("--closed", arguments.closed,
                   "Curves: the last node of every chain joins the first (default: from the file)");
}

}  // namespace

void add_measure_command(CLI::App& app, std::function<int()>& run) {
  const FairingWords words = {.shape = "shape",
                              .input = "",
                              .ends = "Boundary or end nodes",
                              .directions = "normals (curves: tangents)",
                              .rim = "tangent planes (curves: tangents)",
                              .rules = "positions and normals"};
  const auto arguments = std::make_shared<MeasureArguments>();
  CLI::App& command = *app.add_subcommand("measure", "Figures of fairness of a surface or curve, nothing changed");
  add_shape_options(command, *arguments);
  add_constraint_options(command, *arguments, words);
  add_run_options(command, *arguments);
  command.footer(
      "With any option of what holds the shape, only what lies at moving nodes is measured, and how well given normals "
      "are met; \"as in the input\" is as in OTHER where that has as many nodes. Definitions: docs/fairness.md.\n\n"
      "Example: what became of a scan\n"
      "  vspring measure fair.ply --compare scan.ply --report report.json\n\n"
      "Exit status: 0 measured; 1 wrong use; 2 unusable input or output.");
  command.callback([arguments, &run, &command] {
    for (const char* option : {"--fix", "--fix-normals", "--constraints", "--region"})
      arguments->constrained = arguments->constrained || command.count(option) > 0;
    run = [arguments] { return run_measure(*arguments); };
  });
}

}  // namespace vspring::cli
