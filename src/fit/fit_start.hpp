#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "vspring/point_file.hpp"

namespace vspring {

/// Which node each point is tied to at first.
struct FitStart {
  std::vector<Index> nearest;    ///< node nearest to every point, of those that face as it does where there are any
  std::vector<Vector3> normals;  ///< of the points, in the sense of the faces; empty where none are of use
  /// By what the normals of points were multiplied: −1 if they were clearly opposite to the faces, 0 if they fit in
  /// neither sense.
  int sense = 1;
};

/// Which way a surface faces.
struct SurfaceSides {
  std::vector<Vector3> normals;  ///< of the faces around each node, in their sense; zero where there are none
  double mean_edge = 0;
};

/// places: of all nodes. usable: 0 for those that do not count. sides: empty where that does not matter. Throws as
/// nearest_nodes(). Cost: n log n.
FitStart fit_start(const ScatteredPoints& points, const std::vector<Vector3>& places,
                   std::span<const std::uint8_t> usable, const SurfaceSides& sides, ThreadTeam& team);

}  // namespace vspring
