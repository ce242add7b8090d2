#include "fair_command.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "choice.hpp"
#include "exit_status.hpp"
#include "progress_bar.hpp"
#include "report.hpp"
#include "signals.hpp"
#include "terminal.hpp"
#include "vspring/vspring.hpp"

namespace vspring::cli {

namespace {

enum class Hold { boundary, none };

struct FairArguments {
  std::string surface;
  std::string output;
  std::optional<SurfaceFormat> format;
  std::string rules;
  Hold fix = Hold::boundary;
  Hold fix_normals = Hold::none;
  std::string region;
  FairOptions options;
  bool paper = false;
  int threads = 0;
  std::string report;
  bool quiet = false;
  Colour colour = Colour::automatic;
};

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file.is_open() || file.bad()) throw Error(ErrorCode::unusable_file, path + ": cannot be read");
  return text;
}

/// In the order of the documentation: boundary, rules, region.
Constraints make_constraints(const FairArguments& arguments, const SurfaceFile& file) {
  Constraints constraints(file.mesh.node_count());
  if (arguments.fix == Hold::boundary) fix_boundary_positions(constraints, file.mesh);
  if (arguments.fix_normals == Hold::boundary) fix_boundary_normals(constraints, file.mesh);
  if (!arguments.rules.empty()) {
    try {
      apply_rules(constraints, file.mesh, read_text(arguments.rules),
                  {.groups = &file.groups, .normals = &file.normals});
    } catch (const Error& error) {
      if (error.code() != ErrorCode::unusable_constraint) throw;
      throw Error(error.code(), arguments.rules + ": " + error.what());
    }
  }
  if (!arguments.region.empty())
    restrict_to_region(constraints, file.mesh, select_region(file.mesh.positions(), arguments.region, file.groups));
  return constraints;
}

