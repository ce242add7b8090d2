#pragma once

#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "fairing_arguments.hpp"
#include "figures.hpp"
#include "idle_options.hpp"
#include "interruption.hpp"
#include "outputs.hpp"
#include "terminal.hpp"
#include "vspring/context.hpp"
#include "vspring/fair.hpp"
#include "vspring/rules.hpp"
#include "vspring/scalar_file.hpp"
#include "welding.hpp"

namespace vspring::cli {

/// One run of a command that fairs a shape: Ctrl-C, progress, outputs and messages. Make it before reading the input.
class Fairing {
 public:
  explicit Fairing(const FairingArguments& arguments);

  /// Call it when the input is read: from then on an interrupted run has a shape to save.
  void input_is_read() noexcept { cancelling_.input_is_read(); }

  /// The context for calls of this run.
  [[nodiscard]] Context& context() noexcept { return context_; }

  /// A shape before and after, and its constraints.
  template <typename Shape>
  struct Faired {
    const Shape& before;
    const Shape& after;
    const Constraints& constraints;
    const FairReport& report;
  };

  /// Parts that the command provides.
  struct Made {
    /// Writes the shape and returns warnings.
    std::function<std::vector<std::string>()> write;
    /// Titles and other parts of what is shown, except the shapes.
    std::function<std::string()> picture;
    std::span<const Vector3> points = {};
    std::function<std::vector<NodeScalar>()> scalars = {};
    const Welding* welding = nullptr;
    /// Figures that the command adds to the report.
    nlohmann::ordered_json figures = nlohmann::ordered_json::object();
    /// Lines that it adds to the summary.
    std::string lines = {};
    /// Facts that only it knows.
    RunFacts facts = {};
  };

  /// Writes the files and the summary, and returns the exit status. An interrupted run writes no page, picture or
  /// scalars, as they take long; its report has the figures of measure() only, and none of a very large shape.
  template <typename Shape>
  int finish(const Faired<Shape>& faired, std::vector<std::string> warnings, const Made& made);

 private:
  /// Measures both shapes, under one progress bar; useless when cancelled.
  template <typename Shape>
  void measure(std::array<ShownShape<Shape>, 2>& shapes, const Constraints& constraints);

  const FairingArguments* arguments_;
  // The summary goes to standard output unless the shape itself does.
  Terminal errors_;
  Terminal messages_;
  Context context_;
  CancelOnSignal cancelling_;
  TimeLimit time_limit_;
  ProgressBar bar_;
  double progress_begin_ = 0;  ///< where the present call begins on the progress bar
  double progress_share_ = 1;
};

}  // namespace vspring::cli
