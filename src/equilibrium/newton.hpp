#pragma once

#include "equilibrium/equilibrium.hpp"

namespace vspring {

/// Of one step, in iterations of go_to_equilibrium().
constexpr double work_of_newton_step = 60;

/// Goes to where all displacements of the model vanish by Newton's steps, with the whole derivative: to the equilibrium
/// nearby, also one that the plain iteration and go_to_equilibrium() would leave. Steps are so short that no edge turns
/// much. Nodes are anywhere on the way where the outcome is not converged. Cost for n nodes of a curve: linear, for
/// each step.
EquilibriumResult go_by_newton(Net& net, const Model& model, const EquilibriumTask& task, ThreadTeam& team,
                               Context& context);

}  // namespace vspring
