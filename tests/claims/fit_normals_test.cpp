// Points that say which way their surface faces.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_normals_test {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;

double bump(const Vector3& p) { return std::sin(pi * p.x()) * std::sin(pi * p.y()); }

/// Of the surface z = height · bump, upwards.
Vector3 normal_at(const Vector3& p, double height) {
  return Vector3(-height * pi * std::cos(pi * p.x()) * std::sin(pi * p.y()),
                 -height * pi * std::sin(pi * p.x()) * std::cos(pi * p.y()), 1)
      .normalized();
}

/// A closed wall of two sheets that meet in their rim, each `half` times the bump off the middle, and points on the
/// same wall bent upwards, so that those of the lower sheet begin above the upper one.
struct ThinWall {
  static constexpr double half = 0.02;
  static constexpr double bent = 0.1;
  PolygonMesh mesh;
  std::vector<Vector3> targets;  ///< of every node
  Constraints held;
  ScatteredPoints points;

  explicit ThinWall(int cells = 16) : held(0) {
    const PolygonMesh plane = generate::plane({.columns = cells, .rows = cells, .faces = generate::Faces::triangles});
    const Constraints rim = held_boundary(plane);
    std::vector<Vector3> positions;
    std::vector<Index> lower(static_cast<std::size_t>(plane.node_count()));
    const auto add = [&](const Vector3& p, double side) {
      positions.emplace_back(p.x(), p.y(), side * half * bump(p));
      targets.emplace_back(p.x(), p.y(), (bent + side * half) * bump(p));
    };
    for (const Vector3& p : plane.positions()) add(p, 1);
    for (Index i = 0; i < plane.node_count(); ++i) {
      lower[static_cast<std::size_t>(i)] = rim.position_fixed(i) ? i : static_cast<Index>(positions.size());
      if (!rim.position_fixed(i)) add(plane.position(i), -1);
    }
    std::vector<Index> begin = {0};
    std::vector<Index> corners;
    const bool up = upwards(plane);
    for (const bool upper : {true, false}) {
      for (Index f = 0; f < plane.face_count(); ++f) {
        const auto face = plane.face(f);
        std::vector<Index> nodes(face.begin(), face.end());
        if (upper != up) std::reverse(nodes.begin(), nodes.end());
        for (const Index i : nodes) corners.push_back(upper ? i : lower[static_cast<std::size_t>(i)]);
        begin.push_back(static_cast<Index>(corners.size()));
      }
    }
    held = Constraints(static_cast<Index>(positions.size()));
    for (Index i = 0; i < plane.node_count(); ++i) {
      if (rim.position_fixed(i)) held.fix_position(i, positions[static_cast<std::size_t>(i)]);
    }
    mesh = PolygonMesh(std::move(positions), std::move(begin), std::move(corners));
    const PolygonMesh dense = generate::plane({.columns = 40, .rows = 40});
    for (const double side : {1.0, -1.0}) {
      for (const Vector3& p : dense.positions()) {
        if (bump(p) < 0.05) continue;
        points.positions.emplace_back(p.x(), p.y(), (bent + side * half) * bump(p));
        points.normals.push_back(side * normal_at(p, bent + side * half));
      }
    }
  }

  static bool upwards(const PolygonMesh& plane) {
    const auto face = plane.face(0);
    return (plane.position(face[1]) - plane.position(face[0]))
               .cross(plane.position(face[2]) - plane.position(face[0]))
               .z() > 0;
  }

  /// How far nodes that lie well inside are off, up or down.
  [[nodiscard]] double error(const FitResult& result) const {
    double greatest = 0;
    for (const Vector3& p : result.positions) {
      if (bump(p) < 0.5) continue;
      const auto i = static_cast<std::size_t>(&p - result.positions.data());
      const double side = mesh.position(static_cast<Index>(i)).z() > 0 ? 1 : -1;
      greatest = std::max(greatest, std::abs(p.z() - (bent + side * half) * bump(p)));
    }
    return greatest;
  }

