#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "precondition/preconditioner.hpp"
#include "spring/net.hpp"

namespace vspring {

/// A shape and its coarser versions (§4.7) as the solvers see them, whatever the shape is made of: the coarsest level
/// is number 0, the shape itself the last.
class Hierarchy {
 public:
  Hierarchy() = default;
  virtual ~Hierarchy() = default;
  Hierarchy(const Hierarchy&) = delete;
  Hierarchy& operator=(const Hierarchy&) = delete;

  [[nodiscard]] virtual std::size_t count() const = 0;
  virtual Net& net(std::size_t level) = 0;
  /// Moving nodes without which a level does not tell shapes apart: more than one passes for fair.
  [[nodiscard]] virtual std::size_t fewest_nodes() const = 0;
  /// The coarsest level that has as many; the shape itself where none has.
  std::size_t first_of_use() {
    std::size_t level = 0;
    while (level + 1 < count() && net(level).moving < fewest_nodes()) ++level;
    return level;
  }
  /// Leaves out the coarsest levels until `levels` are left.
  virtual void limit(std::size_t levels) = 0;

  /// Hands the shape of a level down to the next coarser one.
  virtual void restrict_from(std::size_t level) = 0;
  /// Hands the shape of a level up to the next finer one. Needs directions on it.
  virtual void prolong_from(std::size_t level) = 0;

  /// Hands the start down to all levels without its noise, and makes it fit to start from on the coarsest.
  virtual void start() = 0;
  /// Other shares (§4.4) for the shape itself.
  virtual void set_laplacian_weights(std::vector<double> shares) = 0;
  /// The start of last resort on the level that is worked on first, which forgets the shape.
  virtual void start_from_membrane(std::size_t level) = 0;
  /// Whether the shape itself winds less often than at `input`, the positions of its nodes.
  virtual bool lost_winding(std::span<const Vector3> /*input*/) { return false; }
  /// A start on the shape itself that keeps its windings. False where there is none.
  virtual bool wind() { return false; }
  /// For that level, made anew; used up before the next one is asked for.
  virtual Preconditioner& preconditioner(std::size_t level) = 0;
};

}  // namespace vspring
