#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "vspring/export.hpp"
#include "vspring/fair.hpp"

namespace VSPRING_API vspring {

/// Fairs one shape again and again while its constraints move, as in an editor. Of surfaces, levels, equations and
/// their factors are kept between calls, and each call starts from the last shape. Curves are faired anew each time,
/// with the bits of vspring::fair(), which takes 2 ms for 1,000 nodes. See docs/solver.md.
class FairingSession {
 public:
  /// threads: how many work on every call, whatever its context says; 0: as many as the machine has. Throws
  /// Error(invalid_argument) for options out of range.
  explicit FairingSession(const PolygonMesh& mesh, const FairOptions& options = {}, int threads = 0);
  /// The same for a curve, with the threads of each context.
  explicit FairingSession(PolygonCurve curve, const FairOptions& options = {});
  ~FairingSession();
  FairingSession(FairingSession&&) noexcept;
  FairingSession& operator=(FairingSession&&) noexcept;
  FairingSession(const FairingSession&) = delete;
  FairingSession& operator=(const FairingSession&) = delete;

  /// Fairs under the constraints as they are now. The result is that of vspring::fair() within the expected error, not
  /// to the bit.
  ///
  /// If the last call found an equilibrium, and the constraints hold the same nodes as then, at other positions or with
  /// other normals, the call starts from the last shape and costs a few iterations. If the constraints go on moving as
  /// they did, it starts from where that leads. A call that is cancelled leaves the session where it was.
  ///
  /// Otherwise it does and costs what vspring::fair() does. So it does after an update() that found no equilibrium or a
  /// shape worse than the input, with methods other than equilibrium, and with options.fair_boundary. Throws as
  /// vspring::fair() does.
  [[nodiscard]] FairResult fair(const Constraints& constraints, Context& context);
  [[nodiscard]] FairResult fair(const Constraints& constraints);

  /// Fairs for a picture during a drag, to `tolerance` in place of the options' (the same share of the diagonal).
  /// Of surfaces nothing is measured: moves and counts of what is held are left out of the report.
  ///
  /// If it cannot start from the last shape, it makes at most 40 iterations on each level. A shape worse than the input
  /// is returned with Outcome::worse_than_input; fair() then looks for a better one. Cost: one or two iterations while
  /// the constraints move steadily, each linear in the moving nodes. Throws as fair() does, and Error(invalid_argument)
  /// for a tolerance out of range.
  [[nodiscard]] FairResult update(const Constraints& constraints, double tolerance, Context& context);

  /// Predicts the positions that update() would return, one per node, for a first picture of a large shape. At the
  /// beginning of a drag a node may be two tenths of its way beside its place. The session stays as it is. Empty where
  /// update() would not start from the last shape, and for curves. Cost: at most about one iteration.
  [[nodiscard]] std::optional<std::vector<Vector3>> predict(const Constraints& constraints, double tolerance);

 private:
  class Session;
  class SurfaceSession;
  class CurveSession;
  std::unique_ptr<Session> session_;
};

}  // namespace vspring
