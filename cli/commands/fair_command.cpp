#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "closed_chains.hpp"
#include "commands/commands.hpp"
#include "commands/option_kinds.hpp"
#include "commands/shared_options.hpp"
#include "fairing.hpp"
#include "fitting.hpp"
#include "idle_options.hpp"
#include "outputs.hpp"
#include "precision.hpp"
#include "prepared_shape.hpp"
#include "terminal.hpp"
#include "vspring/vspring.hpp"
#include "welding.hpp"

namespace vspring::cli {

namespace {

struct FairArguments : FairingArguments {
  std::optional<SurfaceFormat> format;
  PullArguments pull;
};

// Root mean square move, as a share of the size, beyond which features are probably lost.
constexpr double far = 0.05;
// Degrees, of a normal from the nodes on one side of it, per median edge of noise: about 2 radians.
constexpr double turn_by_noise = 120;
constexpr double least_turn_by_noise = 3;

/// Fairing removes all features between boundaries, which users who give a scan, a head or a part may not expect.
std::string note_of_lost_features(const FairArguments& arguments, const PolygonMesh& mesh,
                                  const Constraints& constraints, const FairReport& report) {
  if (!arguments.rules.empty() || !arguments.region.empty() || arguments.fix_directions != Hold::none ||
      asks_to_fit(arguments.pull))
    return {};
  if (!(report.rms_move > far * size_of_moving(mesh, constraints))) return {};
  return "note: only the boundary is held, so everything between became fair; to remove only noise, give --noise auto; "
         "to stay near the input, --within; to fair a part, --region\n";
}

/// Held normals are those of the nodes about the boundary, which noise turns.
std::string note_of_noisy_normals(const FairArguments& arguments, const PolygonMesh& mesh, const Context& context) {
  if (arguments.fix_directions != Hold::boundary || asks_to_fit(arguments.pull)) return {};
  const double turn = turn_by_noise * estimate_noise(mesh, context).edges;
  if (!(turn > least_turn_by_noise)) return {};
  return fmt::format(
      "note: the nodes have noise, which turns the normals that are held at the boundary by about {:.0f}°; take it off "
      "first, by --noise auto in a run before, or give the normals by --constraints\n",
      turn);
}

/// Where no noise is found because faces do not meet, the refusal says so.
void settle_noise(FairArguments& arguments, const SurfaceFile& file, const Welding& welding, Context& context,
                  double rounding) {
  const PolygonMesh& mesh = welding.shape(file);
  try {
    settle_by_noise(arguments.pull, mesh, region_of(arguments, mesh.positions(), welding.rules(file)), context,
                    rounding);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::unusable_shape || welding.loose_faces().empty()) throw;
    throw Error(error.code(), fmt::format("{} auto: {}", arguments.pull.automatic, welding.loose_faces()));
  }
}

int run_fair(FairArguments arguments) {
  settle_options(arguments, false, asks_to_fit(arguments.pull));
  check_outputs(arguments);
  refuse_views(arguments, false);
  if ((arguments.refine || arguments.remesh) && asks_to_fit(arguments.pull))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{}: the nodes of the input pull, and new ones are none; leave one of both out, or fit the "
                            "{} shape to the nodes by vspring fit",
                            arguments.refine ? "--refine" : "--remesh", arguments.refine ? "refined" : "remeshed"));
  Fairing fairing(arguments);

  SurfaceFile file = read_surface(arguments.input, arguments.format);
  if (file.mesh.face_count() == 0)
    throw Error(
        ErrorCode::unusable_file,
        input_name(arguments.input) + ": no face in it; lines are faired by vspring curve, points have no shape");
  Welding welding(file, arguments);
  const double rounding = rounding_of(file);
  refuse_auto_of_rounded(arguments.pull.automatic, welding.shape(file), rounding);
  settle_noise(arguments, file, welding, fairing.context(), rounding);
  PreparedShape<SurfaceFile> prepared(file, welding, ClosedChains(file.mesh, false), arguments, arguments.pull,
                                      asks_to_fit(arguments.pull), fairing.context());
  const PolygonMesh& mesh = prepared.shape();
  fairing.input_is_read();

  const FairedOrFitted done = fair_or_fit(prepared.mirrored(), prepared.constraints(), welding.weights(), arguments,
                                          arguments.pull, fairing.context());
  const Constraints constraints = prepared.mirrored().of_shape(prepared.constraints());
  const FairReport& report = done.faired.report;
  prepared.leave_out(report.rounded_edges);
  std::vector<std::string> warnings = file.warnings;
  std::ranges::move(prepared.warnings(), std::back_inserter(warnings));
  if (std::string text = warning_of_rounding(mesh, rounding); !text.empty()) warnings.push_back(std::move(text));
  PolygonMesh after = mesh;
  after.set_positions(done.faired.positions);
  take_written(after, written_positions(arguments.output, file, done.faired.positions, arguments.format), warnings);

  const auto write = [&] {
    return written_without(arguments.output, write_surface(arguments.output, file,
                                                           welding.positions(done.faired.positions), arguments.format));
  };
  auto figures = done.figures();
  figures.update(prepared.figures());
  RunFacts facts = prepared.facts();
  facts.own_nodes_pull = done.account.has_value();
  return fairing.finish<PolygonMesh>(
      {mesh, after, constraints, report}, welding.with_warnings(std::move(warnings)),
      {.write = write,
       .picture = {},
       .welding = &welding,
       .figures = std::move(figures),
       .lines = prepared.lines() + done.lines() + note_of_lost_features(arguments, mesh, constraints, report) +
                note_of_noisy_normals(arguments, mesh, fairing.context()),
       .facts = std::move(facts)});
}

