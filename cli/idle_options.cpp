#include "idle_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <variant>

#include "fairing_arguments.hpp"
#include "picture.hpp"
#include "vspring/topology.hpp"

namespace vspring::cli {

namespace {

struct IdleRule {
  const char* option;
  bool (*is_idle)(const RunFacts& facts);
  const char* use;
};

constexpr const char* at_boundary = "no node moves at a boundary or end";
constexpr const char* about_boundary[] = {"--fix", "--fix-normals", "--fair-boundary"};

constexpr IdleRule idle_rules[] = {
    {"--fix", [](const RunFacts& run) { return run.fair_boundary; }, "--fair-boundary takes its place"},
    {"--fix", [](const RunFacts& run) { return run.fix_is_none ? !run.boundary_moves : !run.moves_near_boundary; },
     at_boundary},
    {"--fix-normals", [](const RunFacts& run) { return !run.moves_near_boundary && run.sharp_edges == 0; },
     at_boundary},
    {"--fair-boundary", [](const RunFacts& run) { return !run.boundary_moves; },
     "there is no boundary, or rules or a region hold all of it"},
    {"--closed", [](const RunFacts& run) { return !run.is_curve; }, "it is for curves"},
    {"--sharp", [](const RunFacts& run) { return run.spans_curves && run.sharp_option_is_idle; },
     "none of these curves has a surface on both sides"},
    {"--symmetry", [](const RunFacts& run) { return run.spans_curves && !run.ends_in_plane; },
     "the surface has no end in that plane, other than sharp ones"},
    {"--sharp",
     [](const RunFacts& run) {
       return !run.spans_curves && !run.is_curve && run.sharp_option_is_idle && run.takes_marks;
     },
     "the file marks no edge that can be sharp, and none turns by more than an angle that is given"},
    {"--sharp", [](const RunFacts& run) { return !run.spans_curves && !run.is_curve && run.sharp_option_is_idle; },
     "no edge turns by more than that"},
    {"--sharp-curves", [](const RunFacts& run) { return run.is_curve; }, "it is for surfaces"},
    {"--sharp-curves", [](const RunFacts& run) { return run.sharp_edges == 0; }, "there are no sharp edges (--sharp)"},
    {"--min-radius", [](const RunFacts& run) { return !run.is_curve; }, "it is for curves"},
    {"--resample-by", [](const RunFacts& run) { return !run.resamples; }, "it is for --resample and --spacing"},
    {"--refine", [](const RunFacts& run) { return run.refines_nothing; },
     "no edge that moves is longer than that, or turns by more"},
    {"--remesh", [](const RunFacts& run) { return run.remeshes_nothing; }, "no face moves"},
    {"--move", [](const RunFacts& run) { return !run.is_curve; }, "it is for curves"},
    {"--move", [](const RunFacts& run) { return run.moves_freely; }, "these are all coordinates of the curve"},
    {"--distribution", [](const RunFacts& run) { return !run.moves_freely; }, "--move says where nodes are"},
    {"--ignore-point-normals", [](const RunFacts& run) { return run.is_curve; }, "it is for surfaces"},
    {"--ignore-point-normals", [](const RunFacts& run) { return !run.points_face; }, "the points have no normals"},
    // Boundaries that are faired first, but not fitted, go to their equilibrium with every method, except with --paper.
    {"--tolerance",
     [](const RunFacts& run) {
       return !run.equilibrium_tried && !(run.boundary_to_equilibrium && run.boundary_moves && !run.own_nodes_pull);
     },
     "it is for --method equilibrium"},
    {"--step-tolerance", [](const RunFacts& run) { return run.method == Method::equilibrium; },
     "it is for --method sweep and multigrid"},
    {"--springs", [](const RunFacts& run) { return !run.equilibrium_tried || run.own_nodes_pull; },
     "it is for --method equilibrium without points"},
    {"--fair-by", [](const RunFacts& run) { return !run.equilibrium_tried || run.own_nodes_pull; },
     "it is for --method equilibrium without points"},
    {"--fair-by", [](const RunFacts& run) { return run.springs == Springs::edge; }, "it is for --springs sphere"},
    {"--levels", [](const RunFacts& run) { return run.method != Method::multigrid; }, "it is for --method multigrid"},
    {"--pre-smoothing", [](const RunFacts& run) { return run.method != Method::multigrid; },
     "it is for --method multigrid"},
    {"--pre-smoothing", [](const RunFacts& run) { return run.levels < 2; }, "there is one level only"},
    {"--normal-plane", [](const RunFacts& run) { return run.is_planar; },
     "it is for curves in space, and this one lies in a plane"},
    {"--picture-size", [](const RunFacts& run) { return !run.has_picture; }, "it is for --picture"},
    {"--picture-size", [](const RunFacts& run) { return run.is_curve && run.picture_is_svg; },
     "the picture of a curve as SVG has any size"},
    {"--picture-style", [](const RunFacts& run) { return run.is_curve; }, "it is for surfaces"},
    {"--picture-style", [](const RunFacts& run) { return !run.has_picture; }, "it is for --picture"},
    {"--view", [](const RunFacts& run) { return run.is_curve; }, "it is for surfaces"},
    {"--view", [](const RunFacts& run) { return !run.has_picture && !run.has_page; }, "it is for --picture and --html"},
    {"--noise-on-boundary", [](const RunFacts& run) { return !run.has_noise; }, "it is for --noise"},
    {"--noise-on-boundary", [](const RunFacts& run) { return !run.boundary_moves; }, "the shape has no boundary"},
    {"--seed", [](const RunFacts& run) { return !run.draws_numbers; }, "it is for --jitter, --noise and --shuffle"},
    {"--height", [](const RunFacts& run) { return run.is_flat; }, "it is for --profile steps and cone"},
};

/// nodes: of a face or an edge.
bool any_moves_near(std::span<const Index> nodes, const std::vector<std::uint8_t>& boundary,
                    const Constraints& constraints) {
  const auto on_boundary = [&](Index node) { return boundary[static_cast<std::size_t>(node)] != 0; };
  const auto moves = [&](Index node) { return !constraints.position_fixed(node); };
  return std::ranges::any_of(nodes, on_boundary) && std::ranges::any_of(nodes, moves);
}

bool any_of_it_moves(const std::vector<std::uint8_t>& boundary, const Constraints& constraints) {
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    if (boundary[i] != 0 && !constraints.position_fixed(static_cast<Index>(i))) return true;
  }
  return false;
}

bool asks_for_boundary(const RunFacts& facts) {
  return std::ranges::any_of(about_boundary, [&](const char* option) { return facts.given.contains(option); });
}

}  // namespace

