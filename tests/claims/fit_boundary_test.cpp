// What a fit to scattered points makes of a boundary that nothing holds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "support/fits.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_boundary_test {
namespace {

using namespace support;

using Height = std::function<double(double x, double y)>;

double saddle_height(double x, double y) { return 0.4 * (x * x - y * y); }

/// A square of this many cells a side, from −1 to 1, under a height.
PolygonMesh over_square(int cells, generate::Faces faces, const Height& height = saddle_height) {
  PolygonMesh mesh = generate::plane({.columns = cells, .rows = cells, .faces = faces}, 2, 2);
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& p : positions) p = {p.x() - 1, p.y() - 1, height(p.x() - 1, p.y() - 1)};
  mesh.set_positions(std::move(positions));
  return mesh;
}

/// Points over the square of this half side, evenly or at random, with noise of this standard deviation in each
/// coordinate, about.
ScatteredPoints points_over_square(int side, double noise = 0, double half = 1, bool evenly = true) {
  Draw draw(7);
  ScatteredPoints points;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double x = evenly ? 2.0 * i / (side - 1) - 1 : draw.uniform(-1, 1);
      const double y = evenly ? 2.0 * j / (side - 1) - 1 : draw.uniform(-1, 1);
      // A sum of three has about the shape of the bell.
      const Vector3 off = draw.in_cube(1) + draw.in_cube(1) + draw.in_cube(1);
      points.positions.push_back(Vector3(half * x, half * y, saddle_height(half * x, half * y)) + noise * off);
    }
  }
  return points;
}

/// Of the nodes, from the outline of the square under the saddle: aside of it in x and y, and from the saddle.
struct OffSquare {
  OffSquare(const std::vector<Vector3>& positions, const std::vector<Index>& nodes) {
    for (const Index i : nodes) {
      const Vector3& p = positions[static_cast<std::size_t>(i)];
      const double aside = std::abs(std::max(std::abs(p.x()), std::abs(p.y())) - 1);
      const double off = std::hypot(aside, p.z() - saddle_height(p.x(), p.y()));
      greatest = std::max(greatest, off);
      rms += off * off;
    }
    rms = std::sqrt(rms / static_cast<double>(nodes.size()));
  }
  double rms = 0;
  double greatest = 0;
};

/// Of all nodes from the saddle, root mean square.
double off_saddle(const std::vector<Vector3>& positions) {
  double squares = 0;
  for (const Vector3& p : positions) squares += std::pow(p.z() - saddle_height(p.x(), p.y()), 2);
  return std::sqrt(squares / static_cast<double>(positions.size()));
}

FitOptions boundary_first(const FitCriterion& criterion) {
  FitOptions options{.criterion = criterion};
  options.fair.fair_boundary.emplace();
  return options;
}

FitResult fit_free(const PolygonMesh& mesh, const ScatteredPoints& points, const FitCriterion& criterion) {
  return fit(mesh, Constraints(mesh.node_count()), points, boundary_first(criterion));
}

constexpr int cells = 12;
constexpr double edge = 2.0 / cells;

/// Noise of a third of an edge in each coordinate, of the boundary too.
PolygonMesh disturbed(const PolygonMesh& mesh, double length = edge, std::uint64_t seed = 1) {
  return generate::add_noise(mesh, std::sqrt(5) / 3 * length, seed, true);
}

TEST(FitBoundary, PointsOfAHeldPartDoNotKeepItFromTheTolerance) {
  const PolygonMesh truth = over_square(cells, generate::Faces::quads);
  PolygonMesh mesh = disturbed(truth);
  Constraints held(mesh.node_count());
  std::vector<Vector3> positions = mesh.positions();
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (truth.position(i).x() > 0.01) continue;
    held.fix_position(i, truth.position(i));
    positions[static_cast<std::size_t>(i)] = truth.position(i);
  }
  mesh.set_positions(std::move(positions));
  ScatteredPoints points = points_over_square(6 * cells + 1);
  for (Vector3& point : points.positions) {
    if (point.x() < -0.5) point.z() += edge;
  }
  constexpr double within = 0.1 * edge;
  const FitResult result = fit(mesh, held, points, boundary_first(Within{within}));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.outside_points, 0);
  EXPECT_GT(result.report.at_held.greatest, 5 * within);
  for (std::size_t j = 0; j < points.positions.size(); ++j) {
    if (points.positions[j].x() > edge) EXPECT_LE(result.distances[j], within);
  }
}