const std::map<std::string, Springs> springs = {{"edge", Springs::edge}, {"sphere", Springs::sphere}};
const std::map<std::string, PseudoNormals> pseudo_normals = {{"link", PseudoNormals::link},
                                                             {"average", PseudoNormals::average},
                                                             {"area", PseudoNormals::area},
                                                             {"angle", PseudoNormals::angle}};

void add_surface_method(CLI::App& command, FairArguments& arguments, const FairingWords& words) {
  FairOptions& options = arguments.options;
  add_choice(
      command, "--method", arguments.method, methods,
      "The accelerated solver that goes to the true equilibrium, the paper's V-cycle over coarser levels, or its "
      "plain iteration (default: equilibrium)")
      ->group(fairing_group);
  add_stopping_options(command, arguments, "0.001");
  add_choice(command, "--springs", options.springs, springs,
             "In what neighbouring springs agree: in their mean-curvature spheres, for the same shape on every mesh, "
             "or in their lengths along every edge, as in the paper (default: sphere; edge with points, with the other "
             "methods, with --paper, and where sphere springs do not fit the constraints)")
      ->group(fairing_group);
  add_fair_by_option(command, arguments);
  add_continuity_option(command, arguments);
  CLI::Option* kind = add_choice(command, "--pseudo-normals", options.pseudo_normals, pseudo_normals,
                                 "Normals of nodes: Max's weights around the link; the paper's plain average of face "
                                 "normals; weighted by area; by angle (default: link)")
                          ->group(fairing_group);
  command
      .add_flag(
          "--paper", arguments.paper,
          "The paper's own choices throughout, its equations as printed: plain average of normals, nodes at the mean "
          "of their neighbours, points' displacements in full; and the method sweep unless --method says another, node "
          "after node in the order of the file (on one thread), with the last iteration as the result, for "
          "--fair-boundary too (default: off)")
      ->excludes(kind)
      ->group(fairing_group);
  add_shaping_options(command, arguments, words);
}

}  // namespace

void add_fair_command(CLI::App& app, std::function<int()>& run) {
  const FairingWords words = {.shape = "surface",
                              .input = ".obj, .off, .ply or .stl",
                              .ends = "Boundary nodes",
                              .directions = "normals",
                              .rules = "positions and normals"};
  const auto arguments = std::make_shared<FairArguments>();
  CLI::App& command = *app.add_subcommand("fair", "Fair a polygonal surface");
  add_files(command, *arguments, words);
  add_choice(command, "--format", arguments->format, surface_formats,
             "Format of - (default: found from the content; the input's)");
  add_constraint_options(command, *arguments, words);
  add_slide_option(command, *arguments);
  add_symmetry_option(command, *arguments, words);
  command
      .add_flag("--fair-boundary", arguments->fair_boundary,
                "Fair the boundary loops first, as curves between boundary nodes held by rules, then the surface "
                "inside; replaces --fix boundary (default: off)")
      ->group(holding_group);
  add_weld_option(command, *arguments);
  add_refine_options(command, *arguments);
  add_pull_options(command, arguments->pull, pull_of_own_nodes);
  add_surface_method(command, *arguments, words);
  add_sharp_edges(command, arguments->pull);
  add_sharp_curves(command, *arguments);
  add_run_options(command, *arguments);
  add_picture_options(command, arguments->picture, true);
  command.footer(
      "Example: smooth a dent out of a scan and leave the rest as it is\n"
      "  vspring fair scan.ply -o fair.ply --region sphere:0.1,0.2,0.05,0.03 --report report.json\n\n"
      "Exit status: 0 converged; 1 wrong use; 2 unusable input or output; 3 written, but not converged; 130 "
      "interrupted.");
  when_given(command, arguments, run, run_fair);
}

}  // namespace vspring::cli