void look_at(RunFacts& facts, const FairingArguments& arguments) {
  facts.given = arguments.given;
  facts.equilibrium_tried = arguments.options.method_kind() == Method::equilibrium;
  facts.springs = arguments.options.springs;
  facts.fix_is_none = arguments.fix == Hold::none;
  facts.fair_boundary = arguments.fair_boundary;
  const auto& boundary = arguments.options.fair_boundary;
  facts.boundary_to_equilibrium = boundary && std::holds_alternative<EquilibriumMethod>(*boundary);
  facts.has_picture = !arguments.picture.path.empty();
  facts.picture_is_svg = facts.has_picture && named_svg(arguments.picture.path);
  facts.has_page = !arguments.html.empty();
}

void look_at(RunFacts& facts, const PolygonMesh& mesh, const Constraints& constraints) {
  if (!asks_for_boundary(facts)) return;
  const std::vector<std::uint8_t> boundary = boundary_nodes(mesh);
  facts.boundary_moves = any_of_it_moves(boundary, constraints);
  for (Index f = 0; f < mesh.face_count() && !facts.moves_near_boundary; ++f)
    facts.moves_near_boundary = any_moves_near(mesh.face(f), boundary, constraints);
}

void look_at(RunFacts& facts, const PolygonCurve& curve, const Constraints& constraints) {
  facts.is_curve = true;
  facts.is_planar = facts.given.contains("--normal-plane") && lies_in_a_plane(curve, constraints);
  if (!asks_for_boundary(facts)) return;
  const std::vector<std::uint8_t> ends = boundary_nodes(curve);
  facts.boundary_moves = any_of_it_moves(ends, constraints);
  for (const PolygonCurve::Chain& chain : curve.chains()) {
    for (std::size_t k = 0; k + 1 < chain.nodes.size() && !facts.moves_near_boundary; ++k)
      facts.moves_near_boundary = any_moves_near(std::span(chain.nodes).subspan(k, 2), ends, constraints);
  }
}

std::vector<std::string> idle_options(const RunFacts& facts) {
  std::vector<std::string> warnings;
  std::string last;
  for (const IdleRule& rule : idle_rules) {
    if (rule.option == last || !facts.given.contains(rule.option) || !rule.is_idle(facts)) continue;
    warnings.push_back(fmt::format("{} has no effect here: {}", rule.option, rule.use));
    last = rule.option;
  }
  return warnings;
}

}  // namespace vspring::cli
