#pragma once

#include <vector>

#include "base/random.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring::bench {

/// The nodes in a sphere about a node.
struct Region {
  Index seed;
  Vector3 centre;
  double radius;
  std::vector<Index> nodes;
};

/// About the run-th of the nodes that chance picks, the same every time.
inline Region region_of(const PolygonMesh& mesh, std::uint64_t run, double radius) {
  Random random(run + 1);
  const auto seed = static_cast<Index>(random.uniform() * mesh.node_count());
  Region region{seed, mesh.position(seed), radius, {}};
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if ((mesh.position(i) - region.centre).norm() <= radius) region.nodes.push_back(i);
  }
  return region;
}

}  // namespace vspring::bench
