#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "vspring/export.hpp"
#include "vspring/fair.hpp"

namespace VSPRING_API vspring {

/// Fairs one shape again and again while its constraints move, as in an editor. For surfaces it keeps levels, equations
/// and their factors between calls, and each call starts from the last shape. Curves are faired anew each time, with
/// the bits of vspring::fair(): 2 ms for 1,000 nodes. See docs/solver.md.
class FairingSession {
 public:
  /// A session for a surface. threads: for every call, in place of Context::threads; 0: all cores. Throws
  /// Error(invalid_argument) for options out of range, and what as_sharp_edges() throws.
  explicit FairingSession(const PolygonMesh& mesh, const FairOptions& options = {}, int threads = 0);
  /// A session for a curve; each call uses the threads of its context. Throws Error(invalid_argument) for options out
  /// of range.
  explicit FairingSession(PolygonCurve curve, const FairOptions& options = {});
  ~FairingSession();
  /// The source can only be assigned to or destroyed then.
  FairingSession(FairingSession&&) noexcept;
  /// Likewise.
  FairingSession& operator=(FairingSession&&) noexcept;
  FairingSession(const FairingSession&) = delete;
  FairingSession& operator=(const FairingSession&) = delete;

  /// Fairs under `constraints`. The result is that of vspring::fair() within the expected error, not to the bit.
  ///
  /// The call starts from the last shape, and costs a few iterations, if the last call found an equilibrium and the
  /// constraints hold the same nodes as then, at other positions or with other normals. If the constraints keep moving
  /// as before, it starts from the shape extrapolated. A cancelled call leaves the session unchanged.
  ///
  /// Otherwise it does and costs what vspring::fair() does: also after an update() that found no equilibrium or a shape
  /// worse than the input, with methods other than equilibrium, and with options.fair_boundary or sharp_edges. Throws
  /// what vspring::fair() throws.
  [[nodiscard]] FairResult fair(const Constraints& constraints, Context& context);
  /// Likewise, without progress.
  [[nodiscard]] FairResult fair(const Constraints& constraints);

  /// Fairs for a picture during a drag. tolerance: in place of EquilibriumMethod::tolerance, likewise a share of the
  /// diagonal. For surfaces the report lacks moves and counts of held nodes.
  ///
  /// If it cannot start from the last shape, it makes at most 40 iterations on each level. A shape worse than the input
  /// is returned with Outcome::worse_than_input; the next fair() looks for a better one. Cost: one or two iterations
  /// while the constraints move steadily, each linear in the moving nodes. Throws what fair() throws, and
  /// Error(invalid_argument) for a tolerance out of range.
  [[nodiscard]] FairResult update(const Constraints& constraints, double tolerance, Context& context);

  /// Predicts the positions that update() would return, one per node, for a first picture of a large shape. At the
  /// beginning of a drag a node may be off by two tenths of its way. The session does not change. Empty for curves, and
  /// if update() would not start from the last shape. Cost: at most about one iteration.
  [[nodiscard]] std::optional<std::vector<Vector3>> predict(const Constraints& constraints, double tolerance);

 private:
  class Session;
  class SurfaceSession;
  class CurveSession;
  std::unique_ptr<Session> session_;
};

}  // namespace vspring
