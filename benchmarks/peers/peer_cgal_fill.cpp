// CGAL's triangulate_refine_and_fair_hole() with its defaults: continuity 1, Eigen's SparseLU. Variant: a node of the
// hole.

#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "driver.hpp"

namespace {

using namespace vspring;

using Surface = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Vertex = Surface::Vertex_index;

Surface surface_of(const PolygonMesh& mesh) {
  Surface surface;
  for (const Vector3& p : mesh.positions()) surface.add_vertex({p.x(), p.y(), p.z()});
  for (Index f = 0; f < mesh.face_count(); ++f) {
    std::vector<Vertex> corners;
    for (const Index node : mesh.face(f)) corners.emplace_back(node);
    if (surface.add_face(corners) == Surface::null_face())
      throw std::runtime_error("CGAL takes surfaces only, with faces of one sense");
  }
  return surface;
}

PolygonMesh mesh_of(const Surface& surface) {
  MeshBuilder builder;
  for (const auto& p : surface.points()) builder.add_node({p.x(), p.y(), p.z()});
  for (const auto face : surface.faces()) {
    std::vector<Index> corners;
    for (const Vertex vertex : surface.vertices_around_face(surface.halfedge(face)))
      corners.push_back(static_cast<Index>(vertex.idx()));
    builder.add_face(corners);
  }
  return builder.take();
}

}  // namespace

int main(int argc, char** argv) {
  return bench::drive_meshes(argc, argv, [](const PolygonMesh& mesh, int, const std::string& node, bench::Cost& cost) {
    Surface surface = surface_of(mesh);
    // A halfedge of a vertex at a boundary is one of the boundary.
    const auto rim = surface.halfedge(Vertex(std::atoi(node.c_str())));
    std::vector<Surface::Face_index> faces;
    std::vector<Vertex> vertices;
    bool faired = false;
    cost = bench::measure([&] {
      const auto made = CGAL::Polygon_mesh_processing::triangulate_refine_and_fair_hole(
          surface, rim, std::back_inserter(faces), std::back_inserter(vertices));
      faired = std::get<0>(made);
    });
    if (!faired || faces.empty()) throw std::runtime_error("the hole could not be filled and faired");
    return mesh_of(surface);
  });
}
