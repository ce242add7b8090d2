#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "linear/linear_solver.hpp"
#include "precondition/preconditioner.hpp"
#include "precondition/surface_systems.hpp"
#include "precondition/tangential_rigid_modes.hpp"
#include "spring/net.hpp"

namespace vspring {

/// The preconditioner of surfaces. Along the normals it is the inverse of the bending form (see bending_operator()), as
/// if the surface were flat, with the stiffness of points on its diagonal; across them that of the graph's Laplacian,
/// which allows for the correction along the normals.
class SurfacePreconditioner final : public Preconditioner {
 public:
  /// levels, spreading, anchor: of the net; they must outlive this object.
  SurfacePreconditioner(const SystemLevels& levels, LinearSolver& spreading, const TangentialRigidModes& rigid_modes,
                        ThreadTeam& team);

  bool refresh(const Model& model) override;
  [[nodiscard]] double work_of_building() const override { return bending_.work_of_building(); }
  void correct(const Model& model, double enough, std::vector<Vector3>& correction) override;

  /// Finds the correction of every moving node that restores equilibrium, for small slopes, when held nodes move.
  /// moves: a vector for every node from net.moving on. Needs a built form.
  void update(std::span<const Vector3> moves, double enough, std::vector<Vector3>& correction);

 private:
  /// A share of the way of a node by its correction along the normals, without what it goes along the surface.
  [[nodiscard]] Vector3 way_across(std::size_t i, double share = 1) const;
  /// Sets the wanted steps along the surface of nodes that slide to zero.
  void keep_sliding(std::vector<Vector3>& asked) const;
  /// Adds the steps of nodes that slide along the surface and their supports, and those of other nodes that follow
  /// them.
  void add_ways_of_sliding(const std::vector<Vector3>& asked, std::vector<Vector3>& correction);
  /// Solves for the correction, from the forces along the normals, in along_, and the regularisation.
  void solve(double enough, std::vector<Vector3>& correction);
  /// The regularisation of a node, less the part that the correction along the normals has in it, for the graph's
  /// Laplacian.
  [[nodiscard]] Vector3 asked_across(std::size_t i, const Vector3& regularisation) const;

  const Net* net_;
  ThreadTeam* team_;
  double factor_;
  BendingSystem bending_;
  LinearSolver* spreading_;
  std::unique_ptr<LinearSolver> spreading_with_sliding_;  ///< where nodes slide on surfaces, and these move as others
  const TangentialRigidModes* rigid_modes_;
  PointStiffness stiffness_;
  /// The sums of 1/ℓ of every moving node by the present lengths of its edges: then forces between neighbours cancel,
  /// and rough forces leave no trace in long waves.
  std::vector<float> weight_;
  std::vector<float> built_weight_;  // by the lengths when the bending form was built
  std::vector<double> along_;        // the correction along the normals
};

}  // namespace vspring
