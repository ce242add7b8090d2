#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "closed_chains.hpp"
#include "commands/commands.hpp"
#include "commands/option_kinds.hpp"
#include "commands/shared_options.hpp"
#include "degrees.hpp"
#include "fairing.hpp"
#include "fitting.hpp"
#include "framing.hpp"
#include "outputs.hpp"
#include "symmetry.hpp"
#include "terminal.hpp"
#include "vspring/vspring.hpp"

namespace vspring::cli {

namespace {

// Keeps rounding from putting points outside.
constexpr double spare_of_tolerance = 1.001;
// How far noise moves two rows apart, relative to how far it moves one.
constexpr double apart_by_noise = std::numbers::sqrt2;
// As a share of a distance.
constexpr double unseen_distance = 1e-9;

struct CurveArguments : FairingArguments {
  std::optional<CurveFormat> format;
  ColumnChoice columns;
  bool closed = false;
  bool order = false;
  Resampling resampling;
  PullArguments pull;
};

/// A curve that was drawn, and its constraints.
struct Drawn {
  PolygonCurve input;  ///< with its new nodes, if any
  Constraints constraints;
  FairedOrFitted done;
};

bool resamples(const CurveArguments& arguments) { return arguments.resampling.nodes || arguments.resampling.spacing; }

/// Replaces the file's nodes by new ones between held nodes, fits these to the file's nodes if asked for, and fairs
/// them.
Drawn resample_and_fair(const PolygonCurve& curve, const Constraints& constraints, const CurveArguments& arguments,
                        Context& context) {
  if (asks_to_fit(arguments.pull)) {
    ResampledFit made = fit_resampled(curve, constraints, arguments.resampling,
                                      fit_options(arguments.pull, arguments.options), context);
    FairedOrFitted done = account_for(std::move(made.fit), curve, arguments, arguments.pull, context);
    return {std::move(made.resampled.curve), std::move(made.resampled.constraints), std::move(done)};
  }
  ResampledFair made = fair_resampled(curve, constraints, arguments.resampling, arguments.options, context);
  return {std::move(made.resampled.curve), std::move(made.resampled.constraints), {std::move(made.fair), std::nullopt}};
}

/// Fairs a curve, or draws it to its own nodes.
Drawn draw_once(const MirroredShape<PolygonCurve>& mirrored, const Constraints& constraints,
                const CurveArguments& arguments, Context& context) {
  const PolygonCurve& curve = mirrored.shape();
  if (resamples(arguments)) return resample_and_fair(curve, constraints, arguments, context);
  return {curve, mirrored.of_shape(constraints),
          fair_or_fit(mirrored, constraints, {}, arguments, arguments.pull, context)};
}

/// Whether a row's distance from the curve is that from a held node: then no curve is nearer to it.
bool is_at_held(const PolygonCurve& curve, const Constraints& constraints, Index row, double distance) {
  for (Index i = 0; i < curve.node_count(); ++i) {
    if (constraints.position_fixed(i) &&
        (constraints.position(i) - curve.position(row)).norm() <= (1 + unseen_distance) * distance)
      return true;
  }
  return false;
}

/// Draws a curve. If the tolerance is from noise, raises it to what a row beyond a held end needs, as that end has
/// noise, too; says so in `warnings` and changes the tolerance.
Drawn draw(const MirroredShape<PolygonCurve>& mirrored, const Constraints& constraints, CurveArguments& arguments,
           std::vector<std::string>& warnings, Context& context) {
  Drawn drawn = draw_once(mirrored, constraints, arguments, context);
  if (arguments.pull.automatic != "--within" || context.cancelled()) return drawn;
  const Distance& furthest = drawn.done.account->furthest();
  const double needed = furthest.greatest;
  const double given = *arguments.pull.within;
  if (!(needed > given && needed <= apart_by_noise * given) ||
      !is_at_held(mirrored.shape(), constraints, furthest.node, needed))
    return drawn;
  CurveArguments wider = arguments;
  wider.pull.within = spare_of_tolerance * needed;
  Drawn again = draw_once(mirrored, constraints, wider, context);
  if (again.done.faired.report.outcome != Outcome::converged) return drawn;
  warnings.push_back(
      fmt::format("no curve is within {:.3g}, as the noise says: row {} is {:.3g} away from the node that is held "
                  "there; auto allows "
                  "for that; --fix none lets ends go along with their rows",
                  given, furthest.node, needed));
  arguments.pull.within = wider.pull.within;
  return again;
}

/// reordered: how many nodes changed place, if an order was asked for.
std::string note_of_order(std::optional<Index> reordered, const PolygonCurve& curve) {
  if (!reordered) return {};
  return fmt::format("note: {} of {} rows changed place, and all come in order along the curve\n", *reordered,
                     curve.node_count());
}

int run_curve(CurveArguments arguments) {
  settle_options(arguments, true, asks_to_fit(arguments.pull));
  check_outputs(arguments);
  refuse_views(arguments, true);
  refuse_with_symmetry(arguments);
  Fairing fairing(arguments);

  CurveFile file = read_curve(arguments.input, arguments.format, arguments.columns);
  const std::optional<Index> reordered =
      arguments.order ? std::optional(order_nodes(file, arguments.closed)) : std::nullopt;
  const ClosedChains closed(file.curve, arguments.closed);
  const PolygonCurve before = file.curve;
  settle_moving(arguments.pull, file);
  settle_by_noise(arguments.pull, before, region_of(arguments, before.positions(), {.groups = &file.groups}),
                  fairing.context());
  const MirroredShape<PolygonCurve> mirrored(arguments, before);
  read_rules(arguments);
  Constraints constraints = mirrored.make_constraints(arguments, {.groups = &file.groups});
  closed.hold(constraints);
  fairing.input_is_read();

  // Noise must not make corners: fits find corners themselves, from the points.
  if (arguments.pull.sharp > 0 && !asks_to_fit(arguments.pull))
    arguments.options.corners = arguments.resampling.corners = find_corners(before, arguments.pull.sharp);
  Drawn drawn = draw(mirrored, constraints, arguments, file.warnings, fairing.context());
  std::vector<Vector3>& positions = drawn.done.faired.positions;
  const bool has_new_nodes = resamples(arguments);
  if (has_new_nodes) {
    replace_nodes(file, std::move(drawn.input));
  } else {
    closed.follow(positions);
  }
  PolygonCurve after = file.curve;
  after.set_positions(positions);

  const auto write = [&] {
    return written_without(arguments.output, write_curve(arguments.output, file, positions, arguments.format));
  };
  const auto draw = [&] {
    return draw_curve(file, positions, {.before = &before, .points = {}, .part = moved_part(before, after)});
  };
  nlohmann::ordered_json figures = drawn.done.figures();
  figures.update(figures_of(file.plane));
  figures.update(mirrored.figures());
  if (reordered) figures["reordered_nodes"] = *reordered;
  return fairing.finish<PolygonCurve>(
      {file.curve, after, drawn.constraints, drawn.done.faired.report}, file.warnings,
      {.write = write,
       .picture = draw,
       .figures = std::move(figures),
       .lines = mirrored.lines() + drawn.done.lines() + closed.note() + note_of_order(reordered, before) +
                note_of(file.plane),
       .facts = {.resamples = has_new_nodes,
                 .moves_freely = arguments.pull.moving_axes == std::array{true, true, true}}});
}

const std::map<std::string, CurveFormat> curve_formats = {{"obj", CurveFormat::obj}, {"csv", CurveFormat::csv},
                                                          {"dat", CurveFormat::dat}, {"xyz", CurveFormat::xyz},
                                                          {"gpx", CurveFormat::gpx}, {"svg", CurveFormat::svg}};
const std::map<std::string, NormalPlane> normal_planes = {{"full", NormalPlane::full},
                                                          {"principal", NormalPlane::principal}};

const std::map<std::string, ResamplingBy> ways_to_resample = {
    {"length", ResamplingBy::length}, {"cosine", ResamplingBy::cosine}, {"curvature", ResamplingBy::curvature}};

void add_node_options(CLI::App& command, CurveArguments& arguments) {
  const std::string group = "Its nodes";
  command
      .add_flag("--closed", arguments.closed,
                "Join the last node of every chain to the first; the two become one if at the same place (default: "
                "from the file)")
      ->group(group);
  command
      .add_flag("--order", arguments.order,
                "Put the rows of every chain in order along the curve, and write them so; for tables and tracks "
                "(default: the file's order)")
      ->group(group);
  CLI::Option* number = command
                            .add_option("--resample", arguments.resampling.nodes,
                                        "New nodes between held ones, N in all (default: the nodes of the input)")
                            ->type_name("N")
                            ->check(whole_number(1))
                            ->group(group);
  command
      .add_option("--spacing", arguments.resampling.spacing,
                  "New nodes between held ones, on average about H apart, units of the input (default: the "
                  "nodes of the input)")
      ->type_name("H")
      ->check(positive_number())
      ->excludes(number)
      ->group(group);
  add_choice(command, "--resample-by", arguments.resampling.by, ways_to_resample,
             "Spacing of new nodes: even; by the cosine, as in tables of aerofoils, closer at the ends and the nose; "
             "or closer where the curve is bent more (default: length)")
      ->group(group);
}

void add_curve_method(CLI::App& command, CurveArguments& arguments, const FairingWords& words) {
  FairOptions& options = arguments.options;
  add_choice(
      command, "--method", arguments.method, methods,
      "The accelerated solver that goes to the true equilibrium, the paper's V-cycle over coarser levels, or its "
      "plain iteration (default: equilibrium)")
      ->group(fairing_group);
  add_continuity_option(command, arguments, true);
  add_stopping_options(command, arguments, "0.001");
  CLI::Option* plane = add_choice(command, "--normal-plane", options.curve.normal_plane, normal_planes,
                                  "Forces of curves in space act in the whole normal plane, or along the principal "
                                  "normal only, as in the paper (default: full)")
                           ->group(fairing_group);
  command
      .add_flag(
          "--paper", arguments.paper,
          "The paper's own choices throughout, its equations as printed: weights 1/length; in a plane along the mean "
          "normal of both edges, in space along the principal normal, which nodes in line with both neighbours do not "
          "have; points' displacements in full; and the method sweep unless --method says another, node after node "
          "in the order of the file (on one thread), with the last iteration as the result (default: off)")
      ->excludes(plane)
      ->group(fairing_group);
  add_shaping_options(command, arguments, words);
}

}  // namespace

void add_curve_command(CLI::App& app, std::function<int()>& run) {
  const FairingWords words = {.shape = "curve",
                              .input =
                                  ".obj (l elements), .csv, .dat (aerofoils), .xyz or .gpx (tracks: "
                                  "tolerances and all other lengths are metres)",
                              .ends = "End nodes",
                              .directions = "tangents",
                              .rules = "positions, tangents and normals"};
  const auto arguments = std::make_shared<CurveArguments>();
  CLI::App& command = *app.add_subcommand("curve", "Fair a polygonal curve");
  add_files(command, *arguments, words);
  add_choice(command, "--format", arguments->format, curve_formats,
             "Format of - (default: found from the content; the input's). svg, with its curvature comb, only for the "
             "output");
  add_columns(command, "--columns", arguments->columns, columns_of_curves);
  add_constraint_options(command, *arguments, words);
  add_symmetry_option(command, *arguments, words);
  add_node_options(command, *arguments);
  add_pull_options(command, arguments->pull, pull_of_own_nodes);
  add_curve_bounds(command, arguments->pull, pull_of_own_nodes);
  add_moving(command, arguments->pull.moving,
             "Only these coordinates change; rows keep the others to the last digit, and distances are measured in the "
             "changing ones")
      ->group(pull_of_own_nodes);
  add_curve_method(command, *arguments, words);
  add_run_options(command, *arguments);
  add_picture_options(command, arguments->picture, false);
  command.footer(
      "Example: an aerofoil of 200 even nodes, its trailing edge held with the tangents that it has\n"
      "  vspring curve aerofoil.dat -o fair.dat --constraints held.json --resample 200 --picture fair.svg\n\n"
      "Exit status: 0 converged; 1 wrong use; 2 unusable input or output; 3 written, but not converged; 130 "
      "interrupted.");
  when_given(command, arguments, run, run_curve);
}

}  // namespace vspring::cli
