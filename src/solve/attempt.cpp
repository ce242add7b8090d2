#include "solve/attempt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "equilibrium/account.hpp"

namespace vspring {

namespace {

// As a share of the diagonal: for smaller tolerances rounding may have the last word, that of single precision in what
// the acceleration remembers, too. Another shape would be had for next to nothing.
constexpr double as_near_as_rounding = 1e-8;

std::vector<Advice> ways_out() {
  return {{Remedy::rules, "hold more nodes, or normals"},
          {Remedy::region, "let a smaller region move"},
          {Remedy::noise, "only take its noise off"}};
}

const Attempt* best_of(std::span<const Attempt> attempts, const StartShape& start) {
  const Attempt& last = attempts.back();
  if (attempts.size() > 1 && !last.is_final()) {
    const Bent most = start.is_sound ? start.bent : Bent{std::numeric_limits<std::size_t>::max(), 0};
    if (const Attempt* const best = bent_least(attempts, most)) return best;
  } else if (last.fault.empty()) {
    return &last;
  }
  return start.is_sound || last.is_misplaced ? nullptr : &last;
}

/// In words, where what was found is not what was asked for. first: of the attempts; spheres that do not suit say
/// nothing.
std::optional<Warning> difference_from_asked(const Attempt& found, const FairOptions& options, const Attempt& first) {
  if (found.is_even)
    return Warning{WarningCode::other_distribution,
                   "with the spacing of the input no equilibrium was found: nodes go to the mean of their neighbours"};
  if (options.springs == Springs::sphere && found.springs == Springs::edge) {
    if (options.fair_by == FairBy::bending)
      return Warning{
          WarningCode::other_springs,
          "least bending is for sphere springs, which would not see what is held here: these are edge springs"};
    if (first.springs == Springs::sphere)
      return Warning{WarningCode::other_springs, "sphere springs have no equilibrium here: these are edge springs"};
  }
  if (options.fair_by == FairBy::curvature && found.fair_by == FairBy::bending)
    return Warning{
        WarningCode::other_fairness,
        fmt::format("no shape whose curvature changes evenly was found{}: this is the nearest of least bending{}",
                    first.fault.empty() ? "" : " that is no worse than the input (" + first.fault + ")", found.remark)};
  return std::nullopt;
}

}  // namespace

const Attempt* bent_least(std::span<const Attempt> attempts, const Bent& most) {
  const Attempt* best = nullptr;
  for (const Attempt& attempt : attempts) {
    if (!attempt.fault.empty() || !(attempt.bent < most)) continue;
    if (!best || !(best->bent < attempt.bent)) best = &attempt;
  }
  return best;
}

bool Attempt::is_final() const {
  return stands() || outcome == Outcome::cancelled ||
         (fault.empty() && !keeps_folds && expected_error.value_or(1) < as_near_as_rounding);
}

const Attempt* pick(std::span<const Attempt> attempts, const StartShape& start, const FairOptions& options,
                    FairReport& report) {
  const Attempt& last = attempts.back();
  const Attempt* best = options.accept_worse ? &last : best_of(attempts, start);
  const auto worse =
      std::find_if(attempts.begin(), attempts.end(), [](const Attempt& one) { return !one.fault.empty(); });
  const Attempt& told = best ? *best : worse != attempts.end() ? *worse : last;
  report.springs = told.springs;
  report.fair_by = told.fair_by;
  const bool is_in_folds = told.outcome == Outcome::converged && told.keeps_folds;
  report.outcome = last.outcome == Outcome::cancelled ? last.outcome : is_in_folds ? Outcome::stalled : told.outcome;
  report.expected_error = told.expected_error;
  report.residual = told.expected_error.value_or(report.residual);
  if (!told.fault.empty()) {
    if (report.outcome != Outcome::cancelled) report.outcome = Outcome::worse_than_input;
    if (best)
      report.warnings.push_back(
          {WarningCode::worse_than_input, "what was found is worse than the input: " + told.fault});
    else
      report.warnings.push_back(
          {WarningCode::worse_than_input,
           fmt::format("no equilibrium was found that is no worse than the input ({}): this is the input with its "
                       "constraints",
                       told.fault),
           ways_out()});
    return best;
  }
  if (attempts.size() > 1 && !told.is_final()) {
    report.warnings.push_back(
        {WarningCode::no_equilibrium,
         fmt::format("no equilibrium was found{}: this is {}",
                     told.keeps_folds ? " that is not folded, as noise has folded the input" : "",
                     best ? "the shape on the way that is bent least, " + distance_from_equilibrium(report)
                          : "the input with its constraints, which is bent less than all that was found"),
         ways_out()});
    return best;
  }
  const auto difference = difference_from_asked(told, options, attempts.front());
  if (difference) report.warnings.push_back(*difference);
  return best;
}

}  // namespace vspring
