#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <sstream>

#include "commands/option_kinds.hpp"
#include "commands/shared_options.hpp"
#include "fairing_arguments.hpp"

namespace vspring::cli {

namespace {

const std::map<std::string, Hold> holds = {{"boundary", Hold::boundary}, {"none", Hold::none}};
const std::map<std::string, Distribution> distributions = {
    {"smooth", Distribution::smooth}, {"even", Distribution::even}, {"keep", Distribution::keep}};
const std::map<std::string, FairBy> goals = {{"curvature", FairBy::curvature}, {"bending", FairBy::bending}};
const std::map<std::string, Continuity> continuities = {{"tangent", Continuity::tangent},
                                                        {"curvature", Continuity::curvature}};
const std::map<std::string, Colour> colours = {
    {"auto", Colour::automatic}, {"always", Colour::always}, {"never", Colour::never}};

}  // namespace

void add_files(CLI::App& command, FairingArguments& arguments, const FairingWords& words) {
  std::string type = words.shape;
  for (char& c : type) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  command
      .add_option(words.shape, arguments.input,
                  fmt::format("The {} to {}: {}; - for standard input", words.shape, words.to, words.input))
      ->required()
      ->type_name(type);
  command
      .add_option(
          "-o,--output", arguments.output,
          fmt::format("Where the {} {} goes, format by extension; - for standard output", words.done, words.shape))
      ->required()
      ->type_name("OUT");
}

void add_constraint_options(CLI::App& command, FairingArguments& arguments, const FairingWords& words) {
  add_choice(command, "--fix", arguments.fix, holds,
             words.ends + " whose positions are fixed" + words.unfixed + " (default: boundary)")
      ->group(holding_group);
  add_choice(command, "--fix-normals", arguments.fix_directions, holds,
             fmt::format("{} whose {} are fixed as they are in the input, to second order (default: none)", words.ends,
                         words.directions))
      ->group(holding_group);
  command.add_option("--constraints", arguments.rules, fmt::format("Rules for {}, JSON", words.rules))
      ->type_name("FILE.json")
      ->group(holding_group);
  command
      .add_option("--region", arguments.region,
                  "Only these nodes move; they meet the rest smoothly. sphere:x,y,z,r, box:x0,y0,z0,x1,y1,z1 "
                  "(units of the input), group:NAME, or a JSON file with a list of nodes (default: all nodes)")
      ->type_name("SPEC")
      ->group(holding_group);
}

void add_slide_option(CLI::App& command, FairingArguments& arguments) {
  command
      .add_option("--slide", arguments.slides,
                  "Nodes move along something only, such as a rim in its plane. NODES: boundary, or as for --region. "
                  "SUPPORT: plane:px,py,pz,nx,ny,nz by a point and a normal, line:px,py,pz,dx,dy,dz by a point and a "
                  "direction, cylinder:px,py,pz,dx,dy,dz,r around an axis, or circle:cx,cy,cz,nx,ny,nz,r (units of the "
                  "input). May be given several times; a later one wins (default: none)")
      ->type_name("NODES=SUPPORT")
      ->allow_extra_args(false)
      ->group(holding_group);
}

void add_symmetry_option(CLI::App& command, FairingArguments& arguments, const FairingWords& words) {
  command
      .add_option(
          "--symmetry", arguments.symmetry,
          fmt::format("Half a {} becomes half of what the whole comes to: its nodes on the plane, to 1e-6 of the "
                      "diagonal, slide "
                      "in it; a whole one comes out symmetric. x, y or z (the plane where that is 0), x=2.5, or "
                      "plane:px,py,pz,nx,ny,nz by a point and a normal (units of the input) (default: off)",
                      words.shape))
      ->type_name("PLANE")
      ->group(holding_group);
}

void add_columns(CLI::App& command, const std::string& flag, std::vector<std::string>& columns,
                 const std::string& whose) {
  add_names(command, flag, columns, whose)->type_name("X,Y[,Z]")->check([](const std::string& given) {
    const auto count = std::count(given.begin(), given.end(), ',') + 1;
    if (count == 2 || count == 3) return std::string();
    return fmt::format("two or three columns are needed, such as 2,3 or X,Y, not \"{}\"", given);
  });
}

CLI::Option* add_names(CLI::App& command, const std::string& flag, std::vector<std::string>& names,
                       const std::string& text) {
  return command
      .add_option_function<std::string>(
          flag,
          [&names](const std::string& given) {
            std::istringstream rest(given);
            names.clear();
            for (std::string name; std::getline(rest, name, ',');) names.push_back(CLI::detail::trim(name));
            if (given.empty() || given.ends_with(',')) names.emplace_back();
          },
          text)
      ->type_name("COLUMNS");
}

CLI::Option* add_moving(CLI::App& command, std::vector<std::string>& names, const std::string& text) {
  return add_names(command, "--move", names, text + ": letters, such as y or yz, or names of columns (default: all)");
}

void add_weld_option(CLI::App& command, FairingArguments& arguments) {
  command
      .add_option("--weld", arguments.weld,
                  "Surfaces: for fairing, join nodes at most this share of the diagonal apart; the file keeps its "
                  "nodes and faces. 0: only nodes at the same place (default: off; for STL 1e-6, or 1e-6 of the "
                  "largest coordinate if that is more, as it was rounded so)")
      ->type_name("EPS")
      ->check(non_negative_number())
      ->group(holding_group);
}

namespace {

CLI::Option* add_remesh_option(CLI::App& command, FairingArguments& arguments) {
  const std::string name = "--remesh";
  return command
      .add_option_function<std::string>(
          name,
          [&arguments, name](const std::string& given) {
            Remeshing how;
            double length = 0;
            if (given != "auto") {
              if (!CLI::detail::lexical_cast(given, length) || !(length > 0 && std::isfinite(length)))
                throw CLI::ValidationError(name, "a length greater than 0, or auto, is needed, not " + given);
              how.length = length;
            }
            arguments.remesh = how;
          },
          "Surfaces: before fairing, give the part that moves new, even triangles with edges of about this length "
          "(units of the input), for meshes with needles or edges of very different lengths; auto: its median edge "
          "(default: off)")
      ->type_name("LENGTH|auto")
      ->group(mesh_group);
}

}  // namespace

void add_refine_options(CLI::App& command, FairingArguments& arguments) {
  CLI::Option* const remesh = add_remesh_option(command, arguments);
  const std::string name = "--refine";
  command
      .add_option_function<std::string>(
          name,
          [&arguments, name](const std::string& given) {
            const std::string turn = "turn:";
            Refinement how;
            const bool by_turn = given.starts_with(turn);
            double number = 0;
            const bool is_number = CLI::detail::lexical_cast(by_turn ? given.substr(turn.size()) : given, number);
            (by_turn ? how.turn : how.length) = number;
            if (!is_number || !(number > 0 && std::isfinite(number)) || (by_turn && !(number < 180)))
              throw CLI::ValidationError(
                  name,
                  "a length greater than 0, or turn: with more than 0 and less than 180 degrees, is needed, not " +
                      given);
            arguments.refine = how;
          },
          "Surfaces: before fairing, divide the part that moves until none of its edges is longer than this (units of "
          "the input) or, as turn:DEGREES, until the surface turns by at most so much along each (default: off)")
      ->type_name("LENGTH|TURN")
      ->group(mesh_group)
      ->excludes(remesh);
}

CLI::Option* add_tolerance_option(CLI::App& command, FairingArguments& arguments) {
  return command
      .add_option("--tolerance", arguments.tolerance,
                  fmt::format("equilibrium: stop when no node is expected to be further from its final place than "
                              "this share of the diagonal of the box around the moving nodes (default: {})",
                              arguments.tolerance))
      ->type_name("X")
      ->check(positive_number())
      ->group(fairing_group);
}

CLI::Option* add_fair_by_option(CLI::App& command, FairingArguments& arguments) {
  return add_choice(command, "--fair-by", arguments.options.fair_by, goals,
                    "How sphere springs make the surface fair: mean curvature changes as evenly as it can, or bending "
                    "energy is least, which may bulge (default: curvature)")
      ->group(fairing_group);
}

CLI::Option* add_continuity_option(CLI::App& command, FairingArguments& arguments, bool of_curve) {
  return add_choice(command, "--continuity", arguments.options.continuity, continuities,
                    of_curve ? "How the curve meets the nodes beside it that do not move, and its ends where their "
                               "tangents are fixed: with tangents, or with their curvature in the input, too, so that "
                               "curvature does not jump there (default: tangent)"
                             : "How the surface meets the faces beside it that do not move: with their tangent planes, "
                               "or with their curvature, too, so that reflection lines run through without a kink "
                               "(default: tangent)")
      ->group(fairing_group);
}

void add_stopping_options(CLI::App& command, FairingArguments& arguments, const std::string& default_step) {
  add_tolerance_option(command, arguments);
  command
      .add_option("--step-tolerance", arguments.step_tolerance,
                  "multigrid, sweep: stop when no node moves further in an iteration than this share of its mean edge "
                  "length (default: " +
                      default_step + ")")
      ->type_name("E")
      ->check(positive_number())
      ->group(fairing_group);
  command
      .add_option("--levels", arguments.levels,
                  "multigrid: number of levels, fewer if there are too few nodes (default: as many as leave 60 moving "
                  "nodes on the coarsest, the paper's 6 for 60000 to 250000 nodes; curves: 24 to 47 edges)")
      ->type_name("L")
      ->check(whole_number(1, 64))
      ->group(fairing_group);
  command
      .add_option(
          "--pre-smoothing", arguments.pre_smoothing,
          fmt::format("multigrid: iterations on each level on the way down (default: {})", arguments.pre_smoothing))
      ->type_name("N")
      ->check(whole_number(0))
      ->group(fairing_group);
  command
      .add_option("--max-iterations", arguments.max_iterations,
                  "Stop after this many iterations, on each level (default: none for equilibrium, which ends by "
                  "itself; 10000 for the "
                  "others)")
      ->type_name("N")
      ->check(whole_number(0))
      ->group(fairing_group);
}

void add_shaping_options(CLI::App& command, FairingArguments& arguments, const FairingWords& words) {
  FairOptions& options = arguments.options;
  add_choice(command, "--distribution", arguments.distribution, distributions,
             fmt::format("Along the {}, nodes keep the spacing of the input without its noise (smooth); go to the mean "
                         "of their neighbours (even); or keep their shares between neighbours and, in fits of "
                         "surfaces, their places (keep) (default: smooth; keep if the points are the nodes of the "
                         "input; even for curves and with the methods multigrid and sweep)",
                         words.shape))
      ->group(fairing_group);
  command
      .add_option("--strength", options.strength,
                  "result = input + S × (fair − input) for moving nodes, 0 to 1 (default: 1)")
      ->type_name("S")
      ->check(number_between(0, 1))
      ->group(fairing_group);
}

void add_run_options(CLI::App& command, FairingArguments& arguments) {
  command.add_option("--threads", arguments.threads, "Threads; the same bits for every number (default: all cores)")
      ->type_name("N")
      ->check(whole_number(1, 1024))
      ->group(run_group);
  command
      .add_option("--time-limit", arguments.time_limit,
                  "End after this many seconds, reading included, with the best shape so far; the only option whose "
                  "result may differ from run to run (default: none)")
      ->type_name("S")
      ->check(positive_number())
      ->group(run_group);
  command.add_option("--report", arguments.report, "Write what happened, JSON")
      ->type_name("FILE.json")
      ->group(run_group);
  command
      .add_option("--html", arguments.html, "Write a page to view offline, one file: the shape in 3D, charts, figures")
      ->type_name("OUT.html")
      ->group(run_group);
  command
      .add_option("--scalars", arguments.scalars,
                  "Write numbers at nodes for ParaView and the like: curvatures (1/length), deviation from the shape "
                  "before (units of the input); .ply only for surfaces")
      ->type_name("OUT.vtp|OUT.ply")
      ->group(run_group);
  command.add_flag("--quiet", arguments.quiet, "No progress and no summary; warnings and errors stay (default: off)")
      ->group(run_group);
  add_choice(command, "--color", arguments.colour, colours,
             "Colours (default: auto, on terminals unless NO_COLOR is set)")
      ->group(run_group);
}

}  // namespace vspring::cli
