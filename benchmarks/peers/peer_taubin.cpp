// The signal processing of G. Taubin, "A Signal Processing Approach to Fair Surface Design", SIGGRAPH 1995: a step of
// λ towards the mean of the neighbours and one of μ away from it in turn, λ 0.5 and μ −0.53. Two outer rings stay. The
// variant is the number of such pairs.

#include <string>
#include <vector>

#include "driver.hpp"

using namespace vspring;

int main(int argc, char** argv) {
  return bench::drive(argc, argv, [](const PolygonMesh& mesh, int, const std::string& variant, bench::Cost& cost) {
    std::vector<Vector3> positions = mesh.positions();
    cost = bench::measure([&] {
      const auto neighbours = bench::neighbours_of(mesh);
      const std::vector<std::uint8_t> held = bench::two_outer_rings(mesh);
      for (int pair = 0; pair < std::stoi(variant); ++pair) {
        for (const double factor : {0.5, -0.53}) {
          const std::vector<Vector3> before = positions;
          for (std::size_t i = 0; i < positions.size(); ++i) {
            if (held[i] != 0 || neighbours[i].empty()) continue;
            Vector3 sum = Vector3::Zero();
            for (const Index j : neighbours[i]) sum += before[static_cast<std::size_t>(j)];
            positions[i] += factor * (sum / static_cast<double>(neighbours[i].size()) - before[i]);
          }
        }
      }
    });
    return positions;
  });
}
