#pragma once

#include <cstddef>

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// A shape and its coarser versions (§4.7), whatever the shape is made of. Level 0 is the coarsest.
class Hierarchy {
 public:
  Hierarchy() = default;
  virtual ~Hierarchy() = default;
  Hierarchy(const Hierarchy&) = delete;
  Hierarchy& operator=(const Hierarchy&) = delete;

  [[nodiscard]] virtual std::size_t size() const = 0;
  virtual Net& net(std::size_t level) = 0;
  /// Leaves out the coarsest levels until `levels` are left.
  virtual void limit(std::size_t levels) = 0;
  /// Hands the shape of a level down to the next coarser one.
  virtual void restrict_from(std::size_t level) = 0;
  /// Hands the shape of a level up to the next finer one. Needs directions on it.
  virtual void prolong_from(std::size_t level, ThreadTeam& team) = 0;
};

}  // namespace vspring
