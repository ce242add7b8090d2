#pragma once

#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Faces one after the other (CSR), each from a face of a mesh.
struct FaceParcel {
  std::vector<Index> begin = {0};
  std::vector<Index> corners;
  std::vector<Index> from;

  [[nodiscard]] Index count() const { return static_cast<Index>(from.size()); }
  [[nodiscard]] std::span<const Index> face(Index face) const {
    const auto f = static_cast<std::size_t>(face);
    return std::span(corners).subspan(static_cast<std::size_t>(begin[f]),
                                      static_cast<std::size_t>(begin[f + 1] - begin[f]));
  }
  void add(std::span<const Index> nodes, Index of) {
    corners.insert(corners.end(), nodes.begin(), nodes.end());
    begin.push_back(static_cast<Index>(corners.size()));
    from.push_back(of);
  }
};

/// The edges of faces, numbered by their lower and then by their higher node. The edge of a corner leads to the next
/// corner of the face.
class EdgeTable {
 public:
  struct Edge {
    Index low;
    Index high;
    Index first_use;
  };

  /// Cost: linear in nodes and corners, but for nodes with many edges.
  EdgeTable(const FaceParcel& faces, Index node_count);

  [[nodiscard]] Index count() const { return static_cast<Index>(edges_.size()); }
  [[nodiscard]] const Edge& edge(Index edge) const { return edges_[static_cast<std::size_t>(edge)]; }
  /// Whether an edge joins two nodes. Cost: logarithmic.
  [[nodiscard]] bool joins(Index low, Index high) const;
  [[nodiscard]] Index of_corner(Index corner) const { return of_corner_[static_cast<std::size_t>(corner)]; }
  /// The corners whose edge it is, ascending.
  [[nodiscard]] std::span<const Index> uses(Index edge) const {
    const auto e = static_cast<std::size_t>(edge);
    const Index end = e + 1 < edges_.size() ? edges_[e + 1].first_use : static_cast<Index>(uses_.size());
    return std::span(uses_).subspan(static_cast<std::size_t>(edges_[e].first_use),
                                    static_cast<std::size_t>(end - edges_[e].first_use));
  }

 private:
  std::vector<Edge> edges_;
  std::vector<Index> uses_;
  std::vector<Index> of_corner_;
};

}  // namespace vspring
