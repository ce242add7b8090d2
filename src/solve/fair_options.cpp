#include <fmt/format.h>

#include <cmath>

#include "vspring/error.hpp"
#include "vspring/fair.hpp"

namespace vspring {

const char* name(Method method) noexcept {
  switch (method) {
    case Method::equilibrium:
      return "equilibrium";
    case Method::multigrid:
      return "multigrid";
    case Method::sweep:
      return "sweep";
  }
  return "";
}

const char* name(Springs springs) noexcept { return springs == Springs::edge ? "edge" : "sphere"; }

const char* name(FairBy fair_by) noexcept { return fair_by == FairBy::bending ? "bending" : "curvature"; }

const char* name(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::converged:
      return "converged";
    case Outcome::iteration_limit:
      return "iteration-limit";
    case Outcome::work_limit:
      return "work-limit";
    case Outcome::worse_than_input:
      return "worse-than-input";
    case Outcome::stalled:
      return "stalled";
    case Outcome::cancelled:
      return "cancelled";
  }
  return "";
}

void FairOptions::validate() const {
  const auto require = [](bool holds, const char* option, const char* range, double value) {
    if (!holds) throw Error(ErrorCode::invalid_argument, fmt::format("{} must be {}, not {}", option, range, value));
  };
  require(tolerance > 0 && std::isfinite(tolerance), "tolerance", "greater than 0", tolerance);
  require(step_tolerance > 0 && std::isfinite(step_tolerance), "step tolerance", "greater than 0", step_tolerance);
  require(max_iterations.value_or(0) >= 0, "maximum of iterations", "0 or more", max_iterations.value_or(0));
  require(levels.value_or(1) >= 1, "number of levels", "1 or more", levels.value_or(1));
  require(pre_smoothing >= 0, "pre-smoothing", "0 or more", pre_smoothing);
  require(strength >= 0 && strength <= 1, "strength", "from 0 to 1", strength);
}

}  // namespace vspring
