// Nodes that slide on a support stay on it, and the surface that ends there is the one that it bounds.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "support/methods.hpp"
#include "support/refusal.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::sliding_test {
namespace {

using namespace support;

/// A ring of faces: `rows` + 1 circles of nodes, from circle to circle.
struct Ring {
  Index columns;
  Index rows;
  PolygonMesh mesh;

  /// place(row, angle): of the nodes; row from 0 to 1, angle in radians.
  Ring(Index columns_wanted, Index rows_wanted, bool triangles,
       const std::function<Vector3(double row, double angle)>& place)
      : columns(columns_wanted), rows(rows_wanted) {
    MeshBuilder builder;
    for (Index r = 0; r <= rows; ++r) {
      for (Index c = 0; c < columns; ++c)
        builder.add_node(place(static_cast<double>(r) / rows, 2 * std::numbers::pi * c / columns));
    }
    for (Index r = 0; r < rows; ++r) {
      for (Index c = 0; c < columns; ++c) {
        const Index next = (c + 1) % columns;
        const std::vector<Index> quad = {node(r, c), node(r, next), node(r + 1, next), node(r + 1, c)};
        if (triangles) {
          builder.add_face({quad[0], quad[1], quad[2]});
          builder.add_face({quad[0], quad[2], quad[3]});
        } else {
          builder.add_face(quad);
        }
      }
    }
    mesh = builder.take();
  }

  [[nodiscard]] Index node(Index row, Index column) const { return row * columns + column; }
  [[nodiscard]] std::vector<Index> circle(Index row) const {
    std::vector<Index> nodes(static_cast<std::size_t>(columns));
    std::iota(nodes.begin(), nodes.end(), node(row, 0));
    return nodes;
  }
};

constexpr double first_angle = 30 * degree;
constexpr double last_angle = 75 * degree;

Vector3 on_sphere(double polar, double angle) {
  return {std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)};
}

/// A zone of the unit sphere.
Ring zone(Index columns, Index rows, bool triangles) {
  return {columns, rows, triangles,
          [](double row, double angle) { return on_sphere(first_angle + row * (last_angle - first_angle), angle); }};
}

/// Holds the first circle, with the normals of the sphere there; gives the last one these normals.
Constraints held_zone(const Ring& ring) {
  Constraints constraints(ring.mesh.node_count());
  for (const Index i : ring.circle(0)) constraints.fix_position(i, ring.mesh.position(i));
  for (const Index row : {Index{0}, ring.rows}) {
    for (const Index i : ring.circle(row)) constraints.fix_normal(i, ring.mesh.position(i));
  }
  return constraints;
}

/// The mesh with noise inside, and its last circle elsewhere: `move` of each node's place.
PolygonMesh disturbed(const Ring& ring, double noise, const std::function<Vector3(const Vector3&)>& move) {
  std::vector<Vector3> positions = generate::add_noise(ring.mesh, noise, 3).positions();
  for (const Index row : {Index{0}, ring.rows}) {
    for (const Index i : ring.circle(row)) positions[static_cast<std::size_t>(i)] = ring.mesh.position(i);
  }
  for (const Index i : ring.circle(ring.rows)) {
    Vector3& place = positions[static_cast<std::size_t>(i)];
    place = move(place);
  }
  return with_positions(ring.mesh, positions);
}

/// Further out, more on two sides.
Vector3 pushed_out(const Vector3& place) {
  const double angle = std::atan2(place.y(), place.x());
  const double factor = 1.1 + 0.05 * std::cos(2 * angle);
  return {factor * place.x(), factor * place.y(), place.z()};
}

FairOptions to_the_end() { return {.method = equilibrium_alone(1e-12)}; }

double distance_from_support(const FairResult& result, const Constraints& constraints) {
  double greatest = 0;
  for (Index i = 0; i < constraints.node_count(); ++i) {
    const Vector3& place = result.positions[static_cast<std::size_t>(i)];
    if (constraints.support(i) != nullptr)
      greatest = std::max(greatest, (*constraints.support(i)->nearest(place) - place).norm());
  }
  return greatest;
}

