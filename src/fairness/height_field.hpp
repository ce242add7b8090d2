#pragma once

#include <vector>

#include "base/threads.hpp"
#include "shape/triangles.hpp"

namespace vspring {

/// Whether some direction certainly sees every point of the triangles once, all from the same side. Then no two of them
/// cross or overlap, however they are joined. False says nothing: it is returned for closed surfaces, several sheets
/// and surfaces that touch themselves along the boundary, for example. positions: coordinates of at most 2. Cost:
/// linear, plus b log b for b boundary edges.
[[nodiscard]] bool is_height_field(const std::vector<Triangle>& triangles, const std::vector<Vector3>& positions,
                                   ThreadTeam& team);

}  // namespace vspring
