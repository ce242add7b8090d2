#include "equilibrium/from_options.hpp"

#include <utility>

#include "equilibrium/curve_hierarchy.hpp"
#include "equilibrium/surface_hierarchy.hpp"

namespace vspring {

std::unique_ptr<const Model> model_of(const Net& net, const FairOptions& options, std::span<const Vector3> points) {
  if (net.is_curve) return curve_model_for(net, options.curve, options.forces, points);
  return surface_model(options.pseudo_normals, options.forces);
}

Distribution distribution_of(const Net& net, const FairOptions& options) {
  return net.is_curve ? options.distribution.value_or(Distribution::even) : options.distribution_taken();
}

std::unique_ptr<Hierarchy> hierarchy_of(Net net, const Model& model, Distribution distribution, ThreadTeam& team) {
  if (net.is_curve) return std::make_unique<CurveHierarchy>(curve_levels(std::move(net), distribution));
  return std::make_unique<SurfaceHierarchy>(surface_levels(std::move(net), model, distribution, team), team);
}

}  // namespace vspring
