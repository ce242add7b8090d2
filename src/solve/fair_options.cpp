#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <variant>

#include "vspring/error.hpp"
#include "vspring/fair.hpp"

namespace vspring {

namespace {

void require(bool holds, const char* option, const char* range, double value) {
  if (!holds) throw Error(ErrorCode::invalid_argument, fmt::format("{} must be {}, not {}", option, range, value));
}

void check_positive(const char* option, double value) {
  require(value > 0 && std::isfinite(value), option, "greater than 0", value);
}

void check_limit(int max_iterations) {
  require(max_iterations >= 0, "maximum of iterations", "0 or more", max_iterations);
}

constexpr const char* name_of_step_tolerance = "step tolerance";

void check(const EquilibriumMethod& method) {
  check_positive("tolerance", method.tolerance);
  check_limit(method.max_iterations.value_or(0));
}

void check(const MultigridMethod& method) {
  check_positive(name_of_step_tolerance, method.step_tolerance);
  check_limit(method.max_iterations);
  require(method.levels.value_or(1) >= 1, "number of levels", "1 or more", method.levels.value_or(1));
  require(method.pre_smoothing >= 0, "pre-smoothing", "0 or more", method.pre_smoothing);
}

void check(const SweepMethod& method) {
  check_positive(name_of_step_tolerance, method.step_tolerance);
  check_limit(method.max_iterations);
}

}  // namespace

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

const char* name(Continuity continuity) noexcept {
  return continuity == Continuity::curvature ? "curvature" : "tangent";
}

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

std::optional<int> FairOptions::max_iterations() const {
  return std::visit([](const auto& one) { return std::optional<int>(one.max_iterations); }, method);
}

void FairOptions::validate() const {
  const auto check_one = [](const auto& one) { check(one); };
  std::visit(check_one, method);
  if (fair_boundary) std::visit(check_one, *fair_boundary);
  require(strength >= 0 && strength <= 1, "strength", "from 0 to 1", strength);
  if (continuity == Continuity::curvature && method_kind() != Method::equilibrium)
    throw Error(ErrorCode::invalid_argument, fmt::format("a shape meets the curvature of what is around it by the "
                                                         "method equilibrium only, not by {}",
                                                         name(method_kind())));
}

}  // namespace vspring
