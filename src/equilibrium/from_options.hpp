#pragma once

#include <memory>
#include <span>

#include "base/threads.hpp"
#include "equilibrium/hierarchy.hpp"
#include "spring/model.hpp"
#include "vspring/fair.hpp"

namespace vspring {

// Model, distribution and levels by the options, for the net of a surface or of a curve.

/// points: that draw the shape, in its coordinates.
std::unique_ptr<const Model> model_of(const Net& net, const FairOptions& options, std::span<const Vector3> points = {});
/// The one given, or else the default.
Distribution distribution_of(const Net& net, const FairOptions& options);
/// Cost: linear.
std::unique_ptr<Hierarchy> hierarchy_of(Net net, const Model& model, Distribution distribution, ThreadTeam& team);

}  // namespace vspring
