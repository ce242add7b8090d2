#pragma once

#include <cstddef>
#include <vector>

#include "base/threads.hpp"
#include "scan/scan_mesh.hpp"

namespace vspring {

using Places = std::vector<Vector3>;

/// How far shapes are expected to be from the true one at each moving node, in squares and but for a term that all
/// share: how far they are from the noisy nodes, and twice the noise that they follow (C. M. Stein, "Estimation of the
/// mean of a multivariate normal distribution", Ann. Stat. 9, 1981). Single values tell little, means over many nodes
/// much.
struct Risks {
  std::size_t shapes = 0;
  std::vector<double> values;  ///< of every shape at the first node, then at the next
  std::vector<double> means;   ///< of every shape, over all nodes
};

/// How risks are averaged, and how sharply the least counts.
struct Choice {
  int steps;      ///< half-way to the neighbours' mean, in all
  double whole;   ///< share of the means over all nodes
  double weight;  ///< a shape's weight falls by e where its risk is higher by 1/weight squares of the noise
};

/// noisy, and shapes: places of all nodes. normals: of the moving ones; only distances along them count. followed: how
/// much a shape's nodes follow the noise of their own, from 0 to 1, of every shape at the first moving node, then at
/// the next. deviation: of the noise.
Risks risks_of(const ScanMesh& mesh, const std::vector<const Places*>& shapes, const Places& noisy,
               const std::vector<Vector3>& normals, const std::vector<double>& followed, double deviation,
               ThreadTeam& team);

/// For each choice the shapes' means at each node, weighted by exp(−weight · risk). Steps must rise. The same bits on
/// any number of threads. Cost: linear, and that of the steps.
std::vector<Places> choose(const ScanMesh& mesh, const std::vector<const Places*>& shapes, Risks risks,
                           std::span<const Choice> choices, double deviation, ThreadTeam& team);

}  // namespace vspring
