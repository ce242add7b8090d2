#pragma once

#include <functional>
#include <string>
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

  /// Writes the files, says what happened, and returns the exit status. before: the nodes of the input. `write` writes
  /// all but the report, and returns warnings.
  int finish(const FairReport& report, const std::vector<Vector3>& before, std::vector<std::string> warnings,
             const std::function<std::vector<std::string>()>& write);

 private:
  const FairingArguments* arguments_;
  // What people read goes to standard output unless the shape itself goes there.
  Terminal errors_;
  Terminal messages_;
  Context context_;
  CancelOnSignal cancelling_;
  ProgressBar bar_;
};

/// What --fix, --fix-normals, --constraints and --region say, in this order. input.groups must not be null.
[[nodiscard]] Constraints make_constraints(const FairingArguments& arguments, const PolygonMesh& mesh,
                                           const RuleInput& input);
[[nodiscard]] Constraints make_constraints(const FairingArguments& arguments, const PolygonCurve& curve,
                                           const RuleInput& input);

}  // namespace vspring::cli
