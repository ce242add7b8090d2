#pragma once

#include <optional>

#include "equilibrium/hierarchy.hpp"
#include "levels/curve_levels.hpp"
#include "precondition/curve_preconditioner.hpp"

namespace vspring {

/// The levels of a curve.
class CurveHierarchy final : public Hierarchy {
 public:
  using Hierarchy::Hierarchy;

  /// There are none with fewer than are of use.
  [[nodiscard]] std::size_t fewest_nodes() const override { return 0; }
  void prolong_from(std::size_t level) override { prolong_curve(levels_[level], levels_[level + 1]); }
  // Levels are made with the start, averaged.
  void start() override { untangle(net(0)); }
  void start_from_membrane(std::size_t level) override { start_from_chords(net(level)); }
  Preconditioner& preconditioner(std::size_t level) override { return preconditioner_.emplace(net(level)); }

 private:
  std::optional<CurvePreconditioner> preconditioner_;
};

}  // namespace vspring