TEST(FitBoundary, GoesToWhereThePointsEnd) {
  const ScatteredPoints points = points_over_square(6 * cells + 1);
  for (const auto faces : {generate::Faces::quads, generate::Faces::triangles, generate::Faces::hexagons}) {
    const PolygonMesh truth = over_square(cells, faces);
    const PolygonMesh mesh = disturbed(truth);
    const std::vector<Index> boundary = boundary_of(truth);
    const double before = OffSquare(mesh.positions(), boundary).rms;
    constexpr double within = 0.1 * edge;
    std::vector<FitCriterion> criteria = {Within{within}};
    if (faces == generate::Faces::quads)
      criteria.insert(criteria.end(), {RootMeanSquare{0.03 * edge}, SmoothingLength{edge / 2}, Weight{0.1}});
    for (const FitCriterion& criterion : criteria) {
      const std::string which = std::to_string(static_cast<int>(faces)) + ' ' + std::to_string(criterion.index());
      const FitResult result = fit_free(mesh, points, criterion);
      EXPECT_EQ(result.report.fair.outcome, Outcome::converged) << which;
      EXPECT_TRUE(result.report.fair.warnings.empty()) << which;
      EXPECT_EQ(result.report.fair.moving_nodes, mesh.node_count()) << which;
      const OffSquare after(result.positions, boundary);
      EXPECT_LT(after.rms, before / 15) << which;
      EXPECT_LT(after.greatest, within) << which;
      ASSERT_TRUE(result.report.boundary.has_value()) << which;
      EXPECT_EQ(result.report.boundary->points, 4 * 6 * cells) << which;
      EXPECT_EQ(result.report.boundary->ends, std::ssize(boundary)) << which;
      EXPECT_EQ(result.report.boundary->inside + result.report.boundary->kept, 0) << which;
      // Corners stay corners, and what lies between does not crowd.
      for (const Vector3& corner : {Vector3(1, 1, 0), Vector3(-1, 1, 0), Vector3(1, -1, 0), Vector3(-1, -1, 0)}) {
        double nearest = 2;
        for (const Index i : boundary)
          nearest = std::min(nearest, (corner - result.positions[static_cast<std::size_t>(i)]).norm());
        EXPECT_LT(nearest, 0.15 * edge) << which;
      }
      const std::vector<Index> loop = boundary_loops(mesh).at(0);
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vector3& here = result.positions[static_cast<std::size_t>(loop[k])];
        const Vector3& next = result.positions[static_cast<std::size_t>(loop[(k + 1) % loop.size()])];
        EXPECT_GT((next - here).norm(), 0.4 * edge) << which;
      }
    }
  }
}

TEST(FitBoundary, LeavesTheSurfaceAsGoodAsOneThatIsHeldWhereItBelongs) {
  const PolygonMesh truth = over_square(cells, generate::Faces::quads);
  const PolygonMesh mesh = disturbed(truth);
  const ScatteredPoints points = points_over_square(6 * cells + 1);
  for (const FitCriterion& criterion : {FitCriterion(Within{0.1 * edge}), FitCriterion(RootMeanSquare{0.03 * edge})}) {
    const FitResult result = fit_free(mesh, points, criterion);
    Constraints held(mesh.node_count());
    for (const Index i : boundary_of(truth)) held.fix_position(i, truth.position(i));
    const FitResult in_place = fit(mesh, held, points, {.criterion = criterion});
    EXPECT_LT(off_saddle(result.positions), 1.2 * off_saddle(in_place.positions)) << criterion.index();
    EXPECT_LT(result.report.after.all.greatest, 1.2 * in_place.report.after.all.greatest) << criterion.index();
  }
}

TEST(FitBoundary, FollowsNoisyPointsAtRandom) {
  const PolygonMesh truth = over_square(cells, generate::Faces::triangles);
  const std::vector<Index> boundary = boundary_of(truth);
  for (const std::uint64_t seed : {1, 2}) {
    const PolygonMesh mesh = disturbed(truth, edge, seed);
    constexpr double noise = 0.05 * edge;
    const ScatteredPoints points = points_over_square(6 * cells, noise, 1, false);
    const FitResult result = fit_free(mesh, points, Within{4.5 * noise});
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged) << seed;
    EXPECT_LT(OffSquare(result.positions, boundary).rms, OffSquare(mesh.positions(), boundary).rms / 6) << seed;
    EXPECT_LT(off_saddle(result.positions), off_saddle(mesh.positions()) / 6) << seed;
  }
}

