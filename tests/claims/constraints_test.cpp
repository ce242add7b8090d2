// What constraints mean, what is refused and what is warned of.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "support/fairness_of.hpp"
#include "support/refusal.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::constraints_test {
namespace {

using namespace support;
using generate::Faces;
using support::refusal;

std::string refusal(const PolygonMesh& mesh, const Constraints& constraints, ErrorCode code) {
  return refusal([&] { (void)fair(mesh, constraints); }, code);
}

// A mesh and a second one beside it, in one.
PolygonMesh beside(const PolygonMesh& a, const PolygonMesh& b) {
  MeshBuilder builder;
  for (const Vector3& p : a.positions()) builder.add_node(p);
  for (const Vector3& p : b.positions()) builder.add_node(p + Vector3(10, 0, 0));
  for (Index f = 0; f < a.face_count(); ++f) builder.add_face(a.face(f));
  for (Index f = 0; f < b.face_count(); ++f) {
    std::vector<Index> face;
    for (const Index i : b.face(f)) face.push_back(i + a.node_count());
    builder.add_face(face);
  }
  return builder.take();
}

TEST(Constraints, NormalsAreMadeUnitLengthWhateverTheirSize) {
  Constraints constraints(3);
  for (const double size : {1.0, 1e-300, 1e300}) {
    constraints.fix_normal(1, size * Vector3(3, 0, 4));
    EXPECT_LT((constraints.normal(1) - Vector3(0.6, 0, 0.8)).norm(), 1e-15);
  }
  for (const Vector3& bad : {Vector3(0, 0, 0), Vector3(NAN, 0, 1), Vector3(INFINITY, 0, 0)}) {
    EXPECT_TRUE(says(refusal([&] { constraints.fix_normal(2, bad); }, ErrorCode::unusable_constraint), "node 2"));
    EXPECT_FALSE(constraints.normal_fixed(2));
  }
  EXPECT_TRUE(says(refusal([&] { constraints.fix_position(3, {0, 0, 0}); }, ErrorCode::unusable_constraint), "node 3"));
  EXPECT_TRUE(says(refusal([&] { (void)constraints.position_fixed(-1); }, ErrorCode::unusable_constraint), "node -1"));
}

TEST(Constraints, AClosedComponentThatNothingHoldsIsRefused) {
  const PolygonMesh torus = generate::torus();
  const std::string message = refusal(torus, Constraints(torus.node_count()), ErrorCode::unusable_constraint);
  for (const char* part : {"node 0", "(400 nodes, closed)", "by a rule", "let only a region move"})
    EXPECT_TRUE(says(message, part)) << part;
  // Beside one that is held, too.
  const PolygonMesh both = beside(generate::plane(), torus);
  EXPECT_TRUE(says(refusal(both, held_boundary(both), ErrorCode::unusable_constraint), "node 441"));
}

TEST(Constraints, AFreeBoundaryIsRefusedAndAPartlyFreeOneWarnedOf) {
  const PolygonMesh mesh = generate::annulus({.nodes = 300});
  const auto loops = boundary_loops(mesh);
  ASSERT_EQ(loops.size(), 2U);
  for (const auto& free_loop : loops) {
    Constraints constraints = held_boundary(mesh);
    for (const Index i : free_loop) constraints.free_position(i);
    EXPECT_TRUE(says(refusal(mesh, constraints, ErrorCode::unusable_constraint), "boundary loop through node"));
    for (int k = 0; k < 2; ++k) constraints.fix_position(free_loop[static_cast<std::size_t>(k)], {0, 0, 0});
    EXPECT_TRUE(says(refusal(mesh, constraints, ErrorCode::unusable_constraint), "2 of its"));
  }
  Constraints constraints = held_boundary(mesh);
  constraints.free_position(loops[0][3]);
  const auto warnings = fair(mesh, constraints).report.warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(says(warnings[0].text, "1 boundary node is free")) << warnings[0].text;
  EXPECT_TRUE(fair(mesh, held_boundary(mesh)).report.warnings.empty());
}

TEST(Constraints, WhatLeavesAFamilyOfShapesIsWarnedOf) {
  const PolygonMesh cube = generate::genus({.holes = 0, .cells = 2});
  const auto warnings = [&](int positions, int normals) {
    Constraints constraints(cube.node_count());
    // Four corners that are not in a plane.
    int held = 0;
    for (const Vector3& corner : {Vector3(1, 1, 1), Vector3(-1, -1, 1), Vector3(-1, 1, -1), Vector3(1, -1, -1)}) {
      Index best = 0;
      for (Index i = 0; i < cube.node_count(); ++i) {
        if (cube.position(i).dot(corner) > cube.position(best).dot(corner)) best = i;
      }
      if (held < positions) constraints.fix_position(best, cube.position(best));
      if (held < normals) constraints.fix_normal(best, cube.position(best));
      ++held;
    }
    return check_constraints(cube, constraints).size();
  };
  EXPECT_EQ(warnings(1, 0), 1U);
  EXPECT_EQ(warnings(3, 0), 1U) << "a circle leaves the spheres through it";
  EXPECT_EQ(warnings(4, 0), 0U);
  EXPECT_EQ(warnings(1, 1), 1U) << "one tangent plane leaves the radius";
  EXPECT_EQ(warnings(2, 2), 0U);
}

TEST(Constraints, FacesBeyondARimFixTheSphereThatARegionIsOf) {
  PolygonMesh ball = generate::genus({.holes = 0, .cells = 6});
  std::vector<Vector3> places = ball.positions();
  for (Vector3& place : places) place.normalize();
  ball.set_positions(places);
  // A rim on one circle: without the faces beyond it all spheres through that would do.
  std::vector<Index> half;
  for (Index i = 0; i < ball.node_count(); ++i) {
    if (ball.position(i).z() > 1e-9) half.push_back(i);
  }
  Constraints region(ball.node_count());
  restrict_to_region(region, ball, half);
  EXPECT_TRUE(check_constraints(ball, region).empty());
  // Nodes of a circle alone, with nothing held beside them, leave the spheres through it.
  Constraints circle(ball.node_count());
  Index held = 0;
  for (Index i = 0; i < ball.node_count(); ++i) {
    if (std::abs(ball.position(i).z()) > 1e-9) continue;
    circle.fix_position(i, ball.position(i));
    ++held;
  }
  ASSERT_GT(held, 10);
  EXPECT_EQ(check_constraints(ball, circle).size(), 1U);
}

TEST(Constraints, AClosedSurfaceHeldAtOneNodeStaysNearTheInput) {
  const PolygonMesh block = generate::genus({.holes = 0, .cells = 4});
  Constraints constraints(block.node_count());
  constraints.fix_position(0, block.position(0));
  const FairResult result = fair(block, constraints);
  // One of a family: no equilibrium to go to, and nothing that would be called one.
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  ASSERT_EQ(result.report.warnings.size(), 2U);
  EXPECT_NE(result.report.warnings.back().text.find("near the input"), std::string::npos);
  EXPECT_LE(result.report.work, result.report.most_work);
  const auto [before, after] = fairness_of(block, constraints, result.positions);
  EXPECT_LT(after.greatest_turn, before.greatest_turn / 2);
  EXPECT_LT(after.rms_turn, 0.8 * before.rms_turn);
}

TEST(Constraints, WhatFallsApartIsStoppedAndItsBestShapeKept) {
  // So coarse, and held by so little, that nodes drift to one side of the closed surface until it collapses.
  const PolygonMesh block = generate::genus({.holes = 0, .cells = 3});
  Constraints constraints(block.node_count());
  constraints.fix_position(0, block.position(0));
  const FairResult result =
      fair(block, constraints, {.method = SweepMethod{.step_tolerance = 1e-6, .max_iterations = 100000}});
  EXPECT_EQ(result.report.outcome, Outcome::stalled);
  EXPECT_LT(result.report.iterations, 10000);
  EXPECT_EQ(result.report.warnings.size(), 2U);
  EXPECT_LT(result.report.residual, 0.01);
  const auto [before, after] = fairness_of(block, constraints, result.positions);
  EXPECT_LT(after.greatest_turn, before.greatest_turn / 2);
}

TEST(Constraints, NodesThatCannotMoveAreHeldAndBrokenPlacesRefusedWhereTheyWouldMove) {
  // A fin on an inner edge, a doubled face, a node used twice in a face, a coordinate that is no number, each in the
  // middle of a plane.
  const PolygonMesh plane =
      generate::add_noise(generate::plane({.columns = 6, .rows = 6, .faces = Faces::quads}), 0.03, 1);
  struct Broken {
    const char* named;
    int held;  ///< nodes, or 0 where it is refused
    std::function<void(std::vector<Vector3>&, std::vector<std::vector<Index>>&)> harm;
  };
  const std::vector<Broken> all = {{"edge 24–25: more than two faces", 2,
                                    [](auto& p, auto& f) {
                                      p.emplace_back(0.5, 0.5, 1);
                                      f.push_back({24, 25, 49});
                                    }},
                                   {"has the same nodes as face 15", 4, [](auto&, auto& f) { f.push_back(f[15]); }},
                                   {"face 15: node 24 occurs in it more than once", 3,
                                    [](auto&, auto& f) {
                                      f[15] = {24, 25, 24, 31};
                                    }},
                                   {"fewer than three nodes", 0,
                                    [](auto&, auto& f) {
                                      f.push_back({24, 25});
                                    }},
                                   {"node 25: a coordinate is not finite", 0, [](auto& p, auto&) { p[25].z() = NAN; }},
                                   {"node 24: its faces form more than one fan", 1, [](auto& p, auto& f) {
                                      p.emplace_back(0.5, 0.5, 1);
                                      p.emplace_back(0.6, 0.5, 1);
                                      f.push_back({24, 49, 50});
                                    }}};
  for (const Broken& broken : all) {
    SCOPED_TRACE(broken.named);
    std::vector<Vector3> positions = plane.positions();
    std::vector<std::vector<Index>> faces;
    faces.reserve(static_cast<std::size_t>(plane.face_count()));
    for (Index f = 0; f < plane.face_count(); ++f) faces.emplace_back(plane.face(f).begin(), plane.face(f).end());
    broken.harm(positions, faces);
    MeshBuilder builder;
    for (const Vector3& p : positions) builder.add_node(p);
    for (const auto& face : faces) builder.add_face(face);
    const PolygonMesh mesh = builder.take();
    Constraints constraints = held_boundary(mesh);
    constraints.free_position(24);
    constraints.free_position(25);
    if (broken.held == 0) {
      EXPECT_TRUE(says(refusal(mesh, constraints, ErrorCode::unusable_shape), broken.named));
    } else {
      const FairResult result = fair(mesh, constraints);
      EXPECT_EQ(result.report.outcome, Outcome::converged);
      EXPECT_EQ(result.positions[24], mesh.position(24));
      ASSERT_FALSE(result.report.warnings.empty());
      EXPECT_TRUE(says(result.report.warnings[0].text, fmt::format("{} node", broken.held)))
          << result.report.warnings[0].text;
      EXPECT_TRUE(says(result.report.warnings[0].text, broken.named)) << result.report.warnings[0].text;
    }
    // Far from it, the same mesh is faired.
    Constraints elsewhere = held_boundary(mesh);
    const std::vector<Index> region = {8};
    restrict_to_region(elsewhere, mesh, region);
    EXPECT_EQ(fair(mesh, elsewhere).report.outcome, Outcome::converged);
  }
}

TEST(Constraints, AHeldNodeThatIsNowhereIsRefusedWhereTheRimDependsOnIt) {
  const PolygonMesh plane = generate::plane({.columns = 8, .rows = 8, .faces = generate::Faces::quads});
  std::vector<Vector3> positions = plane.positions();
  positions[40].y() = INFINITY;
  const PolygonMesh mesh = with_positions(plane, positions);
  const auto moving = [&](Index node) {
    Constraints constraints(mesh.node_count());
    const std::vector<Index> region = {node};
    restrict_to_region(constraints, mesh, region);
    return constraints;
  };
  // Faces of 30, 39 and 48, beside the moving node, have node 40, which is held.
  Constraints near = moving(38);
  EXPECT_TRUE(says(refusal(mesh, near, ErrorCode::unusable_shape), "node 40: a coordinate is not finite"));
  EXPECT_EQ(fair(mesh, moving(10)).report.outcome, Outcome::converged) << "far from it";
  near.fix_position(40, plane.position(40));
  EXPECT_EQ(fair(mesh, near).report.outcome, Outcome::converged);
}

TEST(Constraints, InconsistentOrientationZeroLengthsAndIsolatedNodesAreFaired) {
  const PolygonMesh cap = generate::sphere_patch({.columns = 8, .rows = 8}, 1, 60);
  const auto held = [&](const PolygonMesh& mesh) {
    Constraints constraints = held_boundary(mesh);
    for (Index i = 0; i < cap.node_count(); ++i) {
      if (constraints.position_fixed(i)) constraints.fix_normal(i, cap.position(i));
    }
    return constraints;
  };
  const FairOptions options{.method = EquilibriumMethod{.tolerance = 1e-11}};
  std::vector<Index> corners = cap.corners();
  for (std::size_t f = 0; f < corners.size() / 3; f += 2) std::swap(corners[3 * f], corners[3 * f + 1]);
  std::vector<Vector3> positions = generate::add_noise(cap, 0.02, 3).positions();
  positions[40] = positions[41];
  positions.emplace_back(7, 7, 7);
  const PolygonMesh mesh(positions, cap.face_begin(), corners);
  const FairResult result = fair(mesh, held(mesh), options);
  for (Index i = 0; i < cap.node_count(); ++i)
    EXPECT_NEAR(result.positions[static_cast<std::size_t>(i)].norm(), 1, 1e-9);
  EXPECT_EQ(result.positions.back(), Vector3(7, 7, 7));
}

/// Noise is across it, inside.
PolygonMesh moebius_strip(double noise_of_inside) {
  MeshBuilder builder;
  const Index around = 40;
  const Index across = 5;
  for (Index k = 0; k < around; ++k) {
    const double angle = 2 * 3.14159265358979323846 * k / around;
    for (Index j = 0; j < across; ++j) {
      const double s = 0.4 * (j - 2.0) / 2;
      const double noise = j > 0 && j + 1 < across ? noise_of_inside * std::sin(5.0 * k + j) : 0;
      const double radius = 1 + s * std::cos(angle / 2) - noise * std::sin(angle / 2);
      const double height = s * std::sin(angle / 2) + noise * std::cos(angle / 2);
      builder.add_node({radius * std::cos(angle), radius * std::sin(angle), height});
    }
  }
  for (Index k = 0; k < around; ++k) {
    for (Index j = 0; j + 1 < across; ++j) {
      const auto at = [&](Index ring, Index place) {
        return ring < around ? ring * across + place : across - 1 - place;
      };
      builder.add_face({at(k, j), at(k + 1, j), at(k + 1, j + 1), at(k, j + 1)});
    }
  }
  return builder.take();
}

TEST(Constraints, AMoebiusStripIsFaired) {
  const PolygonMesh strip = moebius_strip(0.02);
  const FairResult by_edges =
      fair(strip, held_boundary(strip), {.method = EquilibriumMethod{.tolerance = 1e-8}, .springs = Springs::edge});
  EXPECT_EQ(by_edges.report.outcome, Outcome::converged);
  const auto [before, after] = fairness_of(strip, held_boundary(strip), by_edges.positions);
  EXPECT_LT(after.vspring_energy, before.vspring_energy / 4);
  // Spheres, whose normals turn over where the strip's sides meet, may leave it to edges.
  const FairResult by_default = fair(strip, held_boundary(strip), {.method = EquilibriumMethod{.tolerance = 1e-8}});
  EXPECT_EQ(by_default.report.outcome, Outcome::converged);
}

TEST(Constraints, NormalsOfAMoebiusStripAreKnownWhereItsFacesMeetTheOtherWayRound) {
  const PolygonMesh strip = moebius_strip(0);
  const std::vector<Index> seam = {0, 4};
  for (const Vector3& normal : estimate_normals(strip, seam)) EXPECT_NEAR(std::abs(normal.z()), 1, 0.1);
}

TEST(Region, ThePatchMeetsTheRestWithACommonTangentPlane) {
  // A region of a cylinder, faired from a dent: the greater the nodes, the nearer to the cylinder.
  const auto error = [](int cells) {
    const PolygonMesh cylinder =
        generate::cylinder_patch({.columns = cells, .rows = cells, .faces = Faces::quads}, 1, 150, 2.6);
    std::vector<Vector3> dented = cylinder.positions();
    std::vector<Index> region;
    for (Index i = 0; i < cylinder.node_count(); ++i) {
      const double distance = (cylinder.position(i) - Vector3(1, 0, 1.3)).norm();
      if (distance > 0.6) continue;
      region.push_back(i);
      dented[static_cast<std::size_t>(i)].x() -= 0.3 * std::exp(-8 * distance * distance);
    }
    const PolygonMesh mesh(dented, cylinder.face_begin(), cylinder.corners());
    Constraints constraints = held_boundary(mesh);
    restrict_to_region(constraints, mesh, region);
    const FairResult result =
        fair(mesh, constraints, {.method = EquilibriumMethod{.tolerance = 1e-9}, .distribution = Distribution::even});
    double greatest = 0;
    for (const Vector3& p : result.positions) greatest = std::max(greatest, std::abs(std::hypot(p.x(), p.y()) - 1));
    return greatest;
  };
  const double coarse = error(16);
  EXPECT_LT(coarse, 0.01);
  EXPECT_GT(coarse / error(32), 3);
}

TEST(Region, FixesEverythingOutsideAndNormalsWhereTheRimIsAtTheBoundary) {
  const PolygonMesh mesh = generate::plane({.columns = 10, .rows = 10, .faces = Faces::quads});
  const auto restricted = [&](const SphereRegion& sphere, std::size_t size) {
    const auto region = select_region(mesh.positions(), {sphere});
    EXPECT_EQ(region.size(), size);
    Constraints constraints(mesh.node_count());
    restrict_to_region(constraints, mesh, region);
    std::vector<Index> normals;
    for (Index i = 0; i < mesh.node_count(); ++i) {
      const bool inside = std::find(region.begin(), region.end(), i) != region.end();
      EXPECT_EQ(constraints.position_fixed(i), !inside);
      if (constraints.normal_fixed(i)) normals.push_back(i);
    }
    return normals;
  };
  EXPECT_EQ(restricted({{0.5, 0.5, 0}, 0.25}, 21), std::vector<Index>());
  EXPECT_EQ(restricted({{0.5, 0, 0}, 0.25}, 13), (std::vector<Index>{2, 8}));
}

TEST(Region, TheRimTakesItsNormalsFromBothSides) {
  // A funnel between two rings of two rows each, from a cone: what moves is fairer if faces that move have a say in the
  // normals between.
  const int columns = 64;
  const int rows = 14;
  const PolygonMesh tube = generate::tube({.columns = columns, .rows = rows}, 1, 1);
  std::vector<Vector3> positions = tube.positions();
  std::vector<Index> region;
  std::vector<Index> rim;
  for (Index i = 0; i < tube.node_count(); ++i) {
    const Index row = i / columns;
    Vector3& p = positions[static_cast<std::size_t>(i)];
    // Two rings of a plane and of a cylinder, with a cone between.
    const double inwards = std::clamp((row - 1.0) / (rows - 2.0), 0.0, 1.0);
    p.head<2>() *= (row == 0 ? 1.05 : 1) - 0.5 * inwards;
    p.z() = 0.5 * inwards + (row == rows ? 0.05 : 0);
    if (row > 1 && row + 1 < rows) region.push_back(i);
    if (row == 1 || row + 1 == rows) rim.push_back(i);
  }
  const PolygonMesh funnel = with_positions(tube, positions);
  Constraints constraints(funnel.node_count());
  restrict_to_region(constraints, funnel, region);
  const auto variation = [&] {
    const FairResult result = fair(funnel, constraints);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    return measure_surface(with_positions(funnel, result.positions)).curvature_variation;
  };
  const double computed = variation();
  std::vector<std::uint8_t> outside(static_cast<std::size_t>(funnel.face_count()), 0);
  for (Index f = 0; f < funnel.face_count(); ++f) {
    const auto face = funnel.face(f);
    outside[static_cast<std::size_t>(f)] =
        std::all_of(face.begin(), face.end(), [&](Index node) { return constraints.position_fixed(node); }) ? 1 : 0;
  }
  const std::vector<Vector3> normals = estimate_normals(funnel, rim, outside);
  for (std::size_t k = 0; k < rim.size(); ++k) constraints.fix_normal(rim[k], normals[k]);
  const double given = variation();
  EXPECT_LT(computed, 0.5 * given) << given;
}

TEST(Region, ARimNodeWithNothingOutsideKeepsItsNormalFree) {
  const PolygonMesh mesh = generate::plane({.columns = 10, .rows = 10, .faces = Faces::quads});
  std::vector<Index> region;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (i != 60) region.push_back(i);
  }
  Constraints constraints = held_boundary(mesh);
  restrict_to_region(constraints, mesh, region);
  EXPECT_TRUE(constraints.position_fixed(60));
  EXPECT_FALSE(constraints.normal_fixed(60));
  EXPECT_TRUE(constraints.position_fixed(0)) << "what was held before stays held";
  EXPECT_EQ(fair(mesh, constraints).report.outcome, Outcome::converged);
}

}  // namespace
}  // namespace vspring::constraints_test
