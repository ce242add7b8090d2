#include "fairness/height_field.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "support/curves.hpp"
#include "support/surfaces.hpp"
#include "vspring/self_intersections.hpp"

namespace vspring::height_field_test {
namespace {

using namespace support;
using generate::Faces;

constexpr double pi = std::numbers::pi;

/// Turned, so that no axis is special.
PolygonMesh turned(PolygonMesh mesh) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3(0.3, -0.2, 0.1).normalized()).toRotationMatrix();
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& p : positions) p = turn * p;
  return with_positions(std::move(mesh), std::move(positions));
}

bool holds(const PolygonMesh& mesh, int threads = 1) {
  ThreadTeam team(threads);
  return is_height_field(cut_into_triangles(mesh), mesh.positions(), team);
}

/// A strip of so many quads from (0, k) to (1, k), along a way.
PolygonMesh strip(int quads, const std::function<Vector3(double along, double across)>& place) {
  PolygonMesh mesh = generate::plane({.columns = 1, .rows = quads, .faces = Faces::quads}, 1, 1);
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& p : positions) p = place(p.y(), p.x());
  return with_positions(std::move(mesh), std::move(positions));
}

/// Around the z axis counter-clockwise over so many degrees, between these radii.
PolygonMesh ramp(double degrees, double inner, double outer, double rise, double outwards = 0) {
  return strip(60, [=](double along, double across) {
    const double angle = along * degrees * pi / 180;
    const double radius = outer + (inner - outer) * across + outwards * along;
    return Vector3(radius * std::cos(angle), radius * std::sin(angle), rise * along);
  });
}

PolygonMesh together(const std::vector<PolygonMesh>& meshes) {
  MeshBuilder builder;
  Index first = 0;
  for (const PolygonMesh& mesh : meshes) {
    for (const Vector3& p : mesh.positions()) builder.add_node(p);
    for (Index f = 0; f < mesh.face_count(); ++f) {
      std::vector<Index> nodes(mesh.face(f).begin(), mesh.face(f).end());
      for (Index& node : nodes) node += first;
      builder.add_face(nodes);
    }
    first += mesh.node_count();
  }
  return builder.take();
}

PolygonMesh moved(PolygonMesh mesh, const Vector3& by) {
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& p : positions) p += by;
  return with_positions(std::move(mesh), std::move(positions));
}

TEST(HeightField, IsWhatOneDirectionSeesOnce) {
  EXPECT_TRUE(holds(PolygonMesh()));
  EXPECT_TRUE(holds(PolygonMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 3}, {0, 1, 2})));
  for (const Faces faces : {Faces::triangles, Faces::quads}) {
    const generate::Grid grid = {.columns = 12, .rows = 12, .faces = faces, .jitter = 0.3};
    for (const PolygonMesh& mesh : {generate::plane(grid), generate::sphere_patch(grid), generate::cylinder_patch(grid),
                                    generate::saddle(grid, 1)}) {
      EXPECT_TRUE(holds(mesh));
      EXPECT_TRUE(holds(turned(mesh)));
    }
  }
  EXPECT_TRUE(holds(turned(generate::cap({.nodes = 5000, .jitter = 0.3}))));
  EXPECT_TRUE(holds(turned(generate::annulus({.nodes = 3000, .profile = generate::Profile::cone}))));
  EXPECT_TRUE(holds(turned(generate::polygon_patch({.sides = 9, .half_angle = 50}))));
  EXPECT_TRUE(holds(ramp(350, 1, 2, 1)));
}

TEST(HeightField, IsNoSurfaceThatTurnsAway) {
  EXPECT_FALSE(holds(generate::torus()));
  EXPECT_FALSE(holds(generate::genus()));
  EXPECT_FALSE(holds(generate::tube()));
  EXPECT_FALSE(holds(generate::cap({.nodes = 2000, .half_angle = 100})));
  // One face of many that looks the other way, and one without area.
  EXPECT_TRUE(holds(PolygonMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 3, 6}, {0, 1, 2, 0, 2, 3})));
  EXPECT_FALSE(holds(PolygonMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.9, 0.2, 0}}, {0, 3, 6}, {0, 1, 2, 0, 2, 3})));
  EXPECT_FALSE(holds(PolygonMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 0.5, 0}}, {0, 3, 6}, {0, 1, 2, 0, 2, 3})));
  EXPECT_FALSE(holds(PolygonMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 3, 6}, {0, 1, 2, 0, 3, 2})));
}

TEST(HeightField, IsNoSurfaceOverItself) {
  // All normals point up, but the ends of the ramp lie over each other; so do their rims.
  EXPECT_FALSE(holds(ramp(370, 1, 2, 1)));
  EXPECT_FALSE(holds(ramp(800, 1, 2, 3)));
  // Outwards by more than its width it does not come over itself, by less its outline crosses itself.
  EXPECT_TRUE(holds(ramp(700, 1, 2, 1, 3)));
  EXPECT_FALSE(holds(ramp(700, 1, 2, 1, 1)));
  // Its ends meet along a line, but are not joined.
  EXPECT_FALSE(holds(ramp(360, 1, 2, 0)));
}

TEST(HeightField, DoesNotWindTwice) {
  // A closed strip that goes twice around the middle and crosses itself once. All triangles look up.
  const int quads = 48;
  const PolygonMesh open = strip(quads, [](double along, double across) {
    const double angle = 4 * pi * along;
    const double radius = 2 - across + 0.3 * std::cos(angle / 2);
    return Vector3(radius * std::cos(angle), radius * std::sin(angle), 0);
  });
  std::vector<Index> corners = open.corners();
  for (Index& node : corners) node %= 2 * quads;
  EXPECT_FALSE(holds(PolygonMesh(open.positions(), open.face_begin(), corners)));
}

