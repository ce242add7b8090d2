// How shapes are handed up from a level to the next finer one (§4.7): largest distance of the nodes placed from the
// surface that the coarse nodes lie on, relative to its size, by three rules.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "levels/levels.hpp"
#include "spring/net.hpp"
#include "vspring/vspring.hpp"

namespace {

using namespace vspring;

struct Surface {
  std::string name;
  std::function<PolygonMesh(Index cells)> make;
  /// Signed distance of a point from the surface, and its normal there.
  std::function<double(const Vector3&)> distance;
  std::function<Vector3(const Vector3&)> normal;
};

std::vector<Surface> surfaces() {
  return {{"sphere, jittered quads",
           [](Index cells) {
             return generate::sphere_patch(
                 {.columns = cells, .rows = cells, .faces = generate::Faces::quads, .jitter = 0.2}, 1, 90);
           },
           [](const Vector3& p) { return p.norm() - 1; }, [](const Vector3& p) { return p; }},
          {"cylinder, triangles",
           [](Index cells) {
             return generate::cylinder_patch({.columns = cells, .rows = cells, .faces = generate::Faces::triangles}, 1,
                                             120, 2);
           },
           [](const Vector3& p) { return p.head<2>().norm() - 1; },
           [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); }},
          {"torus, triangles",
           [](Index cells) {
             return generate::torus({.columns = 3 * cells, .rows = cells, .faces = generate::Faces::triangles}, 1,
                                    0.35);
           },
           [](const Vector3& p) { return std::hypot(p.head<2>().norm() - 1, p.z()) - 0.35; },
           [](const Vector3& p) {
             const double ratio = 1 - 1 / p.head<2>().norm();
             return Vector3(ratio * p.x(), ratio * p.y(), p.z());
           }}};
}

double greatest_distance(const Surface& surface, const Net& net) {
  const Vector3 origin = -net.frame.to_local(Vector3::Zero()) / net.frame.scale();
  double greatest = 0;
  for (std::size_t i = 0; i < net.moving; ++i)
    greatest = std::max(greatest, std::abs(surface.distance(net.positions[i] / net.frame.scale() + origin)));
  return greatest;
}

/// Puts the nodes that the coarse level lacks at the mean of what `value` gives of their parents, beside `base`.
void place_by_mean(const Level& coarse, Net& net, const std::vector<Vector3>& base) {
  std::vector<Vector3> value(net.positions.size(), Vector3::Zero());
  for (const std::uint32_t i : coarse.finer) value[i] = net.positions[i] - base[i];
  for (std::size_t g = coarse.removals.size(); g-- > 0;) {
    const Removals& removals = coarse.removals[g];
    for (std::size_t k = removals.size(); k-- > 0;) {
      const auto parents = removals.parents_of(k);
      Vector3 mean = Vector3::Zero();
      for (const std::uint32_t j : parents) mean += value[j] / static_cast<double>(parents.size());
      value[removals.nodes[k]] = mean;
    }
  }
  for (std::size_t i = 0; i < net.moving; ++i) net.positions[i] = base[i] + value[i];
}

}  // namespace

int main() {
  fmt::print("| surface | rule | 16 cells | 32 | 64 | 128 | order |\n|---|---|---|---|---|---|---|\n");
  ThreadTeam team(2);
  for (const Surface& surface : surfaces()) {
    std::vector<std::vector<double>> errors(4);
    for (const Index cells : {16, 32, 64, 128}) {
      const PolygonMesh mesh = surface.make(cells);
      Constraints constraints(mesh.node_count());
      fix_boundary_positions(constraints, mesh);
      constraints.fix_position(0, mesh.position(0));
      for (Index i = 0; i < mesh.node_count(); ++i) {
        if (constraints.position_fixed(i)) constraints.fix_normal(i, surface.normal(mesh.position(i)));
      }
      const auto model = surface_model(PseudoNormals::link);
      auto levels = surface_levels(gather_net(mesh, constraints), *model, Distribution::even, team);
      Level& fine = levels[levels.size() - 1];
      Level& coarse = levels[levels.size() - 2];
      const Net exact = fine.net;
      update_directions(coarse.net, *model, team);
      prolong_surface(coarse, fine, team);
      errors[0].push_back(greatest_distance(surface, fine.net));
      fine.net = exact;
      const Vector3 origin = -exact.frame.to_local(Vector3::Zero()) / exact.frame.scale();
      for (std::size_t k = 0; k < coarse.net.positions.size(); ++k)
        coarse.net.normals[k] = surface.normal(coarse.net.positions[k] / exact.frame.scale() + origin).normalized();
      prolong_surface(coarse, fine, team);
      errors[3].push_back(greatest_distance(surface, fine.net));
      fine.net = exact;
      place_by_mean(coarse, fine.net, std::vector<Vector3>(exact.positions.size(), Vector3::Zero()));
      errors[1].push_back(greatest_distance(surface, fine.net));
      // Displacements from a shape with waves: the surface stretched and sheared.
      fine.net = exact;
      std::vector<Vector3> start = exact.positions;
      for (Vector3& p : start) p = Vector3(0.7 * p.x() + 0.2 * p.z(), 1.2 * p.y(), 0.3 * std::sin(2 * p.x()));
      place_by_mean(coarse, fine.net, start);
      errors[2].push_back(greatest_distance(surface, fine.net));
    }
    const char* rules[] = {"springs balance", "mean of positions", "mean of displacements",
                           "springs balance, exact normals"};
    for (const std::size_t rule : {0, 3, 1, 2}) {
      const auto& e = errors[rule];
      fmt::print("| {} | {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {} |\n", surface.name, rules[rule], e[0], e[1], e[2],
                 e[3], e[3] < 1e-12 ? std::string("exact") : fmt::format("{:.1f}", std::log2(e[1] / e[3]) / 2));
    }
  }
}
