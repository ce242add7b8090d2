// CGAL's fair() with continuity 1 and its default weights. Variant "cholmod": CHOLMOD's supernodal factors; otherwise
// its default solver, Eigen's SparseLU. Continuity 1 needs fixed nodes in two rings around the region; they carry the
// tangent plane that vspring is given as a normal.

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Weights/cotangent_weights.h>

#include <Eigen/CholmodSupport>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "driver.hpp"

namespace {

using namespace vspring;

using Surface = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Vertex = Surface::Vertex_index;
using SparseMatrix = CGAL::Eigen_sparse_matrix<double>::EigenType;

/// The matrix of fair() is symmetric once its rows are multiplied by the areas of their nodes.
class SymmetricSolver : public CGAL::Eigen_solver_traits<Eigen::CholmodSupernodalLLT<SparseMatrix>> {
 public:
  explicit SymmetricSolver(Eigen::VectorXd areas) : areas_(std::move(areas)) {}

  bool factor(const Matrix& matrix, double& denominator) {
    denominator = 1;
    const SparseMatrix lower = (areas_.asDiagonal() * matrix.eigen_object()).triangularView<Eigen::Lower>();
    solver().compute(lower);
    return solver().info() == Eigen::Success;
  }

  bool linear_solver(const Vector& right_hand_side, Vector& solution) {
    solution = solver().solve(areas_.cwiseProduct(right_hand_side.eigen_object()));
    return solver().info() == Eigen::Success;
  }

 private:
  Eigen::VectorXd areas_;
};

Surface surface_of(const PolygonMesh& mesh) {
  Surface surface;
  for (const Vector3& p : mesh.positions()) surface.add_vertex({p.x(), p.y(), p.z()});
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (surface.add_face(Vertex(face[0]), Vertex(face[1]), Vertex(face[2])) == Surface::null_face())
      throw std::runtime_error("CGAL takes surfaces only, with faces of one sense");
  }
  return surface;
}

bool fair_by_cholmod(Surface& surface, const std::vector<Vertex>& region) {
  const CGAL::Weights::Secure_cotangent_weight_with_voronoi_area<Surface> weights(surface, surface.points());
  Eigen::VectorXd areas(region.size());
  for (std::size_t k = 0; k < region.size(); ++k) areas[static_cast<Eigen::Index>(k)] = 1 / weights.w_i(region[k]);
  return CGAL::Polygon_mesh_processing::fair(surface, region,
                                             CGAL::parameters::sparse_linear_solver(SymmetricSolver(std::move(areas))));
}

}  // namespace

int main(int argc, char** argv) {
  return bench::drive(argc, argv, [](const PolygonMesh& mesh, int, const std::string& variant, bench::Cost& cost) {
    Surface surface = surface_of(mesh);
    const std::vector<std::uint8_t> held = bench::two_outer_rings(mesh);
    std::vector<Vertex> region;
    for (const Vertex vertex : surface.vertices()) {
      if (held[vertex] == 0) region.push_back(vertex);
    }
    bool solved = false;
    cost = bench::measure([&] {
      solved = variant == "cholmod" ? fair_by_cholmod(surface, region)
                                    : CGAL::Polygon_mesh_processing::fair(surface, region);
    });
    if (!solved) throw std::runtime_error("the linear system could not be solved");
    std::vector<Vector3> positions;
    for (const auto& p : surface.points()) positions.emplace_back(p.x(), p.y(), p.z());
    return positions;
  });
}
