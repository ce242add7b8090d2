#include "solve/surface_hierarchy.hpp"

#include <utility>

#include "solve/surface_preconditioner.hpp"

namespace vspring {

namespace {

// Passes of means over the few nodes of the coarsest level, until they lie as on a soap film.
constexpr int film_passes = 500;

/// The mean of a node's neighbours.
Vector3 mean_place(const Net& net, std::size_t i) {
  Vector3 mean = Vector3::Zero();
  double spokes = 0;
  for (const Link link : net.rings.links(i)) {
    if (!link.spoke()) continue;
    mean += net.positions[link.node()];
    spokes += 1;
  }
  return spokes > 0 ? Vector3(mean / spokes) : net.positions[i];
}

}  // namespace

std::unique_ptr<Preconditioner> SurfaceHierarchy::preconditioner(std::size_t level) {
  return std::make_unique<SurfacePreconditioner>(levels_[level].net, *team_);
}

void SurfaceHierarchy::start() {
  for (std::size_t k = levels_.size(); k-- > 1;) {
    const Net& fine = levels_[k].net;
    SurfaceLevel& coarse = levels_[k - 1];
    for (std::size_t i = 0; i < coarse.net.moving; ++i) {
      const std::size_t at = coarse.finer[i];
      coarse.net.positions[i] = 0.5 * (fine.positions[at] + mean_place(fine, at));
    }
  }
}

void SurfaceHierarchy::forget_shape() {
  Net& net = levels_.front().net;
  for (int pass = 0; pass < film_passes; ++pass) {
    for (std::size_t i = 0; i < net.moving; ++i) net.positions[i] = mean_place(net, i);
  }
}

void SurfaceHierarchy::prolong(std::size_t level) { vspring::prolong(levels_[level], levels_[level + 1], *team_); }

}  // namespace vspring
