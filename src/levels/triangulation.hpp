#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "shape/fan.hpp"
#include "spring/rings.hpp"

namespace vspring {

/// A triangulated surface that can lose nodes. It holds the neighbours of every node in order around it, in the node's
/// own sense, so one-sided surfaces need no care. Stored flat: every node has space for some more neighbours.
class Triangulation {
 public:
  /// closed: triangles all around; open: one fan at a boundary; fixed: anything else (none, several fans, an edge of
  /// more than two triangles). Fixed nodes and those next to them stay as they are.
  enum class Kind : std::uint8_t { closed, open, fixed };

  /// The triangulation of a mesh of triangles. Cost: linear, mostly on all threads.
  Triangulation(const PolygonMesh& mesh, ThreadTeam& team);

  /// The triangulation of the nodes kept, ascending, after all others were removed from `finer`; they get the numbers
  /// number[node].
  Triangulation(const Triangulation& finer, std::span<const std::uint32_t> kept, std::span<const std::uint32_t> number,
                ThreadTeam& team);

  [[nodiscard]] std::size_t size() const noexcept { return kind_.size(); }
  [[nodiscard]] Kind kind(std::size_t node) const { return kind_[node]; }
  /// The neighbours in order; at an open node from boundary to boundary. For a fixed node the codes of its links.
  [[nodiscard]] std::span<const std::uint32_t> ring(std::size_t node) const {
    return {rings_.data() + begin_[node], count_[node]};
  }
  /// Calls use(neighbour) for every neighbour; at a fixed node some come twice.
  template <typename Use>
  void for_each_neighbour(std::size_t node, const Use& use) const {
    for (const std::uint32_t code : ring(node)) use(code & Link::node_mask);
  }
  /// Whether an edge joins two nodes, the first of which is not fixed.
  [[nodiscard]] bool joined(std::size_t node, std::uint32_t other) const;

  /// Appends the links of a node to `rings`.
  void add_links(std::size_t node, std::vector<Link>& buffer, Rings& rings) const;

  /// Whether `node` may collapse into its neighbour ring(node)[place]: the result is a surface, and no node gets too
  /// few or too many neighbours. This is the link condition (Dey, Edelsbrunner, Guha, Nekhayev, "Topology preserving
  /// edge contraction", 1999). Nodes of a boundary can collapse only along it. `node` and its neighbours must not be
  /// fixed.
  [[nodiscard]] bool can_collapse(std::size_t node, std::size_t place) const;
  /// Collapses `node`, which has no ring afterwards.
  void collapse(std::size_t node, std::size_t place);

  /// Flips the edge from `node` to ring(node)[place] in the quadrilateral of its two triangles. None of the four nodes
  /// may be fixed, the edge must be an inner one, and the nodes that it will join must not be joined already.
  void flip(std::size_t node, std::size_t place);

  /// Fewest neighbours of a node of this kind: with fewer, triangles would coincide or an edge would have no triangle.
  [[nodiscard]] static std::size_t fewest(Kind kind) { return kind == Kind::closed ? 3 : 2; }
  /// Number of neighbours that there is space for.
  [[nodiscard]] std::size_t room(std::size_t node) const { return begin_[node + 1] - begin_[node]; }

 private:
  void make_room(const std::vector<std::uint32_t>& needed);
  std::uint32_t* first(std::size_t node) { return rings_.data() + begin_[node]; }
  [[nodiscard]] std::size_t place_of(std::size_t node, std::uint32_t neighbour) const;
  void erase(std::size_t node, std::uint32_t neighbour);
  /// Replaces one place of a ring by several, or none.
  void widen(std::size_t node, std::size_t at, std::size_t places);
  void replace(std::size_t node, std::uint32_t neighbour, std::uint32_t by);
  void insert_between(std::size_t node, std::uint32_t a, std::uint32_t b, std::uint32_t inserted);

  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> count_;
  std::vector<std::uint32_t> rings_;
  std::vector<Kind> kind_;
};

}  // namespace vspring
