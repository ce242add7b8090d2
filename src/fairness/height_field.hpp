#pragma once

#include <vector>

#include "base/threads.hpp"
#include "shape/triangles.hpp"

namespace vspring {

/// Whether it is certain that some direction sees every point of the triangles once, all from the same side. Then no
/// two of them cross or lie on each other, however they are joined. False says nothing: of closed surfaces, of several
/// sheets and of what touches itself along its boundary, for example. positions: coordinates of at most 2. Cost:
/// linear, and b log b of the edges of the boundary.
[[nodiscard]] bool is_height_field(const std::vector<Triangle>& triangles, const std::vector<Vector3>& positions,
                                   ThreadTeam& team);

}  // namespace vspring
