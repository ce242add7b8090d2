#pragma once

#include <vector>

#include "levels/surface_levels.hpp"
#include "solve/equilibrium_method.hpp"
#include "solve/multigrid_solver.hpp"

namespace vspring {

/// The levels of a surface (§4.7).
class SurfaceHierarchy final : public Hierarchy {
 public:
  SurfaceHierarchy(std::vector<SurfaceLevel> levels, ThreadTeam& team) : levels_(std::move(levels)), team_(&team) {}

  [[nodiscard]] std::size_t count() const override { return levels_.size(); }
  Net& net(std::size_t level) override { return levels_[level].net; }
  std::unique_ptr<Preconditioner> preconditioner(std::size_t level) override;
  /// Nodes take half of their neighbours' mean place with them to each coarser level: noise is not a shape.
  void start() override;
  /// All nodes at the mean of their neighbours.
  void forget_shape() override;
  void prolong(std::size_t level) override;

  Net take() && { return std::move(levels_.back().net); }

 private:
  /// Sets the shares of coarse levels so that a soap film, where all nodes are at the mean of their neighbours on the
  /// finest level, is evened out on every level.
  void even_out();
  /// For multigrid on a level, with the shape that it has now; none where there are few nodes.
  std::vector<Interpolation> interpolations(std::size_t level);

  std::vector<SurfaceLevel> levels_;
  std::vector<Interpolation> interpolations_;  ///< of the last level that was asked for
  ThreadTeam* team_;
};

}  // namespace vspring
