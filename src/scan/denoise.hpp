#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/threads.hpp"
#include "scan/risk.hpp"
#include "scan/scan_mesh.hpp"

namespace vspring {

/// A noisy surface without its noise. Low passes of all lengths, and shapes made of these whose faces are flat up to
/// sharp edges, stand to choose from; at each node they are averaged, those most that are expected to be nearest to the
/// true shape around it.
///
/// noisy: places of all nodes. known: of the moving ones, 0 for outliers, whose places tell nothing; empty: all do.
/// deviation: of the noise in each coordinate. ended: asked between steps; once it says yes the result is of no use.
/// Held nodes stay. The same bits on any number of threads. Cost: linear, some 1,000 means over neighbours. Memory:
/// about 2,000 bytes a node.
Places without_noise(const ScanMesh& mesh, Places noisy, const std::vector<std::uint8_t>& known, double deviation,
                     const std::function<bool()>& ended, ThreadTeam& team);

}  // namespace vspring
