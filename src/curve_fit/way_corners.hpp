#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Places of a way at which it turns by more than an angle, in radians, within a few tolerances, as those about them
/// tell: two straight stretches that meet there are nearer to them than a bend that is the same throughout. Stretches
/// are eight tolerances long, or so long that a corner of that angle rises by two over its chord, or one edge. No
/// corners are nearer to each other or to an end than four tolerances. In order. given: 1 for places that are known to
/// be corners, one entry per place, and are not among those returned; empty: none. least_edges: stretches have so many
/// at least. Cost: linear in the places, times
/// those on a stretch.
std::vector<std::size_t> corners_of_way(std::span<const Vector3> way, bool closed, double angle, double tolerance,
                                        std::span<const std::uint8_t> given = {}, int least_edges = 1);

}  // namespace vspring
