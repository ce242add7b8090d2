#pragma once

#include <array>
#include <vector>

#include "span/network.hpp"

namespace vspring {

/// A curve of a network from one junction or corner to the next, both included; a closed one that meets no other
/// repeats its first node at the end.
struct Arc {
  std::vector<Index> nodes;  ///< of the network
  double length = 0;         ///< as a polygon
  /// At its first and last node, in its direction; zero where no curve goes on smoothly.
  std::array<Vector3, 2> tangents = {Vector3::Zero(), Vector3::Zero()};
  std::array<Index, 2> goes_on = {-1, -1};  ///< the end (see Arcs) at which a curve goes on smoothly; −1: none
};

/// The curves of a network. Half-arcs are arcs with a direction: 2a is arc a from its first node on, 2a + 1 from its
/// last node on. A half-arc also names the end of the arc at which it leaves.
class Arcs {
 public:
  /// Cuts a network at junctions and corners. Cost: linear.
  explicit Arcs(const Network& network);

  [[nodiscard]] const std::vector<Arc>& all() const noexcept { return arcs_; }
  [[nodiscard]] const Arc& of(Index half) const { return arcs_[static_cast<std::size_t>(half / 2)]; }

  /// The same arc in the other direction.
  [[nodiscard]] static Index reversed(Index half) { return half ^ 1; }
  [[nodiscard]] Index first_node(Index half) const {
    return half % 2 == 0 ? of(half).nodes.front() : of(half).nodes.back();
  }
  [[nodiscard]] Index last_node(Index half) const { return first_node(reversed(half)); }
  /// Node k along it, from 0 on.
  [[nodiscard]] Index node(Index half, std::size_t k) const {
    const std::vector<Index>& nodes = of(half).nodes;
    return nodes[half % 2 == 0 ? k : nodes.size() - 1 - k];
  }
  /// The network's nodes along it.
  [[nodiscard]] std::vector<Index> nodes_along(Index half) const;
  /// The unit direction in which it leaves its first node: of the circle through this and its places at a twentieth and
  /// a tenth of its length.
  [[nodiscard]] Vector3 leaving(Index half) const;
  /// Whether one goes on smoothly as the other, which leaves where it arrives.
  [[nodiscard]] bool goes_on(Index half, Index next) const {
    return of(half).goes_on[static_cast<std::size_t>(reversed(half) % 2)] == next;
  }

  /// The half-arcs that leave a node; none for nodes within arcs.
  [[nodiscard]] const std::vector<Index>& leaving_at(Index node) const {
    return leaving_at_[static_cast<std::size_t>(node)];
  }

 private:
  void follow(Index from, Index next);
  void find_tangents();
  [[nodiscard]] bool is_sharp(Index half) const;

  const Network& network_;
  std::vector<Arc> arcs_;
  std::vector<std::uint8_t> ends_arcs_;         ///< per node
  std::vector<std::vector<Index>> leaving_at_;  ///< per node
};

}  // namespace vspring
