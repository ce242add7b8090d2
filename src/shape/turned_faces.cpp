#include "shape/turned_faces.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "base/cancellation.hpp"
#include "shape/edges.hpp"
#include "shape/incidence.hpp"

namespace vspring {

namespace {

/// A face and its neighbour at an edge.
struct Step {
  Index from;
  Index to;
  bool turns;  ///< they go round in opposite senses
};

/// All steps, by the faces where they begin; none if no step turns.
std::vector<Step> steps_of(const PolygonMesh& mesh) {
  const Incidence incidence(mesh);
  EdgeFinder edges(mesh, incidence);
  std::vector<Step> steps;
  bool any = false;
  for (Index node = 0; node < mesh.node_count(); ++node) {
    end_if_cancelled_at(static_cast<std::size_t>(node));
    edges.at_node(node, [&](Index neighbour, std::span<const EdgeUse> uses) {
      if (neighbour <= node || uses.size() != 2) return;
      const bool turns = uses[0].forward == uses[1].forward;
      any = any || turns;
      steps.push_back({uses[0].face, uses[1].face, turns});
      steps.push_back({uses[1].face, uses[0].face, turns});
    });
  }
  if (!any) return {};
  std::stable_sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.from < b.from; });
  return steps;
}

}  // namespace

std::vector<std::uint8_t> turned_faces(const PolygonMesh& mesh) {
  const auto count = static_cast<std::size_t>(mesh.face_count());
  std::vector<std::uint8_t> turned(count, 0);
  const std::vector<Step> steps = steps_of(mesh);
  if (steps.empty()) return turned;
  std::vector<std::uint8_t> reached(count, 0);
  std::vector<Index> queue;
  for (Index first = 0; first < mesh.face_count(); ++first) {
    if (reached[static_cast<std::size_t>(first)] != 0) continue;
    reached[static_cast<std::size_t>(first)] = 1;
    queue.assign(1, first);
    for (std::size_t head = 0; head < queue.size(); ++head) {
      end_if_cancelled_at(head);
      const Index face = queue[head];
      const auto begin = std::lower_bound(steps.begin(), steps.end(), face,
                                          [](const Step& step, Index from) { return step.from < from; });
      for (auto step = begin; step != steps.end() && step->from == face; ++step) {
        const auto to = static_cast<std::size_t>(step->to);
        if (reached[to] != 0) continue;
        reached[to] = 1;
        const bool turns = step->turns != (turned[static_cast<std::size_t>(face)] != 0);
        turned[to] = turns ? 1 : 0;
        queue.push_back(step->to);
      }
    }
  }
  return turned;
}

}  // namespace vspring
