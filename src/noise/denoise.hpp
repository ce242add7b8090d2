#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/threads.hpp"
#include "noise/risk.hpp"
#include "noise/scan_mesh.hpp"

namespace vspring {

/// Removes noise from a surface. Candidates are low passes of all lengths, and shapes made of these whose faces are
/// flat up to sharp edges. At each node they are averaged; those expected to be nearest to the true shape around it
/// count most.
///
/// noisy: places of all nodes. known: per moving node, 0 for outliers, whose places are ignored; empty: no outliers.
/// deviation: of the noise in each coordinate. ended: asked between steps; once it returns true the result is useless.
/// Held nodes stay. The same bits on any number of threads. Cost: linear, about 1,000 means over neighbours. Memory:
/// about 2,000 bytes a node.
Places without_noise(const ScanMesh& mesh, Places noisy, const std::vector<std::uint8_t>& known, double deviation,
                     const std::function<bool()>& ended, ThreadTeam& team);

}  // namespace vspring
