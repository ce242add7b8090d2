#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shape/fan.hpp"
#include "shape/incidence.hpp"

namespace vspring {

/// How far from a boundary points may be to tell where it is, in its median edges.
inline constexpr double boundary_reach_in_edges = 2;

/// The boundary edges of a mesh and their succession.
class Boundary {
 public:
  /// Mesh and incidence must outlive it. inside: 1 for nodes known to have closed fans, which are skipped; may be
  /// empty. Cost: linear.
  Boundary(const PolygonMesh& mesh, const Incidence& incidence, std::span<const std::uint8_t> inside = {});

  /// As boundary_nodes().
  [[nodiscard]] const std::vector<std::uint8_t>& nodes() const noexcept { return nodes_; }
  /// As boundary_loops().
  [[nodiscard]] std::vector<std::vector<Index>> loops() const;

 private:
  struct Edge {
    Index low;
    Index high;
    bool forward;  // the face runs from low to high
  };

  // A side is an edge directed to one of its ends: 2 × edge to the low one, + 1 to the high one.
  [[nodiscard]] Index node(std::size_t side) const {
    return side % 2 == 0 ? edges_[side / 2].low : edges_[side / 2].high;
  }
  [[nodiscard]] std::size_t side_towards(Index from, Index to) const;
  /// Per side the next one, around the node that it leads to; none at the end of a chain.
  [[nodiscard]] std::vector<std::size_t> next_sides() const;
  void join_chains(Index i, const Fan& fan, std::vector<std::size_t>& next) const;

  const PolygonMesh* mesh_;
  const Incidence* incidence_;
  std::vector<Edge> edges_;  // ascending
  std::vector<std::uint8_t> nodes_;
};

}  // namespace vspring
