#include "vspring/fairing_session.hpp"

#include <utility>
#include <variant>

#include "constraints/immovable_nodes_fixed.hpp"
#include "constraints/slivers.hpp"
#include "solve/surface_fairing.hpp"

namespace vspring {

namespace {

FairOptions with_tolerance(FairOptions options, double tolerance) {
  // Whatever the method, as for an equilibrium.
  FairOptions{.method = EquilibriumMethod{.tolerance = tolerance}}.validate();
  for (FairingMethod* const one : {&options.method, options.fair_boundary ? &*options.fair_boundary : nullptr}) {
    if (auto* const method = std::get_if<EquilibriumMethod>(one)) method->tolerance = tolerance;
  }
  return options;
}

}  // namespace

class FairingSession::Session {
 public:
  Session() = default;
  virtual ~Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  virtual FairResult fair(const Constraints& constraints, Context& context) = 0;
  virtual FairResult update(const Constraints& constraints, double tolerance, Context& context) = 0;
  virtual std::optional<std::vector<Vector3>> predict(const Constraints& constraints, double tolerance) = 0;
};

class FairingSession::SurfaceSession final : public Session {
 public:
  SurfaceSession(const PolygonMesh& mesh, const FairOptions& options, int threads)
      : slivers_(mesh), threads_(threads), mesh_(mesh), options_(options) {
    start();
  }

  FairResult fair(const Constraints& constraints, Context& context) override {
    if (options_.fair_boundary) return vspring::fair(mesh_, constraints, options_, context);
    leave_slivers_out(constraints);
    return with_immovable_held(constraints,
                               [&](const Constraints& held) { return fairing_->fair_again(held, context); });
  }

  FairResult update(const Constraints& constraints, double tolerance, Context& context) override {
    const FairOptions options = with_tolerance(options_, tolerance);
    if (options.fair_boundary) return vspring::fair(mesh_, constraints, options, context);
    leave_slivers_out(constraints);
    return with_immovable_held(constraints,
                               [&](const Constraints& held) { return fairing_->fair_again(held, context, tolerance); });
  }

  std::optional<std::vector<Vector3>> predict(const Constraints& constraints, double tolerance) override {
    if (with_tolerance(options_, tolerance).fair_boundary) return std::nullopt;
    return immovable_->use(constraints, [&](const Constraints& held) { return fairing_->predict(held, tolerance); });
  }

 private:
  void start() {
    immovable_.emplace(mesh_);
    fairing_.emplace(mesh_, options_, threads_);
  }

  /// Where other ones are held than before, all begins anew.
  void leave_slivers_out(const Constraints& constraints) {
    if (!std::holds_alternative<EquilibriumMethod>(options_.method)) return;
    PolygonMesh without = slivers_.left_out(constraints);
    if (without.has_same_faces(mesh_)) return;
    mesh_ = std::move(without);
    start();
  }

  template <typename Fair>
  FairResult with_immovable_held(const Constraints& constraints, const Fair& fair) {
    return immovable_->run(
        constraints, fair, [](FairResult & result) -> auto& { return result.report.warnings; });
  }

  Slivers slivers_;
  int threads_;
  PolygonMesh mesh_;
  FairOptions options_;
  std::optional<ImmovableNodesFixed> immovable_;
  std::optional<SurfaceFairing> fairing_;
};

class FairingSession::CurveSession final : public Session {
 public:
  CurveSession(PolygonCurve curve, const FairOptions& options) : curve_(std::move(curve)), options_(options) {}

  FairResult fair(const Constraints& constraints, Context& context) override {
    return vspring::fair(curve_, constraints, options_, context);
  }
  FairResult update(const Constraints& constraints, double tolerance, Context& context) override {
    return vspring::fair(curve_, constraints, with_tolerance(options_, tolerance), context);
  }
  std::optional<std::vector<Vector3>> predict(const Constraints& /*constraints*/, double tolerance) override {
    (void)with_tolerance(options_, tolerance);
    return std::nullopt;
  }

 private:
  PolygonCurve curve_;
  FairOptions options_;
};

FairingSession::FairingSession(const PolygonMesh& mesh, const FairOptions& options, int threads) {
  options.validate();
  Context context;
  context.threads = threads;
  session_ = std::make_unique<SurfaceSession>(mesh, options, context.thread_count());
}

FairingSession::FairingSession(PolygonCurve curve, const FairOptions& options) {
  options.validate();
  session_ = std::make_unique<CurveSession>(std::move(curve), options);
}

FairingSession::~FairingSession() = default;
FairingSession::FairingSession(FairingSession&&) noexcept = default;
FairingSession& FairingSession::operator=(FairingSession&&) noexcept = default;

FairResult FairingSession::fair(const Constraints& constraints, Context& context) {
  return session_->fair(constraints, context);
}

FairResult FairingSession::fair(const Constraints& constraints) {
  Context context;
  return fair(constraints, context);
}

FairResult FairingSession::update(const Constraints& constraints, double tolerance, Context& context) {
  return session_->update(constraints, tolerance, context);
}

std::optional<std::vector<Vector3>> FairingSession::predict(const Constraints& constraints, double tolerance) {
  return session_->predict(constraints, tolerance);
}

}  // namespace vspring
