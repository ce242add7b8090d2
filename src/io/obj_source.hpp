#pragma once

#include <vector>

#include "io/surface_source.hpp"

namespace vspring {

/// An OBJ file: where its `v` and `vn` lines are.
class ObjSource : public SurfaceSource {
 public:
  [[nodiscard]] std::string rewritten(Rewrite& rewrite) const override;

  std::vector<std::size_t> node_rows;    ///< offset of the first coordinate of each node
  std::vector<std::size_t> normal_rows;  ///< offset of the first component of each `vn`
  std::vector<Vector3> normals;          ///< of each `vn`, as it is given
  std::vector<Index> corner_normals;     ///< the `vn` of each corner, −1 for none; empty where no face names any
};

}  // namespace vspring
