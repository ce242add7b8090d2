#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "linear/sparse_rows.hpp"
#include "spring/net.hpp"

namespace vspring {

/// Interpolation from a coarser space to the next finer one.
struct Interpolation {
  FloatRows up;
  FloatRows down;  ///< its transpose
};

/// The interpolation from the moving nodes of a coarser net to those of a finer one. finer: per node of the coarse net
/// its number in the fine one. A node interpolates the nearest coarse and held nodes within two edges, with shares that
/// reproduce linear functions of the place; held nodes are zero. Cost: linear.
Interpolation interpolation(const Net& fine, const Net& coarse, std::span<const std::uint32_t> finer, ThreadTeam& team);

}  // namespace vspring
