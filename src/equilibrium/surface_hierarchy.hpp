#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "equilibrium/hierarchy.hpp"
#include "levels/levels.hpp"
#include "linear/linear_solver.hpp"
#include "precondition/anderson.hpp"
#include "precondition/multisecant_predictor.hpp"
#include "precondition/surface_preconditioner.hpp"
#include "precondition/surface_systems.hpp"
#include "precondition/tangential_rigid_modes.hpp"

namespace vspring {

/// The levels of a surface (§4.7).
class SurfaceHierarchy final : public Hierarchy {
 public:
  SurfaceHierarchy(std::vector<Level> levels, ThreadTeam& team) : Hierarchy(std::move(levels)), team_(&team) {}

  [[nodiscard]] std::size_t fewest_nodes() const override { return 60; }
  /// Nodes then move along the surface to where the regularisation of the finer level wants them.
  void prolong_from(std::size_t level) override;
  void forget(std::size_t level) override;
  /// Nodes stay where they come to lie.
  void prolong_roughly_from(std::size_t level) override;
  /// Noise is not a shape: coarser levels start from rest_positions(); with an even distribution, nodes take half of
  /// their neighbours' mean place with them to each coarser level.
  void start() override;
  void set_laplacian_weights(std::vector<double> shares) override {
    Hierarchy::set_laplacian_weights(std::move(shares));
    systems_of_.reset();
  }
  /// All nodes at the mean of their neighbours.
  void start_from_membrane(std::size_t level) override;
  Preconditioner& preconditioner(std::size_t level) override;

  /// The last one for the shape itself, or one made anew where there is none.
  Preconditioner& kept_preconditioner();
  /// Frees the memory of the last one.
  void forget_preconditioner() { preconditioner_.reset(); }

  /// Held nodes of the shape itself go to their new places, and have their new normals; its moving nodes follow as in
  /// the last moves; for the part of the move that is no combination of these, they follow by the equations for small
  /// slopes. Coarser levels stay as they are. tolerance: of the shapes from which and to which it goes, in the net's
  /// coordinates.
  void update(const Constraints& constraints, const Model& model, double tolerance);
  /// Where the moving nodes would be then.
  [[nodiscard]] std::vector<Vector3> predict(const Constraints& constraints, const Model& model, double tolerance);

  /// From the shape that update() began with it has come to an equilibrium.
  void arrived();
  /// Back to the shape that update() began with, and its constraints.
  void go_back();

  /// Of the iteration on the shape itself, from one update() to the next.
  Anderson<float>& memory() { return *memory_; }

 private:
  /// The moves of held nodes of the shape itself, then of the ends of given normals.
  [[nodiscard]] std::vector<Vector3> step_of_held(const Constraints& constraints) const;
  /// The ways of the moving nodes with it.
  [[nodiscard]] std::vector<Vector3> ways_with(const std::vector<Vector3>& held_step, const Model& model,
                                               double tolerance);
  /// Makes the systems of a level ready: hands its shape down as far as they need it.
  void make_systems(std::size_t level);

  std::optional<std::size_t> systems_of_;  ///< the level that these are for
  SystemLevels system_levels_;
  std::optional<TangentialRigidModes> rigid_modes_;
  std::unique_ptr<LinearSolver> spreading_;
  std::optional<SurfacePreconditioner> preconditioner_;
  MultisecantPredictor predictor_;
  /// Of the last update(); none where it tells nothing.
  std::vector<Vector3> held_step_;
  std::vector<Vector3> began_;          ///< where all nodes were before it
  std::vector<Vector3> normals_began_;  ///< and their normals
  std::optional<Anderson<float>> memory_;
  ThreadTeam* team_;
};

}  // namespace vspring
