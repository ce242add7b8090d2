#pragma once

#include <cstdint>
#include <vector>

#include "shape/incidence.hpp"

namespace vspring {

/// One step of the walk around a node, through all other nodes of the faces around it (its link).
struct Link {
  static constexpr std::uint32_t spoke_bit = 1U << 31;
  static constexpr std::uint32_t start_bit = 1U << 30;
  static constexpr std::uint32_t node_mask = start_bit - 1;

  std::uint32_t code = 0;

  [[nodiscard]] std::size_t node() const noexcept { return code & node_mask; }
  /// An edge joins the node to its centre; a face ends here and the next begins.
  [[nodiscard]] bool spoke() const noexcept { return (code & spoke_bit) != 0; }
  /// A chain begins here, at a spoke: no face lies between this link and the one before it. A walk whose first link has
  /// no such mark is closed: a face lies between its last link and its first.
  [[nodiscard]] bool start() const noexcept { return (code & (spoke_bit | start_bit)) == (spoke_bit | start_bit); }
  /// A cut through a face, which is no edge (with_large_faces_cut()), leads from here to the centre: the face ends.
  [[nodiscard]] bool cut() const noexcept { return (code & (spoke_bit | start_bit)) == start_bit; }
  void make_cut() noexcept { code = (code & node_mask) | start_bit; }
};

/// The walk around one node, and what is wrong there.
struct Fan {
  std::vector<Link> links;
  /// Whether faces go all the way around.
  bool closed = false;
  /// Number of chains of faces joined by edges at the node. More than one: non-manifold; none: an isolated node.
  int chains = 0;
  /// A neighbour whose edge belongs to more than two faces, or −1.
  Index crowded_neighbour = -1;
  /// A neighbour along whose edge both faces run in the same direction, or −1. The walk turns such faces over.
  Index flipped_neighbour = -1;
  /// A face that meets the node more than once, or −1.
  Index repeating_face = -1;

  /// Whether the node is an inner or a boundary node of a manifold: it has a normal and may move.
  [[nodiscard]] bool manifold() const noexcept { return chains == 1 && crowded_neighbour < 0 && repeating_face < 0; }
};

/// Walks around nodes. Holds the buffers of a walk, so use one per thread.
class FanWalker {
 public:
  FanWalker(const PolygonMesh& mesh, const Incidence& incidence) : mesh_(&mesh), incidence_(&incidence) {}

  /// The fan of a node, in the sense of its first face where the orientation is consistent; valid until the next walk.
  /// Cost: d log d for d faces, of which there are few at most nodes.
  const Fan& walk(Index node);

 private:
  struct End {
    Index neighbour;
    Index side;  // 2 × corner, + 1 on the side of the previous node in the face
  };
  void find_neighbours();
  /// Pairs the sides of faces and returns true if consistently oriented faces lie all around. Else pairs are left
  /// incomplete.
  bool pair_all_around(Index node);
  void pair_sides(Index node);
  void walk_chain(Index first_side);
  void emit(Index node, std::uint32_t bits) { fan_.links.push_back({static_cast<std::uint32_t>(node) | bits}); }
  [[nodiscard]] Index neighbour(Index side) const { return neighbours_[static_cast<std::size_t>(side)]; }

  const PolygonMesh* mesh_;
  const Incidence* incidence_;
  std::span<const Corner> corners_;
  Fan fan_;
  std::vector<Index> neighbours_;  // of every side
  std::vector<End> ends_;
  std::vector<Index> twin_;
  std::vector<std::uint8_t> visited_;
};

}  // namespace vspring
