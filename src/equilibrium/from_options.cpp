#include "equilibrium/from_options.hpp"

#include <optional>
#include <utility>

#include "equilibrium/surface_hierarchy.hpp"
#include "levels/levels.hpp"
#include "precondition/curve_preconditioner.hpp"

namespace vspring {

namespace {

/// The levels of a curve.
class CurveHierarchy final : public Hierarchy {
 public:
  using Hierarchy::Hierarchy;

  /// There are none with fewer than are of use.
  [[nodiscard]] std::size_t fewest_nodes() const override { return 0; }
  void prolong_from(std::size_t level) override { prolong_curve(levels_[level], levels_[level + 1]); }
  // Levels are made with the start, averaged.
  void start() override { untangle(net(0)); }
  void start_from_membrane(std::size_t level) override { start_from_chords(net(level)); }
  Preconditioner& preconditioner(std::size_t level) override { return preconditioner_.emplace(net(level)); }

 private:
  std::optional<CurvePreconditioner> preconditioner_;
};

}  // namespace

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