TEST(Sliding, ARimThatSlidesInItsPlaneBoundsTheSphere) {
  for (const Index rows : {8, 32}) {
    for (const bool triangles : {false, true}) {
      SCOPED_TRACE(fmt::format("{} rows, {}", rows, triangles ? "triangles" : "quads"));
      const Ring ring = zone(4 * rows, rows, triangles);
      Constraints constraints = held_zone(ring);
      constraints.slide_on(ring.circle(ring.rows), Support::plane({7, 3, std::cos(last_angle)}, {0, 0, -2}));
      const PolygonMesh start = disturbed(ring, 0.02, pushed_out);
      const FairResult result = fair(start, constraints, to_the_end());
      EXPECT_EQ(result.report.outcome, Outcome::converged);
      EXPECT_EQ(result.report.sliding_nodes, ring.columns);
      EXPECT_EQ(result.report.moving_nodes, ring.rows * ring.columns);
      EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-10);
      EXPECT_LT(distance_from_support(result, constraints), 1e-15);
      EXPECT_GT(result.report.greatest_move, 0.1);
      EXPECT_LE(result.report.levels.back().iterations, 30);
    }
  }
}

TEST(Sliding, SoDoesALargeOne) {
  // More nodes than factors are made for.
  const Ring ring = zone(160, 40, true);
  Constraints constraints = held_zone(ring);
  constraints.slide_on(ring.circle(ring.rows), Support::plane({0, 0, std::cos(last_angle)}, {0, 0, 1}));
  const FairResult result = fair(disturbed(ring, 0.01, pushed_out), constraints, to_the_end());
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-10);
  EXPECT_LE(result.report.levels.back().iterations, 40);
}

TEST(Sliding, ARimThatSlidesOnACylinderDoes) {
  const Ring ring = zone(48, 12, true);
  Constraints constraints = held_zone(ring);
  constraints.slide_on(ring.circle(ring.rows), Support::cylinder({0, 0, 5}, {0, 0, 3}, std::sin(last_angle)));
  const PolygonMesh start =
      disturbed(ring, 0.02, [](const Vector3& p) { return Vector3(p.x(), p.y(), p.z() - 0.1 - 0.1 * p.x() * p.y()); });
  const FairResult result = fair(start, constraints, to_the_end());
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-10);
  EXPECT_LT(distance_from_support(result, constraints), 1e-15);
}

TEST(Sliding, APlaneAndACylinderHoldASphereTogether) {
  // One rim slides in its plane, the other one on its cylinder; one node is held.
  const Ring ring = zone(48, 12, false);
  Constraints constraints = held_zone(ring);
  constraints.slide_on(ring.circle(0), Support::plane({0, 0, std::cos(first_angle)}, {0, 0, 1}));
  constraints.slide_on(ring.circle(ring.rows), Support::cylinder({0, 0, 0}, {0, 0, 1}, std::sin(last_angle)));
  constraints.fix_position(ring.node(0, 0), ring.mesh.position(ring.node(0, 0)));
  const PolygonMesh start = disturbed(ring, 0.01, [](const Vector3& p) { return Vector3(p.x(), p.y(), p.z() - 0.05); });
  const FairResult result = fair(start, constraints, to_the_end());
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.sliding_nodes, 2 * ring.columns - 1);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-9);
  EXPECT_LT(distance_from_support(result, constraints), 1e-15);
}

/// A curve across the unit sphere at a place of it, and how far along it nodes start.
struct Crossing {
  const char* name;
  std::function<Support(const Vector3& place)> at;
};

