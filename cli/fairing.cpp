#include "fairing.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <type_traits>
#include <utility>

#include "advice.hpp"
#include "exit_status.hpp"
#include "figures.hpp"
#include "html_page.hpp"
#include "page_scene.hpp"
#include "report.hpp"
#include "scalars.hpp"
#include "stream_names.hpp"
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

/// With the nodes that are one with some of the region, and those that belong to no face any more, which stay anyway.
std::vector<Index> whole_region(const std::vector<Index>& region, const Welded& welded) {
  const auto first = [&](std::size_t node) { return static_cast<std::size_t>(welded.representative[node]); };
  std::vector<std::uint8_t> inside(welded.representative.size(), 0);
  for (const Index node : region) inside[first(static_cast<std::size_t>(node))] = 1;
  std::vector<Index> whole;
  for (std::size_t node = 0; node < inside.size(); ++node) {
    if (inside[first(node)] != 0 || first(node) != node) whole.push_back(static_cast<Index>(node));
  }
  return whole;
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
    auto region = select_region(shape.positions(), parse_region(arguments.region), *input.groups);
    if (input.welded != nullptr) region = whole_region(region, *input.welded);
    restrict_boundary(constraints, shape, region, arguments);
    restrict_to_region(constraints, shape, region);
  }
  return constraints;
}

}  // namespace

void refuse_views(const FairingArguments& arguments, bool curve) {
  refuse_picture(arguments.picture, curve);
  refuse_scalars(arguments.scalars, curve);
}

void check_outputs(const FairingArguments& arguments, const std::vector<std::pair<std::string, std::string>>& others) {
  std::vector<std::pair<std::string, std::string>> taken = others;
  taken.insert(taken.end(), {{"--output", arguments.output},
                             {"--report", arguments.report},
                             {"--constraints", arguments.rules},
                             {"--region", arguments.region}});
  const std::pair<std::string, std::string> views[] = {{"--scalars", arguments.scalars},
                                                       {"--picture", arguments.picture.path},
                                                       {"--html", arguments.html},
                                                       {"--deviation", arguments.deviation}};
  for (const auto& view : views) {
    const std::string& path = view.second;
    if (path.empty()) continue;
    const auto refuse = [&](const std::string& other) {
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("{}: {} is {} already; give it a file of its own", view.first, output_name(path), other));
    };
    // Of standard streams, only two outputs are one.
    if (path == arguments.input && path != "-") refuse("the input");
    for (const auto& [option, file] : taken) {
      if (path == file) refuse(option);
    }
    taken.push_back(view);
    check_writable(path);
  }
  for (const std::string& path : {arguments.output, arguments.report}) {
    if (!path.empty()) check_writable(path);
  }
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
      time_limit_(context_, arguments.time_limit),
      bar_(errors_) {
  context_.threads = arguments.threads;
  if (arguments.quiet) return;
  context_.on_progress = [this](Progress progress) {
    progress.fraction = progress_begin_ + progress_share_ * progress.fraction;
    bar_.show(progress);
  };
}

template <typename Shape>
Fairing::FigurePair Fairing::measured(MeasuredPair<Shape>& shapes, const Constraints& constraints) {
  const bool shown = arguments_->shows_shapes();
  progress_share_ = 0.5;
  FigurePair figures;
  figures[0] = figures_of(shapes[0], &constraints, shown, context_);
  progress_begin_ = 0.5;
  if (!context_.cancelled()) figures[1] = figures_of(shapes[1], &constraints, shown, context_);
  bar_.clear();
  return figures;
}

