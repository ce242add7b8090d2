#pragma once

#include <cstddef>
#include <vector>

#include "base/threads.hpp"
#include "noise/scan_mesh.hpp"

namespace vspring {

using Places = std::vector<Vector3>;

/// The expected squared distance of shapes from the true one at each moving node, less a common term: the squared
/// distance from the noisy nodes, plus twice the noise that they follow (C. M. Stein, "Estimation of the mean of a
/// multivariate normal distribution", Ann. Stat. 9, 1981). Single values are unreliable, means over many nodes are not.
struct Risks {
  std::size_t shapes = 0;
  std::vector<double> values;  ///< of all shapes at the first node, then at the next
  std::vector<double> means;   ///< per shape, over all nodes
};

/// How risks are averaged, and how strongly the least one counts.
struct Choice {
  int steps;      ///< total number of steps half-way to the neighbours' mean
  double whole;   ///< share of the means over all nodes
  double weight;  ///< a shape's weight falls by e if its risk is higher by deviation²/weight
};

/// noisy, and shapes: places of all nodes. normals: of the moving ones; only distances along them count. followed: how
/// much a shape's node follows its own noise, 0 to 1; of all shapes at the first moving node, then at the next.
/// deviation: of the noise.
Risks risks_of(const ScanMesh& mesh, const std::vector<const Places*>& shapes, const Places& noisy,
               const std::vector<Vector3>& normals, const std::vector<double>& followed, double deviation,
               ThreadTeam& team);

/// Returns for each choice the shapes' mean at each node, weighted by exp(−weight · risk). Steps must ascend. The same
/// bits on any number of threads. Cost: linear, and that of the steps.
std::vector<Places> choose(const ScanMesh& mesh, const std::vector<const Places*>& shapes, Risks risks,
                           std::span<const Choice> choices, double deviation, ThreadTeam& team);

}  // namespace vspring
