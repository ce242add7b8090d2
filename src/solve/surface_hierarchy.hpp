#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "levels/surface_levels.hpp"
#include "solve/hierarchy.hpp"

namespace vspring {

/// The levels of a surface (§4.7).
class SurfaceHierarchy final : public Hierarchy {
 public:
  SurfaceHierarchy(std::vector<SurfaceLevel> levels, ThreadTeam& team) : levels_(std::move(levels)), team_(&team) {}

  [[nodiscard]] std::size_t count() const override { return levels_.size(); }
  Net& net(std::size_t level) override { return levels_[level].net; }
  void limit(std::size_t levels) override;
  /// Sets the shares of coarse levels so that a soap film, where all nodes are at the mean of their neighbours on the
  /// finest level, is evened out on every level. Nothing where the finest has shares of its own.
  void even_out() override;
  void restrict_from(std::size_t level) override { restrict_shape(levels_[level], levels_[level - 1]); }
  void prolong_from(std::size_t level) override { prolong(levels_[level], levels_[level + 1], *team_); }
  /// Nodes take half of their neighbours' mean place with them to each coarser level: noise is not a shape.
  void start() override;
  /// All nodes at the mean of their neighbours.
  void forget_shape() override;
  std::unique_ptr<Preconditioner> preconditioner(std::size_t level) override;

  Net take() && { return std::move(levels_.back().net); }

 private:
  std::vector<SurfaceLevel> levels_;
  ThreadTeam* team_;
};

}  // namespace vspring
