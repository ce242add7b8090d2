#pragma once

#include "base/threads.hpp"
#include "vspring/fairness.hpp"

namespace vspring {

/// As the public one, on a team of threads.
Fairness measure(const PolygonMesh& mesh, const Constraints* constraints, ThreadTeam& team);

}  // namespace vspring