TEST(FitBoundary, HasAsManyLoopsAsThereAre) {
  // Circles have no corners. The points are those of a fine ring of the same shape.
  const auto ring = [](Index nodes) {
    return generate::annulus({.nodes = nodes, .inner_radius = 0.4, .profile = generate::Profile::flat});
  };
  const PolygonMesh truth = ring(600);
  const PolygonMesh fine = ring(12000);
  const double length = (truth.position(truth.face(0)[0]) - truth.position(truth.face(0)[1])).norm();
  const PolygonMesh mesh = disturbed(truth, length);
  const FitResult result = fit_free(mesh, {.positions = fine.positions()}, SmoothingLength{length / 2});
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  const auto loops = boundary_loops(truth);
  ASSERT_EQ(loops.size(), 2);
  for (const auto& loop : loops) {
    const double radius = truth.position(loop[0]).head<2>().norm();
    const auto off = [&](const std::vector<Vector3>& positions) {
      double squares = 0;
      for (const Index i : loop) {
        const Vector3& p = positions[static_cast<std::size_t>(i)];
        squares += std::pow(p.head<2>().norm() - radius, 2) + p.z() * p.z();
      }
      return std::sqrt(squares / static_cast<double>(loop.size()));
    };
    EXPECT_LT(off(result.positions), off(mesh.positions()) / 10) << radius;
  }
}

TEST(FitBoundary, OfARefinedSurfaceGoesAsFarAsBefore) {
  constexpr int few = 4;
  constexpr double coarse = 2.0 / few;
  // Further from the points than two of the new edges.
  const PolygonMesh cage = disturbed(over_square(few, generate::Faces::triangles,
                                                 [](double x, double y) { return saddle_height(x, y) + 0.5 * coarse; }),
                                     0.8 * coarse, 2);
  const Refined refined = refine(cage, Constraints(cage.node_count()), {.length = coarse / 4});
  // Of shaken edges.
  EXPECT_NEAR(refined.boundary_reach, 2 * coarse, 0.6 * coarse);
  const ScatteredPoints points = points_over_square(41);
  FitOptions options = boundary_first(SmoothingLength{0.1 * coarse});
  options.boundary_reach = refined.boundary_reach;
  const FitResult result = fit(refined.mesh, refined.constraints, points, options);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  ASSERT_TRUE(result.report.boundary.has_value());
  EXPECT_EQ(result.report.boundary->kept, 0);
  EXPECT_LT(off_saddle(result.positions), 0.01 * coarse);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vector3& p : result.positions) nearest = std::min(nearest, std::hypot(p.x() - x, p.y() - y));
      EXPECT_LT(nearest, 0.1 * coarse) << x << ", " << y;
    }
  }
}

TEST(FitBoundary, ATolerancePassesOverWhatLiesBesideIt) {
  // At random some points lie beyond any fair boundary, by up to about their distance.
  const PolygonMesh mesh = disturbed(over_square(cells, generate::Faces::quads));
  const FitResult result = fit_free(mesh, points_over_square(60, 0, 1, false), Within{0.05 * edge});
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.outside_points, 0);
  EXPECT_GT(result.report.at_held.count, 0);
  EXPECT_GT(result.report.at_held.greatest, 0.05 * edge);
  EXPECT_TRUE(std::ranges::any_of(result.report.fair.warnings,
                                  [](const Warning& warning) { return warning.code == WarningCode::points_at_held; }));
}

TEST(FitBoundary, OfFewNodesKeepsItsCorners) {
  // Three faces around one node, and points on their triangle.
  const PolygonMesh mesh({{0.1, 0.05, 0.1}, {0.9, 0.1, 0.1}, {0, 1, -0.1}, {0.4, 0.3, 0.2}}, {0, 3, 6, 9},
                         {0, 1, 3, 1, 2, 3, 2, 0, 3});
  ScatteredPoints points;
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; i + j <= 20; ++j) points.positions.emplace_back(0.05 * i, 0.05 * j, 0);
  }
  const FitResult result = fit_free(mesh, points, SmoothingLength{0.1});
  EXPECT_EQ(result.report.boundary->ends, 3);
  const Vector3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT((result.positions[i] - corners[i]).norm(), 0.05) << i;
}

