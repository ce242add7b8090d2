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
  std::set<std::pair<Index, Index>> cuts;  ///< the nodes that each joins, the lower number first

  /// Says which links of a walk around a node lead along cuts.
  void mark(Index node, std::span<Link> links) const {
    for (Link& link : links) {
      if (cuts.contains(std::minmax(node, static_cast<Index>(link.node())))) link.make_cut();
    }
  }
};

/// A mesh with its largest faces cut, between their nodes, into such of at most 16 sides: each node of a face looks at
/// all others of it, which in such large ones would take time and memory that go with their square. Cut from the
/// outside in, so that a node looks at those close by. None where no face is so large. Faces in which an edge of the
/// mesh joins two nodes as a cut would stay whole. Cost: linear.
std::optional<CutMesh> with_large_faces_cut(const PolygonMesh& mesh);

}  // namespace vspring
