#pragma once

#include <span>

#include "base/threads.hpp"
#include "shape/incidence.hpp"
#include "vspring/curvature.hpp"

namespace vspring {

/// As the public one, at the nodes with a mark (all where there are no marks), for positions of size 1 that replace the
/// mesh's own.
std::vector<NodeCurvature> curvatures(const PolygonMesh& mesh, const Incidence& incidence,
                                      const std::vector<Vector3>& positions, std::span<const std::uint8_t> marked,
                                      const Context& context, ThreadTeam& team);

}  // namespace vspring
