#pragma once

#include <vector>

#include "span/curve_nodes.hpp"
#include "span/end_normals.hpp"
#include "vspring/span.hpp"

namespace vspring {

/// A surface over a network, cut along sharp curves into sheets that have nodes of their own there.
struct HeldSurface {
  PolygonMesh mesh;           ///< the surface's nodes, followed by further copies of those on sharp curves
  std::vector<Index> origin;  ///< per copy the node that it copies
  Constraints constraints = Constraints(0);  ///< positions on curves, normals where sheets end
  Index symmetric_nodes = 0;                 ///< nodes of ends in the plane of symmetry
};

/// Holds the nodes on curves, and gives normals where the surface ends and along sharp curves, as span_curves() says.
/// spanned: the numbers of the spanned loops of `surface`, and their half-arcs. Cost: n log n.
HeldSurface hold_curves(const SpannedCurves& surface, const CurveNodes& nodes, const Arcs& arcs,
                        const std::vector<std::size_t>& numbers, const std::vector<Loop>& spanned,
                        const std::optional<MirrorPlane>& symmetry);

}  // namespace vspring
