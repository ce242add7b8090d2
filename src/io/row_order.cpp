// Puts the rows of a file in order along the curve.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "io/curve_formats.hpp"
#include "vspring/curve_file.hpp"
#include "vspring/error.hpp"
#include "vspring/order.hpp"

namespace vspring {

Index order_nodes(CurveFile& file, bool closed) {
  if (file.source && !file.source->has_rows)
    throw Error(ErrorCode::invalid_argument,
                file.source->file.name + ": the file says itself in which order its nodes come",
                {{Remedy::order, "leave the order along the curve out"}});
  std::vector<PolygonCurve::Chain> chains = file.curve.chains();
  std::vector<Index> rows(file.curve.positions().size());
  std::iota(rows.begin(), rows.end(), 0);
  Index changed = 0;
  std::vector<Vector3> points;
  for (PolygonCurve::Chain& chain : chains) {
    points.clear();
    for (const Index node : chain.nodes) {
      points.push_back(file.curve.position(node));
      if (!points.back().allFinite())
        throw Error(
            ErrorCode::unusable_shape,
            fmt::format("node {}: its position is not finite, so it has no place in an order; remove it", node));
    }
    const std::vector<Index> slots = std::move(chain.nodes);
    chain.nodes.clear();
    for (const Index place : order_along_curve(points, closed || chain.closed)) {
      const Index node = slots[static_cast<std::size_t>(place)];
      const Index slot = slots[chain.nodes.size()];
      if (node != slot) ++changed;
      rows[static_cast<std::size_t>(slot)] = node;
      chain.nodes.push_back(node);
    }
  }
  file.curve = PolygonCurve(file.curve.positions(), std::move(chains));
  file.row_order = std::move(rows);
  return changed;
}

}  // namespace vspring
