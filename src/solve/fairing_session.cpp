#include "vspring/fairing_session.hpp"

#include <utility>
#include <variant>

#include "constraints/immovable_nodes_fixed.hpp"
#include "constraints/slivers.hpp"
#include "solve/surface_fairing.hpp"
#include "vspring/error.hpp"

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

class [[gnu::visibility("hidden")]] FairingSession::Session {
 public:
  Session() = default;
  virtual ~Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  virtual FairResult fair(const Constraints& constraints, Context& context) = 0;
  virtual FairResult update(const Constraints& constraints, double tolerance, Context& context) = 0;
  virtual std::optional<std::vector<Vector3>> predict(const Constraints& constraints, double tolerance) = 0;
};

class [[gnu::visibility("hidden")]] FairingSession::SurfaceSession final : public Session {
 public:
  SurfaceSession(const PolygonMesh& mesh, const FairOptions& options, int threads)
      : slivers_(mesh), threads_(threads), mesh_(mesh), options_(options), immovable_(mesh), sheets_(mesh) {
    if (!options_.sharp_edges.empty()) (void)as_sharp_edges(mesh, options_.sharp_edges);
    fairing_.emplace(sheets_, options_, threads_);
  }

  FairResult fair(const Constraints& constraints, Context& context) override {
    if (starts_afresh(options_)) return vspring::fair(mesh_, constraints, options_, context);
    return run(constraints, [&](const Constraints& held) { return fairing_->fair_again(held, context); });
  }

  FairResult update(const Constraints& constraints, double tolerance, Context& context) override {
    const FairOptions options = with_tolerance(options_, tolerance);
    if (starts_afresh(options)) return vspring::fair(mesh_, constraints, options, context);
    return run(constraints, [&](const Constraints& held) { return fairing_->fair_again(held, context, tolerance); });
  }

  std::optional<std::vector<Vector3>> predict(const Constraints& constraints, double tolerance) override {
    if (starts_afresh(with_tolerance(options_, tolerance))) return std::nullopt;
    auto positions = immovable_.use(
        constraints, [&](const PolygonMesh&, const Constraints& held) { return fairing_->predict(held, tolerance); });
    if (positions) positions->resize(mesh_.positions().size());
    return positions;
  }

 private:
  /// Lines that are faired by themselves part it into other meshes; curvature at the rim comes after each shape.
  static bool starts_afresh(const FairOptions& options) {
    return options.fair_boundary.has_value() || !options.sharp_edges.empty() ||
           options.continuity == Continuity::curvature;
  }

  template <typename Fair>
  FairResult run(const Constraints& constraints, const Fair& fair) {
    leave_slivers_out(constraints);
    FairResult result = immovable_.run(constraints, [&](const PolygonMesh& sheets, const Constraints& held) {
      start(sheets);
      return fair(held);
    });
    immovable_.join_sheets(constraints, result.positions, result.report);
    return result;
  }

  /// On another mesh than before all begins anew.
  void start(const PolygonMesh& sheets) {
    if (sheets.has_same_faces(sheets_)) return;
    sheets_ = sheets;
    fairing_.emplace(sheets_, options_, threads_);
  }

  void leave_slivers_out(const Constraints& constraints) {
    if (!std::holds_alternative<EquilibriumMethod>(options_.method)) return;
    PolygonMesh without = slivers_.left_out(constraints);
    if (without.has_same_faces(mesh_)) return;
    mesh_ = std::move(without);
    immovable_ = ImmovableNodesFixed(mesh_);
  }

  Slivers slivers_;
  int threads_;
  PolygonMesh mesh_;
  FairOptions options_;
  ImmovableNodesFixed immovable_;
  PolygonMesh sheets_;  ///< what is faired
  std::optional<SurfaceFairing> fairing_;
};

class [[gnu::visibility("hidden")]] FairingSession::CurveSession final : public Session {
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
