#include "spring/bending_factor.hpp"

#include <algorithm>

namespace vspring {

double bending_factor(const Net& net) {
  std::size_t edges = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    edges +=
        static_cast<std::size_t>(std::count_if(links.begin(), links.end(), [](Link link) { return link.spoke(); }));
  }
  return static_cast<double>(edges) > 5 * static_cast<double>(net.moving) ? 0.75 : 1;
}

}  // namespace vspring
