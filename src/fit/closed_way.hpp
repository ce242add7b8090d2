#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Ways of fewer nodes are not smoothed before their corners are looked for.
inline constexpr std::size_t fewest_smoothed = 8;

/// How many faces there are at a place of a way.
using FacesAtPlace = std::function<std::size_t(std::size_t place)>;

/// Finds the corners of a closed way and puts a place at each: where it turns by 40° more within three places than
/// beside them, as smoothing has rounded corners; of fewer than fewest_smoothed places, where it turns by over 60°.
/// Returns these places. A place with a single face up to `furthest` away is put there rather than the nearest one.
/// way: of a size at which no square overflows. Cost: linear.
std::vector<std::size_t> put_at_corners(std::vector<Vector3>& way, std::size_t furthest, const FacesAtPlace& faces);

/// Takes the noise out of the distances along a closed way, between places that are held or corners. Cost: linear.
void space_out(const Constraints& held, std::vector<Vector3>& way);

}  // namespace vspring
