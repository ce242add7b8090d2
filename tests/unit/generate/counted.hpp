#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// What a mesh consists of, counted without the library.
struct Counted {
  Index nodes = 0;
  Index edges = 0;
  Index faces = 0;
  Index isolated_nodes = 0;
  std::vector<std::vector<Index>> boundaries;  ///< loops of nodes
  /// No edge is passed twice in one direction.
  bool oriented = true;
  std::vector<Index> degrees;  ///< edges at each node

  [[nodiscard]] Index euler() const { return nodes - edges + faces; }
  [[nodiscard]] Index boundary_nodes() const {
    Index count = 0;
    for (const auto& loop : boundaries) count += static_cast<Index>(loop.size());
    return count;
  }
};

inline Counted count(const PolygonMesh& mesh) {
  const auto key = [](Index from, Index to) {
    return static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint64_t>(to);
  };
  std::vector<std::uint64_t> sides;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto nodes = mesh.face(f);
    for (std::size_t k = 0; k < nodes.size(); ++k) sides.push_back(key(nodes[k], nodes[(k + 1) % nodes.size()]));
  }
  std::sort(sides.begin(), sides.end());

  Counted counted;
  counted.nodes = mesh.node_count();
  counted.faces = mesh.face_count();
  counted.oriented = std::adjacent_find(sides.begin(), sides.end()) == sides.end();
  counted.degrees.assign(static_cast<std::size_t>(mesh.node_count()), 0);
  std::vector<Index> next(static_cast<std::size_t>(mesh.node_count()), -1);
  for (const std::uint64_t side : sides) {
    const auto from = static_cast<Index>(side >> 32);
    const auto to = static_cast<Index>(side & 0xffffffffU);
    const bool shared = std::binary_search(sides.begin(), sides.end(), key(to, from));
    if (!shared) next[static_cast<std::size_t>(from)] = to;
    if (shared && from > to) continue;
    ++counted.edges;
    ++counted.degrees[static_cast<std::size_t>(from)];
    ++counted.degrees[static_cast<std::size_t>(to)];
  }
  counted.isolated_nodes = static_cast<Index>(std::count(counted.degrees.begin(), counted.degrees.end(), 0));
  for (Index& first : next) {
    if (first < 0) continue;
    std::vector<Index> loop;
    Index node = first;
    while (node >= 0) {
      loop.push_back(node);
      node = std::exchange(next[static_cast<std::size_t>(node)], -1);
    }
    loop.pop_back();  // it ends where it began
    counted.boundaries.push_back(std::move(loop));
  }
  return counted;
}

/// Vector area of a face: its area times its normal.
inline Vector3 face_vector(const PolygonMesh& mesh, Index face) {
  const auto nodes = mesh.face(face);
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
    const Vector3& origin = mesh.position(nodes[0]);
    sum += 0.5 * (mesh.position(nodes[k]) - origin).cross(mesh.position(nodes[k + 1]) - origin);
  }
  return sum;
}

inline Vector3 face_middle(const PolygonMesh& mesh, Index face) {
  Vector3 sum = Vector3::Zero();
  for (const Index node : mesh.face(face)) sum += mesh.position(node);
  return sum / static_cast<double>(mesh.face(face).size());
}

/// Least of face normal · outward direction at the middle of the face, over all faces.
inline double least_outwardness(const PolygonMesh& mesh, const std::function<Vector3(const Vector3&)>& outward) {
  double least = 1;
  for (Index f = 0; f < mesh.face_count(); ++f)
    least = std::min(least, face_vector(mesh, f).normalized().dot(outward(face_middle(mesh, f)).normalized()));
  return least;
}

/// Greatest absolute value of a function over all nodes.
inline double greatest_deviation(const PolygonMesh& mesh, const std::function<double(const Vector3&)>& deviation) {
  double greatest = 0;
  for (const Vector3& position : mesh.positions()) greatest = std::max(greatest, std::abs(deviation(position)));
  return greatest;
}

/// Least angle of all faces, degrees.
inline double least_angle(const PolygonMesh& mesh) {
  double least = 180;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto nodes = mesh.face(f);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Vector3& corner = mesh.position(nodes[k]);
      const Vector3 to_next = mesh.position(nodes[(k + 1) % nodes.size()]) - corner;
      const Vector3 to_last = mesh.position(nodes[(k + nodes.size() - 1) % nodes.size()]) - corner;
      const double angle = std::atan2(to_next.cross(to_last).norm(), to_next.dot(to_last));
      least = std::min(least, angle * 180 / std::numbers::pi);
    }
  }
  return least;
}

}  // namespace vspring
