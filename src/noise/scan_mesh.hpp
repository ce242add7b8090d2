#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "spring/net.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Lists of numbers, one after the other (CSR).
struct Lists {
  std::vector<std::uint32_t> begin = {0};
  std::vector<std::uint32_t> items;

  [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t k) const {
    return {items.data() + begin[k], begin[k + 1] - begin[k]};
  }
  void close() { begin.push_back(static_cast<std::uint32_t>(items.size())); }
};

/// Connectivity of the moving part of a surface, for filters of noise. Nodes are those of the net.
struct ScanMesh {
  std::size_t nodes = 0;
  std::size_t moving = 0;
  Lists neighbours;         ///< along edges, of every moving node
  Lists moving_neighbours;  ///< those neighbours that move
  Lists faces;              ///< corners of every face that has a moving node; neighbours go round in one sense
  Lists faces_of;           ///< of every moving node
  Lists around;             ///< per face, itself and the faces that share a node with it
};

/// Cost: linear in the mesh.
ScanMesh scan_mesh(const Net& net, const PolygonMesh& mesh);

/// The vector area of every face: half the sum of cross products of successive corners. Cost: linear.
std::vector<Vector3> face_areas(const ScanMesh& mesh, const std::vector<Vector3>& places, ThreadTeam& team);

/// Unit normals of the moving nodes, from the sums of the vector areas of their faces; zero if that sum is zero.
std::vector<Vector3> node_normals(const ScanMesh& mesh, const std::vector<Vector3>& places, ThreadTeam& team);

}  // namespace vspring
