#pragma once

#include <span>

#include "base/threads.hpp"
#include "shape/incidence.hpp"
#include "vspring/curvature.hpp"

namespace vspring {

/// As the public one, at the nodes with a mark (all where there are no marks), of the mesh times a power of two that
/// makes its size about 1. The bits do not depend on the marks, nor, but for that factor, on the power.
std::vector<NodeCurvature> curvatures(const PolygonMesh& mesh, const Incidence& incidence, double scale,
                                      std::span<const std::uint8_t> marked, const Context& context, ThreadTeam& team);

/// The curvatures of a mesh that is `scale` times as large.
std::vector<NodeCurvature> scaled(std::vector<NodeCurvature> values, double scale);

}  // namespace vspring
