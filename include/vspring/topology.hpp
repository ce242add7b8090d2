#pragma once

#include <string>
#include <vector>

#include "vspring/export.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

/// 1 for each node with an edge that belongs to one face only, else 0; one entry per node. Cost: linear.
[[nodiscard]] std::vector<std::uint8_t> boundary_nodes(const PolygonMesh& mesh);

/// The loops of boundary edges, each a list of nodes in order; the first node is not repeated at the end. Where more
/// than two boundary edges meet at a node, the faces between them separate the loops. Cost: linear.
[[nodiscard]] std::vector<std::vector<Index>> boundary_loops(const PolygonMesh& mesh);

/// The boundary loops as closed chains of a curve. It has all nodes of the mesh, with their numbers. Cost: linear.
[[nodiscard]] PolygonCurve boundary_curve(const PolygonMesh& mesh);

/// The component of every node, numbered from 0 in the order of their first nodes. Nodes that share a face are in one
/// component; an isolated node is a component of its own. Cost: linear.
[[nodiscard]] std::vector<Index> components(const PolygonMesh& mesh);

/// A defect of a mesh.
struct Defect {
  /// What is wrong, and which members name where.
  enum class Kind {
    not_finite,         ///< node: a coordinate is not finite
    isolated_node,      ///< node: no face uses it; it stays where it is
    too_few_nodes,      ///< face: fewer than three nodes
    repeated_node,      ///< face, node: the node occurs twice in the face
    duplicate_face,     ///< face: has the same nodes as the earlier face `other`
    non_manifold_edge,  ///< node, other: more than two faces share the edge between them
    non_manifold_node,  ///< node: its faces form more than one fan
    orientation,        ///< node, other: the two faces of this edge run along it in the same direction
    zero_length_edge,   ///< node, other: at the same position
    zero_area_face      ///< face: no area, so no normal
  };
  Kind kind;         ///< what is wrong
  Index node = -1;   ///< −1 where `kind` names none
  Index other = -1;  ///< a second node or an earlier face; −1 where `kind` names none
  Index face = -1;   ///< −1 where `kind` names none
  /// One line: names the element and says what is wrong.
  [[nodiscard]] std::string message() const;
};

/// Lists every defect of a mesh, ordered by kind, then by face or, without a face, by node. Each edge is named once;
/// `node` is the smaller of its ends. Cost: n log n in the faces.
[[nodiscard]] std::vector<Defect> check(const PolygonMesh& mesh);

/// The faces of three or more nodes without area, hence without normal. They include faces with a node twice, which
/// check() reports as repeated_node. Cost: linear.
[[nodiscard]] std::vector<Index> faces_without_area(const PolygonMesh& mesh);

}  // namespace vspring
