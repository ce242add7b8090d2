#pragma once

#include <vector>

#include "vspring/context.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/sharp_edges.hpp"

namespace vspring {

/// Whether a surface, of which lines have gone elsewhere before the rest followed, has more folds or crossings than the
/// mesh, with its nodes at `positions`. What compares it with a start on such lines does not see what these did. sharp:
/// edges that may turn; ascending, the smaller node first. Cost: n log n, and that of new_crossings().
bool has_more_folds(const PolygonMesh& mesh, const std::vector<Vector3>& positions, const MeshEdges& sharp,
                    const Context& context);

}  // namespace vspring
