#pragma once

#include "base/threads.hpp"
#include "equilibrium/equilibrium.hpp"
#include "spring/model.hpp"

namespace vspring {

/// Takes a surface with sphere springs towards least bending: by implicit steps along the flow of its springs, each
/// taken only where the bending energy falls and no further edges turn by more than 90°; longer after one that was
/// taken, shorter after one that was not. So it leads from any shape to one that is bent less, whether there is an
/// equilibrium or not. Ends where a full step is shorter than the task's tolerance, or none is taken any more. Nodes
/// spread along the surface on the way. Cost of a step: that of an iteration with a form built anew.
EquilibriumResult descend_bending(Net& net, const Model& model, const EquilibriumTask& task, ThreadTeam& team,
                                  Context& context);

}  // namespace vspring
