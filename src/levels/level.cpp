#include "levels/level.hpp"

namespace vspring {

void restrict_shape(const Level& fine, Level& coarse) {
  Net& to = coarse.net;
  const Net& from = fine.net;
  for (std::size_t k = 0; k < coarse.finer.size(); ++k) {
    const std::size_t i = coarse.finer[k];
    if (k < to.moving) to.positions[k] = from.positions[i];
    if (!to.is_curve) to.normals[k] = from.normals[i];
  }
}

}  // namespace vspring
