#include "vspring/fairing_session.hpp"

#include <utility>

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
      : mesh(std::move(the_mesh)), options(of_session(the_options)), fairing(mesh, options, threads) {}

  PolygonMesh mesh;
  FairOptions options;
  SurfaceFairing fairing;
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
  if (!state_->options.fair_boundary) return state_->fairing.fair_again(constraints, context);
  return vspring::fair(state_->mesh, constraints, state_->options, context);
}

FairResult FairingSession::follow(const Constraints& constraints, double tolerance, Context& context) {
  FairOptions options = state_->options;
  options.tolerance = tolerance;
  options.validate();
  if (!options.fair_boundary) return state_->fairing.fair_again(constraints, context, tolerance);
  return vspring::fair(state_->mesh, constraints, options, context);
}

std::optional<std::vector<Vector3>> FairingSession::foresee(const Constraints& constraints, double tolerance) {
  FairOptions options = state_->options;
  options.tolerance = tolerance;
  options.validate();
  if (options.fair_boundary) return std::nullopt;
  return state_->fairing.foresee(constraints, tolerance);
}

FairResult FairingSession::fair(const Constraints& constraints) {
  Context context;
  return fair(constraints, context);
}

}  // namespace vspring
