#pragma once

#include <vector>

#include "spring/model.hpp"

namespace vspring {

/// The order of a Gauss–Seidel sweep (§4.1) that may run on any number of threads: blocks in groups, no two blocks of a
/// group joined by an edge. Groups follow each other, blocks of a group run in parallel, nodes of a block in order. So
/// the newest positions that a node sees depend on the net alone.
std::vector<std::vector<Block>> parallel_order(const Net& net);

/// The order of Fig. 3: the moving nodes by their numbers in the shape, each a block of its own.
std::vector<Block> file_order(const Net& net);

}  // namespace vspring
