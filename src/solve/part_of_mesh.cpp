#include "solve/part_of_mesh.hpp"

#include "constraints/holding.hpp"
#include "vspring/error.hpp"

namespace vspring {

Net gather_part(const PolygonMesh& whole, const std::optional<ActiveSubmesh>& part, const Constraints& constraints,
                bool for_spheres) {
  if (!part) return gather_net(whole, constraints, for_spheres);
  Net net = gather_net(part->mesh, part->constraints, for_spheres);
  for (Index& node : net.node) node = part->node[static_cast<std::size_t>(node)];
  return net;
}

std::vector<Warning> check_part(const PolygonMesh& whole, const std::optional<ActiveSubmesh>& part,
                                const Constraints& constraints, std::span<const std::uint8_t> pulled) {
  refuse_corners(constraints);
  if (part) {
    std::vector<std::uint8_t> pulled_there;
    for (std::size_t k = 0; k < part->node.size() && !pulled.empty(); ++k)
      pulled_there.push_back(pulled[static_cast<std::size_t>(part->node[k])]);
    try {
      std::vector<Warning> warnings = check_constraints(part->mesh, part->constraints, pulled_there);
      if (warnings.empty()) return warnings;
    } catch (const Error&) {
      return check_constraints(whole, constraints, pulled);
    }
  }
  return check_constraints(whole, constraints, pulled);
}

}  // namespace vspring
