#pragma once

#include <vector>

#include "base/threads.hpp"
#include "linear/banded_qr.hpp"
#include "precondition/point_stiffness.hpp"
#include "precondition/preconditioner.hpp"
#include "spring/net.hpp"

namespace vspring {

/// For curves. Where slopes are small, with K the second difference and W_i = Σ 1/ℓ³, the V-Spring displacement with
/// the circle's tangent is exactly −½ W⁻¹ Gᵀ G y, G y the curvatures √(h/4) κ, κ_i = (2/h_i) (Δy₊/ℓ₊ − Δy₋/ℓ₋) over the
/// length h_i = ℓ₋ + ℓ₊: whatever the spacing. A node with a given direction has a curvature on each side; an end
/// without has none. Points with the stiffness S_i add −S y, a row √(2 W_i S_i) of G. Along the curve, the
/// regularisation is the second difference with the net's shares. A closed curve of which no node is held slides along
/// itself: its first node stays, and what the others do evens out the edges beside it too.
class CurvePreconditioner final : public Preconditioner {
 public:
  explicit CurvePreconditioner(const Net& net) : net_(&net) {}

  bool refresh(const Model& model) override;
  /// Hardly more than the rest.
  [[nodiscard]] double work_of_building() const override { return 0; }
  void correct(const Model& model, double enough, std::vector<Vector3>& correction) override;

 private:
  /// The moving nodes of one run.
  struct Run {
    std::size_t begin;
    BandedQr bending;
  };
  void weigh();
  void build_bending(const MovingRun& moving_run);
  /// A closed run without a held node.
  [[nodiscard]] bool free(const MovingRun& moving_run) const;
  void build_spreading();
  void carry_frames();
  /// Spreads over a free run the turn by which its frames miss each other once around.
  void close_frames(const MovingRun& moving_run);
  const Net* net_;
  ThreadTeam alone_{1};
  PointStiffness stiffness_;
  std::vector<Run> runs_;
  /// 2 W of every moving node by the lengths that its edges have now: then the forces along a run are differences of
  /// what passes between neighbours, and what is rough in them leaves no trace in long waves.
  std::vector<double> weight_;
  std::vector<double> built_weight_;  // and by those when all was built
  // The elimination of the second differences along the curve: what node i takes of node i − 1, and leaves to i + 1.
  std::vector<double> below_;
  std::vector<double> above_;
  std::vector<double> pivot_;
  std::vector<std::uint8_t> slides_;  // 0 for the node that stays
  std::vector<NodeForce> forces_;
  std::vector<Vector3> axis_;            // the frame's first axis across the curve at every node
  std::vector<Eigen::Vector2d> across_;  // the correction in that frame
};

}  // namespace vspring
