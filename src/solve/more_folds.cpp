#include "solve/more_folds.hpp"

#include "base/threads.hpp"
#include "checks/new_crossings.hpp"
#include "shape/box_tree.hpp"
#include "shape/frame.hpp"
#include "shape/turned_edges.hpp"

namespace vspring {

bool has_more_folds(const PolygonMesh& mesh, const std::vector<Vector3>& positions, const MeshEdges& sharp,
                    const Context& context) {
  // So that no square overflows.
  Box box;
  for (const Vector3& p : mesh.positions()) box.extend(p);
  const Frame frame(box);
  const auto local = [&](const std::vector<Vector3>& places) {
    std::vector<Vector3> moved;
    moved.reserve(places.size());
    for (const Vector3& p : places) moved.push_back(frame.to_local(p));
    return moved;
  };
  PolygonMesh before = mesh;
  before.set_positions(local(mesh.positions()));
  const std::vector<Vector3> after = local(positions);
  const TurnedEdges edges(before, sharp);
  ThreadTeam team(context.thread_count());
  return edges.count(after) > edges.count(before.positions()) || loses_area(before, after) ||
         !new_crossings(before, after, context, team).empty();
}

}  // namespace vspring