TEST(Sliding, NodesSlideOnCurves) {
  const auto across = [](const Vector3& p) { return Vector3(p + 0.5 * Vector3(0, 0, 1)); };
  const Crossing crossings[] = {
      {"lines", [&](const Vector3& p) { return Support::line(p + 3 * across(p), across(p)); }},
      {"circles",
       [](const Vector3& p) {
         // Upright, through the place, which it crosses at an angle of 45°.
         const Vector3 aside = Vector3(0, 0, 1).cross(p).normalized();
         const Vector3 down = aside.cross(p);
         return Support::circle(p + 0.2 * (p + down), aside, 0.2 * std::sqrt(2.0));
       }},
      {"polylines",
       [&](const Vector3& p) {
         return Support::polyline({p - 0.5 * across(p), p + 0.02 * across(p), p + 0.1 * p, p + p});
       }},
      {"closed polylines",
       [&](const Vector3& p) {
         return Support::polyline({p + across(p), p + 3 * across(p) + Vector3(0, 0, 1), p - across(p)}, true);
       }},
  };
  const Ring ring = zone(32, 8, true);
  for (const auto& [name, at] : crossings) {
    SCOPED_TRACE(name);
    Constraints constraints = held_zone(ring);
    for (const Index i : ring.circle(ring.rows)) constraints.slide_on(i, at(ring.mesh.position(i)));
    const PolygonMesh start = disturbed(ring, 0.01, [](const Vector3& p) { return Vector3(1.06 * p); });
    const FairResult result = fair(start, constraints, to_the_end());
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LT(distance_from_support(result, constraints), 1e-14);
    EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-9);
  }
}

TEST(Sliding, ATubeThatSlidesInThePlaneOfItsEndStaysATube) {
  // What an end across the axis leaves of the curvature is the same on every circle.
  const Ring ring(40, 10, false,
                  [](double row, double angle) { return Vector3(std::cos(angle), std::sin(angle), 1.5 * row); });
  const auto distance_from_tube = [](const std::vector<Vector3>& positions) {
    double greatest = 0;
    for (const Vector3& p : positions) greatest = std::max(greatest, std::abs(std::hypot(p.x(), p.y()) - 1));
    return greatest;
  };
  Constraints constraints(ring.mesh.node_count());
  for (const Index row : {Index{0}, ring.rows}) {
    for (const Index i : ring.circle(row)) {
      const Vector3& p = ring.mesh.position(i);
      if (row == 0) constraints.fix_position(i, p);
      constraints.fix_normal(i, {p.x(), p.y(), 0});
    }
  }
  constraints.slide_on(ring.circle(ring.rows), Support::plane({0, 0, 1.5}, {0, 0, 1}));
  const FairResult result = fair(disturbed(ring, 0.02, pushed_out), constraints, to_the_end());
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_LT(distance_from_tube(result.positions), 1e-5);
}

TEST(Sliding, NodesInsideSlideToo) {
  // A circle of nodes keeps to its plane: the surface is what it is without, and is cut there.
  const PolygonMesh cap = generate::sphere_patch({.columns = 20, .rows = 20}, 1, 60);
  Constraints constraints = held_boundary(cap, radial);
  std::vector<Index> line;
  for (Index i = 0; i < cap.node_count(); ++i) {
    if (!constraints.position_fixed(i) && std::abs(cap.position(i).x()) < 1e-9) line.push_back(i);
  }
  ASSERT_GT(line.size(), 10U);
  const Support plane = Support::plane({0, 0, 0}, {1, 0, 0});
  constraints.slide_on(line, plane);
  const FairResult result = fair(generate::add_noise(cap, 0.02, 3), constraints, to_the_end());
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-10);
  for (const Index i : line) EXPECT_EQ(result.positions[static_cast<std::size_t>(i)].x(), 0);
}

/// A sheet that nobody knows the fair shape of: waves, over a rectangle whose side x = 0 ends in a plane.
struct Sheet {
  PolygonMesh mesh;
  Constraints constraints;
};

