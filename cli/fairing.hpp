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

/// One run of a command that fairs a shape: Ctrl-C, progress, what is written and what is said. Make it before the
/// input is read.
class Fairing {
 public:
  explicit Fairing(const FairingArguments& arguments);

  /// From here on there is a shape to save when the run is interrupted.
  void input_is_read() noexcept { cancelling_.input_is_read(); }

  /// For the calls that this run makes.
  [[nodiscard]] Context& context() noexcept { return context_; }

  /// A shape before and after, and what held it.
  template <typename Shape>
  struct Faired {
    const Shape& before;
    const Shape& after;
    const Constraints& constraints;
    const FairReport& report;
  };

  /// What the command itself makes.
  struct Made {
    /// Writes the shape and returns warnings.
    std::function<std::vector<std::string>()> write;
    /// Of what is shown, all but the shapes.
    std::function<std::string()> picture;
    std::span<const Vector3> points = {};
    std::function<std::vector<NodeScalar>()> scalars = {};
    const Welding* welding = nullptr;
    /// What the command adds to the report.
    nlohmann::ordered_json figures = nlohmann::ordered_json::object();
    /// What it adds to what people read, in lines.
    std::string lines = {};
    /// What it alone knows.
    RunFacts facts = {};
  };

  /// Writes the files, says what happened, and returns the exit status. A run that was interrupted gets no page, no
  /// picture and no scalars, and its report only the figures of measure(), of a very large shape none: they would take
  /// long.
  template <typename Shape>
  int finish(const Faired<Shape>& faired, std::vector<std::string> warnings, const Made& made);

 private:
  /// Gives both shapes their figures, as one bar shows it; of no use once cancelled.
  template <typename Shape>
  void measure(std::array<ShownShape<Shape>, 2>& shapes, const Constraints& constraints);

  const FairingArguments* arguments_;
  // What people read goes to standard output unless the shape itself goes there.
  Terminal errors_;
  Terminal messages_;
  Context context_;
  CancelOnSignal cancelling_;
  TimeLimit time_limit_;
  ProgressBar bar_;
  double progress_begin_ = 0;  ///< of the call among those that one bar shows
  double progress_share_ = 1;
};

}  // namespace vspring::cli
