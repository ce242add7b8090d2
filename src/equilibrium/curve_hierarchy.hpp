#pragma once

#include <deque>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "equilibrium/hierarchy.hpp"
#include "levels/curve_levels.hpp"
#include "levels/winding.hpp"
#include "precondition/curve_preconditioner.hpp"

namespace vspring {

/// The levels of a curve.
class CurveHierarchy final : public Hierarchy {
 public:
  explicit CurveHierarchy(std::vector<CurveLevel> levels)
      : levels_(std::make_move_iterator(levels.begin()), std::make_move_iterator(levels.end())) {}

  [[nodiscard]] std::size_t count() const override { return levels_.size(); }
  Net& net(std::size_t level) override { return levels_[level].curve.net; }
  /// There are none with fewer than are of use.
  [[nodiscard]] std::size_t fewest_nodes() const override { return 0; }
  void limit(std::size_t levels) override {
    if (levels < levels_.size()) levels_.erase(levels_.begin(), levels_.end() - static_cast<std::ptrdiff_t>(levels));
  }
  void restrict_from(std::size_t level) override { restrict_shape(levels_[level], levels_[level - 1]); }
  void prolong_from(std::size_t level) override { prolong(levels_[level], levels_[level + 1]); }
  // Levels are made with the start, averaged.
  void start() override { untangle(levels_.front()); }
  void set_laplacian_weights(std::vector<double> shares) override {
    levels_.back().curve.net.laplacian_weights = std::move(shares);
  }
  void start_from_membrane(std::size_t level) override { start_from_chords(levels_[level]); }
  bool lost_winding(std::span<const Vector3> input) override { return vspring::lost_winding(levels_.back(), input); }
  bool wind() override { return vspring::wind(levels_.back()); }
  Preconditioner& preconditioner(std::size_t level) override { return preconditioner_.emplace(levels_[level].curve); }

  CurveNet& finest() { return levels_.back().curve; }
  CurveNet take() && { return std::move(levels_.back().curve); }

 private:
  // Nets stay where they are when coarser levels are dropped: ties of points refer to them.
  std::deque<CurveLevel> levels_;
  std::optional<CurvePreconditioner> preconditioner_;
};

}  // namespace vspring
