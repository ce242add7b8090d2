// Sharp edges of surfaces.

#include <utility>
#include <vector>

#include "bindings.hpp"
#include "run.hpp"

namespace vspring::python {

void add_sharp_edges(py::module_& module) {
  // Returns the edges, the nodes of each chain, whether it is closed, its length, and the corners.
  module.def("find_sharp_edges", [](const PolygonMesh& mesh, double angle, double noise, int threads) {
    Run run(threads, py::none());
    SharpEdges sharp = run([&](Context& context) { return find_sharp_edges(mesh, angle, noise, context); });
    run.raise_if_stopped();
    py::list nodes;
    py::list closed;
    for (const PolygonCurve::Chain& chain : sharp.chains.chains()) {
      nodes.append(array_of(chain.nodes));
      closed.append(chain.closed);
    }
    return py::make_tuple(array_of(sharp.edges), std::move(nodes), std::move(closed),
                          array_of(chain_lengths(sharp.chains)), array_of(std::move(sharp.corners)));
  });
}

}  // namespace vspring::python