Sheet sheet(const Eigen::Isometry3d& moved = Eigen::Isometry3d::Identity()) {
  const PolygonMesh flat = generate::plane({.columns = 24, .rows = 16}, 1.5, 1);
  std::vector<Vector3> positions = flat.positions();
  Constraints constraints(flat.node_count());
  const std::vector<std::uint8_t> boundary = boundary_nodes(flat);
  std::vector<Index> side;
  for (Index i = 0; i < flat.node_count(); ++i) {
    Vector3& p = positions[static_cast<std::size_t>(i)];
    const bool at_side = p.x() < 1e-9 && p.y() > 1e-9 && p.y() < 1 - 1e-9;
    const Vector3 normal(-0.6 * std::cos(0.5) - 0.3 * p.y() * p.y(), 0, 1);
    const double rough = boundary[static_cast<std::size_t>(i)] != 0 ? 0 : 0.02 * std::sin(30 * p.x() + 17 * p.y());
    p.z() = 0.3 * std::sin(2 * p.x() + 0.5) + 0.3 * p.x() * p.y() * p.y() + rough;
    if (at_side) {
      side.push_back(i);
      constraints.fix_normal(i, moved.linear() * normal);
    }
    p = moved * p;
    if (!at_side && boundary[static_cast<std::size_t>(i)] != 0) constraints.fix_position(i, p);
  }
  constraints.slide_on(side,
                       Support::plane(moved * Vector3(0, 3, 0.3 * std::sin(0.5)), moved.linear() * Vector3(4, 0, 1)));
  return {with_positions(flat, positions), constraints};
}

TEST(Sliding, TheResultMovesWithTheInput) {
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.rotate(Eigen::AngleAxisd(1.1, Vector3(1, 2, 3).normalized()));
  moved.pretranslate(Vector3(5, -3, 2));
  const Sheet one = sheet();
  const Sheet other = sheet(moved);
  const FairResult result = fair(one.mesh, one.constraints, to_the_end());
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_LT(distance_from_support(result, one.constraints), 1e-15);
  std::vector<Vector3> expected = result.positions;
  for (Vector3& p : expected) p = moved * p;
  EXPECT_LT(greatest_distance(fair(other.mesh, other.constraints, to_the_end()).positions, expected), 1e-9);
}

TEST(Sliding, TheSameBitsOnAnyNumberOfThreads) {
  // So many that several threads have work.
  const Ring ring = zone(160, 40, true);
  Constraints constraints = held_zone(ring);
  constraints.slide_on(ring.circle(ring.rows), Support::cylinder({0, 0, 0}, {0, 0, 1}, std::sin(last_angle)));
  constraints.slide_on(ring.circle(20), Support::plane(ring.mesh.position(ring.node(20, 0)), {0, 0, 1}));
  const PolygonMesh start = disturbed(ring, 0.01, [](const Vector3& p) { return Vector3(p.x(), p.y(), p.z() - 0.1); });
  const auto on = [&](int threads) {
    Context context;
    context.threads = threads;
    const FairResult result = fair(start, constraints, {}, context);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LT(distance_from_support(result, constraints), 1e-15);
    return result.positions;
  };
  EXPECT_EQ(greatest_distance(on(1), on(3)), 0);
}

TEST(Sliding, TheTrueDistanceIsAboutTheExpectedOne) {
  const Sheet given = sheet();
  const FairResult exact = fair(given.mesh, given.constraints, to_the_end());
  for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
    SCOPED_TRACE(tolerance);
    const FairResult result = fair(given.mesh, given.constraints, {.method = equilibrium_alone(tolerance)});
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    const double size = diagonal(given.mesh, given.constraints);
    EXPECT_LT(greatest_distance(result.positions, exact.positions), 3 * *result.report.expected_error * size);
  }
}

