// OpenMesh's Jacobi smoother: damped iterations of the Laplacian (continuity C0), which leave the boundary where it is,
// or of the bi-Laplacian (C1), which leave the ring beside it, too. The variant is the number of iterations, of C1, or
// "C0, " and that number.

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/Traits.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <string>
#include <vector>

#include "driver.hpp"

namespace {

using namespace vspring;

using Surface = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<Surface>;

void build(Surface& surface, const PolygonMesh& mesh) {
  for (const Vector3& p : mesh.positions()) surface.add_vertex({p.x(), p.y(), p.z()});
  for (Index f = 0; f < mesh.face_count(); ++f) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const Index node : mesh.face(f)) corners.push_back(surface.vertex_handle(static_cast<unsigned>(node)));
    surface.add_face(corners);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return bench::drive(argc, argv, [](const PolygonMesh& mesh, int, const std::string& variant, bench::Cost& cost) {
    Surface surface;
    build(surface, mesh);
    const bool is_laplacian = variant.rfind("C0, ", 0) == 0;
    const auto iterations = static_cast<unsigned>(std::stoi(is_laplacian ? variant.substr(4) : variant));
    cost = bench::measure([&] {
      Smoother smoother(surface);
      smoother.initialize(Smoother::Tangential_and_Normal, is_laplacian ? Smoother::C0 : Smoother::C1);
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
