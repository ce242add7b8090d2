#pragma once

#include <optional>
#include <variant>

#include "equilibrium/hierarchy.hpp"
#include "equilibrium/point_levels.hpp"
#include "equilibrium/solver_call.hpp"
#include "precondition/anderson.hpp"
#include "spring/model.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// How an equilibrium is looked for.
struct SearchTask {
  EquilibriumMethod method;
  std::optional<Distribution> distribution;  ///< as in FairOptions
};

/// The task by the options of a shape whose method is EquilibriumMethod.
inline SearchTask search_task(const FairOptions& options) {
  return {std::get<EquilibriumMethod>(options.method), options.distribution};
}

/// Whether so little holds it that spheres of many sizes are fair: then there is a family of equilibria, and steps
/// towards a single one do not converge.
bool is_underconstrained(const Net& net);

/// Coarse levels first, each to its equilibrium, each the start of the next finer one; none of them where the shape is
/// at its equilibrium already. Fills outcome, iterations, levels, residual, expected error and history. points:
/// of the levels, if any.
void run_equilibrium(Hierarchy& hierarchy, const Model& model, const SearchTask& task, const SolverCall& call,
                     PointLevels* points = nullptr);

/// The same from a shape near its equilibrium, without coarser levels, with the preconditioner of the shape itself.
/// Ends early if the shape is not near enough. memory, take_last: as in EquilibriumTask.
void run_equilibrium_from_near(Hierarchy& hierarchy, Preconditioner& preconditioner, const Model& model,
                               const EquilibriumMethod& method, const SolverCall& call, PointLevels* points = nullptr,
                               Anderson<float>* memory = nullptr, bool take_last = false);

}  // namespace vspring