TEST(Sliding, EveryMethodKeepsToTheSupport) {
  const Sheet given = sheet();
  const FairResult exact = fair(given.mesh, given.constraints, to_the_end());
  for (const FairOptions& options :
       {FairOptions{.method = SweepMethod{.step_tolerance = 1e-5, .max_iterations = 20000}},
        FairOptions{.method = MultigridMethod{.step_tolerance = 1e-5}}, FairOptions{.springs = Springs::edge},
        FairOptions{.fair_by = FairBy::bending}, FairOptions{.strength = 0.5},
        FairOptions{.distribution = Distribution::keep}, FairOptions{.distribution = Distribution::even}}) {
    const FairResult result = fair(given.mesh, given.constraints, options);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LT(distance_from_support(result, given.constraints), 1e-15);
    if (options.strength == 1) {
      EXPECT_LT(greatest_distance(result.positions, exact.positions), 0.1);
    }
  }
}

TEST(Sliding, ASessionFollowsAsAFreshStart) {
  Sheet given = sheet();
  FairingSession session(given.mesh, to_the_end(), 1);
  Context context;
  (void)session.fair(given.constraints, context);
  for (Index i = 0; i < given.mesh.node_count(); ++i) {
    if (given.constraints.position_fixed(i))
      given.constraints.fix_position(i,
                                     given.constraints.position(i) + Vector3(0, 0, 0.1 * given.mesh.position(i).x()));
  }
  const FairResult followed = session.fair(given.constraints, context);
  EXPECT_EQ(followed.report.levels.size(), 1U);
  EXPECT_LT(distance_from_support(followed, given.constraints), 1e-15);
  EXPECT_LT(greatest_distance(followed.positions, fair(given.mesh, given.constraints, to_the_end()).positions), 1e-7);
}

TEST(Sliding, HalfASurfaceThatMeetsAPlaneUprightIsHalfOfTheWhole) {
  // The whole has all faces at the plane, its half those on one side: they agree as far as the mesh tells the shape.
  double before = 0;
  for (const Index columns : {12, 24, 48}) {
    const PolygonMesh flat = generate::plane({.columns = columns, .rows = columns}, 1, 1);
    std::vector<Vector3> positions = flat.positions();
    for (Vector3& p : positions) p.z() = 0.4 * p.x() * p.x() + 0.3 * std::sin(3 * p.y()) * std::cos(2 * p.x());
    const PolygonMesh half = with_positions(flat, positions);
    const std::vector<std::uint8_t> boundary = boundary_nodes(half);
    Constraints held(half.node_count());
    std::vector<Index> side;
    for (Index i = 0; i < half.node_count(); ++i) {
      const bool at_side =
          half.position(i).x() < 1e-9 && half.position(i).y() > 1e-9 && half.position(i).y() < 1 - 1e-9;
      if (at_side) side.push_back(i);
      if (!at_side && boundary[static_cast<std::size_t>(i)] != 0) held.fix_position(i, half.position(i));
    }
    const FairResult whole = fair(find_symmetry(half, parse_plane("x")), held, to_the_end());
    Constraints sliding = held;
    sliding.slide_on(side, Support::plane({0, 0, 0}, {1, 0, 0}));
    const Symmetric<PolygonMesh> shape = find_symmetry(with_positions(half, whole.positions), parse_plane("x"));
    const std::vector<Vector3> normals = estimate_normals(shape.whole, side);
    for (std::size_t k = 0; k < side.size(); ++k) sliding.fix_normal(side[k], normals[k]);
    const FairResult result = fair(half, sliding, to_the_end());
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_EQ(result.report.springs, Springs::sphere);
    // The whole's nodes slide along the side, too.
    const double apart = distance(result.positions, shape.whole).greatest;
    EXPECT_LT(apart, 0.01);
    if (before > 0) {
      EXPECT_LT(apart, 0.6 * before);
    }
    before = apart;
  }
}

