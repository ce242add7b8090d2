#include "fairness/hubs.hpp"

#include <algorithm>
#include <cstdint>

namespace vspring {

namespace {

// From this many triangles on, a node is worth a search of its own.
constexpr std::uint32_t many = 64;
// On the unit sphere: far more than rounding, and far less than the distance of a hub's neighbours.
constexpr double margin_on_sphere = 0x1p-30;

}  // namespace

Hubs find_hubs(const std::vector<Triangle>& triangles, std::size_t node_count) {
  std::vector<std::uint32_t> uses(node_count, 0);
  for (const Triangle& triangle : triangles) {
    for (const Index i : triangle.nodes) ++uses[static_cast<std::size_t>(i)];
  }
  Hubs result;
  // The index of a node's hub.
  std::vector<std::size_t> place(node_count, 0);
  for (std::size_t i = 0; i < node_count; ++i) {
    if (uses[i] < many) continue;
    place[i] = result.hubs.size();
    result.hubs.push_back({static_cast<Index>(i), {}});
  }
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    std::size_t busiest = static_cast<std::size_t>(triangles[k].nodes[0]);
    for (const Index i : triangles[k].nodes) {
      if (uses[static_cast<std::size_t>(i)] > uses[busiest]) busiest = static_cast<std::size_t>(i);
    }
    const bool is_at_hub = uses[busiest] >= many;
    (is_at_hub ? result.hubs[place[busiest]].triangles : result.others).push_back(static_cast<Index>(k));
  }
  std::erase_if(result.hubs, [](const Hubs::Hub& hub) { return hub.triangles.empty(); });
  return result;
}

Box box_seen_from(const Vector3& hub, const Vector3& a, const Vector3& b) {
  const Vector3 to_a = (a - hub).stableNormalized();
  const Vector3 to_b = (b - hub).stableNormalized();
  // An arc with a chord c rises above it by 1 − √(1 − c²/4), which is at most c²/4.
  const double rise = (to_b - to_a).squaredNorm() / 4 + margin_on_sphere;
  const Vector3 reach = Vector3::Constant(rise);
  return {to_a.cwiseMin(to_b) - reach, to_a.cwiseMax(to_b) + reach};
}

}  // namespace vspring
