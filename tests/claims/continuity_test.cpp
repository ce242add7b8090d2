// A surface that meets the curvature of what is held around it.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/positions.hpp"
#include "support/refusal.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::continuity_test {
namespace {

using namespace support;

using Place = std::function<Vector3(double u, double v)>;

Vector3 on_unit_sphere(double u, double v) {
  const double polar = 1 + v;
  const double around = 1.2 * u;
  return {std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)};
}

Vector3 on_ellipsoid(double u, double v) {
  const Vector3 p = on_unit_sphere(u, v);
  return {1.5 * p.x(), p.y(), 0.8 * p.z()};
}

Vector3 on_torus(double u, double v) {
  const double around = 0.3 + 1.2 * u;
  const double across = 0.9 + 1.4 * v;
  const double radius = 1 + 0.4 * std::cos(across);
  return {radius * std::cos(around), radius * std::sin(around), 0.4 * std::sin(across)};
}

/// A square of so many cells on a surface, of which a disc in the middle moves; it starts with bumps.
struct Patch {
  Patch(generate::Faces faces, int cells, const Place& place, double noise = 0) {
    const PolygonMesh flat = generate::plane({.columns = cells, .rows = cells, .faces = faces}, 1, 1);
    std::vector<Vector3> positions;
    for (const Vector3& p : flat.positions()) positions.push_back(place(p.x(), p.y()));
    truth = with_positions(flat, positions);
    if (noise > 0) positions = generate::add_noise(truth, noise / cells, 5, true).positions();
    constraints = Constraints(flat.node_count());
    for (Index i = 0; i < flat.node_count(); ++i) {
      const Vector3 off = flat.position(i) - Vector3(0.5, 0.5, 0);
      if (off.norm() < 0.3) region.push_back(i);
    }
    mesh = with_positions(flat, positions);
    restrict_to_region(constraints, mesh, region);
    for (const Index i : region)
      positions[static_cast<std::size_t>(i)] =
          truth.position(i) +
          0.02 * Vector3(std::sin(40 * truth.position(i).x()), 1, std::cos(33 * truth.position(i).y()));
    mesh.set_positions(std::move(positions));
  }

  [[nodiscard]] FairResult faired(Continuity continuity, const FairOptions& given = {}) const {
    FairOptions options = given;
    options.continuity = continuity;
    return fair(mesh, constraints, options);
  }

  [[nodiscard]] double off_unit_sphere(const std::vector<Vector3>& positions) const {
    double greatest = 0;
    for (const Index i : region)
      greatest = std::max(greatest, std::abs(positions[static_cast<std::size_t>(i)].norm() - 1));
    return greatest;
  }

  PolygonMesh truth;
  PolygonMesh mesh;
  Constraints constraints{0};
  std::vector<Index> region;
};

bool only_tangent(const FairReport& report) {
  return std::any_of(report.warnings.begin(), report.warnings.end(),
                     [](const Warning& warning) { return warning.code == WarningCode::tangent_only; });
}

FairOptions to_the_end() { return {.method = EquilibriumMethod{.tolerance = 1e-12}}; }

TEST(Continuity, OfCurvatureIsExactOnSpheresOnEveryMesh) {
  for (const generate::Faces faces : every_kind) {
    const Patch patch(faces, 32, on_unit_sphere);
    const FairResult result = patch.faired(Continuity::curvature, to_the_end());
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_EQ(result.report.continuity, Continuity::curvature);
    EXPECT_TRUE(result.report.warnings.empty());
    EXPECT_LT(patch.off_unit_sphere(result.positions), 1e-10) << static_cast<int>(faces);
    for (Index i = 0; i < patch.mesh.node_count(); ++i) {
      if (patch.constraints.position_fixed(i))
        EXPECT_EQ(result.positions[static_cast<std::size_t>(i)], patch.mesh.position(i));
    }
  }
}

TEST(Continuity, OfCurvatureLeavesAJumpThatVanishesWithTheEdges) {
  double before = 0;
  for (const int cells : {32, 64}) {
    const Patch patch(generate::Faces::triangles, cells, on_ellipsoid);
    const FairResult result = patch.faired(Continuity::curvature);
    ASSERT_EQ(result.report.continuity, Continuity::curvature);
    ASSERT_TRUE(result.report.curvature_jump);
    const auto [tangent, after] = *result.report.curvature_jump;
    EXPECT_LT(after, (cells == 64 ? 0.4 : 0.8) * tangent) << cells;
    if (before > 0) EXPECT_LT(after, 0.6 * before);
    before = after;
  }
}

