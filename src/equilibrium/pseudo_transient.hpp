#pragma once

#include <cstdint>

#include "equilibrium/equilibrium.hpp"

namespace vspring {

/// near: Newton's steps from the first, which also go to an equilibrium that the flow would leave.
enum class FlowStart : std::uint8_t { anywhere, near };

/// Of one step, in iterations of go_to_equilibrium().
constexpr double work_of_flow_step = 60;

/// Goes to where all displacements of the model vanish along the flow dP/dt = F(P), which the plain iteration follows
/// too: by implicit steps that become longer as F becomes smaller, at last Newton's (pseudo-transient continuation:
/// C. T. Kelley, D. E. Keyes, SIAM J. Numer. Anal. 35(2), 1998). Slow and sure, for shapes of up to some thousand nodes
/// that go_to_equilibrium() does not get near: it knows the whole derivative. Nodes are anywhere on the way where the
/// outcome is not converged. Cost for n nodes: about n^1.5 an iteration, 0.2 s for 2,400.
EquilibriumResult follow_flow(Net& net, const Model& model, const EquilibriumTask& task, FlowStart start,
                              ThreadTeam& team, Context& context);

}  // namespace vspring
