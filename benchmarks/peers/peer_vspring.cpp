// vspring's fair() to the equilibrium, boundary positions and normals held. Variant "sphere": the normals of the unit
// sphere; otherwise those of the mesh.

#include <stdexcept>
#include <string>
#include <utility>

#include "driver.hpp"
#include "support/surfaces.hpp"

using namespace vspring;

int main(int argc, char** argv) {
  return bench::drive(
      argc, argv, [](const PolygonMesh& mesh, int threads, const std::string& variant, bench::Cost& cost) {
        const Constraints constraints =
            variant == "sphere" ? support::held_boundary(mesh, support::radial) : support::clamped_boundary(mesh);
        FairOptions options;
        options.method = Method::equilibrium;
        Context context;
        context.threads = threads;
        FairResult result;
        cost = bench::measure([&] { result = fair(mesh, constraints, options, context); });
        if (result.report.outcome != Outcome::converged) throw std::runtime_error(name(result.report.outcome));
        return std::move(result.positions);
      });
}