TEST(Continuity, OfCurvatureIsNearerToASurfaceThatIsSmoothThroughout) {
  const auto off = [](const Vector3& p) {
    const Vector3 unit(p.x() / 1.5, p.y(), p.z() / 0.8);
    return (unit.squaredNorm() - 1) / (2 * Vector3(unit.x() / 1.5, unit.y(), unit.z() / 0.8).norm());
  };
  const Patch patch(generate::Faces::quads, 40, on_ellipsoid);
  const auto furthest = [&](Continuity continuity) {
    double greatest = 0;
    const std::vector<Vector3> positions = patch.faired(continuity).positions;
    for (const Index i : patch.region)
      greatest = std::max(greatest, std::abs(off(positions[static_cast<std::size_t>(i)])));
    return greatest;
  };
  EXPECT_LT(furthest(Continuity::curvature), 0.6 * furthest(Continuity::tangent));
}

TEST(Continuity, OfCurvatureBearsNoiseOfATenthOfAnEdge) {
  // In each coordinate, of a ball of that radius times the root of five.
  const Patch patch(generate::Faces::triangles, 40, on_unit_sphere, 0.1 * std::sqrt(5));
  const FairResult result = patch.faired(Continuity::curvature);
  EXPECT_EQ(result.report.continuity, Continuity::curvature);
  EXPECT_LT(patch.off_unit_sphere(result.positions),
            2 * patch.off_unit_sphere(patch.faired(Continuity::tangent).positions));
}

TEST(Continuity, SayingTangentChangesNothing) {
  const Patch patch(generate::Faces::mixed, 20, on_torus);
  EXPECT_EQ(patch.faired(Continuity::tangent).positions, fair(patch.mesh, patch.constraints).positions);
}

TEST(Continuity, WhereNothingIsAroundTangentPlanesAreMetWithAWarning) {
  const PolygonMesh cap = generate::cap({.nodes = 400, .radius = 1, .half_angle = 50});
  const Constraints constraints = held_boundary(cap, radial);
  const PolygonMesh mesh = generate::add_noise(cap, 0.02, 3);
  FairOptions options;
  options.continuity = Continuity::curvature;
  const FairResult result = fair(mesh, constraints, options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.continuity, Continuity::tangent);
  EXPECT_TRUE(only_tangent(result.report));
  EXPECT_EQ(result.positions, fair(mesh, constraints).positions);
}

TEST(Continuity, GoesThatShareOfTheWay) {
  const Patch patch(generate::Faces::quads, 20, on_unit_sphere);
  FairOptions options = to_the_end();
  const std::vector<Vector3> whole = patch.faired(Continuity::curvature, options).positions;
  options.strength = 0.25;
  const FairResult part = patch.faired(Continuity::curvature, options);
  for (const Index i : patch.region) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_LT((part.positions[k] - (patch.mesh.position(i) + 0.25 * (whole[k] - patch.mesh.position(i)))).norm(),
              1e-15);
  }
}

TEST(Continuity, TheSameBitsOnAnyNumberOfThreadsAndTheSameShapeAnywhere) {
  const Patch patch(generate::Faces::triangles, 30, on_ellipsoid);
  FairOptions options = to_the_end();
  options.continuity = Continuity::curvature;
  Context context;
  context.threads = 1;
  const std::vector<Vector3> one = fair(patch.mesh, patch.constraints, options, context).positions;
  context.threads = 3;
  EXPECT_EQ(fair(patch.mesh, patch.constraints, options, context).positions, one);
  const Eigen::AngleAxisd turn(0.7, Vector3(1, 2, 3).normalized());
  const auto moved = [&](const Vector3& p) { return Vector3(1e6 * (turn * p) + Vector3(3e6, -2e6, 1e5)); };
  std::vector<Vector3> positions;
  for (const Vector3& p : patch.mesh.positions()) positions.push_back(moved(p));
  const PolygonMesh elsewhere = with_positions(patch.mesh, positions);
  Constraints constraints(elsewhere.node_count());
  restrict_to_region(constraints, elsewhere, patch.region);
  const FairResult result = fair(elsewhere, constraints, options);
  EXPECT_EQ(result.report.continuity, Continuity::curvature);
  double apart = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
    apart = std::max(apart, (result.positions[i] - moved(one[i])).norm() / 1e6);
  EXPECT_LT(apart, 1e-9);
}