  [[nodiscard]] FitResult fit(const ScatteredPoints& to, const FitOptions& options) const {
    return vspring::fit(mesh, held, to, options);
  }
};

FitOptions weight(double k, const FairingMethod& method = EquilibriumMethod{}) {
  FitOptions options{.criterion = Weight{k}};
  options.fair.method = method;
  return options;
}

TEST(FitNormals, EachSideOfAThinWallHasItsOwnPoints) {
  const ThinWall wall;
  for (const FairingMethod& method : {FairingMethod(EquilibriumMethod{}), FairingMethod(SweepMethod{})}) {
    SCOPED_TRACE(method.index());
    const FitResult result = wall.fit(wall.points, weight(0.1, method));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_TRUE(result.report.fair.warnings.empty());
    // Near the rim the wall is as round as its thickness allows.
    EXPECT_LT(wall.error(result), 0.012);
  }
  // No other way is looked for in vain.
  const FitOptions alone = weight(0.1, EquilibriumMethod{.fallbacks = false});
  ScatteredPoints without = wall.points;
  without.normals.clear();
  EXPECT_GT(wall.error(wall.fit(without, alone)), 0.03);
  // Nobody knows the normal there.
  without.normals.assign(without.positions.size(), Vector3::Zero());
  EXPECT_GT(wall.error(wall.fit(without, alone)), 0.03);
}

TEST(FitNormals, HoldOnAllLevelsAndForTolerances) {
  const ThinWall wall(40);
  EXPECT_LT(wall.error(wall.fit(wall.points, weight(0.01))), 0.004);
  FitOptions options;
  options.criterion = SmoothingLength{0.05};
  EXPECT_LT(wall.error(wall.fit(wall.points, options)), 0.004);
}

TEST(FitNormals, MayAllBeTheOtherWayRound) {
  const PolygonMesh plane = generate::plane({.columns = 12, .rows = 12});
  const PolygonMesh dense = generate::plane({.columns = 30, .rows = 30});
  ScatteredPoints points;
  for (const Vector3& p : dense.positions()) points.positions.emplace_back(p.x(), p.y(), 0.1 * bump(p));
  const FitResult plain = fit(plane, held_boundary(plane), points, weight(0.1));
  for (const double way : {1.0, -1.0}) {
    points.normals.assign(points.positions.size(), Vector3(0, 0, ThinWall::upwards(plane) ? way : -way));
    const FitResult result = fit(plane, held_boundary(plane), points, weight(0.1));
    EXPECT_EQ(result.positions, plain.positions);
    EXPECT_EQ(result.report.fair.warnings.size(), way > 0 ? 0U : 1U);
  }
}

TEST(FitNormals, TellNoSideWhereTheirSignsDiffer) {
  // A torus, and points on one whose tube is thicker.
  const PolygonMesh torus = generate::torus({.columns = 40, .rows = 16}, 1, 0.4);
  const PolygonMesh thicker = generate::torus({.columns = 90, .rows = 45}, 1, 0.43);
  ScatteredPoints points{.positions = thicker.positions()};
  const auto fitted = [&] {
    return fit(torus, Constraints(torus.node_count()), points, {.criterion = SmoothingLength{0.2}});
  };
  const FitResult plain = fitted();
  EXPECT_LT(plain.report.after.all.rms, plain.report.before.all.rms / 2);
  for (const bool at_random : {true, false}) {
    SCOPED_TRACE(at_random);
    points.normals.clear();
    for (const Vector3& p : points.positions) {
      const auto j = static_cast<double>(points.normals.size());
      const bool turned = at_random ? std::sin(99 * j * j) > 0 : p.x() > 0;
      points.normals.push_back((turned ? -1 : 1) * (p - Vector3(p.x(), p.y(), 0).normalized()).normalized());
    }
    const FitResult result = fitted();
    EXPECT_EQ(result.positions, plain.positions);
    ASSERT_EQ(result.report.fair.warnings.size(), plain.report.fair.warnings.size() + 1);
    EXPECT_EQ(result.report.fair.warnings[0].code, WarningCode::normals_ignored);
  }
}

