#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Marks spikes with 1: up to three rows in succession that lie aside of the way from the row before to the row after,
/// by more than six lengths between rows around. They are single wrong readings, short runs of these, and jumps along a
/// track. At most `most` rows, the furthest first. least: none lie less far aside. Cost: linear, times the number of
/// adjacent spikes.
std::vector<std::uint8_t> find_spikes(std::span<const Vector3> rows, bool closed, std::size_t most, double least = 0);

}  // namespace vspring
