#pragma once

#include <vector>

#include "io/surface_source.hpp"

namespace vspring {

/// An OFF file: where its nodes are.
class OffSource : public SurfaceSource {
 public:
  [[nodiscard]] std::string rewritten(Rewrite& rewrite) const override;

  std::vector<std::size_t> rows;  ///< offset of the first coordinate of each node
  int normal_column = 0;  ///< of the normal's first component in the words of a node; 0 where there are no normals
};

}  // namespace vspring
