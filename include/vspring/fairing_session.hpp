#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "vspring/fair.hpp"

namespace vspring {

/// Fairs one mesh again and again while somebody moves its constraints: levels, equations and their factors are kept,
/// and each shape starts from the one before.
class FairingSession {
 public:
  /// Throws as fair() does for options out of range. threads: how many work on every call, whatever its context says;
  /// 0: as many as the machine has.
  explicit FairingSession(PolygonMesh mesh, const FairOptions& options = {}, int threads = 0);
  ~FairingSession();
  FairingSession(FairingSession&&) noexcept;
  FairingSession& operator=(FairingSession&&) noexcept;
  FairingSession(const FairingSession&) = delete;
  FairingSession& operator=(const FairingSession&) = delete;

  /// As fair(), with the constraints as they are now. Where they hold the same nodes as at the last call, only
  /// elsewhere or with other normals, and that one found an equilibrium, this one starts from there, and where they go
  /// on much as before from where that leads: then it costs a few iterations. The shape is the same within the expected
  /// error, not to the bit. Where there is none to be found the best shape stays, and the outcome says so. Cancelled
  /// there, the next call starts where this one did. Otherwise, where a picture since the last call led nowhere or to
  /// something worse, and always with other methods than the equilibrium's and with options.fair_boundary, it does and
  /// costs what fair() does. report.before is that of the mesh.
  [[nodiscard]] FairResult fair(const Constraints& constraints, Context& context);
  [[nodiscard]] FairResult fair(const Constraints& constraints);

  /// The same for pictures of a drag: no node is expected to be further from its final place than `tolerance`, in place
  /// of that of the options, and nothing is measured: `before`, `after`, moves and counts of what is held are left out
  /// of the report. Where it cannot go on from the last shape it makes at most 40 iterations on each level; a shape
  /// that is worse than the input is said to be (Outcome::worse_than_input), and fair() looks for a better one. Costs
  /// one or two iterations, each linear in the moving nodes, where constraints go on much as at the last calls. Throws
  /// as fair() does, and for a tolerance out of range.
  [[nodiscard]] FairResult follow(const Constraints& constraints, double tolerance, Context& context);

  /// About where follow() would lead, for a first picture of a large shape: as the last steps went, and for what these
  /// do not tell as if slopes were small, when two tenths of the way may be missing. The session stays as it is. None
  /// where follow() would not start from the last shape. Costs at most about one iteration.
  [[nodiscard]] std::optional<std::vector<Vector3>> foresee(const Constraints& constraints, double tolerance);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vspring
