// Shapes that are hardly shapes: every figure stays finite, and what could not be measured is counted.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "support/refusal.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fairness_degenerate_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

template <typename Figures>
void expect_finite(const Figures& figures, const char* what) {
  for (const Figure& figure : list_figures(figures))
    EXPECT_TRUE(std::isfinite(figure.value)) << what << ": " << figure.key;
}

void expect_measurable(const PolygonMesh& mesh, const char* what) {
  expect_finite(measure_surface(mesh), what);
  for (const NodeCurvature& at : curvatures(mesh)) {
    for (const double value : {at.k1, at.k2, at.k1_along_1, at.k1_along_2, at.k2_along_1, at.k2_along_2})
      EXPECT_TRUE(std::isfinite(value)) << what;
    EXPECT_TRUE(at.normal.allFinite() && at.direction1.allFinite() && at.direction2.allFinite()) << what;
  }
}

TEST(DegenerateSurfaces, HaveFiniteFigures) {
  expect_measurable(PolygonMesh(), "nothing");
  expect_measurable(PolygonMesh({{1, 2, 3}}, {0}, {}), "a node");
  const PolygonMesh triangle({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 3}, {0, 1, 2});
  expect_measurable(triangle, "a triangle");
  EXPECT_EQ(measure_surface(triangle).nodes_without_curvature, 3);
  EXPECT_NEAR(measure_surface(triangle).area, 0.5, 1e-15);
  expect_measurable(PolygonMesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 3}, {0, 1, 2}), "a flat triangle");
  expect_measurable(PolygonMesh({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {0, 3}, {0, 1, 2}), "a point");
  expect_measurable(PolygonMesh({{0, 0, 0}, {1, 0, 0}}, {0, 2}, {0, 1}), "a face of two nodes");
  expect_measurable(PolygonMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 4}, {0, 1, 0, 2}), "a node twice");

  PolygonMesh grid = generate::plane({.columns = 8, .rows = 8});
  std::vector<Vector3> positions = grid.positions();
  for (Vector3& position : positions) position.setConstant(0.25);
  grid.set_positions(positions);
  expect_measurable(grid, "a mesh in one point");
  EXPECT_EQ(measure_surface(grid).zero_area_faces, grid.face_count());
  for (std::size_t k = 0; k < positions.size(); ++k) positions[k] = {static_cast<double>(k), 0, 0};
  grid.set_positions(positions);
  expect_measurable(grid, "a mesh on a line");

  PolygonMesh holes = generate::torus({.columns = 12, .rows = 8, .faces = generate::Faces::mixed});
  positions = holes.positions();
  positions[7] = positions[8];
  positions[20] = {nan, 0, 0};
  positions[40] = {0, infinity, 0};
  holes.set_positions(positions);
  expect_measurable(holes, "collapsed and not finite");
  EXPECT_EQ(measure_surface(holes).zero_length_edges, 1);
}

TEST(DegenerateSurfaces, IsolatedNodesSayNothing) {
  const PolygonMesh mesh = generate::torus({.columns = 24, .rows = 12});
  std::vector<Vector3> positions = mesh.positions();
  positions.emplace_back(nan, nan, nan);
  positions.emplace_back(1e30, 0, 0);
  const auto with = list_figures(measure_surface(PolygonMesh(positions, mesh.face_begin(), mesh.corners())));
  const auto without = list_figures(measure_surface(mesh));
  for (std::size_t k = 0; k < with.size(); ++k) EXPECT_EQ(with[k].value, without[k].value) << with[k].key;
}

TEST(DegenerateSurfaces, HubsAndLargeFaces) {
  // A cone of 1,000 triangles, and one face of 1,000 nodes.
  constexpr int sides = 1000;
  MeshBuilder cone;
  MeshBuilder disc;
  cone.add_node({0, 0, 1});
  std::vector<Index> rim;
  for (int k = 0; k < sides; ++k) {
    const Vector3 place(std::cos(2 * std::numbers::pi * k / sides), std::sin(2 * std::numbers::pi * k / sides), 0);
    cone.add_node(place);
    rim.push_back(disc.add_node(place));
    cone.add_face({0, k + 1, k + 1 < sides ? k + 2 : 1});
  }
  disc.add_face(rim);
  expect_measurable(cone.take(), "cone");
  expect_measurable(disc.take(), "disc");
}

