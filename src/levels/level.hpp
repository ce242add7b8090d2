#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "levels/coarsening.hpp"
#include "spring/net.hpp"

namespace vspring {

/// One level of the hierarchy of a shape (§4.7).
struct Level {
  Net net;
  /// Per node its number in the net of the next finer level; empty on the finest.
  std::vector<std::uint32_t> finer;
  /// Of surfaces: the nodes of the next finer level that this one lacks, in its numbers; empty on the finest. Groups as
  /// from coarsen().
  std::vector<Removals> removals;
  /// Of surfaces: the rest_positions() of the nodes in the finest net; empty on the finest level, and with
  /// Distribution::even.
  std::vector<Vector3> places;
};

/// Hands the shape of a level down to the next coarser one: nodes stay where they are, on surfaces with their normals.
/// Cost: linear in the coarse nodes.
inline void restrict_shape(const Level& fine, Level& coarse) {
  Net& to = coarse.net;
  const Net& from = fine.net;
  for (std::size_t k = 0; k < coarse.finer.size(); ++k) {
    const std::size_t i = coarse.finer[k];
    if (k < to.moving) to.positions[k] = from.positions[i];
    if (!to.is_curve) to.normals[k] = from.normals[i];
  }
}

}  // namespace vspring
