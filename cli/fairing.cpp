#include "fairing.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <fstream>
#include <iterator>

#include "exit_status.hpp"
#include "html_page.hpp"
#include "report.hpp"
#include "vspring/error.hpp"
#include "vspring/output_file.hpp"
#include "vspring/topology.hpp"

namespace vspring::cli {

namespace {

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file.is_open() || file.bad()) throw Error(ErrorCode::unusable_file, path + ": cannot be read");
  return text;
}

double diagonal_of(const std::vector<Vector3>& positions) {
  Eigen::AlignedBox<double, 3> box;
  for (const Vector3& position : positions) {
    if (position.allFinite()) box.extend(position);
  }
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

void fix_boundary_directions(Constraints& constraints, const PolygonMesh& mesh) {
  fix_boundary_normals(constraints, mesh);
}

void fix_boundary_directions(Constraints& constraints, const PolygonCurve& curve) {
  fix_boundary_tangents(constraints, curve);
}

/// A boundary that is faired goes on smoothly outside the region.
void restrict_boundary(Constraints& constraints, const PolygonMesh& mesh, const std::vector<Index>& region,
                       const FairingArguments& arguments) {
  if (arguments.options.fair_boundary) restrict_to_region(constraints, boundary_curve(mesh), region);
}

void restrict_boundary(Constraints& /*constraints*/, const PolygonCurve& /*curve*/,
                       const std::vector<Index>& /*region*/, const FairingArguments& /*arguments*/) {}

template <typename Shape>
Constraints constraints_of(const FairingArguments& arguments, const Shape& shape, const RuleInput& input) {
  Constraints constraints(shape.node_count());
  if (arguments.fix == Hold::boundary && !arguments.options.fair_boundary) fix_boundary_positions(constraints, shape);
  if (arguments.fix_directions == Hold::boundary) fix_boundary_directions(constraints, shape);
  if (!arguments.rules.empty()) {
    try {
      apply_rules(constraints, shape, read_text(arguments.rules), input);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::unusable_constraint) throw;
      throw Error(error.code(), arguments.rules + ": " + error.what());
    }
  }
  if (!arguments.region.empty()) {
    const auto region = select_region(shape.positions(), arguments.region, *input.groups);
    restrict_boundary(constraints, shape, region, arguments);
    restrict_to_region(constraints, shape, region);
  }
  return constraints;
}

}  // namespace

void refuse_shared_page(const FairingArguments& arguments,
                        const std::vector<std::pair<std::string, std::string>>& others) {
  const std::string& page = arguments.html;
  if (page.empty()) return;
  const auto refuse = [&](const std::string& option, const std::string& path, bool output) {
    // Of standard streams, only two outputs are one.
    if (path != page || (page == "-" && !output)) return;
    throw Error(ErrorCode::invalid_argument, fmt::format("--html: {} is {} already; give the page a file of its own",
                                                         page == "-" ? "standard output" : page, option));
  };
  refuse("the input", arguments.input, false);
  refuse("--output", arguments.output, true);
  refuse("--report", arguments.report, true);
  refuse("--constraints", arguments.rules, false);
  refuse("--region", arguments.region, false);
  for (const auto& [option, path] : others) refuse(option, path, true);
}

Constraints make_constraints(const FairingArguments& arguments, const PolygonMesh& mesh, const RuleInput& input) {
  return constraints_of(arguments, mesh, input);
}

Constraints make_constraints(const FairingArguments& arguments, const PolygonCurve& curve, const RuleInput& input) {
  return constraints_of(arguments, curve, input);
}

Fairing::Fairing(const FairingArguments& arguments)
    : arguments_(&arguments),
      errors_(2, arguments.colour),
      messages_(arguments.output == "-" || arguments.html == "-" ? 2 : 1, arguments.colour),
      cancelling_(context_),
      bar_(errors_) {
  context_.threads = arguments.threads;
  if (!arguments.quiet) context_.on_progress = [this](const Progress& progress) { bar_.show(progress); };
}

int Fairing::finish(const FairReport& report, const std::vector<Vector3>& before, std::vector<std::string> warnings,
                    const Writers& writers) {
  bar_.clear();
  warnings.insert(warnings.end(), report.warnings.begin(), report.warnings.end());
  nlohmann::ordered_json json;
  {
    const UninterruptedWhileWriting guard;
    for (std::string& warning : writers.shape()) warnings.push_back(std::move(warning));
    json = to_json(report);
    json["warnings"] = warnings;
    json["input"] = arguments_->input;
    json["output"] = arguments_->output;
    if (!arguments_->report.empty()) write_file(arguments_->report, json.dump(2) + "\n");
  }
  const bool complete = arguments_->html.empty() || write_page(json, writers);
  if (!complete) warnings.push_back(arguments_->html + ": not written, as the run was interrupted");
  for (const std::string& warning : warnings) (void)errors_.write(errors_.yellow("warning: ") + warning + "\n");
  if (!arguments_->quiet && !messages_.write(summary(report, diagonal_of(before), messages_)))
    throw Error(ErrorCode::unusable_file, "standard output: takes no more; the shape is written nonetheless");
  return complete ? exit_status(report.outcome) : exit_interrupted;
}

bool Fairing::write_page(const nlohmann::ordered_json& report, const Writers& writers) const {
  if (context_.cancelled()) return false;
  const nlohmann::ordered_json scene = writers.scene();
  if (context_.cancelled()) return false;
  const std::string page = html_page("vspring: " + arguments_->input, report, scene);
  if (context_.cancelled()) return false;
  const UninterruptedWhileWriting guard;
  write_file(arguments_->html, page);
  return true;
}

}  // namespace vspring::cli
