#pragma once

#include <cstddef>
#include <deque>
#include <iterator>
#include <utility>
#include <vector>

#include "levels/levels.hpp"
#include "precondition/preconditioner.hpp"

namespace vspring {

/// A surface or curve and its coarser versions (§4.7) as the solvers see them: the coarsest level is number 0, the
/// shape itself the last.
class Hierarchy {
 public:
  explicit Hierarchy(std::vector<Level> levels)
      : levels_(std::make_move_iterator(levels.begin()), std::make_move_iterator(levels.end())) {}
  virtual ~Hierarchy() = default;
  Hierarchy(const Hierarchy&) = delete;
  Hierarchy& operator=(const Hierarchy&) = delete;

  [[nodiscard]] std::size_t count() const { return levels_.size(); }
  Net& net(std::size_t level) { return levels_[level].net; }
  /// The shape itself.
  Net& finest() { return levels_.back().net; }
  [[nodiscard]] const Net& finest() const { return levels_.back().net; }
  Net take() && { return std::move(levels_.back().net); }
  /// The least number of moving nodes of a level that determines its shape: with fewer, several shapes are fair.
  [[nodiscard]] virtual std::size_t fewest_nodes() const = 0;
  /// The coarsest level that has as many; the shape itself where none has.
  std::size_t first_of_use() {
    std::size_t level = 0;
    while (level + 1 < count() && net(level).moving < fewest_nodes()) ++level;
    return level;
  }
  /// Leaves out the coarsest levels until `levels` are left.
  void limit(std::size_t levels) {
    if (levels < count()) levels_.erase(levels_.begin(), levels_.end() - static_cast<std::ptrdiff_t>(levels));
  }

  /// Hands the shape of a level down to the next coarser one.
  void restrict_from(std::size_t level) { restrict_shape(levels_[level], levels_[level - 1]); }
  /// Hands the shape of a level up to the next finer one. Needs directions on it.
  virtual void prolong_from(std::size_t level) = 0;
  /// The same in a hurry.
  virtual void prolong_roughly_from(std::size_t level) { prolong_from(level); }

  /// Frees what is needed to iterate a level and to hand it up, when neither is done again.
  virtual void forget(std::size_t /*level*/) {}

  /// Hands the start down to all levels without its noise, and makes it fit to start from on the coarsest.
  virtual void start() = 0;
  /// Other shares (§4.4) for the shape itself.
  virtual void set_laplacian_weights(std::vector<double> shares) { finest().laplacian_weights = std::move(shares); }
  /// The start of last resort on the level that is iterated first; it ignores the shape.
  virtual void start_from_membrane(std::size_t level) = 0;
  /// The preconditioner of that level, made anew; valid until the next call.
  virtual Preconditioner& preconditioner(std::size_t level) = 0;

 protected:
  // Nets stay where they are when coarser levels are dropped: ties of points refer to them.
  std::deque<Level> levels_;
};

}  // namespace vspring