template <typename Shape>
int Fairing::finish(const Faired<Shape>& faired, const std::vector<Vector3>& input, std::vector<std::string> warnings,
                    const Writers& writers) {
  bar_.clear();
  FairReport report = faired.report;
  time_limit_.end(report);
  for (const Warning& warning : report.warnings) warnings.push_back(with_options(warning.text));
  RunFacts facts = writers.facts;
  facts.method = report.method;
  facts.levels = report.levels.size();
  look_at(facts, *arguments_);
  look_at(facts, faired.before, faired.constraints);
  std::ranges::move(idle_options(facts), std::back_inserter(warnings));
  {
    const UninterruptedWhileWriting guard;
    for (std::string& warning : writers.shape()) warnings.push_back(std::move(warning));
  }
  const bool is_reported = !(arguments_->report.empty() && arguments_->html.empty());
  nlohmann::ordered_json json;
  if (is_reported) {
    json = to_json(report);
    json["warnings"] = warnings;
    json["input"] = arguments_->input;
    json["output"] = arguments_->output;
    json.update(writers.figures);
  }
  MeasuredPair<Shape> shapes = {MeasuredShape(faired.before), MeasuredShape(faired.after)};
  FigurePair figures;
  if (!context_.cancelled() && is_reported) {
    figures = measured(shapes, faired.constraints);
    if (!context_.cancelled()) {
      // Not assigned as a list: clang 14 does not destroy what such an assignment replaces.
      nlohmann::ordered_json fairness = {{"before", values_of(figures[0])}, {"after", values_of(figures[1])}};
      json["fairness"].swap(fairness);
    }
  }
  if (!arguments_->report.empty()) {
    const UninterruptedWhileWriting guard;
    write_file(arguments_->report, json.dump(2) + "\n");
  }
  const std::string missing = write_views(shapes, figures, json, writers);
  if (!missing.empty()) warnings.push_back(output_name(missing) + ": not written, as the run was interrupted");
  errors_.warn(warnings);
  if (!arguments_->quiet &&
      !messages_.write(summary(report, diagonal_of(input), arguments_->options, messages_) + writers.lines))
    throw Error(ErrorCode::unusable_file, "standard output: takes no more; the shape is written nonetheless");
  return context_.cancelled() ? exit_interrupted : exit_status(report.outcome);
}

template <typename Shape>
std::string Fairing::write_views(MeasuredPair<Shape>& shapes, const FigurePair& figures,
                                 const nlohmann::ordered_json& report, const Writers& writers) const {
  constexpr bool surface = std::is_same_v<Shape, PolygonMesh>;
  const std::string title = "vspring: " + input_name(arguments_->input);
  const PictureArguments& picture = arguments_->picture;
  nlohmann::ordered_json scene;
  if (!context_.cancelled() && (!arguments_->html.empty() || (surface && !picture.path.empty()))) {
    const PageShape<Shape> both[] = {{"before", &shapes[0], figures[0]}, {"after", &shapes[1], figures[1]}};
    const bool deviation = !arguments_->html.empty() || picture.shows("deviation");
    const PageRoles roles = {
        .leading = 1, .reference = 0, .deviation = deviation, .view = picture.view, .points = writers.points};
    scene = scene_of(both, roles, context_);
  }
  // What an interrupted call made is of no use.
  const auto write = [&](const std::string& path, const auto& bytes_of) {
    if (path.empty()) return true;
    if (context_.cancelled()) return false;
    const std::string bytes = bytes_of();
    if (context_.cancelled()) return false;
    const UninterruptedWhileWriting guard;
    write_file(path, bytes);
    return true;
  };
  if (!write(arguments_->html, [&] { return html_page(title, report, scene); })) return arguments_->html;
  if (!write(picture.path, [&] {
        return surface ? surface_picture(picture, title, scene, context_)
                       : curve_picture(picture, writers.picture(), context_);
      }))
    return picture.path;
  if (arguments_->scalars.empty()) return {};
  if (context_.cancelled()) return arguments_->scalars;
  std::vector<NodeScalar> scalars = scalars_of(shapes[1], &shapes[0], context_);
  if (writers.scalars) std::ranges::move(writers.scalars(), std::back_inserter(scalars));
  if (context_.cancelled()) return arguments_->scalars;
  const UninterruptedWhileWriting guard;
  if (writers.welding != nullptr)
    writers.welding->write_scalars(arguments_->scalars, shapes[1].shape(), std::move(scalars));
  else
    write_scalars(arguments_->scalars, shapes[1].shape(), scalars);
  return {};
}

template int Fairing::finish(const Faired<PolygonMesh>&, const std::vector<Vector3>&, std::vector<std::string>,
                             const Writers&);
template int Fairing::finish(const Faired<PolygonCurve>&, const std::vector<Vector3>&, std::vector<std::string>,
                             const Writers&);

}  // namespace vspring::cli
