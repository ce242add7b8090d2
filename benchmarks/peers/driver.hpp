#pragma once

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "memory.hpp"
#include "vspring/vspring.hpp"

/// What the drivers have in common: DRIVER MESH RESULT THREADS [VARIANT] reads a mesh, has one program fair it, writes
/// the result and prints the seconds and the mebibytes that the program's own call took.
namespace vspring::bench {

struct Cost {
  double seconds = 0;
  double mebibytes = 0;  ///< peak of resident memory during the call above what was resident when it began
};

template <typename Call>
Cost measure(const Call& call) {
  malloc_trim(0);  // what was freed before must not serve the call for nothing
  forget_peak_memory();
  const double before = resident_mebibytes();
  const auto begin = std::chrono::steady_clock::now();
  call();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return {seconds, peak_memory_mebibytes() - before};
}

/// 1 for the boundary and the nodes next to it. Programs that know no normals hold a tangent plane by the positions of
/// these two rings: the boundary and the ring beside it are all that the bi-Laplacian at a moving node refers to.
inline std::vector<std::uint8_t> two_outer_rings(const PolygonMesh& mesh) {
  const std::vector<std::uint8_t> boundary = boundary_nodes(mesh);
  std::vector<std::uint8_t> rings = boundary;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const auto on_boundary = [&](Index node) { return boundary[static_cast<std::size_t>(node)] != 0; };
    if (std::none_of(face.begin(), face.end(), on_boundary)) continue;
    for (const Index node : face) rings[static_cast<std::size_t>(node)] = 1;
  }
  return rings;
}

/// Neighbours along edges, each as often as a face has it beside the node.
inline std::vector<std::vector<Index>> neighbours_of(const PolygonMesh& mesh) {
  std::vector<std::vector<Index>> neighbours(static_cast<std::size_t>(mesh.node_count()));
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      auto& around = neighbours[static_cast<std::size_t>(face[k])];
      around.push_back(face[(k + 1) % face.size()]);
      around.push_back(face[(k + face.size() - 1) % face.size()]);
    }
  }
  return neighbours;
}

/// Changes a mesh by one program.
/// program(mesh, threads, variant, cost): returns the new mesh, and in cost what its call took.
template <typename Program>
int drive_meshes(int argc, char** argv, const Program& program) {
  try {
    if (argc < 4) throw std::runtime_error("usage: DRIVER MESH RESULT THREADS [VARIANT]");
    const PolygonMesh mesh = read_surface(argv[1]).mesh;
    Cost cost;
    write_surface(argv[2], program(mesh, std::atoi(argv[3]), std::string(argc > 4 ? argv[4] : ""), cost));
    fmt::print("{} {}\n", cost.seconds, cost.mebibytes);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return 1;
  }
}

/// Fairs a mesh by one program.
/// program(mesh, threads, variant, cost): returns the new positions, and in cost what its call took.
template <typename Program>
int drive(int argc, char** argv, const Program& program) {
  return drive_meshes(argc, argv, [&](PolygonMesh mesh, int threads, const std::string& variant, Cost& cost) {
    mesh.set_positions(program(mesh, threads, variant, cost));
    return mesh;
  });
}

}  // namespace vspring::bench
