#pragma once

#include <span>
#include <vector>

#include "vspring/export.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

/// A mesh of which some edges and faces are divided.
struct RefinedMesh {
  /// The nodes of the input, followed by new ones; the faces in the order of the input's, each divided one replaced by
  /// its parts.
  PolygonMesh mesh;
  /// New node k, whose number is k behind the input's last, is the mean of the nodes mean_of[mean_begin[k]] to
  /// mean_of[mean_begin[k + 1] - 1]: of the ends of an edge, or of the corners of a face. These have smaller numbers
  /// and may be new, too.
  std::vector<Index> mean_begin = {0};
  std::vector<Index> mean_of;  ///< see mean_begin
  /// Per face the face of the input that it is, or is a part of; ascending.
  std::vector<Index> face_from;

  /// How many nodes are new.
  [[nodiscard]] Index new_node_count() const noexcept { return static_cast<Index>(mean_begin.size()) - 1; }
  /// How many nodes the input has.
  [[nodiscard]] Index input_node_count() const noexcept { return mesh.node_count() - new_node_count(); }
  /// The nodes whose mean a new node is. node: its number in `mesh`.
  [[nodiscard]] std::span<const Index> means(Index node) const {
    const auto k = static_cast<std::size_t>(node - input_node_count());
    return std::span(mean_of).subspan(static_cast<std::size_t>(mean_begin[k]),
                                      static_cast<std::size_t>(mean_begin[k + 1] - mean_begin[k]));
  }

  /// Numbers at the nodes, such as colours, given those at the nodes of the input: new nodes get means. values: a
  /// multiple of the number of nodes of the input, those of one node together. Throws Error(invalid_argument) if they
  /// are no multiple. Cost: linear.
  [[nodiscard]] std::vector<double> at_nodes(std::span<const double> values) const;

  /// Edges, given those of the input: each divided one is replaced by its parts, in their order along it. edges: of
  /// nodes of the input. Throws Error(invalid_argument) naming a node that it does not have. Cost: n log n.
  [[nodiscard]] MeshEdges parts_of(const MeshEdges& edges) const;
};

}  // namespace vspring
