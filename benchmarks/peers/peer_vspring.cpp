// vspring's fair() to the equilibrium, boundary positions and normals held. Variant "sphere": the normals of the unit
// sphere; "rings": two outer rings held by position, as other programs hold them, which give the inner one its tangent
// planes; otherwise the boundary's normals as they are in the mesh. With ",bending" behind it fair by least bending.

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "driver.hpp"
#include "support/surfaces.hpp"

using namespace vspring;

namespace {

Constraints hold_rings(const PolygonMesh& mesh) {
  Constraints constraints(mesh.node_count());
  const std::vector<std::uint8_t> held = bench::two_outer_rings(mesh);
  std::vector<Index> moving;
  for (Index node = 0; node < mesh.node_count(); ++node) {
    if (held[static_cast<std::size_t>(node)] == 0) moving.push_back(node);
  }
  restrict_to_region(constraints, mesh, moving);
  return constraints;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::drive(
      argc, argv, [](const PolygonMesh& mesh, int threads, const std::string& words, bench::Cost& cost) {
        const std::size_t comma = words.find(',');
        const std::string variant = words.substr(0, comma);
        const Constraints constraints = variant == "sphere"  ? support::held_boundary(mesh, support::radial)
                                        : variant == "rings" ? hold_rings(mesh)
                                                             : support::clamped_boundary(mesh);
        FairOptions options;
        if (comma != std::string::npos && words.substr(comma + 1) == "bending") options.fair_by = FairBy::bending;
        Context context;
        context.threads = threads;
        FairResult result;
        cost = bench::measure([&] { result = fair(mesh, constraints, options, context); });
        if (result.report.outcome != Outcome::converged) throw std::runtime_error(name(result.report.outcome));
        return std::move(result.positions);
      });
}
