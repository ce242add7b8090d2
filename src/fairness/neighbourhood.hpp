#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "shape/incidence.hpp"

namespace vspring {

/// Per node the other nodes of its faces, each once and in a fixed order; neighbourhoods are gathered from these.
class FaceNeighbours {
 public:
  /// usable: one entry per node, 0 for nodes to leave out. At hubs of many faces and in large faces only some nodes are
  /// taken, so memory stays linear. Cost: linear.
  FaceNeighbours(const PolygonMesh& mesh, const Incidence& incidence, std::span<const std::uint8_t> usable,
                 ThreadTeam& team);

  [[nodiscard]] std::span<const Index> of(Index node) const {
    const auto i = static_cast<std::size_t>(node);
    const Part& part = parts_[i / nodes_per_task];
    const std::size_t k = i % nodes_per_task;
    return {part.nodes.data() + part.begin[k], part.begin[k + 1] - part.begin[k]};
  }

 private:
  struct Part {
    std::vector<std::uint32_t> begin = {0};
    std::vector<Index> nodes;
  };
  std::vector<Part> parts_;
};

/// Gathers the nodes around a node, ring by ring over the faces, until there are enough for a polynomial of fourth
/// degree. The work per node is bounded for any mesh. Holds a buffer, so use one per task.
class Neighbourhood {
 public:
  explicit Neighbourhood(const FaceNeighbours& neighbours) : neighbours_(&neighbours) {}

  /// Fourteen coefficients, and some to spare: three rings of triangles (36 nodes), two of quads (24); at boundaries
  /// one or two rings more.
  static constexpr std::size_t enough = 20;
  /// If these do not determine the polynomial.
  static constexpr std::size_t plenty = 40;
  /// An upper bound.
  static constexpr std::size_t most_nodes = 96;

  void go_to(Index node);
  /// At least `wanted` nodes around, if a few rings have them, without the node itself; valid until the next call.
  std::span<const Index> around(std::size_t wanted);

 private:
  static constexpr std::size_t fewest_rings = 2;
  static constexpr std::size_t most_rings = 5;
  // Much more than the nodes stored, so probe runs stay short.
  static constexpr std::size_t slots = 256;
  struct Slot {
    Index node = -1;
    std::uint32_t round = 0;
  };
  void add(Index node);
  void add_ring();

  const FaceNeighbours* neighbours_;
  std::vector<Index> nodes_;
  std::array<std::size_t, most_rings + 1> end_{};  // of each gathered ring; the first is the node itself
  std::size_t rings_ = 0;
  std::array<Slot, slots> seen_;
  std::uint32_t round_ = 0;
};

}  // namespace vspring
