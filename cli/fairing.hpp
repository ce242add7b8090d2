#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "fairing_options.hpp"
#include "progress_bar.hpp"
#include "signals.hpp"
#include "terminal.hpp"
#include "vspring/context.hpp"
#include "vspring/fair.hpp"

namespace vspring::cli {

/// One run of a command that fairs a shape: Ctrl-C, progress, what is written and what is said. Make it before the
/// input is read.
class Fairing {
 public:
  explicit Fairing(const FairingArguments& arguments);

  /// For the calls that this run makes.
  [[nodiscard]] Context& context() noexcept { return context_; }

  /// What the command itself writes.
  struct Writers {
    /// Writes all but report and page, and returns warnings.
    std::function<std::vector<std::string>()> shape;
    /// The scene of the page, see scene_of(); asked for with --html only. What it returns once the context is cancelled
    /// is not used.
    std::function<nlohmann::ordered_json()> scene;
  };

  /// Writes the files, says what happened, and returns the exit status. before: the nodes of the input. A run that was
  /// interrupted gets no page: it takes long to measure what a large one shows.
  int finish(const FairReport& report, const std::vector<Vector3>& before, std::vector<std::string> warnings,
             const Writers& writers);

 private:
  /// Returns whether the page was written.
  bool write_page(const nlohmann::ordered_json& report, const Writers& writers) const;

  const FairingArguments* arguments_;
  // What people read goes to standard output unless the shape itself goes there.
  Terminal errors_;
  Terminal messages_;
  Context context_;
  CancelOnSignal cancelling_;
  ProgressBar bar_;
};

/// Throws Error(invalid_argument) where the page would take the place of an input or of another output. others: more
/// options with the files they were given.
void refuse_shared_page(const FairingArguments& arguments,
                        const std::vector<std::pair<std::string, std::string>>& others = {});

/// What --fix, --fix-normals, --constraints and --region say, in this order. input.groups must not be null.
[[nodiscard]] Constraints make_constraints(const FairingArguments& arguments, const PolygonMesh& mesh,
                                           const RuleInput& input);
[[nodiscard]] Constraints make_constraints(const FairingArguments& arguments, const PolygonCurve& curve,
                                           const RuleInput& input);

}  // namespace vspring::cli
