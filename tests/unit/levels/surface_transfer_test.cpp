#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "levels/levels.hpp"
#include "spring/v_spring.hpp"
#include "support/surfaces.hpp"
#include "sweep/sweep.hpp"
#include "unit/levels/zoo.hpp"

namespace vspring::surface_transfer_test {
namespace {

using generate::Faces;
using generate::Grid;
using support::every_kind;

struct Surface {
  std::function<PolygonMesh(const Grid&)> mesh;
  std::function<Vector3(const Vector3&)> normal;
  std::function<double(const Vector3&)> distance;
};

constexpr double pipe = 0.4;

Vector3 ring_centre(const Vector3& p) { return Vector3(p.x(), p.y(), 0).normalized(); }

const Surface sphere = {[](const Grid& grid) { return generate::sphere_patch(grid, 1, 80); },
                        [](const Vector3& p) { return Vector3(p.normalized()); },
                        [](const Vector3& p) { return std::abs(p.norm() - 1); }};
const Surface cylinder = {[](const Grid& grid) { return generate::cylinder_patch(grid, 1, 120, 2); },
                          [](const Vector3& p) { return ring_centre(p); },
                          [](const Vector3& p) { return std::abs(Vector3(p.x(), p.y(), 0).norm() - 1); }};
const Surface torus = {[](const Grid& grid) { return generate::torus(grid, 1, pipe); },
                       [](const Vector3& p) { return Vector3((p - ring_centre(p)).normalized()); },
                       [](const Vector3& p) { return std::abs((p - ring_centre(p)).norm() - pipe); }};

struct Error {
  double greatest = 0;
  double mean = 0;  // root mean square
};

enum class Normals { exact, computed, none };

/// Hands the exact shape up from the second finest level and tells how far off the surface it comes out.
Error error_of(const Surface& surface, const Grid& grid, Normals normals) {
  const PolygonMesh mesh = surface.mesh(grid);
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  constraints.fix_position(0, mesh.position(0));
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (constraints.position_fixed(i)) constraints.fix_normal(i, surface.normal(mesh.position(i)));
  }
  ThreadTeam team(1);
  const auto model = surface_model(PseudoNormals::link);
  auto levels = surface_levels(gather_net(mesh, constraints), *model, Distribution::even, team);
  Level& coarse = levels[levels.size() - 2];
  Net& net = levels.back().net;
  update_directions(coarse.net, *model, team);
  for (std::size_t i = 0; i < coarse.net.node.size(); ++i) {
    if (normals == Normals::exact) coarse.net.normals[i] = surface.normal(mesh.position(coarse.net.node[i]));
    if (normals == Normals::none) coarse.net.normals[i].setZero();
  }
  if (normals == Normals::none) {
    for (auto& normal : net.normals) normal.setZero();
  }
  for (std::size_t i = 0; i < net.moving; ++i) net.positions[i].setConstant(7);
  prolong_surface(coarse, levels.back(), team);
  Constraints free(mesh.node_count());
  const auto positions = scatter_positions(net, mesh.positions(), free, 1);
  Error error;
  for (const Vector3& position : positions) {
    const double distance = surface.distance(position);
    error.greatest = std::max(error.greatest, distance);
    error.mean += distance * distance / static_cast<double>(positions.size());
  }
  error.mean = std::sqrt(error.mean);
  return error;
}

TEST(Prolongation, IsExactOnSpheres) {
  for (const Faces faces : every_kind) {
    for (const double jitter : {0.0, 0.4}) {
      const Grid grid = {.columns = 24, .rows = 24, .faces = faces, .jitter = jitter};
      EXPECT_LT(error_of(sphere, grid, Normals::computed).greatest, 1e-12);
      EXPECT_GT(error_of(sphere, grid, Normals::none).mean, 1e-4);
    }
  }
}

TEST(Prolongation, IsExactOnCylindersWithExactNormals) {
  for (const Faces faces : every_kind) {
    const Grid grid = {.columns = 48, .rows = 24, .faces = faces, .jitter = 0.4};
    EXPECT_LT(error_of(cylinder, grid, Normals::exact).greatest, 1e-12);
    EXPECT_GT(error_of(cylinder, grid, Normals::none).mean, 1e-4);
  }
}

TEST(Prolongation, IsOfThirdOrderOnToriAsFarAsNormalsAre) {
  for (const Faces faces : every_kind) {
    for (const double jitter : {0.0, 0.4}) {
      SCOPED_TRACE("faces " + std::to_string(static_cast<int>(faces)) + ", jitter " + std::to_string(jitter));
      const auto error = [&](int cells, Normals normals) {
        return error_of(torus, {.columns = 2 * cells, .rows = cells, .faces = faces, .jitter = jitter}, normals);
      };
      const auto order = [&](double coarse, double fine) { return std::log(coarse / fine) / std::log(3); };
      const Error coarse = error(32, Normals::exact);
      const Error fine = error(96, Normals::exact);
      const Error straight = error(96, Normals::none);
      EXPECT_GT(order(coarse.mean, fine.mean), 3);
      EXPECT_GT(order(coarse.greatest, fine.greatest), 2.3);
      EXPECT_LT(order(error(32, Normals::none).mean, straight.mean), 2.2);
      EXPECT_LT(fine.mean, 0.01 * straight.mean);
      EXPECT_LT(error(96, Normals::computed).mean, 0.25 * straight.mean);
    }
  }
}

struct Hierarchy {
  std::unique_ptr<const Model> model = surface_model(PseudoNormals::link);
  std::vector<Level> levels;
};

Hierarchy hierarchy_of(const PolygonMesh& mesh, int threads = 1, Distribution distribution = Distribution::even) {
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  fix_boundary_normals(constraints, mesh);
  ThreadTeam team(threads);
  Hierarchy hierarchy;
  hierarchy.levels = surface_levels(gather_net(mesh, constraints), *hierarchy.model, distribution, team);
  return hierarchy;
}

TEST(Prolongation, LeavesWhatIsHeldInPlace) {
  const PolygonMesh mesh = generate::annulus({.nodes = 3000});
  Hierarchy hierarchy = hierarchy_of(mesh);
  Net& net = hierarchy.levels.back().net;
  const auto positions = net.positions;
  const auto normals = net.normals;
  ThreadTeam team(1);
  Level& coarse = hierarchy.levels[hierarchy.levels.size() - 2];
  update_directions(coarse.net, *hierarchy.model, team);
  prolong_surface(coarse, hierarchy.levels.back(), team);
  for (std::size_t i = net.moving; i < net.node.size(); ++i) {
    EXPECT_EQ(net.positions[i], positions[i]);
    EXPECT_EQ(net.normals[i], normals[i]);
  }
}

TEST(ProlongationThreads, GiveTheSameBitsForEveryNumber) {
  const auto run = [](int threads) {
    Hierarchy hierarchy = hierarchy_of(generate::annulus({.nodes = 40000}), threads);
    ThreadTeam team(threads);
    for (std::size_t k = hierarchy.levels.size() - 1; k > 0; --k)
      restrict_shape(hierarchy.levels[k], hierarchy.levels[k - 1]);
    for (std::size_t k = 1; k < hierarchy.levels.size(); ++k) {
      update_directions(hierarchy.levels[k - 1].net, *hierarchy.model, team);
      prolong_surface(hierarchy.levels[k - 1], hierarchy.levels[k], team);
    }
    return hierarchy.levels.back().net.positions;
  };
  const auto one = run(1);
  EXPECT_EQ(one, run(2));
  EXPECT_EQ(one, run(3));
}

/// How far nodes lie from where the regularisation wants them, in mean edges: root mean square.
double unevenness(Net& net, const Model& model) {
  ThreadTeam team(1);
  update_directions(net, model, team);
  std::vector<NodeForce> forces(net.moving);
  model.find_forces(net, {0, net.moving}, forces);
  double sum = 0;
  for (const NodeForce& force : forces) sum += force.regularisation.squaredNorm() / (force.mean_edge * force.mean_edge);
  return std::sqrt(sum / static_cast<double>(net.moving));
}

TEST(Prolongation, PlacesNodesAboutWhereTheRegularisationWantsThem) {
  for (const Distribution distribution : {Distribution::even, Distribution::keep}) {
    for (const Faces faces : every_kind) {
      SCOPED_TRACE(static_cast<int>(faces));
      const PolygonMesh mesh = generate::sphere_patch({.columns = 60, .rows = 60, .faces = faces, .jitter = 0.3});
      Hierarchy hierarchy = hierarchy_of(mesh, 1, distribution);
      ThreadTeam team(1);
      Level& coarse = hierarchy.levels[hierarchy.levels.size() - 2];
      Sweep sweep(coarse.net, *hierarchy.model, team);
      for (int k = 0; k < 200; ++k) sweep.iterate();
      update_directions(coarse.net, *hierarchy.model, team);
      Net& net = hierarchy.levels.back().net;
      for (std::size_t i = 0; i < net.moving; ++i) net.positions[i].setConstant(7);
      prolong_surface(coarse, hierarchy.levels.back(), team);
      const double left = unevenness(net, *hierarchy.model);
      EXPECT_LT(left, 0.25);
    }
  }
}

TEST(Prolongation, FoldsNoTriangleOfAFlatDisc) {
  const PolygonMesh mesh = generate::flat_disc({.nodes = 5000});
  Hierarchy hierarchy = hierarchy_of(mesh);
  ThreadTeam team(1);
  auto& levels = hierarchy.levels;
  for (std::size_t k = levels.size() - 1; k > 0; --k) restrict_shape(levels[k], levels[k - 1]);
  Sweep sweep(levels.front().net, *hierarchy.model, team);
  for (int k = 0; k < 100; ++k) sweep.iterate();
  for (std::size_t k = 1; k < levels.size(); ++k) {
    update_directions(levels[k - 1].net, *hierarchy.model, team);
    prolong_surface(levels[k - 1], levels[k], team);
  }
  Constraints constraints(mesh.node_count());
  const auto positions = scatter_positions(levels.back().net, mesh.positions(), constraints, 1);
  int folded = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const auto at = [&](std::size_t k) { return positions[static_cast<std::size_t>(face[k])]; };
    folded += (at(1) - at(0)).cross(at(2) - at(0)).z() > 0 ? 0 : 1;
  }
  EXPECT_EQ(folded, 0);
}

TEST(Prolongation, StaysFiniteWhereNodesCoincide) {
  PolygonMesh mesh = generate::flat_disc({.nodes = 2000});
  auto positions = mesh.positions();
  for (std::size_t i = 0; i < positions.size() / 2; ++i) positions[i].setZero();
  mesh.set_positions(positions);
  for (const Distribution distribution : {Distribution::even, Distribution::keep}) {
    Hierarchy hierarchy = hierarchy_of(mesh, 1, distribution);
    ThreadTeam team(1);
    for (std::size_t k = 1; k < hierarchy.levels.size(); ++k) {
      update_directions(hierarchy.levels[k - 1].net, *hierarchy.model, team);
      prolong_surface(hierarchy.levels[k - 1], hierarchy.levels[k], team);
      for (const Vector3& position : hierarchy.levels[k].net.positions) EXPECT_TRUE(position.allFinite());
      for (const Vector3& normal : hierarchy.levels[k].net.normals) EXPECT_TRUE(normal.allFinite());
    }
  }
}

}  // namespace
}  // namespace vspring::surface_transfer_test
