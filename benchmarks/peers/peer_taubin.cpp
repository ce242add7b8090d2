// The signal processing of G. Taubin, "A Signal Processing Approach to Fair Surface Design", SIGGRAPH 1995: a step of
// λ towards the mean of the neighbours and one of μ away from it in turn, λ 0.5 and μ −0.53. Two outer rings stay. The
// variant is the number of such pairs.

#include <string>
#include <vector>

#include "driver.hpp"

namespace {

using namespace vspring;

/// Neighbours along edges, each as often as a face has it beside the node.
std::vector<std::vector<Index>> neighbours_of(const PolygonMesh& mesh) {
  std::vector<std::vector<Index>> neighbours(static_cast<std::size_t>(mesh.node_count()));
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      auto& around = neighbours[static_cast<std::size_t>(face[k])];
      around.push_back(face[(k + 1) % face.size()]);
      around.push_back(face[(k + face.size() - 1) % face.size()]);
    }
  }
  return neighbours;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::drive(argc, argv, [](const PolygonMesh& mesh, int, const std::string& variant, bench::Cost& cost) {
    std::vector<Vector3> positions = mesh.positions();
    cost = bench::measure([&] {
      const auto neighbours = neighbours_of(mesh);
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
