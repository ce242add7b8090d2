#include "constraints/active_submesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/fairness_of.hpp"
#include "support/methods.hpp"
#include "vspring/vspring.hpp"

namespace vspring::moving_part_test {
namespace {

/// Only nodes as near to the middle move.
Constraints held_around(const PolygonMesh& mesh, double reach) {
  Constraints constraints(mesh.node_count());
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (mesh.position(i).head<2>().cwiseAbs().maxCoeff() > reach) constraints.fix_position(i, mesh.position(i));
  }
  return constraints;
}

std::vector<int> faces_at_nodes(const PolygonMesh& mesh) {
  std::vector<int> faces(static_cast<std::size_t>(mesh.node_count()), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    for (const Index i : mesh.face(f)) ++faces[static_cast<std::size_t>(i)];
  }
  return faces;
}

TEST(ActiveSubmesh, NodesThatMoveAndTheirNeighboursHaveAllTheirFaces) {
  for (const auto faces :
       {generate::Faces::triangles, generate::Faces::quads, generate::Faces::mixed, generate::Faces::hexagons}) {
    const PolygonMesh mesh = generate::saddle({.columns = 24, .rows = 24, .faces = faces});
    const Constraints constraints = held_around(mesh, 0.3);
    const auto part = active_submesh(mesh, constraints);
    ASSERT_TRUE(part);
    EXPECT_LT(part->mesh.node_count(), mesh.node_count() / 3);
    const std::vector<int> whole = faces_at_nodes(mesh);
    const std::vector<int> cut = faces_at_nodes(part->mesh);
    Index moving = 0;
    for (Index f = 0; f < part->mesh.face_count(); ++f) {
      const auto face = part->mesh.face(f);
      const bool moves =
          std::any_of(face.begin(), face.end(), [&](Index i) { return !part->constraints.position_fixed(i); });
      for (const Index i : face) {
        const auto k = static_cast<std::size_t>(i);
        EXPECT_EQ(part->mesh.position(i), mesh.position(part->node[k]));
        EXPECT_TRUE(!moves || cut[k] == whole[static_cast<std::size_t>(part->node[k])]);
      }
    }
    for (Index i = 0; i < mesh.node_count(); ++i) moving += constraints.position_fixed(i) ? 0 : 1;
    for (Index i = 0; i < part->mesh.node_count(); ++i) moving -= part->constraints.position_fixed(i) ? 0 : 1;
    EXPECT_EQ(moving, 0);
  }
}

TEST(ActiveSubmesh, ThereIsNoneWhereMostOfTheMeshMoves) {
  const PolygonMesh mesh = generate::saddle({.columns = 12, .rows = 12});
  EXPECT_FALSE(active_submesh(mesh, held_around(mesh, 0.95)));
  EXPECT_TRUE(active_submesh(mesh, held_around(mesh, 0.5)));
}

TEST(ActiveSubmesh, FairingItIsFairingTheWhole) {
  // The same cells amid many others, and with so few around that nothing is cut out.
  const PolygonMesh large = generate::saddle({.columns = 40, .rows = 40}, 2);
  const PolygonMesh small = generate::saddle({.columns = 14, .rows = 14}, 0.7);
  const Constraints in_large = held_around(large, 0.28);
  const Constraints in_small = held_around(small, 0.28);
  ASSERT_TRUE(active_submesh(large, in_large));
  ASSERT_FALSE(active_submesh(small, in_small));
  for (const FairingMethod& method :
       {FairingMethod(support::equilibrium_alone()), FairingMethod(SweepMethod{.step_tolerance = 1e-6})}) {
    const FairOptions options{.method = method};
    const FairResult of_large = fair(large, in_large, options);
    const FairResult of_small = fair(small, in_small, options);
    ASSERT_EQ(of_large.report.outcome, Outcome::converged);
    EXPECT_EQ(of_large.report.iterations, of_small.report.iterations);
    EXPECT_EQ(of_large.report.moving_nodes, of_small.report.moving_nodes);
    EXPECT_EQ(of_large.report.nodes, large.node_count());
    EXPECT_EQ(of_large.report.faces, large.face_count());
    EXPECT_EQ(of_large.report.fixed_positions, large.node_count() - of_large.report.moving_nodes);
    const double energy = support::fairness_of(small, in_small, of_small.positions).after.vspring_energy;
    EXPECT_NEAR(support::fairness_of(large, in_large, of_large.positions).after.vspring_energy, energy, 1e-6 * energy);
    std::size_t compared = 0;
    for (Index i = 0; i < large.node_count(); ++i) {
      if (in_large.position_fixed(i)) {
        EXPECT_EQ(of_large.positions[static_cast<std::size_t>(i)], large.position(i));
        continue;
      }
      for (Index j = 0; j < small.node_count(); ++j) {
        if ((small.position(j) - large.position(i)).norm() > 1e-9) continue;
        EXPECT_LT(
            (of_small.positions[static_cast<std::size_t>(j)] - of_large.positions[static_cast<std::size_t>(i)]).norm(),
            1e-9);
        ++compared;
      }
    }
    EXPECT_EQ(static_cast<Index>(compared), of_large.report.moving_nodes);
  }
}

TEST(ActiveSubmesh, FaultsAreNamedByTheirPlaceInTheWhole) {
  const PolygonMesh mesh = generate::saddle({.columns = 24, .rows = 24});
  Index middle = 0;
  while (mesh.position(middle).head<2>().norm() > 1e-9) ++middle;
  std::vector<Vector3> positions = mesh.positions();
  positions[static_cast<std::size_t>(middle)].x() = std::nan("");
  PolygonMesh broken = mesh;
  broken.set_positions(positions);
  try {
    (void)fair(broken, held_around(mesh, 0.3));
    FAIL() << "it was taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("node " + std::to_string(middle)), std::string::npos) << error.what();
  }
}

TEST(ActiveSubmesh, ASessionFollowsInIt) {
  const PolygonMesh mesh = generate::saddle({.columns = 40, .rows = 40});
  Constraints constraints = held_around(mesh, 0.4);
  FairingSession session(mesh, {.method = EquilibriumMethod{.tolerance = 1e-7}});
  ASSERT_EQ(session.fair(constraints).report.outcome, Outcome::converged);
  Index rim = 0;
  while (mesh.position(rim).head<2>().cwiseAbs().maxCoeff() > 0.451 || !constraints.position_fixed(rim)) ++rim;
  constraints.fix_position(rim, mesh.position(rim) + Vector3(0, 0, 0.004));
  const FairResult followed = session.fair(constraints);
  EXPECT_EQ(followed.report.levels.size(), 1U);
  const FairResult anew = fair(mesh, constraints, {.method = EquilibriumMethod{.tolerance = 1e-7}});
  for (std::size_t i = 0; i < anew.positions.size(); ++i)
    EXPECT_LT((followed.positions[i] - anew.positions[i]).norm(), 1e-6);
}

}  // namespace
}  // namespace vspring::moving_part_test
