#pragma once

#include <vector>

#include "io/surface_source.hpp"

namespace vspring {

/// An OFF file: where its nodes are. Throws Error(unusable_file) where lines have no say and the new numbers would make
/// it a file that is read in another way.
class OffSource : public SurfaceSource {
 public:
  [[nodiscard]] std::string rewritten(Rewrite& rewrite) const override;

  std::vector<std::size_t> rows;  ///< offset of the first coordinate of each node
  bool in_stream = false;         ///< its lines have no say in where a node begins
  int normal_column = 0;  ///< of the normal's first component in the words of a node; 0 where there are no normals
};

}  // namespace vspring
