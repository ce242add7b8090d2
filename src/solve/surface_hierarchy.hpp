#pragma once

#include <utility>
#include <vector>

#include "levels/surface_levels.hpp"
#include "solve/hierarchy.hpp"

namespace vspring {

class SurfaceHierarchy final : public Hierarchy {
 public:
  explicit SurfaceHierarchy(std::vector<SurfaceLevel> levels) : levels_(std::move(levels)) {}

  [[nodiscard]] std::size_t size() const override { return levels_.size(); }
  Net& net(std::size_t level) override { return levels_[level].net; }
  void limit(std::size_t levels) override {
    if (levels < levels_.size()) levels_.erase(levels_.begin(), levels_.end() - static_cast<std::ptrdiff_t>(levels));
  }
  void restrict_from(std::size_t level) override { restrict_shape(levels_[level], levels_[level - 1]); }
  void prolong_from(std::size_t level, ThreadTeam& team) override { prolong(levels_[level], levels_[level + 1], team); }

 private:
  std::vector<SurfaceLevel> levels_;
};

}  // namespace vspring
