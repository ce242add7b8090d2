#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "linear/linear_solver.hpp"
#include "precondition/point_stiffness.hpp"
#include "precondition/preconditioner.hpp"
#include "precondition/surface_systems.hpp"
#include "precondition/tangential_rigid_modes.hpp"
#include "spring/net.hpp"

namespace vspring {

/// For surfaces. Along the normals the inverse of the bending form (see bending_operator()), taken as if the surface
/// were flat, with what points add to its diagonal; across them that of the graph's Laplacian, which takes into account
/// where the correction along the normals goes.
class SurfacePreconditioner final : public Preconditioner {
 public:
  /// levels, spreading, anchor: of the net that is worked on; they must outlive it.
  SurfacePreconditioner(const SystemLevels& levels, LinearSolver& spreading, const TangentialRigidModes& rigid_modes,
                        ThreadTeam& team);

  bool refresh(const Model& model) override;
  [[nodiscard]] double work_of_building() const override { return bending_.work_of_building(); }
  void correct(const Model& model, double enough, std::vector<Vector3>& correction) override;

  /// The correction of every moving node that brings back equilibrium, if slopes are small, where held nodes move:
  /// moves has a vector for every node from net.moving on. Needs a form that was built.
  void update(std::span<const Vector3> moves, double enough, std::vector<Vector3>& correction);

 private:
  /// Solves for the correction: from what is asked along the normals, in along_, and by the regularisation.
  void solve(double enough, std::vector<Vector3>& correction);
  /// Turns what the regularisation asks of a node into what it is to do beside the correction along the normals, by the
  /// graph's Laplacian.
  [[nodiscard]] Vector3 asked_across(std::size_t i, const Vector3& regularisation) const;

  const Net* net_;
  ThreadTeam* team_;
  double factor_;
  BendingSystem bending_;
  LinearSolver* spreading_;
  const TangentialRigidModes* rigid_modes_;
  PointStiffness stiffness_;
  /// The sums of 1/ℓ of every moving node by the lengths that its edges have now: then what neighbours ask of each
  /// other cancels, and what is rough in the forces leaves no trace in long waves.
  std::vector<float> weight_;
  std::vector<float> built_weight_;  // and by those when the bending form was built
  std::vector<double> along_;        // the correction along the normals
};

}  // namespace vspring
