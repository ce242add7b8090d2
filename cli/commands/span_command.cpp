#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "commands/commands.hpp"
#include "commands/option_kinds.hpp"
#include "commands/shared_options.hpp"
#include "exit_status.hpp"
#include "fairing.hpp"
#include "fitting.hpp"
#include "outputs.hpp"
#include "precision.hpp"
#include "terminal.hpp"
#include "vspring/vspring.hpp"

namespace vspring::cli {

namespace {

struct SpanArguments : FairingArguments {
  std::optional<SurfaceFormat> format;
  std::vector<std::string> columns;
  std::vector<std::string> sharp;
  SpanOptions span;
};

// Most loops of each kind that the summary names.
constexpr int loops_in_words = 10;
// How far a surface bulges: as shares of the thickness of its patches, and of their size.
constexpr double thicker = 0.25;
constexpr double thicker_in_size = 0.005;

nlohmann::ordered_json loop_json(const NetworkLoop& loop) {
  nlohmann::ordered_json json = {{"curves", loop.curves},
                                 {"junctions", loop.junctions},
                                 {"length", loop.length},
                                 {"state", name(loop.state)},
                                 {"turn", loop.turn}};
  if (loop.state != LoopState::spanned) return json;
  json["grid"] = loop.is_grid;
  json["first_node"] = loop.first_node;
  json["nodes"] = loop.node_count;
  json["first_face"] = loop.first_face;
  json["faces"] = loop.face_count;
  return json;
}

nlohmann::ordered_json span_figures(const SpannedCurves& spanned) {
  nlohmann::ordered_json curves = nlohmann::ordered_json::array();
  for (const NetworkCurve& curve : spanned.curves)
    curves.push_back({{"from", curve.from.front()},
                      {"to", curve.from.back()},
                      {"length", curve.length},
                      {"sharp", curve.is_sharp},
                      {"loops", curve.loops},
                      {"nodes", curve.nodes}});
  nlohmann::ordered_json loops = nlohmann::ordered_json::array();
  for (const NetworkLoop& loop : spanned.loops) loops.push_back(loop_json(loop));
  return {{"curves", std::move(curves)},
          {"loops", std::move(loops)},
          {"sharp_edges", spanned.sharp_edges.size()},
          {"spanned_loops", std::ranges::count(spanned.loops, LoopState::spanned, &NetworkLoop::state)}};
}

/// The loops of one state, for people. advice: what to do about them.
std::string open_line(const SpannedCurves& spanned, LoopState state, const char* what, const char* advice) {
  std::string loops;
  int count = 0;
  for (std::size_t l = 0; l < spanned.loops.size(); ++l) {
    if (spanned.loops[l].state != state) continue;
    if (++count <= loops_in_words)
      loops += fmt::format("{} {} ({} curve{})", count == 1 ? "" : ",", l, spanned.loops[l].curves.size(),
                           spanned.loops[l].curves.size() == 1 ? "" : "s");
  }
  if (count == 0) return {};
  if (count > loops_in_words) loops += fmt::format(" and {} more", count - loops_in_words);
  return fmt::format("left open        {} loop{}{}{}\n", what, count == 1 ? "" : "s", loops, advice);
}

std::string span_lines(const SpannedCurves& spanned) {
  const auto count = std::ranges::count(spanned.loops, LoopState::spanned, &NetworkLoop::state);
  const auto grids = std::ranges::count_if(
      spanned.loops, [](const NetworkLoop& loop) { return loop.state == LoopState::spanned && loop.is_grid; });
  std::string text = fmt::format("spanned          {} of {} loops of {} curves: {} by quads, {} by triangles\n", count,
                                 spanned.loops.size(), spanned.curves.size(), grids, count - grids);
  text += open_line(spanned, LoopState::outer, "outer rim:", "; --also spans it");
  text += open_line(spanned, LoopState::lid, "lid:", "; --also spans it");
  text += open_line(spanned, LoopState::left_out, "as asked:", "");
  text += open_line(spanned, LoopState::unspannable, "for the reasons above:", "");
  return text + open_line(spanned, LoopState::cancelled, "as time was over:", "");
}

/// The chains that are named: those of a group, which has all of their nodes, and those of a number.
std::vector<Index> chains_of(const std::vector<std::string>& names, const CurveFile& file) {
  const auto& all = file.curve.chains();
  std::vector<Index> chains;
  for (const std::string& name : names) {
    if (const auto group = file.groups.find(name); group != file.groups.end()) {
      for (std::size_t c = 0; c < all.size(); ++c) {
        const bool is_in = std::ranges::all_of(
            all[c].nodes, [&](Index node) { return std::ranges::binary_search(group->second, node); });
        if (is_in) chains.push_back(static_cast<Index>(c));
      }
      continue;
    }
    std::size_t number = 0;
    const char* const end = name.data() + name.size();
    const bool is_number = !name.empty() && std::from_chars(name.data(), end, number).ptr == end;
    if (!is_number || number >= all.size()) {
      std::string known;
      for (const auto& [group, members] : file.groups) known += (known.empty() ? "" : ", ") + group;
      throw Error(
          ErrorCode::invalid_argument,
          fmt::format("--sharp {}: the file has no such group, and its curves go from 0 to {}{}", name,
                      static_cast<std::ptrdiff_t>(all.size()) - 1, known.empty() ? "" : "; its groups are " + known));
    }
    chains.push_back(static_cast<Index>(number));
  }
  return chains;
}

/// Says where the surface is thicker than the patches that it began as: between the sections of a thin body.
std::string warning_of_bulges(const SpannedCurves& spanned) {
  const std::vector<Vector3>& before = spanned.mesh.positions();
  if (before.empty()) return {};
  Vector3 centre = Vector3::Zero();
  for (const Vector3& p : before) centre += p / static_cast<double>(before.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3& p : before) spread += (p - centre) * (p - centre).transpose();
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
  const auto extents = [&](const std::vector<Vector3>& positions) {
    Eigen::AlignedBox3d box;
    for (const Vector3& p : positions) box.extend(Vector3(axes.transpose() * (p - centre)));
    return Vector3(box.sizes());
  };
  // Along the least of the axes, the first one.
  const double thin = extents(before)[0];
  const double now = extents(spanned.positions)[0];
  if (!(now - thin > std::max(thicker * thin, thicker_in_size * extents(before).norm()))) return {};
  return fmt::format(
      "the surface bulges between its curves: it is {:.3g} thick, the patches between them are {:.3g}; add curves "
      "there, or take the patches as they are (--flat)",
      now, thin);
}

int run_span(SpanArguments arguments) {
  settle_options(arguments, false, false);
  check_outputs(arguments);
  refuse_views(arguments, false);
  Fairing fairing(arguments);

  const CurveFile file = read_curve(arguments.input, std::nullopt, arguments.columns);
  SpanOptions& options = arguments.span;
  options.fair = arguments.options;
  options.sharp = chains_of(arguments.sharp, file);
  if (!arguments.symmetry.empty()) options.symmetry = parse_plane(arguments.symmetry);
  fairing.input_is_read();

  const SpannedCurves spanned = span_curves(file.curve, options, fairing.context());
  const SurfaceFile surface = file_of(spanned);
  std::vector<std::string> warnings = file.warnings;
  if (std::string bulges = warning_of_bulges(spanned); !bulges.empty()) warnings.push_back(std::move(bulges));
  PolygonMesh after = spanned.mesh;
  after.set_positions(spanned.positions);
  take_written(after, written_positions(arguments.output, surface, spanned.positions, arguments.format), warnings);
  const auto write = [&] {
    // Groups and lines are more than other formats have.
    write_surface(arguments.output, surface, spanned.positions, arguments.format);
    return std::vector<std::string>();
  };
  RunFacts facts;
  facts.spans_curves = true;
  facts.ends_in_plane = spanned.symmetric_nodes > 0;
  facts.sharp_option_is_idle = spanned.sharp_edges.empty();
  const int status =
      fairing.finish<PolygonMesh>({spanned.mesh, after, spanned.constraints, spanned.report}, std::move(warnings),
                                  {.write = write,
                                   .picture = {},
                                   .figures = span_figures(spanned),
                                   .lines = span_lines(spanned),
                                   .facts = std::move(facts)});
  return status == exit_converged && !spanned.usable() ? exit_not_converged : status;
}

void add_network_options(CLI::App& command, SpanArguments& arguments) {
  const std::string group = "The curves";
  SpanOptions& options = arguments.span;
  add_columns(command, "--columns", arguments.columns, columns_of_curves);
  command
      .add_option("--join", options.join,
                  "Curves that come nearer to each other than this meet there (units of the input; default: a "
                  "thousandth of the diagonal of the box around them)")
      ->type_name("LENGTH")
      ->check(non_negative_number())
      ->group(group);
  command
      .add_flag("--fair-curves", options.fair_curves,
                "First fair the curves in space; they keep their junctions and the tangents at their ends (default: "
                "they stay as they are)")
      ->group(group);
  add_names(command, "--sharp", arguments.sharp,
            "Curves along which the surface may have an edge, by their OBJ groups or by their numbers in the file from "
            "0, with commas between (default: none)")
      ->type_name("NAMES")
      ->group(group);
  const auto add_loops = [&](const std::string& flag, std::vector<Index>& loops, const std::string& text) {
    command.add_option(flag, loops, text)
        ->type_name("LOOPS")
        ->delimiter(',')
        ->check(whole_number(0))
        ->group("Which loops");
  };
  add_loops("--loops", options.loops,
            "Span only these loops, by their numbers in the summary and the report, with commas between (default: all "
            "but outer rims and lids)");
  add_loops("--also", options.also, "Span these, too: outer rims and lids (default: none)");
  add_loops("--without", options.without, "Leave these open (default: none)");
}

}  // namespace

void add_span_command(CLI::App& app, std::function<int()>& run) {
  const FairingWords words = {.shape = "surface",
                              .input = ".obj (its l lines), .csv, .xyz, .dat or .gpx",
                              .ends = {},
                              .directions = {},
                              .rules = {},
                              .to = "span",
                              .done = "spanned"};
  const auto arguments = std::make_shared<SpanArguments>();
  CLI::App& command = *app.add_subcommand("span", "Span a network of curves with a fair surface");
  command.add_option("curves", arguments->input, "The curves to span: " + words.input + "; - for standard input")
      ->required()
      ->type_name("CURVES");
  command
      .add_option("-o,--output", arguments->output,
                  "Where the surface goes, format by extension; - for standard output")
      ->required()
      ->type_name("OUT");
  add_choice(command, "--format", arguments->format, surface_formats, "Format of the output - (default: obj)");
  add_network_options(command, *arguments);
  command
      .add_option("--length", arguments->span.edge_length,
                  "Length of edges (units of the input; default: an 80th of the diagonal of the box around the curves)")
      ->type_name("LENGTH")
      ->check(positive_number())
      ->group(mesh_group);
  command
      .add_option(
          "--symmetry", arguments->symmetry,
          "Where the surface ends in this plane it is at right angles to it, but not along --sharp curves: half "
          "a shape becomes half of a smooth whole. x, y or z (the plane where that is 0), x=2.5, or "
          "plane:px,py,pz,nx,ny,nz by a point "
          "and a normal (units of the input) (default: off)")
      ->type_name("PLANE")
      ->group(fairing_group);
  CLI::Option* const flat = command
                                .add_flag("--flat", arguments->span.flat,
                                          "Do not fair the surface: Coons's patches, and triangles of least dihedral "
                                          "angles, with creases along curves (default: off)")
                                ->group(fairing_group);
  add_tolerance_option(command, *arguments)->excludes(flat);
  add_fair_by_option(command, *arguments)->excludes(flat);
  add_run_options(command, *arguments);
  add_picture_options(command, arguments->picture, true);
  command.footer(
      "Example: a hull from its stations, sheer and keel\n"
      "  vspring span lines.obj -o hull.obj --symmetry y --report report.json\n\n"
      "Exit status: 0 spanned and converged; 1 wrong use; 2 unusable input or output; 3 written, but a loop cannot be "
      "spanned or not converged; 130 interrupted.");
  when_given(command, arguments, run, run_span);
}

}  // namespace vspring::cli