TEST(Continuity, SessionsKeepIt) {
  const Patch patch(generate::Faces::quads, 20, on_ellipsoid);
  FairOptions options;
  options.continuity = Continuity::curvature;
  FairingSession session(patch.mesh, options, 1);
  const FairResult result = session.fair(patch.constraints);
  EXPECT_EQ(result.report.continuity, Continuity::curvature);
  EXPECT_EQ(result.positions, fair(patch.mesh, patch.constraints, options).positions);
}

TEST(Continuity, ASymmetricWholeKeepsItAndIsSymmetric) {
  // About the plane y = 0.
  const Patch patch(generate::Faces::quads, 32, [](double u, double v) { return on_ellipsoid(u - 0.5, v); });
  std::vector<Vector3> positions = patch.truth.positions();
  for (const Index i : patch.region) {
    Vector3& p = positions[static_cast<std::size_t>(i)];
    p.z() += 0.02 * std::cos(9 * p.y());
  }
  const PolygonMesh mesh = with_positions(patch.truth, positions);
  FairOptions options;
  options.continuity = Continuity::curvature;
  const auto shape = find_symmetry(mesh, parse_plane("y"));
  ASSERT_FALSE(shape.is_half);
  const FairResult result = fair(shape, patch.constraints, options);
  EXPECT_EQ(result.report.continuity, Continuity::curvature);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vector3& image = result.positions[static_cast<std::size_t>(shape.partner[i])];
    EXPECT_EQ(result.positions[i], Vector3(image.x(), -image.y(), image.z()));
  }
}

TEST(Continuity, AFilledHoleMeetsTheCurvatureAround) {
  const Patch patch(generate::Faces::triangles, 32, on_ellipsoid);
  std::vector<std::uint8_t> is_cut(patch.truth.positions().size(), 0);
  for (const Index i : patch.region) is_cut[static_cast<std::size_t>(i)] = 1;
  MeshBuilder builder;
  for (const Vector3& p : patch.truth.positions()) builder.add_node(p);
  for (Index f = 0; f < patch.truth.face_count(); ++f) {
    const auto face = patch.truth.face(f);
    if (std::none_of(face.begin(), face.end(), [&](Index i) { return is_cut[static_cast<std::size_t>(i)] != 0; }))
      builder.add_face(std::vector<Index>(face.begin(), face.end()));
  }
  const PolygonMesh holed = builder.take();
  const auto off = [&](Continuity continuity) {
    FillOptions options;
    options.fair.continuity = continuity;
    const FilledHoles filled = fill_holes(holed, options);
    EXPECT_EQ(filled.report.continuity, continuity);
    double greatest = 0;
    for (const Vector3& p : filled.positions) {
      const Vector3 unit(p.x() / 1.5, p.y(), p.z() / 0.8);
      greatest = std::max(greatest, std::abs(unit.norm() - 1));
    }
    return greatest;
  };
  EXPECT_LT(off(Continuity::curvature), 0.7 * off(Continuity::tangent));
}

TEST(Continuity, OfCurvatureIsRefusedWhereItMeansNothing) {
  const Patch patch(generate::Faces::quads, 12, on_unit_sphere);
  FairOptions options;
  options.continuity = Continuity::curvature;
  FairOptions sweeps = options;
  sweeps.method = SweepMethod{};
  const auto refused = [](const std::function<void()>& call) { return refusal(call, ErrorCode::invalid_argument); };
  EXPECT_TRUE(says(refused([&] { (void)fair(patch.mesh, patch.constraints, sweeps); }), "by the method equilibrium"));
  EXPECT_TRUE(says(refused([&] {
                     (void)fit(patch.mesh, patch.constraints, {.positions = patch.mesh.positions()},
                               {.criterion = SmoothingLength{0.1}, .fair = options});
                   }),
                   "where no points pull"));
}

}  // namespace
}  // namespace vspring::continuity_test