TEST(FitNormals, TheNearestShapeIsNoFurtherAwayThanTheInput) {
  // A sphere, and points on a greater one; about its pole normals are turned.
  const int around = 14;
  const auto at = [](double from_pole, double turn) {
    return Vector3(std::cos(from_pole), std::sin(from_pole) * std::cos(turn), std::sin(from_pole) * std::sin(turn));
  };
  MeshBuilder builder;
  builder.add_node(at(0, 0));
  builder.add_node(at(pi, 0));
  for (int ring = 1; ring < around / 2; ++ring) {
    for (int k = 0; k < around; ++k) builder.add_node(at(2 * pi * ring / around, 2 * pi * k / around));
  }
  const auto node = [&](int ring, int k) { return Index(2 + (ring - 1) * around + k % around); };
  for (int k = 0; k < around; ++k) {
    builder.add_face({0, node(1, k), node(1, k + 1)});
    for (int ring = 1; ring + 1 < around / 2; ++ring)
      builder.add_face({node(ring, k), node(ring + 1, k), node(ring + 1, k + 1), node(ring, k + 1)});
    builder.add_face({node(around / 2 - 1, k), 1, node(around / 2 - 1, k + 1)});
  }
  const PolygonMesh sphere = builder.take();
  ScatteredPoints points;
  for (int ring = 1; ring < 30; ++ring) {
    for (int k = 0; k < 60; ++k) {
      const Vector3 normal = at(pi * ring / 30, pi * k / 30);
      points.positions.push_back(1.05 * normal);
      points.normals.push_back(normal.x() > 0.75 ? Vector3(-normal) : normal);
    }
  }
  const FitResult result = fit(sphere, Constraints(sphere.node_count()), points, {.criterion = RootMeanSquare{0.01}});
  EXPECT_LE(result.report.after.all.rms, result.report.before.all.rms);
}

TEST(FitNormals, APointThatFacesAwayFromAllNodesPullsAtNothing) {
  const PolygonMesh plane = generate::plane({.columns = 12, .rows = 12});
  const Vector3 up(0, 0, ThinWall::upwards(plane) ? 1 : -1);
  const ScatteredPoints points{.positions = {{0.3, 0.3, 0.05}, {0.3, 0.7, 0.05}, {0.7, 0.5, 0.05}},
                               .normals = {up, up, -up}};
  const FitResult result = fit(plane, held_boundary(plane), points, weight(10));
  EXPECT_EQ(result.report.pulling_points, 2);
  EXPECT_LT(result.distances[0], 0.005);
  EXPECT_GT(result.distances[2], 0.01);
}

TEST(FitNormals, GiveTheSameBitsOnAnyNumberOfThreads) {
  const ThinWall wall;
  const auto run = [&](int threads) {
    Context context;
    context.threads = threads;
    return fit(wall.mesh, wall.held, wall.points, weight(0.1), context).positions;
  };
  EXPECT_EQ(run(1), run(3));
}

TEST(FitNormals, MustBeOfLengthOne) {
  const ThinWall wall(4);
  const auto refusal = [&](const ScatteredPoints& points) -> std::string {
    try {
      (void)wall.fit(points, weight(1));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
      return error.what();
    }
    return "";
  };
  ScatteredPoints points = wall.points;
  points.normals[7] *= 0.3;
  EXPECT_NE(refusal(points).find("the normal of point 7 has the length 0.3"), std::string::npos);
  points.normals[7].x() = std::nan("");
  EXPECT_NE(refusal(points).find("the normal of point 7"), std::string::npos);
  points.normals.pop_back();
  EXPECT_NE(refusal(points).find("normals are given for"), std::string::npos);
}

}  // namespace
}  // namespace vspring::fit_normals_test