/// Half of a zone of the unit sphere, where x is not negative.
PolygonMesh half_zone(Index columns, Index rows) {
  MeshBuilder builder;
  for (Index r = 0; r <= rows; ++r) {
    for (Index c = 0; c <= columns; ++c) {
      Vector3 p = on_sphere(first_angle + r * (last_angle - first_angle) / rows,
                            (static_cast<double>(c) / columns - 0.5) * std::numbers::pi);
      if (c == 0 || c == columns) p.x() = 0;
      builder.add_node(p);
    }
  }
  for (Index r = 0; r < rows; ++r) {
    for (Index c = 0; c < columns; ++c) {
      const Index i = r * (columns + 1) + c;
      builder.add_face({i, i + 1, i + columns + 2, i + columns + 1});
    }
  }
  return builder.take();
}

TEST(Sliding, AHalfWhoseRimSlidesIsHalfOfTheSphere) {
  constexpr Index columns = 24;
  constexpr Index rows = 12;
  const PolygonMesh half = half_zone(columns, rows);
  Constraints constraints(half.node_count());
  std::vector<Index> rim;
  std::vector<Vector3> positions = half.positions();
  for (Index c = 0; c <= columns; ++c) {
    constraints.fix_position(c, half.position(c));
    rim.push_back(rows * (columns + 1) + c);
    Vector3& place = positions[static_cast<std::size_t>(rim.back())];
    place = pushed_out(place);
  }
  for (Index c = 0; c <= columns; ++c) {
    for (const Index i : {c, rim[static_cast<std::size_t>(c)]}) constraints.fix_normal(i, half.position(i));
  }
  // Leaning, so its mirror image is another one.
  for (const Index i : rim) {
    const Vector3& p = half.position(i);
    constraints.slide_on(i, Support::line(p, Vector3(p.x(), p.y(), 0.3 * p.x())));
  }
  const PolygonMesh start = with_positions(half, positions);
  const FairResult result = fair(find_symmetry(start, parse_plane("x")), constraints, to_the_end());
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.sliding_nodes, columns + 1);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-9);
  EXPECT_LT(distance_from_support(result, constraints), 1e-15);
  // On the plane, it would leave it.
  constraints.slide_on(rim.front(), Support::line(half.position(rim.front()), {1, 1, 0}));
  const std::string message = refusal([&] { (void)fair(find_symmetry(start, parse_plane("x")), constraints, {}); },
                                      ErrorCode::unusable_constraint);
  EXPECT_TRUE(says(message, fmt::format("node {} slides on something", rim.front()))) << message;
}

TEST(Sliding, NewNodesBetweenThoseThatSlideDoSo) {
  const Ring ring = zone(16, 4, true);
  Constraints constraints = held_zone(ring);
  const Support plane = Support::plane({0, 0, std::cos(last_angle)}, {0, 0, 1});
  std::vector<Index> rim = ring.circle(ring.rows);
  // Beside a held one, too.
  constraints.fix_position(rim.front(), ring.mesh.position(rim.front()));
  rim.erase(rim.begin());
  constraints.slide_on(rim, plane);
  const Refined refined = refine(ring.mesh, constraints, {.length = 0.25});
  const std::vector<std::uint8_t> boundary = boundary_nodes(refined.mesh);
  Index sliding = 0;
  for (Index i = 0; i < refined.mesh.node_count(); ++i) {
    if (boundary[static_cast<std::size_t>(i)] == 0 || refined.mesh.position(i).z() > 0.5) continue;
    sliding += refined.constraints.support(i) != nullptr ? 1 : 0;
    EXPECT_TRUE(i == ring.node(ring.rows, 0) || *refined.constraints.support(i) == plane) << i;
  }
  EXPECT_EQ(sliding, 31);
  const FairResult result = fair(refined.mesh, refined.constraints, {});
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 0.02);
}

