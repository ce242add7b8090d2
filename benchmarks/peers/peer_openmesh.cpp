// OpenMesh's Jacobi smoother with C1 continuity: damped iterations of the bi-Laplacian, which leave the boundary and
// the ring beside it where they are. The variant is the number of iterations.

#include <OpenMesh/Core/Mesh/Traits.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <string>
#include <vector>

#include "driver.hpp"

namespace {

using namespace vspring;

using Surface = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<Surface>;

void build(Surface& surface, const PolygonMesh& mesh) {
  for (const Vector3& p : mesh.positions()) surface.add_vertex({p.x(), p.y(), p.z()});
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    surface.add_face(surface.vertex_handle(static_cast<unsigned>(face[0])),
                     surface.vertex_handle(static_cast<unsigned>(face[1])),
                     surface.vertex_handle(static_cast<unsigned>(face[2])));
  }
}

}  // namespace

int main(int argc, char** argv) {
  return bench::drive(argc, argv, [](const PolygonMesh& mesh, int, const std::string& variant, bench::Cost& cost) {
    Surface surface;
    build(surface, mesh);
    const auto iterations = static_cast<unsigned>(std::stoi(variant));
    cost = bench::measure([&] {
      Smoother smoother(surface);
      smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C1);
      smoother.smooth(iterations);
    });
    std::vector<Vector3> positions;
    for (const auto vertex : surface.vertices()) {
      const auto& p = surface.point(vertex);
      positions.emplace_back(p[0], p[1], p[2]);
    }
    return positions;
  });
}
