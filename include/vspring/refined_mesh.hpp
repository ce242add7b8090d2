#pragma once

#include <span>
#include <vector>

#include "vspring/export.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

/// A mesh of which some edges and faces are divided, or of which a part has other triangles.
struct RefinedMesh {
  /// The nodes of the input, but for those removed, followed by new ones; the faces in the order of the input's, each
  /// divided one replaced by its parts.
  PolygonMesh mesh;
  /// New node k is the mean of the nodes mean_of[mean_begin[k]] to mean_of[mean_begin[k + 1] - 1]: of the ends of an
  /// edge, or of the corners of a face. There the nodes of the input have their numbers, and new node k the number k
  /// behind its last. These have smaller numbers and may be new, too.
  std::vector<Index> mean_begin = {0};
  std::vector<Index> mean_of;  ///< see mean_begin
  /// Per face the face of the input that it is, or is a part of; ascending.
  std::vector<Index> face_from;
  /// Of remesh(): the shares of these nodes in their mean, which sum up to 1, as many as mean_of has; empty: all are
  /// equal.
  std::vector<double> shares = {};
  /// Of remesh(): per new node the face of the input whose corners mean_of names.
  std::vector<Index> mean_face = {};
  /// Of remesh(): nodes of the input that the mesh does not have; ascending.
  std::vector<Index> removed = {};

  /// Whether it may lack nodes of the input, and faces have other nodes than parts of them would have.
  [[nodiscard]] bool is_remeshed() const noexcept { return !removed.empty() || !mean_face.empty(); }
  /// How many nodes are new.
  [[nodiscard]] Index new_node_count() const noexcept { return static_cast<Index>(mean_begin.size()) - 1; }
  /// How many nodes of the input the mesh has. They come first, in their order.
  [[nodiscard]] Index kept_node_count() const noexcept { return mesh.node_count() - new_node_count(); }
  /// How many nodes the input has.
  [[nodiscard]] Index input_node_count() const noexcept {
    return kept_node_count() + static_cast<Index>(removed.size());
  }
  /// The nodes whose mean a new node is, numbered as in mean_of. node: its number in `mesh`.
  [[nodiscard]] std::span<const Index> means(Index node) const {
    const auto k = static_cast<std::size_t>(node - kept_node_count());
    return std::span(mean_of).subspan(static_cast<std::size_t>(mean_begin[k]),
                                      static_cast<std::size_t>(mean_begin[k + 1] - mean_begin[k]));
  }
  /// The mean at a new node of what value(of) says of each of means(node).
  template <typename Value>
  [[nodiscard]] double mean(Index node, const Value& value) const {
    const auto of = means(node);
    const auto first = static_cast<std::size_t>(mean_begin[static_cast<std::size_t>(node - kept_node_count())]);
    double sum = 0;
    for (std::size_t j = 0; j < of.size(); ++j) sum += shares.empty() ? value(of[j]) : shares[first + j] * value(of[j]);
    return shares.empty() ? sum / static_cast<double>(of.size()) : sum;
  }
  /// Per node of `mesh` its number in mean_of. Cost: linear.
  [[nodiscard]] std::vector<Index> numbers_in_means() const;

  /// Numbers at the nodes, such as colours, given those at the nodes of the input: new nodes get means. values: a
  /// multiple of the number of nodes of the input, those of one node together. Throws Error(invalid_argument) if they
  /// are no multiple. Cost: linear.
  [[nodiscard]] std::vector<double> at_nodes(std::span<const double> values) const;

  /// Edges, given those of the input: each divided one is replaced by its parts, in their order along it. edges: of
  /// nodes of the input, of which none is removed. Throws Error(invalid_argument) naming a node that it does not have.
  /// Cost: n log n.
  [[nodiscard]] MeshEdges parts_of(const MeshEdges& edges) const;
};

}  // namespace vspring
