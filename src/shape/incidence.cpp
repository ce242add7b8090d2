#include "shape/incidence.hpp"

#include "base/cancellation.hpp"

namespace vspring {

Incidence::Incidence(const PolygonMesh& mesh) : begin_(static_cast<std::size_t>(mesh.node_count()) + 2, 0) {
  const auto for_each_corner = [&](const auto& use) {
    for (Index f = 0; f < mesh.face_count(); ++f) {
      end_if_cancelled_at(static_cast<std::size_t>(f));
      const auto face = mesh.face(f);
      if (face.size() < 3) continue;
      for (std::size_t k = 0; k < face.size(); ++k)
        use(static_cast<std::size_t>(face[k]), Corner{f, static_cast<Index>(k)});
    }
  };
  // Counted one place further on: filling in the corners advances each entry from the begin of the node before to its
  // end.
  for_each_corner([&](std::size_t node, Corner) { ++begin_[node + 2]; });
  for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  corners_.resize(static_cast<std::size_t>(begin_.back()));
  for_each_corner(
      [&](std::size_t node, Corner corner) { corners_[static_cast<std::size_t>(begin_[node + 1]++)] = corner; });
}

}  // namespace vspring
