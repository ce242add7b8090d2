#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Finds the places of a way at which it turns by more than an angle, in radians, within a few tolerances: two straight
/// stretches that meet there fit the places around better than an even bend. Stretches are eight tolerances long, or so
/// long that a corner of that angle rises by two tolerances over its chord, and at least one edge. Corners are at least
/// four tolerances from each other and from ends. Returned in order. given: one entry per place, 1 for known corners,
/// which are not returned; empty: none. least_edges: least number of edges of a stretch. Cost: linear in the places,
/// times those on a stretch.
std::vector<std::size_t> corners_of_way(std::span<const Vector3> way, bool closed, double angle, double tolerance,
                                        std::span<const std::uint8_t> given = {}, int least_edges = 1);

}  // namespace vspring
