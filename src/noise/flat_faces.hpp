#pragma once

#include <span>
#include <vector>

#include "base/threads.hpp"
#include "noise/scan_mesh.hpp"

namespace vspring {

/// Makes normals of faces like those of their neighbours, except across sharp edges. Normals become means over faces
/// that share a node, weighted by area, nearness and likeness (Y. Zheng, H. Fu, O. K.-C. Au, C.-L. Tai, "Bilateral
/// normal filtering for mesh denoising", IEEE TVCG 17, 2011), again and again; then nodes move until faces have them
/// (X. Sun, P. L. Rosin, R. R. Martin, F. C. Langbein, "Fast and effective feature-preserving mesh denoising", IEEE
/// TVCG 13, 2007). Returns a shape for each number of rounds; these must ascend. Held nodes stay. Cost: linear; the
/// same bits on any number of threads.
std::vector<std::vector<Vector3>> with_flat_faces(const ScanMesh& mesh, const std::vector<Vector3>& places,
                                                  std::span<const int> turns, ThreadTeam& team);

}  // namespace vspring