TEST(HeightField, DoesNotTouchItselfInTheView) {
  // A strip like the letter C whose ends come within `gap` of each other, at different heights.
  const auto letter = [](double gap) {
    return strip(4, [=](double along, double across) {
      const std::vector<Vector3> outside = {{gap, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, {-2, -2, 1}};
      const std::vector<Vector3> inside = {{gap, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 1}};
      const auto k = static_cast<std::size_t>(std::lround(4 * along));
      Vector3 place = across < 0.5 ? outside[k] : inside[k];
      if (k == 4) place.x() = 0;
      return place;
    });
  };
  EXPECT_TRUE(holds(letter(0.1)));
  EXPECT_TRUE(holds(letter(1e-9)));
  EXPECT_FALSE(holds(letter(1e-14))) << "as close as rounding";
  EXPECT_FALSE(holds(letter(0)));
  EXPECT_FALSE(holds(letter(-0.1)));
}

TEST(HeightField, IsOneSheet) {
  const PolygonMesh sheet = generate::plane({.columns = 5, .rows = 5});
  EXPECT_TRUE(holds(sheet));
  EXPECT_FALSE(holds(together({sheet, moved(sheet, {0.013, 0.017, 0.5})}))) << "over each other";
  // The smaller one over the middle of the other: both rims are simple and apart, and wind the same way.
  std::vector<Vector3> small = sheet.positions();
  for (Vector3& p : small) p = 0.5 * p + Vector3(0.26, 0.27, 0.5);
  EXPECT_FALSE(holds(together({sheet, with_positions(sheet, small)})));
}

TEST(HeightField, MeetsNoNodeTwice) {
  // Two triangles that share a node, side by side or one over the other.
  EXPECT_FALSE(
      holds(PolygonMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {0, 3, 6}, {0, 1, 2, 0, 3, 4})));
  EXPECT_FALSE(
      holds(PolygonMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0.2, 1}, {1, 0.8, 1}}, {0, 3, 6}, {0, 1, 2, 0, 3, 4})));
  // Three at an edge, two of them on one side of it.
  EXPECT_FALSE(holds(PolygonMesh({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 1, 1}, {0.5, -1, 0}}, {0, 3, 6, 9},
                                 {0, 1, 2, 0, 1, 3, 1, 0, 4})));
  // The same face twice.
  EXPECT_FALSE(holds(PolygonMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 3, 6}, {0, 1, 2, 0, 1, 2})));
}

TEST(HeightField, IsTheSameForEveryNumberOfThreads) {
  const PolygonMesh cap = generate::cap({.nodes = 30000, .half_angle = 80, .jitter = 0.3});
  EXPECT_TRUE(holds(cap));
  EXPECT_TRUE(holds(cap, 4));
  // The last face alone turned over.
  std::vector<Index> corners = cap.corners();
  std::swap(corners[corners.size() - 1], corners[corners.size() - 2]);
  EXPECT_FALSE(holds(PolygonMesh(cap.positions(), cap.face_begin(), corners), 4));
}

/// All pairs are looked at where a triangle beside the mesh faces the other way.
std::size_t crossings_without_certificate(const PolygonMesh& mesh, const Vector3& direction) {
  const Vector3 across = direction.unitOrthogonal();
  const Vector3 place = 5 * across;
  const PolygonMesh facing_away({place, place + direction.cross(across), place + across}, {0, 3}, {0, 1, 2});
  const PolygonMesh both = together({mesh, facing_away});
  EXPECT_FALSE(holds(both));
  return self_intersections(both).size();
}

TEST(HeightField, CrossesItselfNowhere) {
  int height_fields = 0;
  int crossing = 0;
  for (std::uint64_t seed = 1; seed <= 800; ++seed) {
    Draw draw(seed);
    const Vector3 size = draw.in_cube(1).cwiseAbs();
    const double phase = draw.uniform(0, 2 * pi);
    // Noisy sheets, and ways around an axis, up and down, that may come over themselves.
    const PolygonMesh sheet = generate::plane(
        {.columns = 6, .rows = 6, .faces = seed % 4 == 0 ? Faces::triangles : Faces::quads, .jitter = 0.3});
    const PolygonMesh way = strip(40, [&](double along, double across) {
      const double angle = along * (200 + 300 * size.y()) * pi / 180;
      const double radius = 1 - 0.5 * across + 0.8 * size.z() * along;
      return Vector3(radius * std::cos(angle), radius * std::sin(angle), 0.5 * std::sin(2 * pi * along + phase));
    });
    const PolygonMesh mesh = turned(generate::add_noise(seed % 2 == 0 ? sheet : way, 0.15 * size.x() * size.x(), seed));
    Vector3 normal = Vector3::Zero();
    for (const Triangle& t : cut_into_triangles(mesh)) {
      const Vector3& p = mesh.position(t.nodes[0]);
      normal += (mesh.position(t.nodes[1]) - p).cross(mesh.position(t.nodes[2]) - p);
    }
    const std::size_t pairs = crossings_without_certificate(mesh, normal.normalized());
    EXPECT_EQ(self_intersections(mesh).size(), pairs) << seed;
    if (pairs > 0) ++crossing;
    if (holds(mesh)) {
      ++height_fields;
      EXPECT_EQ(pairs, 0U) << seed;
    }
  }
  EXPECT_GT(height_fields, 50);
  EXPECT_GT(crossing, 50);
}

}  // namespace
}  // namespace vspring::height_field_test
