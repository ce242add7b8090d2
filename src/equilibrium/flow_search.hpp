#pragma once

#include "checks/start_places.hpp"
#include "equilibrium/hierarchy.hpp"
#include "equilibrium/relaxation.hpp"
#include "equilibrium/solver_call.hpp"
#include "spring/model.hpp"

namespace vspring {

/// Corrections that take a surface for flat and even may lead nowhere where it has folds. The flow of the plain
/// iteration, with all that it depends on, may lead somewhere: from the shape that was reached, from where some sweeps
/// take the start, from a soap film, from the start itself or from where very many sweeps take it. The first
/// equilibrium that is found stays, else the shape that was reached.
void search_along_flow(Relaxation& relaxation, Hierarchy& hierarchy, const Model& model, const StartPlaces& start,
                       const SolverCall& call);

}  // namespace vspring
