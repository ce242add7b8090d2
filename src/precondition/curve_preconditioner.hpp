#pragma once

#include <vector>

#include "base/threads.hpp"
#include "linear/banded_qr.hpp"
#include "precondition/preconditioner.hpp"
#include "spring/net.hpp"

namespace vspring {

/// The preconditioner of curves. With small slopes and W_i = Σ 1/ℓ³, the V-Spring displacement with the circle's
/// tangent is exactly −½ W⁻¹ Gᵀ G y for any spacing. G y are the curvatures √(h/4) κ, κ_i = (2/h_i) (Δy₊/ℓ₊ − Δy₋/ℓ₋),
/// over the length h_i = ℓ₋ + ℓ₊. A node with a given direction has a curvature on each side; an end without has none.
/// Points with the stiffness S_i add −S y, a row √(2 W_i S_i) of G. Along the curve, the regularisation is the second
/// difference with the net's shares. A closed curve without held nodes can slide along itself: its first node stays,
/// and the others even out the edges next to it, too.
class CurvePreconditioner final : public Preconditioner {
 public:
  explicit CurvePreconditioner(const Net& net) : net_(&net) {}

  bool refresh(const Model& model) override;
  /// Hardly more than an iteration.
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
  /// Spreads over a free run the angle by which its frames differ once around.
  void close_frames(const MovingRun& moving_run);
  const Net* net_;
  ThreadTeam alone_{1};
  PointStiffness stiffness_;
  std::vector<Run> runs_;
  /// 2 W of every moving node by the present lengths of its edges: then forces between neighbours cancel, and rough
  /// forces leave no trace in long waves.
  std::vector<double> weight_;
  std::vector<double> built_weight_;  // by the lengths when all was built
  // The elimination of the second differences along the curve: factors of node i from node i − 1 and to node i + 1.
  std::vector<double> below_;
  std::vector<double> above_;
  std::vector<double> pivot_;
  std::vector<std::uint8_t> slides_;  // 0 for the node that stays
  std::vector<NodeForce> forces_;
  std::vector<Vector3> axis_;            // the frame's first axis across the curve at every node
  std::vector<Eigen::Vector2d> across_;  // the correction in that frame
};

}  // namespace vspring
