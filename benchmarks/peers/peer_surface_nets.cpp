// The smoothing of surface nets, S. F. F. Gibson, "Constrained Elastic Surface Nets", MICCAI 1998: every node goes half
// the way to the mean of its neighbours, all at once as in newer VTK's vtkConstrainedSmoothingFilter, and stays within
// half a voxel, along each axis, of where it was. Corners of voxels are the nodes of a surface net. The variant is the
// number of such steps and the size of the voxels along x, y and z, "16; 1 1 3".

#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "driver.hpp"

using namespace vspring;

int main(int argc, char** argv) {
  return bench::drive(argc, argv, [](const PolygonMesh& mesh, int, const std::string& variant, bench::Cost& cost) {
    int steps = 0;
    char separator = 0;
    Vector3 size = Vector3::Zero();
    if (!(std::istringstream(variant) >> steps >> separator >> size.x() >> size.y() >> size.z()))
      throw std::runtime_error("the variant is: STEPS; X Y Z");
    const std::vector<Vector3>& start = mesh.positions();
    std::vector<Vector3> positions = start;
    cost = bench::measure([&] {
      const auto neighbours = bench::neighbours_of(mesh);
      for (int step = 0; step < steps; ++step) {
        const std::vector<Vector3> before = positions;
        for (std::size_t i = 0; i < positions.size(); ++i) {
          if (neighbours[i].empty()) continue;
          Vector3 sum = Vector3::Zero();
          for (const Index j : neighbours[i]) sum += before[static_cast<std::size_t>(j)];
          const Vector3 half_way = (sum / static_cast<double>(neighbours[i].size()) + before[i]) / 2;
          positions[i] = half_way.cwiseMax(start[i] - size / 2).cwiseMin(start[i] + size / 2);
        }
      }
    });
    return positions;
  });
}