TEST(Sliding, ConstraintsKeepOneWayToHold) {
  Constraints constraints(4);
  const Support plane = Support::plane({0, 0, 0}, {0, 0, 2});
  constraints.slide_on(1, plane);
  ASSERT_NE(constraints.support(1), nullptr);
  EXPECT_EQ(*constraints.support(1), plane);
  EXPECT_EQ(constraints.support(0), nullptr);
  EXPECT_EQ(constraints.sliding_count(), 1);
  constraints.fix_position(1, {1, 2, 3});
  EXPECT_EQ(constraints.support(1), nullptr);
  constraints.slide_on(1, plane);
  EXPECT_FALSE(constraints.position_fixed(1));
  constraints.hold_as(2, constraints, 1);
  EXPECT_EQ(constraints.support(2), constraints.support(1));
  constraints.free_position(1);
  EXPECT_EQ(constraints.sliding_count(), 1);
  constraints.add_nodes(1);
  EXPECT_EQ(constraints.support(4), nullptr);
  EXPECT_TRUE(says(refusal([&] { constraints.slide_on(9, plane); }, ErrorCode::unusable_constraint), "node 9"));
}

TEST(Sliding, ADegenerateSupportIsRefused) {
  const std::function<void()> calls[] = {
      [] {
        (void)Support::plane({0, 0, 0}, {0, 0, 0});
      },
      [] {
        (void)Support::plane({0, NAN, 0}, {0, 0, 1});
      },
      [] {
        (void)Support::line({0, 0, 0}, {0, 0, 0});
      },
      [] {
        (void)Support::cylinder({0, 0, 0}, {0, 0, 1}, 0);
      },
      [] {
        (void)Support::circle({0, 0, 0}, {0, 0, 1}, -1);
      },
      [] {
        (void)Support::circle({0, 0, 0}, {0, 0, 1}, INFINITY);
      },
      [] {
        (void)Support::polyline({{0, 0, 0}});
      },
      [] {
        (void)Support::polyline({{1, 1, 1}, {1, 1, 1}});
      },
      [] {
        (void)Support::polyline({{1, 1, 1}, {1, INFINITY, 1}});
      },
  };
  for (const auto& call : calls) EXPECT_TRUE(says(refusal(call, ErrorCode::unusable_constraint), "to slide on has"));
}

