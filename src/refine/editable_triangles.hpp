#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// The ends of an edge.
using NodePair = std::pair<Index, Index>;

/// A surface of triangles whose edges can be split, collapsed and flipped. Edges may lie on lines, which have numbers;
/// these edges are never flipped.
class EditableTriangles {
 public:
  static constexpr Index no_line = -1;
  static constexpr Index fixed_line = -2;  ///< of edges that stay as they are

  struct Triangle {
    std::array<Index, 3> nodes = {-1, -1, -1};                 ///< the first is −1 once it is removed
    std::array<Index, 3> lines = {no_line, no_line, no_line};  ///< of the edges from each node to the next

    [[nodiscard]] bool is_there() const { return nodes[0] >= 0; }
    [[nodiscard]] Index node(std::size_t k) const { return nodes[k % 3]; }
    [[nodiscard]] Index line(std::size_t k) const { return lines[k % 3]; }
    [[nodiscard]] std::size_t place_of(Index node) const {
      return static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
    }
  };
  /// The triangles at an edge. Only edges of fixed_line may have more than two.
  struct Sides {
    std::size_t count = 0;
    std::array<Index, 2> triangle = {-1, -1};
    std::array<std::size_t, 2> corner = {0, 0};  ///< from which the triangle runs along the edge
  };

  explicit EditableTriangles(Index node_count) : around_(static_cast<std::size_t>(node_count)) {}

  void add(const Triangle& triangle);
  Index add_node();

  [[nodiscard]] Index node_count() const { return static_cast<Index>(around_.size()); }
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  [[nodiscard]] const Triangle& triangle(Index number) const { return triangles_[static_cast<std::size_t>(number)]; }
  /// The triangles at a node, by their numbers.
  [[nodiscard]] std::span<const Index> around(Index node) const { return around_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] Sides sides(Index a, Index b) const;
  [[nodiscard]] bool is_edge(Index a, Index b) const { return sides(a, b).count > 0; }
  /// The line of an edge that is there.
  [[nodiscard]] Index line_of(Index a, Index b) const;
  /// The nodes that share an edge with this one, ascending.
  [[nodiscard]] std::vector<Index> neighbours(Index node) const;
  /// Whether the triangles at a node follow each other around it, in one fan.
  [[nodiscard]] bool is_one_fan(Index node) const;
  /// All edges, the lower node first, ascending. Cost: n log n.
  [[nodiscard]] std::vector<NodePair> edges() const;

  /// Puts a node of no triangle into an edge. Its parts lie on the line of the whole.
  void split(Index a, Index b, Index middle);
  /// Whether an edge can shrink to nothing so that the surface stays one of the same kind: the link condition (Dey,
  /// Edelsbrunner, Guha, Nekhayev, "Topology preserving edge contraction", 1999), and no line falls upon another one.
  [[nodiscard]] bool can_collapse(Index a, Index b) const;
  /// Moves node `from` to `to`; the triangles between vanish, and so does the node.
  void collapse(Index from, Index to);
  /// Whether an edge of two triangles is on no line, and their other nodes are not joined.
  [[nodiscard]] bool can_flip(Index a, Index b) const;
  void flip(Index a, Index b);

 private:
  void remove(Index triangle);
  void set_line(Index a, Index b, Index line);
  Triangle& at(Index number) { return triangles_[static_cast<std::size_t>(number)]; }

  std::vector<Triangle> triangles_;
  std::vector<std::vector<Index>> around_;
};

}  // namespace vspring
