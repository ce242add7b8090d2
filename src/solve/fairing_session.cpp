#include "vspring/fairing_session.hpp"

#include <utility>

#include "constraints/immovable_nodes_fixed.hpp"
#include "solve/surface_fairing.hpp"

namespace vspring {

namespace {

/// Somebody waits: no other method is tried where this one finds nothing.
FairOptions of_session(FairOptions options) {
  if (!options.method) options.method = Method::equilibrium;
  return options;
}

}  // namespace

struct FairingSession::State {
  State(PolygonMesh the_mesh, const FairOptions& the_options, int threads)
      : mesh(std::move(the_mesh)), options(of_session(the_options)), fairing(mesh, options, threads), immovable(mesh) {}

  template <typename Fair>
  FairResult with_immovable_held(const Constraints& constraints, const Fair& fair) {
    return immovable.run(
        constraints, fair, [](FairResult & result) -> auto& { return result.report.warnings; });
  }

  PolygonMesh mesh;
  FairOptions options;
  SurfaceFairing fairing;
  ImmovableNodesFixed immovable;
};

FairingSession::FairingSession(PolygonMesh mesh, const FairOptions& options, int threads) {
  options.validate();
  Context context;
  context.threads = threads;
  state_ = std::make_unique<State>(std::move(mesh), options, context.thread_count());
}

FairingSession::~FairingSession() = default;
FairingSession::FairingSession(FairingSession&&) noexcept = default;
FairingSession& FairingSession::operator=(FairingSession&&) noexcept = default;

FairResult FairingSession::fair(const Constraints& constraints, Context& context) {
  if (!state_->options.fair_boundary)
    return state_->with_immovable_held(
        constraints, [&](const Constraints& held) { return state_->fairing.fair_again(held, context); });
  return vspring::fair(state_->mesh, constraints, state_->options, context);
}

FairResult FairingSession::update(const Constraints& constraints, double tolerance, Context& context) {
  FairOptions options = state_->options;
  options.tolerance = tolerance;
  options.validate();
  if (!options.fair_boundary)
    return state_->with_immovable_held(
        constraints, [&](const Constraints& held) { return state_->fairing.fair_again(held, context, tolerance); });
  return vspring::fair(state_->mesh, constraints, options, context);
}

std::optional<std::vector<Vector3>> FairingSession::predict(const Constraints& constraints, double tolerance) {
  FairOptions options = state_->options;
  options.tolerance = tolerance;
  options.validate();
  if (options.fair_boundary) return std::nullopt;
  return state_->immovable.use(constraints,
                               [&](const Constraints& held) { return state_->fairing.predict(held, tolerance); });
}

FairResult FairingSession::fair(const Constraints& constraints) {
  Context context;
  return fair(constraints, context);
}

}  // namespace vspring
