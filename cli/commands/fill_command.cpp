#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
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
#include "welding.hpp"

namespace vspring::cli {

namespace {

struct FillArguments : FairingArguments {
  std::optional<SurfaceFormat> format;
  FillOptions fill;
};

// Most holes of each kind that the summary names.
constexpr int holes_in_words = 10;

nlohmann::ordered_json hole_json(const Hole& hole) {
  nlohmann::ordered_json json = {
      {"node", hole.rim.front()}, {"edges", hole.rim.size()}, {"length", hole.length}, {"state", name(hole.state)}};
  if (hole.fault != HoleFault::none) json["fault"] = fault_message(hole);
  if (hole.state != HoleState::filled) return json;
  json["first_node"] = hole.first_node;
  json["new_nodes"] = hole.node_count;
  json["first_face"] = hole.first_face;
  json["new_faces"] = hole.face_count;
  json["outcome"] = hole.outcome ? nlohmann::ordered_json(name(*hole.outcome)) : nullptr;
  return json;
}

nlohmann::ordered_json hole_figures(const FilledHoles& filled) {
  nlohmann::ordered_json holes = nlohmann::ordered_json::array();
  for (const Hole& hole : filled.holes) holes.push_back(hole_json(hole));
  return {{"holes", std::move(holes)},
          {"filled_holes", std::ranges::count(filled.holes, HoleState::filled, &Hole::state)},
          {"new_nodes", filled.node_like.size()},
          {"new_faces", filled.face_like.size()}};
}

/// The holes of one state, for people. advice: what to do about them.
std::string open_line(const FilledHoles& filled, HoleState state, const char* what, const char* advice) {
  std::string nodes;
  int count = 0;
  for (const Hole& hole : filled.holes) {
    if (hole.state != state) continue;
    if (++count <= holes_in_words)
      nodes += fmt::format("{} at node {} ({} edges)", count == 1 ? "" : ",", hole.rim.front(), hole.rim.size());
  }
  if (count == 0) return {};
  if (count > holes_in_words) nodes += fmt::format(" and {} more", count - holes_in_words);
  return fmt::format("left open        {}{}{}\n", what, nodes, advice);
}

std::string hole_lines(const FilledHoles& filled) {
  const auto count = std::ranges::count(filled.holes, HoleState::filled, &Hole::state);
  const auto holes = std::ssize(filled.holes) - std::ranges::count(filled.holes, HoleState::outer_rim, &Hole::state);
  std::string text = "filled           nothing: the surface has no hole\n";
  if (holes > 0) {
    text = fmt::format("filled           {} of {} hole{}, with {} nodes and {} faces\n", count, holes,
                       holes == 1 ? "" : "s", filled.node_like.size(), filled.face_like.size());
  }
  text += open_line(filled, HoleState::outer_rim, "outer rims:", "; --outer-rims or --at fills them");
  text += open_line(filled, HoleState::too_large, "larger ones:", "");
  text += open_line(filled, HoleState::unfillable, "for the reasons above:", "");
  return text + open_line(filled, HoleState::cancelled, "as time was over:", "");
}

int run_fill(FillArguments arguments) {
  settle_options(arguments, false, false);
  check_outputs(arguments);
  refuse_views(arguments, false);
  Fairing fairing(arguments);

  SurfaceFile file = read_surface(arguments.input, arguments.format);
  if (file.mesh.face_count() == 0)
    throw Error(ErrorCode::unusable_file,
                input_name(arguments.input) + ": no face in it, so there is no surface that could have holes");
  const Welding welding(file, arguments);
  FillOptions& options = arguments.fill;
  options.fair = arguments.options;
  if (const Welded* const welded = welding.rules(file).welded; welded != nullptr) {
    for (Index& node : options.at) {
      if (node >= 0 && node < file.mesh.node_count()) node = welded->representative[static_cast<std::size_t>(node)];
    }
  }
  fairing.input_is_read();

  const FilledHoles filled = fill_holes(welding.shape(file), options, fairing.context());
  add_patches(file, filled);
  std::vector<std::string> warnings = file.warnings;
  PolygonMesh after = filled.mesh;
  after.set_positions(filled.positions);
  take_written(after, written_positions(arguments.output, file, filled.positions, arguments.format), warnings);
  const auto write = [&] {
    return written_without(arguments.output,
                           write_surface(arguments.output, file, file.mesh.positions(), arguments.format));
  };
  auto figures = hole_figures(filled);
  figures.update(welding.figures());
  const int status = fairing.finish<PolygonMesh>(
      {filled.mesh, after, filled.constraints(), filled.report}, welding.with_warnings(std::move(warnings)),
      {.write = write, .picture = {}, .figures = std::move(figures), .lines = welding.lines() + hole_lines(filled)});
  return status == exit_converged && !filled.usable() ? exit_not_converged : status;
}

void add_hole_options(CLI::App& command, FillArguments& arguments) {
  const std::string group = "Which holes";
  FillOptions& options = arguments.fill;
  command
      .add_option("--at", options.at,
                  "Only holes through these boundary nodes, outer rims among them, by numbers from 0 with commas "
                  "between (default: all holes but outer rims)")
      ->type_name("NODES")
      ->delimiter(',')
      ->check(whole_number(0))
      ->group(group);
  command
      .add_option("--max-size", options.most_length,
                  "Only holes whose rim is no longer than this (units of the input; default: any)")
      ->type_name("LENGTH")
      ->check(positive_number())
      ->group(group);
  command
      .add_option("--max-edges", options.most_edges, "Only holes whose rim has no more edges than this (default: any)")
      ->type_name("N")
      ->check(whole_number(3))
      ->group(group);
  command
      .add_flag("--outer-rims", options.outer_rims,
                "Fill the outer rims of sheets, too: rims whose normal is less than 60° from that of the faces there; "
                "at ends of tubes it is 90°, at holes up to 180° (default: off)")
      ->group(group);
}

}  // namespace

void add_fill_command(CLI::App& app, std::function<int()>& run) {
  const FairingWords words = {.shape = "surface",
                              .input = ".obj, .off, .ply or .stl",
                              .ends = {},
                              .directions = {},
                              .rules = {},
                              .to = "fill",
                              .done = "filled"};
  const auto arguments = std::make_shared<FillArguments>();
  CLI::App& command = *app.add_subcommand("fill", "Fill the holes of a surface with fair patches");
  add_files(command, *arguments, words);
  add_choice(command, "--format", arguments->format, surface_formats,
             "Format of - (default: found from the content; the input's)");
  add_hole_options(command, *arguments);
  add_weld_option(command, *arguments);
  CLI::Option* const flat = command
                                .add_flag("--flat", arguments->fill.flat,
                                          "Do not fair patches: they are the triangles of least dihedral angles, as "
                                          "dense as the mesh around, with creases at the rim (default: off)")
                                ->group(fairing_group);
  add_tolerance_option(command, *arguments)->excludes(flat);
  add_fair_by_option(command, *arguments)->excludes(flat);
  add_continuity_option(command, *arguments)->excludes(flat);
  add_run_options(command, *arguments);
  add_picture_options(command, arguments->picture, true);
  command.footer(
      "Nodes and faces of the input stay as they are; those of patches follow them.\n\n"
      "Example: close the small holes of a scan\n"
      "  vspring fill scan.ply -o closed.ply --max-edges 50 --report report.json\n\n"
      "Exit status: 0 filled and converged; 1 wrong use; 2 unusable input or output; 3 written, but a hole cannot be "
      "filled or not converged; 130 interrupted.");
  when_given(command, arguments, run, run_fill);
}

}  // namespace vspring::cli