TEST(DegenerateSurfaces, OfAnySize) {
  PolygonMesh mesh = generate::torus({.columns = 24, .rows = 12});
  const double energy = measure_surface(mesh).bending_energy;
  for (const double scale : {1e-150, 1e150}) {
    PolygonMesh scaled = mesh;
    std::vector<Vector3> positions = mesh.positions();
    for (Vector3& position : positions) position *= scale;
    scaled.set_positions(positions);
    EXPECT_NEAR(measure_surface(scaled).bending_energy, energy, 1e-9);
    expect_measurable(scaled, "of another size");
  }
}

TEST(DegenerateSurfaces, ThatHideNodesFromMeasuresAreRefused) {
  PolygonMesh mesh = generate::plane({.columns = 8, .rows = 8});
  EXPECT_NO_THROW(check_measurable(mesh));
  std::vector<Vector3> positions = mesh.positions();
  positions[40].y() = nan;
  mesh.set_positions(positions);
  const auto refused = [](const auto& shape, const Constraints* constraints) {
    return support::refusal([&] { check_measurable(shape, constraints); }, ErrorCode::unusable_shape);
  };
  EXPECT_EQ(refused(mesh, nullptr), "node 40: a coordinate is not finite; correct it");
  // What is held all around is not measured.
  Constraints constraints(mesh.node_count());
  for (Index i = 0; i < mesh.node_count(); ++i) constraints.fix_position(i, mesh.position(i));
  EXPECT_NO_THROW(check_measurable(mesh, &constraints));
  constraints.free_position(41);
  EXPECT_EQ(refused(mesh, &constraints), "node 40: a coordinate is not finite; correct it");
}

TEST(DegenerateCurves, ThatHideNodesFromMeasuresAreRefused) {
  const std::vector<Vector3> places = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 0, infinity}};
  const auto refused = [](const PolygonCurve& curve, const Constraints* constraints) {
    return support::refusal([&] { check_measurable(curve, constraints); }, ErrorCode::unusable_shape);
  };
  EXPECT_EQ(refused(PolygonCurve(places), nullptr), "node 3: a coordinate is not finite; correct it");
  Constraints constraints(4);
  for (const Index i : {1, 2, 3}) constraints.fix_position(i, places[static_cast<std::size_t>(i)]);
  EXPECT_NO_THROW(check_measurable(PolygonCurve(places), &constraints));
  EXPECT_EQ(refused(PolygonCurve(places, true), &constraints), "node 3: a coordinate is not finite; correct it");
}

TEST(DegenerateCurves, HaveFiniteFigures) {
  const auto expect_curve = [](const PolygonCurve& curve, const char* what) {
    expect_finite(measure_curve(curve), what);
    Constraints constraints(curve.node_count());
    if (curve.node_count() > 0) constraints.fix_tangent(0, Vector3(1, 0, 0));
    expect_finite(measure_curve(curve, &constraints), what);
  };
  expect_curve(PolygonCurve(), "nothing");
  expect_curve(PolygonCurve({{1, 2, 3}}), "a node");
  expect_curve(PolygonCurve({{1, 2, 3}}, true), "a closed node");
  const PolygonCurve edge({{0, 0, 0}, {3, 4, 0}});
  expect_curve(edge, "an edge");
  EXPECT_NEAR(measure_curve(edge).length, 5, 1e-15);
  expect_curve(PolygonCurve({{0, 0, 0}, {3, 4, 0}}, true), "there and back");
  expect_curve(PolygonCurve({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}}), "to and fro");
  expect_curve(PolygonCurve({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, true), "a point");
  expect_curve(PolygonCurve({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 0, 0}}), "a node twice");
  EXPECT_EQ(measure_curve(PolygonCurve({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 1, 0}})).zero_length_edges, 1);
  expect_curve(PolygonCurve({{0, 0, 0}, {1, 0, 0}, {nan, 0, 0}, {2, 1, 0}, {3, 0, infinity}, {3, 0, 0}}), "not finite");
  expect_curve(PolygonCurve({{0, 0, 0}, {1e200, 0, 0}, {2e200, 1e200, 0}, {2e200, 3e200, 0}}), "large");
  expect_curve(PolygonCurve({{0, 0, 0}, {1e-200, 0, 0}, {2e-200, 1e-200, 0}, {2e-200, 3e-200, 0}}), "small");
}

}  // namespace
}  // namespace vspring::fairness_degenerate_test
