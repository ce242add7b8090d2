#pragma once

#include <algorithm>
#include <cstddef>

#include "spring/net.hpp"

namespace vspring {

/// κ of F ≈ −κ L² h: the V-Spring force F on a nearly flat surface with such a mesh; h: heights; L h: the mean height
/// of a node's neighbours less its own. 3/4 on triangles, 1 on quads.
inline double bending_factor(const Net& net) {
  std::size_t edges = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    edges +=
        static_cast<std::size_t>(std::count_if(links.begin(), links.end(), [](Link link) { return link.spoke(); }));
  }
  return static_cast<double>(edges) > 5 * static_cast<double>(net.moving) ? 0.75 : 1;
}

}  // namespace vspring
