#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "shape/places.hpp"
#include "vspring/figures.hpp"

namespace vspring {

namespace {

/// nodes: of a face or an edge, which is measured if one of them moves.
void require_measurable(std::span<const Index> nodes, const std::vector<Vector3>& positions,
                        const Constraints* constraints) {
  const auto moves = [&](Index node) { return constraints == nullptr || !constraints->position_fixed(node); };
  if (std::any_of(nodes.begin(), nodes.end(), moves)) require_places(nodes, positions);
}

}  // namespace

void check_measurable(const PolygonMesh& mesh, const Constraints* constraints) {
  for (Index face = 0; face < mesh.face_count(); ++face)
    require_measurable(mesh.face(face), mesh.positions(), constraints);
}

void check_measurable(const PolygonCurve& curve, const Constraints* constraints) {
  for (const PolygonCurve::Chain& chain : curve.chains()) {
    const std::span<const Index> nodes(chain.nodes);
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
      require_measurable(nodes.subspan(k, 2), curve.positions(), constraints);
    if (chain.closed && !nodes.empty())
      require_measurable(std::array{nodes.back(), nodes.front()}, curve.positions(), constraints);
  }
}

}  // namespace vspring
