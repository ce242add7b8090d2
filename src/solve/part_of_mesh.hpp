#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "constraints/active_submesh.hpp"
#include "spring/net.hpp"

namespace vspring {

// A mesh under constraints of which, where only a small part moves, that part is worked on. All numbers of nodes are
// those of the whole mesh.

/// As gather_net() of the whole, in what the part costs.
Net gather_part(const PolygonMesh& whole, const std::optional<ActiveSubmesh>& part, const Constraints& constraints,
                bool for_spheres = false);

/// As check_constraints() of the whole; in what the part costs where nothing is to be said.
std::vector<Warning> check_part(const PolygonMesh& whole, const std::optional<ActiveSubmesh>& part,
                                const Constraints& constraints, std::span<const std::uint8_t> pulled = {});

/// The members of the part, in its order.
template <typename Value>
std::vector<Value> values_of(const std::vector<Value>& values, const std::vector<Index>& nodes) {
  std::vector<Value> part;
  part.reserve(nodes.size());
  for (const Index node : nodes) part.push_back(values[static_cast<std::size_t>(node)]);
  return part;
}

}  // namespace vspring
