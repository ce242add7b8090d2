#pragma once

#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "vspring/vspring.hpp"

namespace vspring::bench {

struct Region {
  Index seed;
  Vector3 centre;
  double radius;
  std::vector<Index> nodes;
};

/// All nodes within `radius` of one drawn at random.
inline Region random_region(const PolygonMesh& mesh, double radius, std::uint64_t draw) {
  Random random(draw);
  const auto seed = static_cast<Index>(random.uniform() * mesh.node_count());
  Region region{seed, mesh.position(seed), radius, {}};
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if ((mesh.position(i) - region.centre).norm() <= radius) region.nodes.push_back(i);
  }
  return region;
}

/// Only the region moves; boundaries and spots that are no surface do not.
inline Constraints hold_all_but(const Region& region, const PolygonMesh& mesh) {
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  apply_rules(constraints, mesh, R"({"rules": [{"nodes": "non-manifold", "position": "fixed"}]})");
  restrict_to_region(constraints, mesh, region.nodes);
  return constraints;
}

}  // namespace vspring::bench
