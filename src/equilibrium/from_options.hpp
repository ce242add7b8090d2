#pragma once

#include <memory>

#include "base/threads.hpp"
#include "equilibrium/hierarchy.hpp"
#include "spring/model.hpp"
#include "vspring/fair.hpp"

namespace vspring {

// What options ask for, of a surface's net or of a curve's.

std::unique_ptr<const Model> model_of(const Net& net, const FairOptions& options);
/// The one given, or else the default.
Distribution distribution_of(const Net& net, const FairOptions& options);
/// Cost: linear.
std::unique_ptr<Hierarchy> hierarchy_of(Net net, const Model& model, Distribution distribution, ThreadTeam& team);

}  // namespace vspring
