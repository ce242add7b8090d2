#include "shape/circle.hpp"
#include "shape/frame.hpp"
#include "vspring/curvature.hpp"

namespace vspring {

std::vector<double> curvatures(const PolygonCurve& curve) {
  Eigen::AlignedBox<double, 3> box;
  for (const PolygonCurve::Chain& chain : curve.chains()) {
    for (const Index node : chain.nodes) {
      if (curve.position(node).allFinite()) box.extend(curve.position(node));
    }
  }
  const Frame frame(box);
  std::vector<double> result(static_cast<std::size_t>(curve.node_count()), 0);
  for (const PolygonCurve::Chain& chain : curve.chains()) {
    const std::size_t count = chain.nodes.size();
    const auto at = [&](std::size_t k) { return frame.to_local(curve.position(chain.nodes[k % count])); };
    const std::size_t ends = chain.closed ? 0 : 1;
    for (std::size_t k = ends; k + ends < count; ++k)
      result[static_cast<std::size_t>(chain.nodes[k])] =
          frame.scale() * circle_curvature(at(k + count - 1), at(k), at(k + 1)).norm();
  }
  return result;
}

}  // namespace vspring