double diagonal_of(const PolygonMesh& mesh) {
  Eigen::AlignedBox<double, 3> box;
  for (const Vector3& position : mesh.positions()) {
    if (position.allFinite()) box.extend(position);
  }
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

int run_fair(FairArguments arguments) {
  if (arguments.paper) arguments.options.pseudo_normals = PseudoNormals::average;
  // What people read goes to standard output unless the shape itself goes there.
  const Terminal errors(2, arguments.colour);
  const Terminal messages(arguments.output == "-" ? 2 : 1, arguments.colour);
  Context context;
  context.threads = arguments.threads;
  const CancelOnSignal cancelling(context);

  const SurfaceFile file = read_surface(arguments.surface, arguments.format);
  const Constraints constraints = make_constraints(arguments, file);
  ProgressBar bar(errors);
  if (!arguments.quiet) context.on_progress = [&](const Progress& progress) { bar.show(progress); };
  const FairResult result = fair(file.mesh, constraints, arguments.options, context);
  bar.clear();

  std::vector<std::string> warnings = file.warnings;
  warnings.insert(warnings.end(), result.report.warnings.begin(), result.report.warnings.end());
  {
    const UninterruptedWhileWriting guard;
    for (const std::string& lost : write_surface(arguments.output, file, result.positions, arguments.format))
      warnings.push_back(fmt::format("{}: written without {}", arguments.output, lost));
    if (!arguments.report.empty()) {
      auto json = to_json(result.report);
      json["warnings"] = warnings;
      json["input"] = arguments.surface;
      json["output"] = arguments.output;
      write_file(arguments.report, json.dump(2) + "\n");
    }
  }
  for (const std::string& warning : warnings) (void)errors.write(errors.yellow("warning: ") + warning + "\n");
  if (!arguments.quiet && !messages.write(summary(result.report, diagonal_of(file.mesh), messages)))
    throw Error(ErrorCode::unusable_file, "standard output: takes no more; the shape is written nonetheless");
  return exit_status(result.report.outcome);
}

const std::map<std::string, Hold> holds = {{"boundary", Hold::boundary}, {"none", Hold::none}};
const std::map<std::string, PseudoNormals> pseudo_normals = {{"link", PseudoNormals::link},
                                                             {"average", PseudoNormals::average},
                                                             {"area", PseudoNormals::area},
                                                             {"angle", PseudoNormals::angle}};
const std::map<std::string, Distribution> distributions = {{"even", Distribution::even}, {"keep", Distribution::keep}};
const std::map<std::string, Method> methods = {{"sweep", Method::sweep}};
const std::map<std::string, Colour> colours = {
    {"auto", Colour::automatic}, {"always", Colour::always}, {"never", Colour::never}};

void add_input_options(CLI::App& command, FairArguments& arguments) {
  command
      .add_option("surface", arguments.surface, "The surface to fair: .obj, .off, .ply or .stl; - for standard input")
      ->required()
      ->type_name("SURFACE");
  command
      .add_option("-o,--output", arguments.output,
                  "Where the fair surface goes, format by extension; - for standard output")
      ->required()
      ->type_name("OUT");
  add_choice(command, "--format", arguments.format, surface_formats,
             "Format of - (default: found from the content; the input's)");
}

void add_constraint_options(CLI::App& command, FairArguments& arguments) {
  const std::string group = "What holds the shape";
  add_choice(command, "--fix", arguments.fix, holds, "Nodes whose positions are fixed (default: boundary)")
      ->group(group);
  add_choice(command, "--fix-normals", arguments.fix_normals, holds,
             "Nodes whose normals are fixed as they are in the input, to second order (default: none)")
      ->group(group);
  command.add_option("--constraints", arguments.rules, "Rules for positions and normals, JSON")
      ->type_name("FILE.json")
      ->group(group);
  command
      .add_option("--region", arguments.region,
                  "Only these nodes move; their fixed neighbours get the tangent planes of what lies outside. "
                  "sphere:x,y,z,r, box:x0,y0,z0,x1,y1,z1 (units of the input), group:NAME, or a JSON file with a list "
                  "of nodes (default: all nodes)")
      ->type_name("SPEC")
      ->group(group);
}

void add_method_options(CLI::App& command, FairArguments& arguments) {
  const std::string group = "How it is faired";
  FairOptions& options = arguments.options;
  add_choice(command, "--method", options.method, methods, "The paper's plain iteration (default: sweep)")
      ->group(group);
  command
      .add_option("--step-tolerance", options.step_tolerance,
                  fmt::format("Stop when no node moves further in an iteration than this share of its mean edge length "
                              "(default: {})",
                              options.step_tolerance))
      ->type_name("E")
      ->check(CLI::PositiveNumber)
      ->group(group);
  command.add_option("--max-iterations", options.max_iterations, "Stop after this many iterations (default: 10000)")
      ->type_name("N")
      ->check(CLI::NonNegativeNumber)
      ->group(group);
  CLI::Option* kind = add_choice(command, "--pseudo-normals", options.pseudo_normals, pseudo_normals,
                                 "Normals of nodes: Max's weights around the link; the paper's plain average of face "
                                 "normals; weighted by area; by angle (default: link)")
                          ->group(group);
  command
      .add_flag("--paper", arguments.paper,
                "The paper's own choices throughout: plain average of normals (default: off)")
      ->excludes(kind)
      ->group(group);
  add_choice(
      command, "--distribution", options.distribution, distributions,
      "Along the surface, nodes go to the mean of their neighbours, or keep their share between them (default: even)")
      ->group(group);
  command
      .add_option("--strength", options.strength,
                  "result = input + S × (fair − input) for moving nodes, 0 to 1 (default: 1)")
      ->type_name("S")
      ->check(CLI::Range(0.0, 1.0))
      ->group(group);
}

void add_run_options(CLI::App& command, FairArguments& arguments) {
  const std::string group = "The run";
  command.add_option("--threads", arguments.threads, "Threads; the same bits for every number (default: all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024))
      ->group(group);
  command.add_option("--report", arguments.report, "Write what happened, JSON")->type_name("FILE.json")->group(group);
  command.add_flag("--quiet", arguments.quiet, "No progress and no summary; warnings and errors stay (default: off)")
      ->group(group);
  add_choice(command, "--color", arguments.colour, colours,
             "Colours (default: auto, on terminals unless NO_COLOR is set)")
      ->group(group);
}

}  // namespace

void add_fair_command(CLI::App& app, std::function<int()>& run) {
  const auto arguments = std::make_shared<FairArguments>();
  CLI::App& command = *app.add_subcommand("fair", "Fair a polygonal surface");
  add_input_options(command, *arguments);
  add_constraint_options(command, *arguments);
  add_method_options(command, *arguments);
  add_run_options(command, *arguments);
  command.footer(
      "Example: smooth a dent out of a scan and leave the rest as it is\n"
      "  vspring fair scan.ply -o fair.ply --region sphere:0.1,0.2,0.05,0.03 --report report.json\n\n"
      "Exit status: 0 converged; 1 wrong use; 2 unusable input or output; 3 written, but not converged; 130 "
      "interrupted.");
  command.callback([arguments, &run] { run = [arguments] { return run_fair(*arguments); }; });
}

}  // namespace vspring::cli
