#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "vspring/fair.hpp"

namespace vspring {

/// A shape on its way.
struct FairPreview {
  std::vector<Vector3> positions;
  double correction =
      0;  ///< the largest distance that a node was corrected by, as a share of the diagonal of what moves
};

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
  /// elsewhere or with other normals, and that one found an equilibrium, this one starts from there: then it costs a
  /// few iterations. The shape is the same within the expected error, not to the bit. Where there is none to be
  /// found the best shape stays, and the outcome says so. Otherwise, and always with other
  /// methods than the equilibrium's and with options.fair_boundary, it costs what fair() costs. report.before is that
  /// of the mesh.
  [[nodiscard]] FairResult fair(const Constraints& constraints, Context& context);
  [[nodiscard]] FairResult fair(const Constraints& constraints);

  /// A look at the shape of these constraints between two calls of fair(), for the frames of a drag: the last shape
  /// follows the held nodes and is corrected once, nothing is measured, and the next call starts from there. Each look
  /// corrects what the one before left, so that a slow drag stays near the equilibrium. Takes half the time of fair()
  /// where that starts from the last shape. Nothing where that would fair anew, and where a node was to be corrected by
  /// 0.05 % of the diagonal or more: then fair() is due. Nodes and normals must be finite.
  [[nodiscard]] std::optional<FairPreview> preview(const Constraints& constraints);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vspring
