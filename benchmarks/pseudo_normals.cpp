// The error of each kind of pseudo-normal on curved shapes of every kind of polygon, and how isotropic the V-Spring
// operator is that it makes on a square grid. Prints the tables of docs/pseudo-normals.md.

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "spring/model.hpp"
#include "spring/v_spring.hpp"
#include "vspring/generate.hpp"

namespace {

using namespace vspring;
using generate::Faces;
using generate::Grid;

const std::vector<std::pair<std::string, PseudoNormals>> kinds = {{"link", PseudoNormals::link},
                                                                  {"average", PseudoNormals::average},
                                                                  {"area", PseudoNormals::area},
                                                                  {"angle", PseudoNormals::angle}};

Net net_of(const PolygonMesh& mesh) {
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  return gather_net(mesh, constraints);
}

/// Greatest angle, degrees, between computed and exact normals at interior nodes.
double greatest_error(const PolygonMesh& mesh, const std::function<Vector3(const Vector3&)>& exact,
                      PseudoNormals kind) {
  Net net = net_of(mesh);
  ThreadTeam team(1);
  update_directions(net, *surface_model(kind), team);
  double greatest = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const Vector3 normal = exact(mesh.position(net.node[i]));
    greatest =
        std::max(greatest, std::atan2(net.normals[i].cross(normal).norm(), std::abs(net.normals[i].dot(normal))));
  }
  return greatest * 180 / std::numbers::pi;
}

void print_errors() {
  const auto radial = [](const Vector3& p) -> Vector3 { return p.normalized(); };
  const auto from_axis = [](const Vector3& p) -> Vector3 { return Vector3(p.x(), p.y(), 0).normalized(); };
  fmt::print("| shape | faces | cells | link | average | area | angle |\n|---|---|---|---|---|---|---|\n");
  for (const auto& [name, faces] : {std::pair("triangles", Faces::triangles), std::pair("quads", Faces::quads),
                                    std::pair("mixed", Faces::mixed), std::pair("hexagons", Faces::hexagons)}) {
    for (const bool sphere : {true, false}) {
      for (const int cells : {16, 32, 64}) {
        const Grid grid{.columns = cells, .rows = cells, .faces = faces, .jitter = 0.3};
        const PolygonMesh mesh =
            sphere ? generate::sphere_patch(grid, 1, 45) : generate::cylinder_patch(grid, 1, 90, std::numbers::pi / 2);
        fmt::print("| jittered {} | {} | {} |", sphere ? "sphere" : "cylinder", name, cells);
        for (const auto& kind : kinds)
          fmt::print(" {:.2g} |",
                     sphere ? greatest_error(mesh, radial, kind.second) : greatest_error(mesh, from_axis, kind.second));
        fmt::print("\n");
      }
    }
  }
}

/// Rings that pass through the edge neighbours alone.
Rings spokes_of(const Rings& rings) {
  Rings spokes;
  std::vector<Link> links;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    links.clear();
    for (const Link link : rings.links(i)) {
      if (link.spoke()) links.push_back(link);
    }
    spokes.add(links);
  }
  return spokes;
}

/// The V-Spring displacement at the middle of a square grid whose heights are ε times a quartic, over ε h⁴: what the
/// operator makes of it, its symbol's leading term.
double response(PseudoNormals kind, bool through_spokes_only, const std::function<double(double, double)>& quartic) {
  const int cells = 12;
  const double epsilon = 1e-6;
  PolygonMesh mesh = generate::plane({.columns = cells, .rows = cells, .faces = Faces::quads}, cells, cells);
  Vector3 middle = Vector3::Zero();
  for (const Vector3& position : mesh.positions()) middle += position / mesh.node_count();
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& position : positions) {
    const Vector3 from_middle = position - middle;
    position.z() = epsilon * quartic(from_middle.x(), from_middle.y());
  }
  mesh.set_positions(positions);
  Net net = net_of(mesh);
  if (through_spokes_only) net.rings = spokes_of(net.rings);
  ThreadTeam team(1);
  update_directions(net, *surface_model(kind), team);
  for (std::size_t i = 0; i < net.moving; ++i) {
    if ((mesh.position(net.node[i]) - middle).norm() > 1e-3) continue;
    const auto force = node_force(i, net.rings.links(i), net.positions, net.normals, {}, net.tiny);
    return force.spring.z() / net.frame.scale() / epsilon;
  }
  return 0;
}

void print_isotropy() {
  fmt::print(
      "\n| height on a square grid of quads | link | average | area | angle | Max's weights through edge neighbours "
      "only |\n|---|---|---|---|---|---|\n");
  const auto straight = [](double x, double) { return std::pow(x, 4); };
  const auto turned = [](double x, double y) { return std::pow((x + y) / std::sqrt(2.0), 4); };
  for (const auto& [name, quartic] : {std::pair<std::string, std::function<double(double, double)>>("x⁴", straight),
                                      {"the same turned by 45°", turned}}) {
    fmt::print("| {} |", name);
    for (const auto& kind : kinds) fmt::print(" {:.3f} |", response(kind.second, false, quartic));
    fmt::print(" {:.3f} |\n", response(PseudoNormals::link, true, quartic));
  }
}

/// Greatest error, degrees, of the normals that the boundary is held by: "as in the input".
void print_boundary() {
  fmt::print("\n| boundary of | faces | 16 cells | 32 cells | 64 cells |\n|---|---|---|---|---|\n");
  for (const auto& [name, faces] : {std::pair("triangles", Faces::triangles), std::pair("quads", Faces::quads),
                                    std::pair("mixed", Faces::mixed), std::pair("hexagons", Faces::hexagons)}) {
    for (const bool sphere : {true, false}) {
      fmt::print("| a jittered {} | {} |", sphere ? "sphere" : "cylinder", name);
      for (const int cells : {16, 32, 64}) {
        const Grid grid{.columns = cells, .rows = cells, .faces = faces, .jitter = 0.3};
        const PolygonMesh mesh =
            sphere ? generate::sphere_patch(grid, 1, 45) : generate::cylinder_patch(grid, 1, 90, std::numbers::pi / 2);
        Constraints constraints(mesh.node_count());
        fix_boundary_normals(constraints, mesh);
        double greatest = 0;
        for (Index i = 0; i < mesh.node_count(); ++i) {
          if (!constraints.normal_fixed(i)) continue;
          const Vector3& p = mesh.position(i);
          const Vector3 exact = sphere ? p.normalized() : Vector3(p.x(), p.y(), 0).normalized();
          const Vector3& normal = constraints.normal(i);
          greatest = std::max(greatest, std::atan2(normal.cross(exact).norm(), std::abs(normal.dot(exact))));
        }
        fmt::print(" {:.2g} |", greatest * 180 / std::numbers::pi);
      }
      fmt::print("\n");
    }
  }
}

}  // namespace

int main() {
  print_errors();
  print_isotropy();
  print_boundary();
  return 0;
}
