#include <algorithm>
#include <cstddef>
#include <vector>

#include "shape/sharp_edges.hpp"
#include "shape/sheets.hpp"
#include "vspring/constraints.hpp"
#include "vspring/topology.hpp"

namespace vspring {

void fix_boundary_normals(Constraints& constraints, const PolygonMesh& mesh, const MeshEdges& given) {
  if (given.empty()) return fix_boundary_normals(constraints, mesh);
  const MeshEdges sharp = as_sharp_edges(mesh, given).edges;
  const MeshOfSheets sides = into_sheets(mesh, nodes_of(sharp), sharp);
  const auto boundary = boundary_nodes(mesh);
  std::vector<Index> nodes;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (boundary[static_cast<std::size_t>(i)] != 0 && !std::binary_search(sides.origin.begin(), sides.origin.end(), i))
      nodes.push_back(i);
  }
  const std::vector<Vector3> normals = estimate_normals(sides.mesh, nodes);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!normals[k].isZero(0)) constraints.fix_normal(nodes[k], normals[k]);
  }
}

}  // namespace vspring
