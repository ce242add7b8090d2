#pragma once

#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fairing_arguments.hpp"
#include "idle_options.hpp"
#include "measured_shape.hpp"
#include "progress_bar.hpp"
#include "signals.hpp"
#include "terminal.hpp"
#include "time_limit.hpp"
#include "vspring/context.hpp"
#include "vspring/fair.hpp"
#include "vspring/figures.hpp"
#include "vspring/rules.hpp"
#include "vspring/scalar_file.hpp"
#include "welding.hpp"

namespace vspring::cli {

/// One run of a command that fairs a shape: Ctrl-C, progress, what is written and what is said. Make it before the
/// input is read.
class Fairing {
 public:
  explicit Fairing(const FairingArguments& arguments);

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
  struct Writers {
    /// Writes the shape and returns warnings.
    std::function<std::vector<std::string>()> shape;
    /// Curves: the picture as SVG; asked for with --picture.
    std::function<std::string()> picture;
    /// Shown with surfaces in page and picture.
    std::span<const Vector3> points = {};
    /// What the command adds to --scalars.
    std::function<std::vector<NodeScalar>()> scalars = {};
    /// Of surfaces: what the shape has become of the file's.
    const Welding* welding = nullptr;
    /// What the command adds to the report.
    nlohmann::ordered_json figures = nlohmann::ordered_json::object();
    /// What it adds to what people read, in lines.
    std::string lines = {};
    /// What it alone knows.
    RunFacts facts = {};
  };

  /// Writes the files, says what happened, and returns the exit status. input: the nodes that were read. A run that was
  /// interrupted gets no page, no picture and no scalars, and its report only the figures that fair() measures: of a
  /// large shape the others take long.
  template <typename Shape>
  int finish(const Faired<Shape>& faired, const std::vector<Vector3>& input, std::vector<std::string> warnings,
             const Writers& writers);

 private:
  using FigurePair = std::array<std::vector<Figure>, 2>;

  template <typename Shape>
  using MeasuredPair = std::array<MeasuredShape<Shape>, 2>;

  /// Figures before and after; of no use once cancelled.
  template <typename Shape>
  FigurePair measured(MeasuredPair<Shape>& shapes, const Constraints& constraints);
  /// Page, picture and scalars, as far as they are asked for; returns the first that an interruption prevented.
  template <typename Shape>
  [[nodiscard]] std::string write_views(MeasuredPair<Shape>& shapes, const FigurePair& figures,
                                        const nlohmann::ordered_json& report, const Writers& writers) const;

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

/// Throws Error(invalid_argument) where page, picture, scalars or deviations would take the place of an input or of
/// another output, and Error(unusable_file) where an output cannot be written. others: more options with the files they
/// were given.
void check_outputs(const FairingArguments& arguments,
                   const std::vector<std::pair<std::string, std::string>>& others = {});

/// Throws Error where picture or scalars cannot be made, see refuse_picture() and refuse_scalars().
void refuse_views(const FairingArguments& arguments, bool curve);

/// What --fix, --fix-normals, --constraints and --region say, in this order. input.groups must not be null.
[[nodiscard]] Constraints make_constraints(const FairingArguments& arguments, const PolygonMesh& mesh,
                                           const RuleInput& input);
[[nodiscard]] Constraints make_constraints(const FairingArguments& arguments, const PolygonCurve& curve,
                                           const RuleInput& input);

}  // namespace vspring::cli
