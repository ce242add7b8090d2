#pragma once

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "shape/fan.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Faces of more sides are cut by with_large_faces_cut().
inline constexpr std::size_t largest_uncut_face = 128;

struct CutMesh {
  PolygonMesh mesh;
  std::set<std::pair<Index, Index>> cuts;  ///< the two nodes of each, the lower number first

  /// Says which links of a walk around a node lead along cuts.
  void mark(Index node, std::span<Link> links) const {
    for (Link& link : links) {
      if (cuts.contains(std::minmax(node, static_cast<Index>(link.node())))) link.make_cut();
    }
  }
};

/// A mesh with its largest faces cut between their nodes into pieces of at most 16 sides. The solver pairs each node
/// with all others of its face, which is quadratic in the size of the face. Cuts go from the outside in, so that pieces
/// join near nodes. None if no face is so large. A face stays whole if an edge of the mesh joins two nodes as a cut
/// would. Cost: linear.
std::optional<CutMesh> with_large_faces_cut(const PolygonMesh& mesh);

}  // namespace vspring
