#include "io/obj_groups.hpp"

#include <algorithm>

namespace vspring {

void ObjGroups::end_run(Index next_face) {
  const auto note = [&](const std::string& name) {
    auto& runs = faces_[name];
    if (next_face > run_begin_ && (runs.empty() || runs.back().first != run_begin_))
      runs.emplace_back(run_begin_, next_face);
  };
  for (const std::string& name : groups_) note(name);
  if (!object_.empty()) note(object_);
  run_begin_ = next_face;
}

void ObjGroups::start_groups(std::vector<std::string> names, Index next_face) {
  end_run(next_face);
  groups_ = std::move(names);
}

void ObjGroups::start_object(std::string name, Index next_face) {
  end_run(next_face);
  object_ = std::move(name);
}

std::map<std::string, std::vector<Index>> ObjGroups::take(const PolygonMesh& mesh) {
  end_run(mesh.face_count());
  std::map<std::string, std::vector<Index>> groups;
  std::vector<Index> seen_in(mesh.positions().size(), -1);
  Index number = 0;
  for (const auto& [name, runs] : faces_) {
    std::vector<Index>& nodes = groups[name];
    for (const auto& [first, last] : runs) {
      for (Index corner = mesh.face_begin()[first]; corner < mesh.face_begin()[last]; ++corner) {
        const Index node = mesh.corners()[corner];
        if (seen_in[node] == number) continue;
        seen_in[node] = number;
        nodes.push_back(node);
      }
    }
    std::sort(nodes.begin(), nodes.end());
    ++number;
  }
  return groups;
}

}  // namespace vspring
