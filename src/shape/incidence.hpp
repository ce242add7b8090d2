#pragma once

#include <span>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// One corner of a face: the face and the place of the node in it.
struct Corner {
  Index face;
  Index place;
};

/// The corners at every node, in the order of the faces (CSR). Faces of fewer than three nodes are left out.
class Incidence {
 public:
  explicit Incidence(const PolygonMesh& mesh);

  [[nodiscard]] std::span<const Corner> corners(Index node) const {
    const auto i = static_cast<std::size_t>(node);
    return {corners_.data() + begin_[i], static_cast<std::size_t>(begin_[i + 1] - begin_[i])};
  }

 private:
  std::vector<Index> begin_;
  std::vector<Corner> corners_;
};

}  // namespace vspring