TEST(Sliding, NearestPlaces) {
  const auto there = [](const Support& support, const Vector3& place) { return support.nearest(place).value(); };
  EXPECT_LT((there(Support::plane({0, 0, 2}, {0, 0, 1}), {3, 4, 5}) - Vector3(3, 4, 2)).norm(), 1e-15);
  EXPECT_LT((there(Support::line({1, 0, 0}, {0, 5, 0}), {3, 4, 5}) - Vector3(1, 4, 0)).norm(), 1e-15);
  EXPECT_LT((there(Support::circle({0, 0, 1}, {0, 0, 1}, 10), {3, 4, 5}) - Vector3(6, 8, 1)).norm(), 1e-14);
  EXPECT_LT((there(Support::cylinder({0, 0, 1}, {0, 0, 1}, 10), {3, 4, 5}) - Vector3(6, 8, 5)).norm(), 1e-14);
  const Support corner = Support::polyline({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  EXPECT_LT((there(corner, {0.4, -1, 1}) - Vector3(0.4, 0, 0)).norm(), 1e-15);
  EXPECT_LT((there(corner, {2, -1, 0}) - Vector3(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((there(corner, {-2, 1, 0}) - Vector3(0, 0, 0)).norm(), 1e-15);
  EXPECT_FALSE(Support::circle({0, 0, 1}, {0, 0, 1}, 10).nearest({0, 0, 7}));
  EXPECT_FALSE(Support::cylinder({0, 0, 1}, {0, 0, 1}, 10).nearest({0, 0, 7}));
  // Straight ahead on a cylinder is straight where that is unrolled.
  const Support helix = Support::cylinder({0, 0, 0}, {0, 0, 1}, 2).straight_ahead({3, 0, 1}, {7, 1, 1});
  EXPECT_LT((there(helix, {2 * std::cos(0.25), 2 * std::sin(0.25), 1.5}) -
             Vector3(2 * std::cos(0.25), 2 * std::sin(0.25), 1.5))
                .norm(),
            1e-15);
  EXPECT_LT((helix.axis({2, 0, 1}) - Vector3(0, 1, 1).normalized()).norm(), 1e-15);
}

std::string refusal_of_zone(const std::function<void(const Ring&, Constraints&)>& hold) {
  const Ring ring = zone(16, 6, true);
  Constraints constraints = held_zone(ring);
  hold(ring, constraints);
  return refusal([&] { (void)fair(ring.mesh, constraints); }, ErrorCode::unusable_constraint);
}

TEST(Sliding, ANodeThatCannotReachItsSupportIsRefused) {
  const std::string far = refusal_of_zone([](const Ring& ring, Constraints& constraints) {
    constraints.slide_on(ring.node(6, 3), Support::plane({0, 0, -20}, {0, 0, 1}));
  });
  EXPECT_TRUE(says(far, "node 99 lies 20.3 away")) << far;
  const std::string centre = refusal_of_zone([](const Ring& ring, Constraints& constraints) {
    constraints.slide_on(ring.node(6, 3), Support::circle(ring.mesh.position(ring.node(6, 3)), {0, 0, 1}, 1));
  });
  EXPECT_TRUE(says(centre, "node 99 lies on the axis")) << centre;
  const std::string loose = refusal_of_zone([](const Ring& ring, Constraints& constraints) {
    constraints.slide_on(ring.node(6, 3), Support::plane(ring.mesh.position(ring.node(6, 3)), {0, 0, 1}));
    constraints.free_normal(ring.node(6, 3));
  });
  EXPECT_TRUE(says(loose, "node 99 slides at the boundary and has no given normal")) << loose;
  const std::string unheld = refusal_of_zone([](const Ring& ring, Constraints& constraints) {
    for (const Index row : {Index{0}, ring.rows})
      constraints.slide_on(ring.circle(row),
                           Support::plane({0, 0, ring.mesh.position(ring.node(row, 0)).z()}, {0, 0, 1}));
  });
  EXPECT_TRUE(says(unheld, "nothing holds the component of node 0")) << unheld;
}

TEST(Sliding, ANodeWhoseSurfaceLiesAlongTheSupportIsHeldThere) {
  const Ring ring = zone(16, 6, true);
  Constraints constraints = held_zone(ring);
  constraints.slide_on(ring.circle(ring.rows), Support::plane({0, 0, std::cos(last_angle)}, {0, 0, 1}));
  const Index stuck = ring.node(ring.rows, 5);
  const Vector3 place = ring.mesh.position(stuck);
  constraints.slide_on(stuck, Support::plane(1.01 * place, place));
  const FairResult result = fair(disturbed(ring, 0.01, pushed_out), constraints, {});
  ASSERT_FALSE(result.report.warnings.empty());
  const std::string& warning = result.report.warnings.front().text;
  EXPECT_TRUE(says(warning, "1 node cannot move and is held: node 101 cannot slide")) << warning;
  EXPECT_LT(std::abs((result.positions[static_cast<std::size_t>(stuck)] - 1.01 * place).dot(place)), 1e-15);
  EXPECT_EQ(result.report.sliding_nodes, ring.columns - 1);
}

TEST(Sliding, NodesOfCurvesAreRefused) {
  Constraints of_curve(3);
  of_curve.fix_position(0, {0, 0, 0});
  of_curve.fix_position(2, {2, 0, 0});
  of_curve.slide_on(1, Support::plane({1, 0, 0}, {1, 0, 0}));
  const PolygonCurve curve({{0, 0, 0}, {1, 1, 0}, {2, 0, 0}});
  EXPECT_TRUE(says(refusal([&] { (void)fair(curve, of_curve); }, ErrorCode::unusable_constraint),
                   "node 1 cannot slide: it is of a curve"));
}

}  // namespace
}  // namespace vspring::sliding_test
