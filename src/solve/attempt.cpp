#include "solve/attempt.hpp"

#include <fmt/format.h>

#include <optional>

#include "equilibrium/account.hpp"

namespace vspring {

namespace {

// As a share of the diagonal: for smaller tolerances rounding may have the last word, that of single precision in what
// the acceleration remembers, too. Another shape would be had for next to nothing.
constexpr double as_near_as_rounding = 1e-8;
constexpr const char* ways_out = "hold more nodes, or normals, let a smaller region move, or only take its noise off";

const Attempt* best_of(std::span<const Attempt> attempts, bool start_is_sound) {
  for (const Attempt& attempt : attempts) {
    if (attempt.stands()) return &attempt;
  }
  const Attempt& last = attempts.back();
  return last.fault.empty() || (!start_is_sound && !last.is_misplaced) ? &last : nullptr;
}

/// In words, where what was found is not what was asked for; by itself that of springs says nothing. is_second: whether
/// another attempt came first.
std::optional<Warning> difference_from_asked(const Attempt& found, const FairOptions& options, bool is_second) {
  if (options.springs == Springs::sphere && found.springs == Springs::edge) {
    if (options.fair_by == FairBy::bending)
      return Warning{
          WarningCode::other_springs,
          "least bending is for sphere springs, which would not see what is held here: these are edge springs"};
    if (is_second)
      return Warning{WarningCode::other_springs, "sphere springs have no equilibrium here: these are edge springs"};
  }
  if (options.fair_by == FairBy::curvature && found.fair_by == FairBy::bending)
    return Warning{WarningCode::other_fairness,
                   "no shape whose curvature changes evenly was found: this is the nearest of least bending"};
  return std::nullopt;
}

}  // namespace

bool Attempt::is_final() const {
  return stands() || outcome == Outcome::cancelled || (fault.empty() && expected_error < as_near_as_rounding);
}

const Attempt* pick(std::span<const Attempt> attempts, bool start_is_sound, const FairOptions& options,
                    FairReport& report) {
  const Attempt& last = attempts.back();
  const bool was_cancelled = last.outcome == Outcome::cancelled;
  const Attempt* best = options.as_found ? &last : best_of(attempts, start_is_sound);
  const Attempt& told = best ? *best : last;
  report.springs = told.springs;
  report.fair_by = told.fair_by;
  report.outcome = told.outcome;
  report.expected_error = told.expected_error;
  report.residual = told.expected_error;
  if (told.fault.empty()) {
    const bool is_bent_less = attempts.size() > 1 && !told.stands() && !was_cancelled;
    const auto difference = difference_from_asked(told, options, &told != attempts.data());
    if (difference && !is_bent_less) report.warnings.push_back(*difference);
    if (is_bent_less)
      report.warnings.push_back(
          {WarningCode::no_equilibrium, fmt::format("no equilibrium was found: this is the input, bent less, {}; {}",
                                                    distance_from_equilibrium(report), ways_out)});
    return best;
  }
  if (!was_cancelled) report.outcome = Outcome::worse_than_input;
  report.warnings.push_back(
      {WarningCode::worse_than_input,
       best ? "what was found is worse than the input: " + told.fault
            : fmt::format("no equilibrium was found that is no worse than the input ({}): this is the input with its "
                          "constraints; {}",
                          told.fault, ways_out)});
  return best;
}

}  // namespace vspring
