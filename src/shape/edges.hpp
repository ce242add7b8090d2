#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "shape/incidence.hpp"

namespace vspring {

/// One face's use of an edge.
struct EdgeUse {
  Index neighbour;  ///< the other end
  Index face;
  bool forward;  ///< the face runs along the edge away from the node
};

/// Finds the edges at nodes. Holds a buffer, so use one per thread.
class EdgeFinder {
 public:
  EdgeFinder(const PolygonMesh& mesh, const Incidence& incidence) : mesh_(&mesh), incidence_(&incidence) {}

  /// Calls use(neighbour, uses) for every edge at the node, neighbours ascending; uses: all faces at the edge,
  /// ascending. Cost: d log d for d faces.
  template <typename Use>
  void at_node(Index node, const Use& use) {
    uses_.clear();
    for (const Corner corner : incidence_->corners(node)) {
      const auto face = mesh_->face(corner.face);
      const auto size = static_cast<Index>(face.size());
      uses_.push_back({face[static_cast<std::size_t>((corner.place + 1) % size)], corner.face, true});
      uses_.push_back({face[static_cast<std::size_t>((corner.place + size - 1) % size)], corner.face, false});
    }
    std::sort(uses_.begin(), uses_.end(), [](const EdgeUse& a, const EdgeUse& b) {
      return a.neighbour != b.neighbour ? a.neighbour < b.neighbour : a.face < b.face;
    });
    for (std::size_t begin = 0; begin < uses_.size();) {
      std::size_t end = begin + 1;
      while (end < uses_.size() && uses_[end].neighbour == uses_[begin].neighbour) ++end;
      use(uses_[begin].neighbour, std::span<const EdgeUse>(uses_).subspan(begin, end - begin));
      begin = end;
    }
  }

 private:
  const PolygonMesh* mesh_;
  const Incidence* incidence_;
  std::vector<EdgeUse> uses_;
};

}  // namespace vspring
