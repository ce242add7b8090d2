#pragma once

#include <array>
#include <span>
#include <vector>

#include "shape/incidence.hpp"

namespace vspring {

/// Gathers the nodes around a node, ring by ring over the faces, until there are enough of them for a polynomial of
/// fourth degree. Work per node is bounded whatever the mesh. Holds a buffer, so use one per task.
class Neighbourhood {
 public:
  Neighbourhood(const PolygonMesh& mesh, const Incidence& incidence) : mesh_(&mesh), incidence_(&incidence) {}

  /// Fourteen coefficients, and some to spare: three rings of triangles (36 nodes), two of quads (24); at boundaries
  /// one or two rings more.
  static constexpr std::size_t enough = 20;
  /// Where these lie badly.
  static constexpr std::size_t plenty = 40;

  /// At least `wanted` nodes around where a few rings have them, without the node itself, with finite positions; valid
  /// until the next call.
  std::span<const Index> around(Index node, std::size_t wanted);

 private:
  // More than 64 nodes are looked up in it, so that runs stay short.
  static constexpr std::size_t slots = 256;
  struct Slot {
    Index node = -1;
    std::uint32_t round = 0;
  };
  void add_face(Corner corner);
  void add(Index node);

  const PolygonMesh* mesh_;
  const Incidence* incidence_;
  std::vector<Index> nodes_;
  std::array<Slot, slots> seen_;
  std::uint32_t round_ = 0;
};

}  // namespace vspring