TEST(FitBoundary, WherePointsGoOnItGoesAcrossThemAlone) {
  const PolygonMesh truth = over_square(cells, generate::Faces::quads);
  PolygonMesh mesh = truth;
  std::vector<Vector3> positions = truth.positions();
  Draw draw(1);
  for (Vector3& p : positions) p.z() += draw.uniform(-0.5, 0.5) * edge;
  mesh.set_positions(std::move(positions));
  const std::vector<Index> boundary = boundary_of(truth);
  const FitResult result = fit_free(mesh, points_over_square(9 * cells + 1, 0, 1.6), SmoothingLength{edge / 2});
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.boundary->points, 0);
  EXPECT_EQ(result.report.boundary->inside, std::ssize(boundary));
  EXPECT_LT(off_saddle(result.positions), off_saddle(mesh.positions()) / 20);
  for (const Index i : boundary) {
    const Vector3& before = mesh.position(i);
    const double move = (result.positions[static_cast<std::size_t>(i)] - before).norm();
    // The shortest way to a slope is no longer than that straight down.
    EXPECT_LT(move, std::abs(before.z() - saddle_height(before.x(), before.y())) + 0.01 * edge) << i;
  }
}

TEST(FitBoundary, StaysWhereThereAreNoPoints) {
  const PolygonMesh mesh = disturbed(over_square(cells, generate::Faces::quads));
  ScatteredPoints points = points_over_square(6 * cells + 1);
  std::erase_if(points.positions, [](const Vector3& p) { return p.x() > 0; });
  FitOptions few_steps = boundary_first(SmoothingLength{edge / 2});
  few_steps.fair.method = EquilibriumMethod{.max_iterations = 5};
  const Constraints free(mesh.node_count());
  const FitResult result = fit(mesh, free, points, few_steps);
  ASSERT_TRUE(result.report.boundary.has_value());
  EXPECT_GT(result.report.boundary->kept, cells);
  EXPECT_GT(result.report.boundary->ends, cells);
  const auto& warnings = result.report.fair.warnings;
  const auto untold = std::find_if(warnings.begin(), warnings.end(),
                                   [](const Warning& warning) { return warning.code == WarningCode::untold_boundary; });
  ASSERT_NE(untold, warnings.end());
  Index stayed = 0;
  for (const Index i : boundary_of(mesh)) {
    const Vector3& before = mesh.position(i);
    if (before.x() > 3 * edge) EXPECT_EQ(result.positions[static_cast<std::size_t>(i)], before) << i;
    stayed += result.positions[static_cast<std::size_t>(i)] == before ? 1 : 0;
  }
  EXPECT_EQ(stayed, result.report.boundary->kept);
  // Nor is it drawn in along the end of the points.
  const PolygonMesh truth = over_square(cells, generate::Faces::quads);
  for (const Index i : boundary_of(truth)) {
    if (std::abs(truth.position(i).y()) == 1 && truth.position(i).x() < 1)
      EXPECT_GT(std::abs(result.positions[static_cast<std::size_t>(i)].y()), 1 - edge) << i;
  }

  // Nowhere near any.
  for (Vector3& p : points.positions) p.z() += 10;
  const FitResult far = fit(mesh, free, points, few_steps);
  EXPECT_EQ(far.report.boundary->kept, std::ssize(boundary_of(mesh)));
  EXPECT_EQ(far.report.fair.boundary, nullptr);
}

// A boundary that lies far within where noisy points end.
TEST(FitBoundary, BringsNoFoldOrCrossing) {
  constexpr int many = 16;
  constexpr double length = 2.0 / many;
  PolygonMesh mesh = over_square(many, generate::Faces::triangles);
  Draw draw(1);
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& p : positions) {
    p.head<2>() *= 1 - 1.2 * length;
    p += 0.05 * length * (draw.in_cube(1) + draw.in_cube(1) + draw.in_cube(1));
  }
  mesh.set_positions(std::move(positions));
  FitOptions few_steps = boundary_first(SmoothingLength{length / 2});
  few_steps.fair.method = EquilibriumMethod{.max_iterations = 5};
  const ScatteredPoints points = points_over_square(89, 0.1 * length, 1, false);
  PolygonMesh fitted = mesh;
  fitted.set_positions(fit(mesh, Constraints(mesh.node_count()), points, few_steps).positions);
  EXPECT_LE(measure_surface(fitted).flipped_faces, measure_surface(mesh).flipped_faces);
  EXPECT_LE(self_intersections(fitted).size(), self_intersections(mesh).size());
}

