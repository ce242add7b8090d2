#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solve/multigrid_solver.hpp"
#include "spring/net.hpp"

namespace vspring {

/// From the moving nodes of a coarser net to those of a finer one. finer: for every node of the coarse net its number
/// in the fine one. positions: of the fine nodes. A node takes of the nearest coarse and held ones within two edges,
/// with shares that reproduce linear functions of the place; held nodes stay at zero. Cost: linear.
Interpolation interpolation(const Net& fine, std::span<const Vector3> positions, const Net& coarse,
                            std::span<const std::uint32_t> finer, ThreadTeam& team);

}  // namespace vspring
