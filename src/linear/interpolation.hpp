#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "linear/sparse_rows.hpp"
#include "spring/net.hpp"

namespace vspring {

/// How a coarser space hangs together with the next finer one.
struct Interpolation {
  FloatRows up;
  FloatRows down;  ///< its transpose
};

/// From the moving nodes of a coarser net to those of a finer one. finer: for every node of the coarse net its number
/// in the fine one. A node takes of the nearest coarse and held ones within two edges, with shares that reproduce
/// linear functions of the place; held nodes stay at zero. Cost: linear.
Interpolation interpolation(const Net& fine, const Net& coarse, std::span<const std::uint32_t> finer, ThreadTeam& team);

}  // namespace vspring
