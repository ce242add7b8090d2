#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "solve/linear_solver.hpp"
#include "solve/multigrid_solver.hpp"
#include "solve/preconditioner.hpp"
#include "spring/net.hpp"

namespace vspring {

/// For surfaces. Along the normals the inverse of the bending form (see bending_form()), taken as if the surface were
/// flat; across them that of the graph's Laplacian, which takes into account where the correction along the normals
/// goes.
class SurfacePreconditioner final : public Preconditioner {
 public:
  /// interpolations: to the moving nodes from ever coarser sets of nodes, for multigrid; none: by Cholesky factors.
  /// They must outlive it.
  SurfacePreconditioner(const Net& net, std::span<const Interpolation> interpolations, ThreadTeam& team);

  bool refresh() override;
  void correct(std::span<const NodeForce> forces, std::vector<Vector3>& correction) override;

 private:
  /// What the regularisation is to do beside the correction along the normals, by the graph's Laplacian.
  [[nodiscard]] Vector3 asked_across(std::size_t i, const NodeForce& force,
                                     const std::vector<Vector3>& correction) const;

  const Net* net_;
  ThreadTeam* team_;
  double factor_;
  std::unique_ptr<LinearSolver> bending_;
  std::unique_ptr<LinearSolver> spreading_;
  /// The sums of 1/ℓ of every moving node by the lengths that its edges have now: then what neighbours ask of each
  /// other cancels, and what is rough in the forces leaves no trace in long waves.
  std::vector<double> weight_;
  std::vector<double> built_weight_;  // and by those when the bending form was built
  Eigen::MatrixXd along_;             // the correction along the normals
  Eigen::MatrixXd across_;
};

}  // namespace vspring