TEST(FitBoundary, StaysWhereLoopsMeet) {
  // Two squares share a corner.
  const PolygonMesh square = over_square(12, generate::Faces::triangles);
  Index corner = 0;
  for (Index i = 0; i < square.node_count(); ++i) {
    if (square.position(i).head<2>().sum() > square.position(corner).head<2>().sum()) corner = i;
  }
  std::vector<Vector3> positions = square.positions();
  std::vector<Index> begin = square.face_begin();
  std::vector<Index> corners = square.corners();
  for (const Vector3& p : square.positions()) positions.push_back(2 * square.position(corner) - p);
  for (std::size_t f = 1; f < square.face_begin().size(); ++f)
    begin.push_back(static_cast<Index>(square.corners().size()) + square.face_begin()[f]);
  for (const Index node : square.corners()) corners.push_back(node == corner ? node : square.node_count() + node);
  const PolygonMesh noisy = generate::add_noise(PolygonMesh(positions, begin, corners), 0.02, 4);
  FitOptions options{.criterion = Noise{estimate_noise(noisy).deviation}};
  options.fair.distribution = Distribution::keep;
  options.fair.fair_boundary = EquilibriumMethod{};
  const FitResult result = fit(noisy, Constraints(noisy.node_count()), {.positions = noisy.positions()}, options);
  EXPECT_TRUE(result.report.fair.usable());
  EXPECT_EQ(result.positions[static_cast<std::size_t>(corner)], noisy.position(corner));
  EXPECT_GT(greatest_distance(result.positions, noisy.positions()), 0.005);
}

TEST(FitBoundary, GoesOnFromWhatIsHeld) {
  const PolygonMesh truth = over_square(cells, generate::Faces::quads);
  const PolygonMesh mesh = disturbed(truth);
  Constraints held(mesh.node_count());
  std::vector<Index> free;
  for (const Index i : boundary_of(truth)) {
    if (truth.position(i).x() == -1)
      held.fix_position(i, truth.position(i));
    else
      free.push_back(i);
  }
  const FitResult result = fit(mesh, held, points_over_square(6 * cells + 1), boundary_first(Within{0.1 * edge}));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (held.position_fixed(i)) EXPECT_EQ(result.positions[static_cast<std::size_t>(i)], held.position(i)) << i;
  }
  EXPECT_EQ(result.report.boundary->ends, std::ssize(free));
  EXPECT_LT(OffSquare(result.positions, free).rms, OffSquare(mesh.positions(), free).rms / 10);
}

TEST(FitBoundary, HasTheSameBitsOnAnyNumberOfThreadsAndAtAnySize) {
  const PolygonMesh mesh = disturbed(over_square(cells, generate::Faces::triangles));
  const ScatteredPoints points = points_over_square(6 * cells, 0.03 * edge, 1, false);
  const Constraints free(mesh.node_count());
  const auto run = [&](int threads) {
    Context context;
    context.threads = threads;
    return fit(mesh, free, points, boundary_first(SmoothingLength{edge / 2}), context).positions;
  };
  const std::vector<Vector3> alone = run(1);
  EXPECT_EQ(alone, run(3));

  constexpr double huge = 0x1p500;
  PolygonMesh large = mesh;
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& p : positions) p *= huge;
  large.set_positions(std::move(positions));
  ScatteredPoints as_large = points;
  for (Vector3& p : as_large.positions) p *= huge;
  std::vector<Vector3> at_size = fit_free(large, as_large, SmoothingLength{huge * edge / 2}).positions;
  for (Vector3& p : at_size) p /= huge;
  EXPECT_LT(greatest_distance(alone, at_size), 1e-9);
}

TEST(FitBoundary, IsForTheMethodEquilibrium) {
  const PolygonMesh mesh = over_square(cells, generate::Faces::quads);
  FitOptions options = boundary_first(Weight{1});
  options.fair.method = SweepMethod{};
  EXPECT_THROW((void)fit(mesh, Constraints(mesh.node_count()), points_over_square(20), options), Error);
}

}  // namespace
}  // namespace vspring::fit_boundary_test
