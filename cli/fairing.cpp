#include "fairing.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <type_traits>
#include <utility>

#include "advice.hpp"
#include "exit_status.hpp"
#include "report.hpp"
#include "vspring/error.hpp"

namespace vspring::cli {

namespace {

// An interrupted run still measures shapes of at most so many nodes.
constexpr Index most_when_interrupted = 200'000;

/// Adds a warning for each option that had no effect.
template <typename Shape>
std::vector<std::string> idle_in(RunFacts facts, const FairingArguments& arguments,
                                 const Fairing::Faired<Shape>& faired) {
  facts.method = faired.report.method;
  facts.levels = faired.report.levels.size();
  look_at(facts, arguments);
  look_at(facts, faired.before, faired.constraints);
  return idle_options(facts);
}

}  // namespace

Fairing::Fairing(const FairingArguments& arguments)
    : arguments_(&arguments),
      errors_(2, arguments.colour),
      messages_(arguments.output == "-" || arguments.html == "-" ? 2 : 1, arguments.colour),
      cancelling_(context_, CancelOnSignal::While::reading),
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
void Fairing::measure(std::array<ShownShape<Shape>, 2>& shapes, const Constraints& constraints) {
  if constexpr (std::is_same_v<Shape, PolygonMesh>) {
    if (!arguments_->shows_shapes()) {
      auto figures = figures_of(shapes[0].shape(), shapes[1].shape(), &constraints, context_);
      for (std::size_t k = 0; k < shapes.size(); ++k) shapes[k].figures = std::move(figures[k]);
      bar_.clear();
      return;
    }
  }
  progress_share_ = 1.0 / static_cast<double>(shapes.size());
  for (std::size_t k = 0; k < shapes.size() && !context_.cancelled(); ++k) {
    progress_begin_ = static_cast<double>(k) * progress_share_;
    shapes[k].figures = figures_of(shapes[k].measured, &constraints, arguments_->shows_shapes(), context_);
  }
  bar_.clear();
}

template <typename Shape>
int Fairing::finish(const Faired<Shape>& faired, std::vector<std::string> warnings, const Made& made) {
  bar_.clear();
  FairReport report = faired.report;
  time_limit_.end(report);
  for (const Warning& warning : report.warnings) warnings.push_back(with_options(warning));
  std::ranges::move(idle_in(made.facts, *arguments_, faired), std::back_inserter(warnings));
  {
    const UninterruptedWhileWriting guard;
    std::ranges::move(made.write(), std::back_inserter(warnings));
  }
  const bool is_reported = !arguments_->report.empty() || !arguments_->html.empty();
  std::array<ShownShape<Shape>, 2> shapes = {
      {{{"before", {}}, MeasuredShape(faired.before)}, {{"after", {}}, MeasuredShape(faired.after)}}};
  if (is_reported && !context_.cancelled()) measure(shapes, faired.constraints);
  const bool is_measured = is_reported && !context_.cancelled();
  std::optional<BeforeAndAfter> fairness;
  if (is_measured)
    fairness = fairness_of(shapes[0].figures, shapes[1].figures);
  else if ((is_reported || !arguments_->quiet) && !(context_.cancelled() && report.nodes > most_when_interrupted))
    fairness = fairness_of(faired.before, faired.after, faired.constraints, context_);
  nlohmann::ordered_json json;
  if (is_reported) {
    json = to_json(report);
    const nlohmann::ordered_json none = nlohmann::ordered_json::object();
    json["fairness"] = fairness ? to_json(*fairness) : nlohmann::ordered_json({{"before", none}, {"after", none}});
    if constexpr (std::is_same_v<Shape, PolygonMesh>) {
      if (report.boundary)
        json["boundary"]["fairness"] = to_json(fairness_of_boundary(faired.before, faired.after, faired.constraints));
    }
    json["warnings"] = warnings;
    json["input"] = arguments_->input;
    json["output"] = arguments_->output;
    json.update(made.figures);
    if (is_measured) {
      // Not assigned as a list: clang 14 would not destroy the replaced value.
      nlohmann::ordered_json figures = {{"before", values_of(shapes[0].figures)},
                                        {"after", values_of(shapes[1].figures)}};
      json["fairness"].swap(figures);
    }
  }
  if (!arguments_->report.empty()) write_uninterrupted(arguments_->report, json.dump(2) + "\n");
  const Shown<Shape> shown = {.shapes = shapes,
                              .leading = 1,
                              .reference = 0,
                              .points = made.points,
                              .picture = made.picture,
                              .scalars = made.scalars,
                              .welding = made.welding};
  const std::string missing = write_views(*arguments_, shown, json, context_);
  if (!missing.empty()) warnings.push_back(not_written(missing));
  errors_.warn(warnings);
  if (!arguments_->quiet &&
      !messages_.write(
          summary(report, fairness, size_of_moving(faired.before, faired.constraints), arguments_->options, messages_) +
          made.lines))
    throw Error(ErrorCode::unusable_file, "standard output: takes no more; the shape is written");
  return context_.cancelled() ? exit_interrupted : exit_status(report);
}

template int Fairing::finish(const Faired<PolygonMesh>&, std::vector<std::string>, const Made&);
template int Fairing::finish(const Faired<PolygonCurve>&, std::vector<std::string>, const Made&);

}  // namespace vspring::cli
