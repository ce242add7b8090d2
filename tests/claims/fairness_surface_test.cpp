// Figures of surfaces: counts of known shapes, qualities of faces, normals that are given, and invariance.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "vspring/vspring.hpp"

namespace vspring::fairness_surface_test {
namespace {

using generate::Faces;
constexpr double pi = std::numbers::pi;

PolygonMesh moved(PolygonMesh mesh, const auto& map) {
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& position : positions) position = map(position);
  mesh.set_positions(positions);
  return mesh;
}

PolygonMesh grid(int cells, Faces faces = Faces::triangles) {
  return generate::plane({.columns = cells, .rows = cells, .faces = faces}, 1, 1);
}

/// Two meshes in one.
PolygonMesh together(const PolygonMesh& a, const PolygonMesh& b) {
  MeshBuilder builder;
  Index first = 0;
  for (const PolygonMesh* mesh : {&a, &b}) {
    for (const Vector3& position : mesh->positions()) builder.add_node(position);
    for (Index f = 0; f < mesh->face_count(); ++f) {
      std::vector<Index> nodes(mesh->face(f).begin(), mesh->face(f).end());
      for (Index& node : nodes) node += first;
      builder.add_face(nodes);
    }
    first = mesh->node_count();
  }
  return builder.take();
}

TEST(SurfaceFigures, CountsFacesThatAreFlipped) {
  for (const Faces faces : {Faces::triangles, Faces::quads, Faces::mixed, Faces::hexagons})
    EXPECT_EQ(measure_surface(grid(8, faces)).flipped_faces, 0);
  // A node drawn beyond the far edge of its one face on that side turns this face over, and only it.
  const PolygonMesh disc(
      {{0, 0, 0},
       {1, 0, 0},
       {0.3, 1, 0},
       {-0.8, 0.6, 0},
       {-0.8, -0.6, 0},
       {0.3, -1, 0},
       {2, 0, 0},
       {0.6, 2, 0},
       {-1.6, 1.2, 0},
       {-1.6, -1.2, 0},
       {0.6, -2, 0}},
      {0, 3, 6, 9, 12, 15, 19, 23, 27, 31, 35},
      {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 5, 1, 1, 6, 7, 2, 2, 7, 8, 3, 3, 8, 9, 4, 4, 9, 10, 5, 5, 10, 6, 1});
  EXPECT_EQ(measure_surface(disc).flipped_faces, 0);
  std::vector<Vector3> positions = disc.positions();
  positions[0] = {-1, 0, 0};
  PolygonMesh folded = disc;
  folded.set_positions(positions);
  EXPECT_EQ(measure_surface(folded).flipped_faces, 1);
  EXPECT_NEAR(measure_surface(folded).greatest_turn, 180, 1e-9);
  // Sharp edges are no folds, and a face that is merely listed the other way round is none either.
  const PolygonMesh blend = generate::pipe_blend();
  EXPECT_EQ(measure_surface(blend).flipped_faces, 0);
  std::vector<Index> corners = blend.corners();
  std::reverse(corners.begin(), corners.begin() + 4);
  EXPECT_EQ(measure_surface(PolygonMesh(blend.positions(), blend.face_begin(), corners)).flipped_faces, 0);
}

TEST(SelfIntersections, OfTwoSheetsThatCross) {
  // 10 squares along the line x = 0.55 and 10 of the other sheet, which begin and end at the same places.
  const PolygonMesh flat = generate::plane({.columns = 10, .rows = 10, .faces = Faces::quads}, 1, 1);
  const PolygonMesh upright = moved(flat, [](const Vector3& p) { return Vector3(0.55, p.x(), p.y() - 0.53); });
  const auto pairs = self_intersections(together(flat, upright));
  EXPECT_EQ(pairs.size(), 10U);
  for (const auto& [a, b] : pairs) {
    EXPECT_LT(a, 100);
    EXPECT_GE(b, 100);
  }
  EXPECT_EQ(measure_surface(together(flat, upright)).self_intersections, 10);
  // Shifted by half a square, every one meets two, but for the last.
  const PolygonMesh shifted = moved(upright, [](const Vector3& p) -> Vector3 { return p + Vector3(0, 0.05, 0); });
  EXPECT_EQ(self_intersections(together(flat, shifted)).size(), 19U);
}

TEST(SelfIntersections, TouchingIsNone) {
  const PolygonMesh flat = grid(6, Faces::quads);
  EXPECT_TRUE(self_intersections(flat).empty());
  EXPECT_TRUE(self_intersections(generate::torus()).empty());
  EXPECT_TRUE(self_intersections(generate::genus()).empty());
  // In one plane; corner on a plane; edge on a plane; the same edge.
  EXPECT_TRUE(self_intersections(together(flat, flat)).empty());
  const PolygonMesh on_edge = moved(flat, [](const Vector3& p) { return Vector3(p.x() + 0.03, 0.41, p.y()); });
  EXPECT_TRUE(self_intersections(together(flat, on_edge)).empty());
  const PolygonMesh at_rim = moved(flat, [](const Vector3& p) { return Vector3(p.x(), 0, p.y()); });
  EXPECT_TRUE(self_intersections(together(flat, at_rim)).empty());
  // Far from the origin it takes the rounding of coordinates to tell.
  const auto away = [](const Vector3& p) -> Vector3 { return p / 3 + Vector3(1000.1, 2000.2, 3000.3); };
  EXPECT_TRUE(self_intersections(moved(together(flat, on_edge), away)).empty());
}

TEST(SelfIntersections, OfFacesThatShareANode) {
  // Two triangles at node 0, the far edge of one through the other.
  const PolygonMesh mesh({{0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {1, 0, -1}, {1, 0, 1}}, {0, 3, 6}, {0, 1, 2, 0, 3, 4});
  EXPECT_EQ(self_intersections(mesh).size(), 1U);
}

TEST(SelfIntersections, AreTheSameForEveryNumberOfThreads) {
  const PolygonMesh crumpled = generate::add_noise(grid(40), 0.05, 3);
  Context one;
  one.threads = 1;
  Context four;
  four.threads = 4;
  const auto pairs = self_intersections(crumpled, one);
  EXPECT_GT(pairs.size(), 100U);
  EXPECT_EQ(pairs, self_intersections(crumpled, four));
  const auto figures = list_figures(measure_surface(crumpled, nullptr, one));
  const auto again = list_figures(measure_surface(crumpled, nullptr, four));
  for (std::size_t k = 0; k < figures.size(); ++k) EXPECT_EQ(figures[k].value, again[k].value) << figures[k].key;
}

/// What comparing all faces by twos finds.
std::vector<std::pair<Index, Index>> crossings_by_twos(const PolygonMesh& mesh) {
  std::vector<std::pair<Index, Index>> pairs;
  for (Index a = 0; a < mesh.face_count(); ++a) {
    for (Index b = a + 1; b < mesh.face_count(); ++b) {
      MeshBuilder two;
      for (const Vector3& position : mesh.positions()) two.add_node(position);
      two.add_face(mesh.face(a));
      two.add_face(mesh.face(b));
      if (!self_intersections(two.take()).empty()) pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

TEST(SelfIntersections, AreThoseThatComparingAllFindsToo) {
  const PolygonMesh crumpled = generate::add_noise(grid(9), 0.1, 5);
  EXPECT_EQ(self_intersections(crumpled), crossings_by_twos(crumpled));
}

TEST(SelfIntersections, AroundNodesOfManyFacesAreThoseThatComparingAllFindsToo) {
  // Triangles at random places, at nodes 0 and 1, some at both, and elsewhere.
  constexpr Index nodes = 60;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    std::mt19937_64 random(seed);
    const auto number = [&](Index from) { return from + static_cast<Index>(random() % (nodes - from)); };
    const auto coordinate = [&] { return 2 * static_cast<double>(random() >> 11U) * 0x1p-53 - 1; };
    MeshBuilder builder;
    for (Index i = 0; i < nodes; ++i) builder.add_node({coordinate(), coordinate(), coordinate()});
    for (int k = 0; k < 210; ++k) {
      const Index first = k < 90 ? 0 : k < 180 ? 1 : number(2);
      const Index second = number(k % 30 == 0 ? 0 : 2);
      const Index third = number(2);
      if (first != second && second != third && third != first) builder.add_face({first, second, third});
    }
    const PolygonMesh mesh = builder.take();
    const auto pairs = self_intersections(mesh);
    EXPECT_GT(pairs.size(), 500U);
    EXPECT_EQ(pairs, crossings_by_twos(mesh));
  }
}

TEST(SelfIntersections, OfFansAreThoseWhereTheirRimIsPushedThroughThem) {
  // A cone on a disc, each a fan of thin triangles.
  constexpr Index sides = 200;
  const auto cone = [](Index pushed) {
    MeshBuilder builder;
    builder.add_node({0, 0, 1});
    builder.add_node({0, 0, 0});
    for (Index k = 0; k < sides; ++k) {
      const double angle = 2 * pi * (k == pushed ? k + 2.5 : k) / sides;
      const double height = k == pushed ? 0.01 : 0;
      builder.add_node({std::cos(angle), std::sin(angle), height});
    }
    for (Index k = 0; k < sides; ++k) {
      const Index next = (k + 1) % sides;
      builder.add_face({0, 2 + k, 2 + next});
      builder.add_face({1, 2 + next, 2 + k});
    }
    return builder.take();
  };
  EXPECT_TRUE(self_intersections(cone(-1)).empty());
  const PolygonMesh crossed = cone(7);
  const auto pairs = self_intersections(crossed);
  EXPECT_FALSE(pairs.empty());
  EXPECT_EQ(pairs, crossings_by_twos(crossed));
}

TEST(SelfIntersections, AreCountedAsOftenAsTheyAreListed) {
  for (const Faces faces : {Faces::triangles, Faces::quads, Faces::hexagons}) {
    const PolygonMesh crumpled = generate::add_noise(grid(20, faces), 0.1, 5);
    const std::size_t pairs = self_intersections(crumpled).size();
    EXPECT_GT(pairs, 20U);
    EXPECT_EQ(measure_surface(crumpled).self_intersections, static_cast<Index>(pairs));
  }
}

TEST(SurfaceFigures, OfTwoShapesAreThoseOfEach) {
  for (const Faces faces : {Faces::triangles, Faces::quads, Faces::hexagons, Faces::mixed}) {
    PolygonMesh before = generate::add_noise(grid(12, faces), 0.03, 3);
    PolygonMesh after = moved(
        grid(12, faces), [](const Vector3& p) { return Vector3(p.x(), p.y(), 0.1 * std::sin(9 * p.x()) * p.y()); });
    Constraints constraints(before.node_count());
    fix_boundary_positions(constraints, before);
    constraints.fix_normal(0, Vector3(0, 0, 1));
    // Where both have the same nodes to look at, and where they do not.
    for (const bool is_broken : {false, true}) {
      if (is_broken) {
        std::vector<Vector3> positions = before.positions();
        positions[40].x() = std::nan("");
        before.set_positions(positions);
      }
      for (const Constraints* held : {static_cast<const Constraints*>(nullptr), &std::as_const(constraints)}) {
        const auto both = measure_surfaces(before, after, held, Context());
        const std::array<const PolygonMesh*, 2> meshes = {&before, &after};
        for (std::size_t k = 0; k < 2; ++k) {
          const auto figures = list_figures(both[k]);
          const auto alone = list_figures(measure_surface(*meshes[k], held));
          ASSERT_EQ(figures.size(), alone.size());
          for (std::size_t f = 0; f < figures.size(); ++f)
            EXPECT_EQ(figures[f].value, alone[f].value) << figures[f].key;
        }
      }
    }
  }
}

TEST(SurfaceFigures, OfTwoShapesNeedOneMesh) {
  EXPECT_THROW((void)measure_surfaces(grid(3), grid(4), nullptr, Context()), Error);
  EXPECT_THROW((void)measure_surfaces(grid(3), grid(3, Faces::quads), nullptr, Context()), Error);
}

TEST(SurfaceFigures, ExtremesOfMeanCurvature) {
  EXPECT_EQ(measure_surface(generate::cap({.nodes = 2000, .jitter = 0.3})).mean_curvature_extrema, 0);
  EXPECT_EQ(measure_surface(grid(20)).mean_curvature_extrema, 0);
  // z = 0.1 sin x sin y over 3 × 2 half waves has one hump or hollow in each.
  const PolygonMesh waves =
      moved(generate::plane({.columns = 90, .rows = 60, .faces = Faces::mixed, .jitter = 0.2}, 3 * pi, 2 * pi),
            [](const Vector3& p) { return Vector3(p.x(), p.y(), 0.1 * std::sin(p.x()) * std::sin(p.y())); });
  EXPECT_EQ(measure_surface(waves).mean_curvature_extrema, 6);
}

TEST(SurfaceFigures, EdgesAndAngles) {
  const SurfaceFigures square = measure_surface(grid(5, Faces::quads));
  EXPECT_NEAR(square.smallest_angle, 90, 1e-9);
  EXPECT_NEAR(square.greatest_angle, 90, 1e-9);
  EXPECT_NEAR(square.edge_spread, 1, 1e-9);
  const SurfaceFigures oblong =
      measure_surface(generate::plane({.columns = 4, .rows = 4, .faces = Faces::quads}, 3, 1));
  EXPECT_NEAR(oblong.edge_spread, 3, 1e-9);
  EXPECT_NEAR(oblong.neighbouring_edge_spread, 3, 1e-9);
  EXPECT_NEAR(oblong.area, 3, 1e-9);
  EXPECT_NEAR(oblong.diagonal, std::sqrt(10), 1e-9);
  // An arrow head: 270° inside.
  const SurfaceFigures arrow =
      measure_surface(PolygonMesh({{0, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}}, {0, 4}, {0, 1, 2, 3}));
  EXPECT_NEAR(arrow.greatest_angle, 270, 1e-9);
  EXPECT_EQ(arrow.self_intersections, 0);
}

TEST(SurfaceFigures, NormalErrorIsTheAngleToTheGivenNormal) {
  const PolygonMesh mesh = generate::sphere_patch({.columns = 12, .rows = 12, .faces = Faces::mixed, .jitter = 0.2});
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  EXPECT_FALSE(measure_surface(mesh, &constraints).normal_error);
  const auto boundary = boundary_nodes(mesh);
  Index first = -1;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (boundary[static_cast<std::size_t>(i)] == 0) continue;
    constraints.fix_normal(i, -mesh.position(i));
    if (first < 0) first = i;
  }
  EXPECT_NEAR(*measure_surface(mesh, &constraints).normal_error, 0, 1e-6);
  const Vector3 across = mesh.position(first).unitOrthogonal();
  constraints.fix_normal(first, Eigen::AngleAxisd(0.1, across) * mesh.position(first));
  EXPECT_NEAR(*measure_surface(mesh, &constraints).normal_error, 0.1 * 180 / pi, 1e-5);
}

TEST(SurfaceFigures, WithConstraintsOnlyTheMovingPart) {
  const PolygonMesh mesh = generate::add_noise(grid(20), 0.01);
  Constraints constraints(mesh.node_count());
  for (Index i = 0; i < mesh.node_count(); ++i) constraints.fix_position(i, mesh.position(i));
  EXPECT_EQ(measure_surface(mesh, &constraints).area, 0);
  constraints.free_position(220);
  const SurfaceFigures part = measure_surface(mesh, &constraints);
  EXPECT_GT(part.area, 0.005);
  EXPECT_LT(part.area, 0.02);
  EXPECT_LT(part.bending_energy, measure_surface(mesh).bending_energy / 10);
}

TEST(SurfaceFigures, ScaleTurnAndRenumber) {
  const PolygonMesh mesh =
      generate::add_noise(generate::torus({.columns = 32, .rows = 12, .faces = Faces::mixed, .jitter = 0.2}), 0.01);
  const auto before = list_figures(measure_surface(mesh));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  const double diagonal = measure_surface(mesh).diagonal;
  for (const double scale : {1.0, 1e-5, 3e4}) {
    const PolygonMesh after_mesh = generate::shuffle(moved(mesh, [&](const Vector3& p) -> Vector3 {
                                     return scale * (turn * p + Vector3(5, -3, 1));
                                   })).mesh;
    const SurfaceFigures figures = measure_surface(after_mesh);
    const auto after = list_figures(figures);
    // The box lies along the axes and does not turn with the shape: its diagonal is a unit of curvatures.
    const double boxes = figures.diagonal / scale / diagonal;
    for (std::size_t k = 0; k < before.size(); ++k) {
      double expected = before[k].value;
      if (before[k].unit == "units") expected *= scale * boxes;
      if (before[k].unit == "units²") expected *= scale * scale;
      if (before[k].definition.find(" D²") != std::string_view::npos)
        expected *= boxes * boxes;
      else if (before[k].definition.find(" D") != std::string_view::npos)
        expected *= boxes;
      EXPECT_NEAR(after[k].value, expected, 1e-7 * std::abs(expected) + 1e-9) << before[k].key << " scale " << scale;
    }
  }
}

TEST(Figures, HaveNoSignWhereTheyAreZero) {
  for (const Figure& figure : list_figures(measure_surface(generate::plane({.columns = 4, .rows = 4}))))
    EXPECT_FALSE(figure.value == 0 && std::signbit(figure.value)) << figure.key;
}

TEST(Figures, HaveKeysOfTheirOwn) {
  const auto figures = list_figures(SurfaceFigures{});
  for (std::size_t a = 0; a < figures.size(); ++a) {
    EXPECT_FALSE(figures[a].definition.empty());
    for (std::size_t b = 0; b < a; ++b) EXPECT_NE(figures[a].key, figures[b].key);
  }
}

}  // namespace
}  // namespace vspring::fairness_surface_test
