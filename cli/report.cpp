#include "report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <type_traits>
#include <variant>

#include "vspring/topology.hpp"
#include "vspring/version.hpp"

namespace vspring::cli {

namespace {

nlohmann::ordered_json to_json(const Fairness& fairness) {
  return {{"vspring_energy", fairness.vspring_energy},
          {"greatest_turn", fairness.greatest_turn},
          {"rms_turn", fairness.rms_turn}};
}

Fairness fairness_in(const std::vector<Figure>& figures) {
  Fairness fairness;
  for (const Figure& figure : figures) {
    if (figure.key == "vspring_energy") fairness.vspring_energy = figure.value;
    if (figure.key == "greatest_turn") fairness.greatest_turn = figure.value;
    if (figure.key == "rms_turn") fairness.rms_turn = figure.value;
  }
  return fairness;
}

/// The step of the plain iteration does not show the distance from the final place.
nlohmann::ordered_json error_of(const FairReport& report) {
  if (!report.expected_error) return nullptr;
  return *report.expected_error;
}

bool has_default_limit(const FairOptions& options) {
  return std::visit([](const auto& one) { return one.max_iterations == std::decay_t<decltype(one)>().max_iterations; },
                    options.method);
}

std::string outcome_line(const FairReport& report, const FairOptions& options, const Terminal& terminal) {
  switch (report.outcome) {
    case Outcome::converged:
      return terminal.green("converged");
    case Outcome::iteration_limit:
      return terminal.yellow(has_default_limit(options)
                                 ? "stopped at the default limit of iterations (--max-iterations changes it)"
                                 : "stopped at the limit of iterations (--max-iterations)");
    case Outcome::work_limit:
      return terminal.yellow("stopped at the limit of work");
    case Outcome::worse_than_input:
      return terminal.yellow("worse than the input");
    case Outcome::stalled:
      return terminal.yellow("stalled");
    case Outcome::cancelled:
      return terminal.yellow("interrupted: this is the shape so far");
  }
  return {};
}

}  // namespace

BeforeAndAfter fairness_of(const PolygonMesh& before, const PolygonMesh& after, const Constraints& constraints,
                           const Context& context) {
  return {measure(before, &constraints, context), measure(after, &constraints, context)};
}

BeforeAndAfter fairness_of(const PolygonCurve& before, const PolygonCurve& after, const Constraints& constraints,
                           const Context& /*context*/) {
  return {measure(before, &constraints), measure(after, &constraints)};
}

BeforeAndAfter fairness_of(const std::vector<Figure>& before, const std::vector<Figure>& after) {
  return {fairness_in(before), fairness_in(after)};
}

BeforeAndAfter fairness_of_boundary(const PolygonMesh& before, const PolygonMesh& after,
                                    const Constraints& constraints) {
  Constraints of_curve = constraints;
  for (Index i = 0; i < of_curve.node_count(); ++i) of_curve.free_normal(i);
  return {measure(boundary_curve(before), &of_curve), measure(boundary_curve(after), &of_curve)};
}

nlohmann::ordered_json to_json(const FairReport& report) {
  nlohmann::ordered_json json;
  json["outcome"] = name(report.outcome);
  json["method"] = name(report.method);
  if (report.faces > 0) {
    json["springs"] = name(report.springs);
    json["fair_by"] = name(report.fair_by);
  }
  json["continuity"] = name(report.continuity);
  if (report.curvature_jump)
    json["curvature_jump"] = {{"tangent", (*report.curvature_jump)[0]}, {"after", (*report.curvature_jump)[1]}};
  json["iterations"] = report.iterations;
  json["residual"] = report.residual;
  json["expected_error"] = error_of(report);
  json["nodes"] = report.nodes;
  json["faces"] = report.faces;
  json["moving_nodes"] = report.moving_nodes;
  json["fixed_positions"] = report.fixed_positions;
  json["sliding_nodes"] = report.sliding_nodes;
  json["fixed_normals"] = report.fixed_normals;
  json["fixed_tangents"] = report.fixed_tangents;
  if (report.faces == 0) json["corners"] = report.corners;
  json["greatest_move"] = report.greatest_move;
  json["rms_move"] = report.rms_move;
  json["seconds"] = report.seconds;
  json["peak_memory_bytes"] = peak_memory_bytes();
  json["threads"] = report.threads;
  json["version"] = version();
  if (report.boundary) {
    json["boundary"] = {{"outcome", name(report.boundary->outcome)},
                        {"iterations", report.boundary->iterations},
                        {"expected_error", error_of(*report.boundary)},
                        {"moving_nodes", report.boundary->moving_nodes}};
  }
  json["warnings"] = nlohmann::ordered_json::array();
  json["warning_codes"] = nlohmann::ordered_json::array();
  for (const Warning& warning : report.warnings) {
    json["warnings"].push_back(warning.text);
    json["warning_codes"].push_back(name(warning.code));
  }
  json["history"] = report.history;
  json["node_iterations"] = report.work;
  json["node_iteration_limit"] = report.most_work > 0 ? nlohmann::ordered_json(report.most_work) : nullptr;
  json["levels"] = nlohmann::ordered_json::array();
  for (const LevelReport& level : report.levels)
    json["levels"].push_back({{"moving_nodes", level.moving_nodes},
                              {"iterations", level.iterations},
                              {"outcome", name(level.outcome)},
                              {"strategy", level.strategy},
                              {"kept_nodes", level.kept_nodes},
                              {"seconds", level.seconds}});
  return json;
}

nlohmann::ordered_json to_json(const BeforeAndAfter& fairness) {
  return {{"before", to_json(fairness.before)}, {"after", to_json(fairness.after)}};
}

std::string summary(const FairReport& report, const std::optional<BeforeAndAfter>& fairness, double size,
                    const FairOptions& options, const Terminal& terminal) {
  std::string text = outcome_line(report, options, terminal);
  if (report.iterations > 0) text += fmt::format(" after {} iterations", report.iterations);
  text += fmt::format(", {:.2f} s", report.seconds);
  if (report.expected_error)
    text += *report.expected_error < 1
                ? fmt::format(", expected error {:.1g} % of the size", 100 * *report.expected_error)
                : ", far from an equilibrium";
  text += "\n";
  const double share = size > 0 ? 100 / size : 0;
  text +=
      fmt::format("{} of {} nodes moved, by up to {:.4g} ({:.2g} % of the size), root mean square {:.4g} ({:.2g} %)\n",
                  report.moving_nodes, report.nodes, report.greatest_move, report.greatest_move * share,
                  report.rms_move, report.rms_move * share);
  if (report.sliding_nodes > 0) text += fmt::format("sliding          {} of them on supports\n", report.sliding_nodes);
  if (report.corners > 0) text += fmt::format("corners          {} kept sharp\n", report.corners);
  if (!fairness) return text;
  const auto& [before, after] = *fairness;
  text += fmt::format("V-Spring energy  {:.4g} → {:.4g}\n", before.vspring_energy, after.vspring_energy);
  text += fmt::format("greatest turn    {:.1f}° → {:.1f}°\n", before.greatest_turn, after.greatest_turn);
  text += fmt::format("rms turn         {:.2f}° → {:.2f}°\n", before.rms_turn, after.rms_turn);
  return text;
}

}  // namespace vspring::cli
