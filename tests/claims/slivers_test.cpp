// Triangles without area at the rim of what moves: as if they were not there.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "support/surfaces.hpp"
#include "vspring/constraints.hpp"
#include "vspring/fair.hpp"
#include "vspring/fairing_session.hpp"
#include "vspring/fit.hpp"
#include "vspring/generate.hpp"

namespace vspring::slivers_test {
namespace {

using Face = std::vector<Index>;

/// Where a sliver lies: nowhere, as the node in its middle is one of both faces; beyond the rim; inside of it.
enum class Sliver { none, beyond, inside };

struct Specimen {
  PolygonMesh mesh;
  Constraints constraints;
};

Face with_node(Face face, Index node, Index after) {
  face.insert(std::find(face.begin(), face.end(), after) + 1, node);
  return face;
}

/// A rough dome, of which what is near the middle moves, with one more node in the middle of an edge of the rim.
Specimen dome(generate::Faces kind, Sliver sliver) {
  PolygonMesh grid = generate::plane({.columns = 16, .rows = 16, .faces = kind}, 2, 2);
  std::vector<Vector3> places = grid.positions();
  for (Vector3& place : places) place = {place.x() - 1, place.y() - 1, std::sqrt(4 - place.squaredNorm() / 4)};
  grid.set_positions(places);
  grid = generate::add_noise(grid, 0.02, 1, true);
  const auto moves = [&](Index node) { return node < grid.node_count() && grid.position(node).head<2>().norm() < 0.6; };
  const auto moving = [&](std::span<const Index> face) { return std::count_if(face.begin(), face.end(), moves); };
  Index inner = 0;
  while (moving(grid.face(inner)) == 0) ++inner;
  const Face face(grid.face(inner).begin(), grid.face(inner).end());
  std::size_t k = 0;
  while (moves(face[k]) || moves(face[(k + 1) % face.size()])) ++k;
  const Index a = face[k];
  const Index c = face[(k + 1) % face.size()];
  Index outer = 0;
  const auto has = [&](Index f, Index node) { return std::count(grid.face(f).begin(), grid.face(f).end(), node) > 0; };
  while (outer == inner || !has(outer, a) || !has(outer, c)) ++outer;
  MeshBuilder builder;
  for (const Vector3& position : grid.positions()) builder.add_node(position);
  const Index b = builder.add_node((grid.position(a) + grid.position(c)) / 2);
  for (Index f = 0; f < grid.face_count(); ++f) {
    Face nodes(grid.face(f).begin(), grid.face(f).end());
    if (f == inner && sliver != Sliver::inside) nodes = with_node(nodes, b, a);
    if (f == outer && sliver != Sliver::beyond) nodes = with_node(nodes, b, c);
    builder.add_face(nodes);
  }
  if (sliver == Sliver::beyond) builder.add_face({a, c, b});
  if (sliver == Sliver::inside) builder.add_face({c, a, b});
  PolygonMesh mesh = builder.take();
  Constraints constraints(mesh.node_count());
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (!moves(i)) constraints.fix_position(i, mesh.position(i));
  }
  return {std::move(mesh), std::move(constraints)};
}

TEST(Slivers, AtTheRimChangeNothing) {
  for (const generate::Faces kind : support::every_kind) {
    const Specimen plain = dome(kind, Sliver::none);
    const FairResult expected = fair(plain.mesh, plain.constraints);
    ASSERT_EQ(expected.report.outcome, Outcome::converged);
    const ScatteredPoints own{.positions = plain.mesh.positions()};
    const FitResult fitted = fit(plain.mesh, plain.constraints, own);
    for (const Sliver where : {Sliver::beyond, Sliver::inside}) {
      const Specimen specimen = dome(kind, where);
      const FairResult result = fair(specimen.mesh, specimen.constraints);
      EXPECT_EQ(result.positions, expected.positions);
      EXPECT_EQ(result.report.faces, specimen.mesh.face_count());
      EXPECT_EQ(fit(specimen.mesh, specimen.constraints, own).positions, fitted.positions);
    }
  }
}

TEST(Slivers, AreNothingThatPointsAreMeasuredFrom) {
  // The only face without a node that moves.
  const PolygonMesh grid = generate::plane({.columns = 6, .rows = 6});
  MeshBuilder builder;
  for (const Vector3& position : grid.positions()) builder.add_node(position);
  for (Index f = 0; f < grid.face_count(); ++f) builder.add_face(grid.face(f));
  const Index between = builder.add_node((grid.position(0) + grid.position(1)) / 2);
  builder.add_face(std::array{Index{1}, Index{0}, between});
  const PolygonMesh mesh = std::move(builder).take();
  Constraints held = support::held_boundary(mesh);
  held.fix_position(between, mesh.position(between));
  ScatteredPoints points;
  for (const Vector3& position : grid.positions()) points.positions.push_back(position + Vector3(0, 0, 0.1));
  const FitResult result = fit(mesh, held, points, {.criterion = SmoothingLength{0.1}});
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
}

TEST(Slivers, AreLeftOutOfASessionWhileTheirNodesAreHeld) {
  const Specimen plain = dome(generate::Faces::triangles, Sliver::none);
  const Specimen specimen = dome(generate::Faces::triangles, Sliver::beyond);
  const Index middle = specimen.mesh.node_count() - 1;
  FairingSession session(specimen.mesh);
  FairingSession without(plain.mesh);
  EXPECT_EQ(session.fair(specimen.constraints).positions, without.fair(plain.constraints).positions);
  Constraints free = specimen.constraints;
  free.free_position(middle);
  EXPECT_EQ(session.fair(free).positions, FairingSession(specimen.mesh).fair(free).positions);
  EXPECT_EQ(session.fair(specimen.constraints).positions, FairingSession(plain.mesh).fair(plain.constraints).positions);
}

}  // namespace
}  // namespace vspring::slivers_test
