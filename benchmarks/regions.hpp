#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "vspring/vspring.hpp"

namespace vspring::bench {

struct RandomRegion {
  Index seed;
  Vector3 centre;
  double radius;
  std::vector<Index> nodes;
};

/// All nodes within `radius` of one drawn at random.
inline RandomRegion random_region(const PolygonMesh& mesh, double radius, std::uint64_t draw) {
  Random random(draw);
  const auto seed = static_cast<Index>(random.uniform() * mesh.node_count());
  RandomRegion region{seed, mesh.position(seed), radius, {}};
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if ((mesh.position(i) - region.centre).norm() <= radius) region.nodes.push_back(i);
  }
  return region;
}

/// Only the region moves; boundaries and spots that are no surface do not.
inline Constraints hold_all_but(const RandomRegion& region, const PolygonMesh& mesh) {
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  apply_rules(constraints, mesh, R"({"rules": [{"nodes": "non-manifold", "position": "fixed"}]})");
  restrict_to_region(constraints, mesh, region.nodes);
  return constraints;
}

/// The faces around some nodes and two rings more, which are its outer rings.
inline PolygonMesh cut_out(const PolygonMesh& mesh, const std::vector<Index>& nodes) {
  const auto at = [](Index node) { return static_cast<std::size_t>(node); };
  std::vector<std::uint8_t> marked(at(mesh.node_count()), 0);
  for (const Index node : nodes) marked[at(node)] = 1;
  const auto touched = [&](Index f) {
    const auto face = mesh.face(f);
    return std::any_of(face.begin(), face.end(), [&](Index node) { return marked[at(node)] != 0; });
  };
  std::vector<std::uint8_t> ring = marked;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (!touched(f)) continue;
    for (const Index node : mesh.face(f)) ring[at(node)] = 1;
  }
  marked = ring;
  MeshBuilder builder;
  std::vector<Index> numbers(marked.size(), -1);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (!touched(f)) continue;
    std::vector<Index> face;
    for (const Index node : mesh.face(f)) {
      Index& number = numbers[at(node)];
      if (number < 0) number = builder.add_node(mesh.position(node));
      face.push_back(number);
    }
    builder.add_face(face);
  }
  return builder.take();
}

}  // namespace vspring::bench
