// vspring's fill_holes(). Variant: a node of the hole; with ",bending" behind it fair by least bending.

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "driver.hpp"

int main(int argc, char** argv) {
  using namespace vspring;
  return bench::drive_meshes(argc, argv,
                             [](const PolygonMesh& mesh, int threads, const std::string& variant, bench::Cost& cost) {
                               FillOptions options{.at = {std::atoi(variant.c_str())}};
                               if (variant.ends_with(",bending")) options.fair.fair_by = FairBy::bending;
                               Context context;
                               context.threads = threads;
                               FilledHoles filled;
                               cost = bench::measure([&] { filled = fill_holes(mesh, options, context); });
                               if (!filled.usable()) throw std::runtime_error(name(filled.report.outcome));
                               PolygonMesh closed = filled.mesh;
                               closed.set_positions(filled.positions);
                               return closed;
                             });
}
