#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Up to three rows in succession that lie aside of the way from the row before to the row after, by more than six of
/// the lengths between rows about them: single readings that are off, short runs of such, jumps along a track. 1 for
/// each; at most so many, the furthest first. Cost: linear, times the number of them where they lie beside each other.
std::vector<std::uint8_t> find_spikes(std::span<const Vector3> rows, bool closed, std::size_t most);

}  // namespace vspring
