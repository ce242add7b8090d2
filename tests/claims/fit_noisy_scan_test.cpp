// Closed surfaces with noise that folds them, fitted to their own nodes, which keep their places.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_noisy_scan_test {
namespace {

using namespace support;

constexpr double minor_radius = 0.45;

PolygonMesh exact() {
  return generate::torus({.columns = 32, .rows = 14, .faces = generate::Faces::quads}, 1, minor_radius);
}

/// Moved by up to three quarters of a mean edge.
PolygonMesh folded() { return generate::add_noise(exact(), 0.15, 1); }

double rms_from_torus(const std::vector<Vector3>& positions) {
  double squares = 0;
  for (const Vector3& p : positions) {
    const double d = std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()) - minor_radius;
    squares += d * d;
  }
  return std::sqrt(squares / static_cast<double>(positions.size()));
}

/// In degrees.
double greatest_turn(const PolygonMesh& mesh, const std::vector<Vector3>& positions) {
  PolygonMesh shape = mesh;
  shape.set_positions(positions);
  return measure(shape).greatest_turn;
}

TEST(FitNoisyScan, NoFoldIsLeftWhateverIsAskedFor) {
  const PolygonMesh noisy = folded();
  const double before = rms_from_torus(noisy.positions());
  ASSERT_GT(greatest_turn(noisy, noisy.positions()), 120);
  FitOptions ways[4];
  ways[0].criterion = Within{0.15};
  ways[1].criterion = RootMeanSquare{before};
  ways[2].criterion = SmoothingLength{0.2};
  ways[3].criterion = Weight{0.03};
  for (FitOptions& options : ways) {
    SCOPED_TRACE(&options - ways);
    options.fair.distribution = Distribution::keep;
    const FitResult result = fit(noisy, Constraints(noisy.node_count()), {.positions = noisy.positions()}, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_LT(greatest_turn(noisy, result.positions), 60);
    EXPECT_LT(rms_from_torus(result.positions), before / 2);
  }
}

FitOptions without_noise(double deviation) {
  FitOptions options;
  options.fair.distribution = Distribution::keep;
  options.criterion = Noise{deviation};
  return options;
}

FitResult fit_to_itself(const PolygonMesh& mesh, const FitOptions& options) {
  return fit(mesh, Constraints(mesh.node_count()), {.positions = mesh.positions()}, options);
}

/// Of each coordinate of a point in a ball.
double deviation_in_ball(double radius) { return radius / std::sqrt(5.0); }

TEST(FitNoisyScan, NoiseIsTakenOffOnEveryKindOfFace) {
  for (const generate::Faces faces : every_kind) {
    for (const double radius : {0.05, 0.15}) {
      SCOPED_TRACE(::testing::Message() << static_cast<int>(faces) << " " << radius);
      const PolygonMesh torus = generate::torus({.columns = 32, .rows = 16, .faces = faces}, 1, minor_radius);
      const PolygonMesh noisy = generate::add_noise(torus, radius, 1);
      const FitResult result = fit_to_itself(noisy, without_noise(deviation_in_ball(radius)));
      EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
      EXPECT_EQ(result.report.pulled_nodes, noisy.node_count()) << "points stay with their nodes";
      EXPECT_LT(greatest_turn(noisy, result.positions), 60);
      // Bricks have three neighbours a node, which tell less of noise.
      const double left = faces == generate::Faces::hexagons ? 0.75 : 0.45;
      EXPECT_LT(rms_from_torus(result.positions), left * rms_from_torus(noisy.positions()));
    }
  }
}

TEST(FitNoisyScan, ASmoothShapeIsFoundFromNoiseOfItsEdges) {
  // In docs/notes/fit.md, on a torus like this one, fits by a smoothing length left 0.16 of such noise.
  const PolygonMesh torus = generate::torus({.columns = 64, .rows = 48, .jitter = 0.2}, 1, minor_radius);
  const double deviation = 0.02;
  const PolygonMesh noisy = generate::add_noise(torus, std::sqrt(5.0) * deviation, 1);
  const FitResult result = fit_to_itself(noisy, without_noise(deviation));
  ASSERT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LT(rms_from_torus(result.positions), 0.12 * rms_from_torus(noisy.positions()));
}

TEST(FitNoisyScan, SharpEdgesStaySharp) {
  // In docs/notes/fit.md low passes, which round them off, leave half of such noise at their best.
  const PolygonMesh block = generate::genus({.holes = 1, .cells = 8});
  const auto face = block.face(0);
  const double deviation = 0.25 * (block.position(face[0]) - block.position(face[1])).norm();
  const PolygonMesh noisy = generate::add_noise(block, std::sqrt(5.0) * deviation, 1);
  const FitResult result = fit_to_itself(noisy, without_noise(deviation));
  ASSERT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LT(distance(result.positions, block).rms, 0.3 * distance(noisy.positions(), block).rms);
}

TEST(FitNoisyScan, OutliersThatAreLeftOutTellNothing) {
  const PolygonMesh torus = generate::torus({.columns = 32, .rows = 16}, 1, minor_radius);
  PolygonMesh noisy = generate::add_noise(torus, 0.05, 1);
  std::vector<Vector3> positions = noisy.positions();
  for (std::size_t i = 7; i < positions.size(); i += 101) positions[i] *= 1.4;
  noisy.set_positions(positions);
  FitOptions options = without_noise(deviation_in_ball(0.05));
  options.outliers = 0.02;
  const FitResult result = fit_to_itself(noisy, options);
  EXPECT_LT(distance(result.positions, torus).greatest, 0.08);
}

TEST(FitNoisyScan, OutliersAreOnlyNodesFarOffWhateverShareIsAllowed) {
  const PolygonMesh block = generate::genus({.holes = 1, .cells = 8});
  const auto face = block.face(0);
  const double edge = (block.position(face[0]) - block.position(face[1])).norm();
  PolygonMesh noisy = generate::add_noise(block, 0.3 * edge, 1);
  FitOptions options = without_noise(deviation_in_ball(0.3 * edge));
  const double most = distance(fit_to_itself(noisy, options).positions, block).greatest;
  options.outliers = 0.03;
  const FitResult clean = fit_to_itself(noisy, options);
  // Hardly any of its edges and corners are some.
  EXPECT_LT(clean.report.outliers, 0.02 * noisy.node_count());
  EXPECT_LT(distance(clean.positions, block).greatest, 2 * most);
  std::vector<Vector3> positions = noisy.positions();
  const std::vector<Index> off = {100, 300, 500};
  for (const Index i : off) positions[static_cast<std::size_t>(i)] += Vector3(2, 2, 2) * edge;
  noisy.set_positions(positions);
  const FitResult result = fit_to_itself(noisy, options);
  for (const Index i : off)
    EXPECT_TRUE(std::binary_search(result.report.outlying_points.begin(), result.report.outlying_points.end(), i)) << i;
  EXPECT_LT(distance(result.positions, block).greatest, 2 * most);
}

TEST(FitNoisyScan, NormalsThatAreGivenAreKept) {
  const PolygonMesh cap = generate::cap({.nodes = 900});
  const PolygonMesh noisy = generate::add_noise(cap, 0.03, 1);
  Constraints held(noisy.node_count());
  fix_boundary_positions(held, noisy);
  fix_boundary_normals(held, noisy);
  const FitResult result = fit(noisy, held, {.positions = noisy.positions()}, without_noise(deviation_in_ball(0.03)));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LT(distance(result.positions, cap).rms, 0.5 * distance(noisy.positions(), cap).rms);
}

TEST(FitNoisyScan, WhatIsMoreThanNoiseStays) {
  // A bump of a few edges on a plane. Smoothed alike everywhere to the same distance the shape loses more of it.
  PolygonMesh exact_bump = generate::plane({.columns = 30, .rows = 30, .faces = generate::Faces::quads});
  std::vector<Vector3> positions = exact_bump.positions();
  for (Vector3& p : positions) p.z() = 0.1 * std::exp(-(p - Vector3(0.5, 0.5, 0)).squaredNorm() / 0.005);
  exact_bump.set_positions(positions);
  constexpr double radius = 0.006;
  const PolygonMesh noisy = generate::add_noise(exact_bump, radius, 1);
  const ScatteredPoints points{.positions = noisy.positions()};
  const Constraints held = held_boundary(noisy);
  const FitResult kept = fit(noisy, held, points, without_noise(deviation_in_ball(radius)));
  ASSERT_EQ(kept.report.fair.outcome, Outcome::converged);
  FitOptions alike;
  // With other distributions that is an equilibrium.
  alike.fair.distribution = Distribution::smooth;
  alike.criterion = RootMeanSquare{kept.report.after.all.rms};
  const FitResult smoothed = fit(noisy, held, points, alike);
  const auto off = [&](const std::vector<Vector3>& places) { return distance(places, exact_bump); };
  EXPECT_LT(off(kept.positions).greatest, 0.7 * off(smoothed.positions).greatest);
  EXPECT_LT(off(kept.positions).rms, 0.8 * off(smoothed.positions).rms);
  EXPECT_LT(off(kept.positions).rms, 0.5 * off(noisy.positions()).rms);
}

TEST(FitNoisyScan, ARootMeanSquareIsKeptAndTakesTheNoiseOff) {
  const PolygonMesh torus = generate::torus({.columns = 48, .rows = 24}, 1, minor_radius);
  constexpr double radius = 0.05;
  const PolygonMesh noisy = generate::add_noise(torus, radius, 1);
  const double before = distance(noisy.positions(), torus).rms;
  // Less than the noise leaves some of it.
  for (const double share : {0.9, 0.98, 1.1}) {
    SCOPED_TRACE(share);
    FitOptions options;
    options.fair.distribution = Distribution::keep;
    options.criterion = RootMeanSquare{share * before};
    const FitResult result = fit_to_itself(noisy, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_LE(result.report.after.all.rms, *options.rms());
    EXPECT_GT(result.report.after.all.rms, 0.7 * *options.rms());
    EXPECT_LT(distance(result.positions, torus).rms, 0.35 * before);
  }
}

/// Within a tolerance, nodes keep their place.
FitOptions within(double tolerance) {
  FitOptions options;
  options.fair.distribution = Distribution::keep;
  options.criterion = Within{tolerance};
  return options;
}

/// A torus with Gaussian-like noise: of balls in turn, so that some nodes are far out.
PolygonMesh with_far_nodes(const PolygonMesh& mesh, double radius) {
  PolygonMesh noisy = mesh;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) noisy = generate::add_noise(noisy, radius, seed);
  return noisy;
}

TEST(FitNoisyScan, WithinThreeTimesTheNoiseTheNoiseIsOffAndNoNodeIsFurtherAway) {
  const PolygonMesh torus = generate::torus({.columns = 64, .rows = 32}, 1, minor_radius);
  constexpr double radius = 0.03;
  const PolygonMesh noisy = with_far_nodes(torus, radius);
  const double deviation = std::sqrt(5.0) * deviation_in_ball(radius);
  const FitResult free = fit_to_itself(noisy, without_noise(deviation));
  const FitResult result = fit_to_itself(noisy, within(3 * deviation));
  ASSERT_GT(free.report.after.all.greatest, 1.05 * 3 * deviation) << "else nothing is taken back";
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LE(result.report.after.all.greatest, 3 * deviation);
  EXPECT_FALSE(result.report.active_points.empty());
  EXPECT_EQ(result.report.outside_points, 0);
  EXPECT_LT(greatest_turn(noisy, result.positions), greatest_turn(torus, torus.positions()) + 10);
  EXPECT_LT(rms_from_torus(result.positions), 0.25 * rms_from_torus(noisy.positions()));
}

TEST(FitNoisyScan, WithinTakesTheNoiseOfARegionForThatOfWhatMoves) {
  const PolygonMesh torus = generate::torus({.columns = 64, .rows = 32}, 1, minor_radius);
  constexpr double radius = 0.03;
  const PolygonMesh all_noisy = with_far_nodes(torus, radius);
  std::vector<Vector3> positions = torus.positions();
  std::vector<Index> region;
  for (Index i = 0; i < torus.node_count(); ++i) {
    if (torus.position(i).x() < 0.8) continue;
    region.push_back(i);
    positions[static_cast<std::size_t>(i)] = all_noisy.position(i);
  }
  const PolygonMesh noisy(positions, torus.face_begin(), torus.corners());
  Constraints held(noisy.node_count());
  restrict_to_region(held, noisy, region);
  const double deviation = std::sqrt(5.0) * deviation_in_ball(radius);
  const FitResult result = fit(noisy, held, {.positions = noisy.positions()}, within(3 * deviation));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.fair.iterations, 0) << "by filters";
  EXPECT_LT(rms_from_torus(result.positions), 0.5 * rms_from_torus(noisy.positions()));
}

TEST(FitNoisyScan, OutliersThatAreLeftOutAreNotTakenBackTo) {
  const PolygonMesh torus = generate::torus({.columns = 64, .rows = 32}, 1, minor_radius);
  constexpr double radius = 0.06;
  PolygonMesh noisy = with_far_nodes(torus, radius);
  std::vector<Vector3> positions = noisy.positions();
  for (std::size_t i = 7; i < positions.size(); i += 101) {
    const Vector3& p = torus.positions()[i];
    const Vector3 middle = Vector3(p.x(), p.y(), 0).normalized();
    positions[i] += 0.5 * (p - middle).normalized();
  }
  noisy.set_positions(positions);
  // So little room that every node is taken back by itself in the end.
  const double deviation = std::sqrt(5.0) * deviation_in_ball(radius);
  FitOptions options = within(2.1 * deviation);
  options.outliers = 0.015;
  const FitResult result = fit_to_itself(noisy, options);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.fair.iterations, 0) << "by filters";
  EXPECT_EQ(result.report.outside_points, 0);
  EXPECT_LT(distance(result.positions, torus).greatest, 0.15);
}

TEST(FitNoisyScan, WithinLessThanTwiceTheNoiseIsTheShapeOfLeastBending) {
  const PolygonMesh torus = generate::torus({.columns = 48, .rows = 24}, 1, minor_radius);
  constexpr double radius = 0.05;
  const PolygonMesh noisy = generate::add_noise(torus, radius, 1);
  const double tolerance = deviation_in_ball(radius);
  const FitResult result = fit_to_itself(noisy, within(tolerance));
  EXPECT_GT(result.report.fair.iterations, 0) << "not by filters";
  EXPECT_LE(result.report.after.all.greatest, tolerance);
  EXPECT_LT(rms_from_torus(result.positions), rms_from_torus(noisy.positions()));
}

TEST(FitNoisyScan, WithinFarMoreThanTheNoiseIsTheShapeOfLeastBending) {
  // A dent that is wider than filters see: with far more room than noise it goes, as nothing holds it.
  const PolygonMesh plane = generate::plane({.columns = 24, .rows = 24});
  std::vector<Vector3> positions = plane.positions();
  for (Vector3& p : positions) p.z() = 0.02 * std::exp(-(p - Vector3(0.5, 0.5, 0)).squaredNorm() / 0.05);
  PolygonMesh dented = plane;
  dented.set_positions(positions);
  const FitResult result = fit(dented, held_boundary(dented), {.positions = dented.positions()}, within(0.01));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LE(result.report.after.all.greatest, 0.01);
  EXPECT_GT(result.report.after.all.greatest, 0.009);
}

TEST(FitNoisyScan, OffsetsOfAFairShapeAreFairedWithinTheWholeTolerance) {
  // Noise of far less than edges is what measured offsets have: nobody looks for details in it.
  const PolygonMesh saddle = generate::saddle({.columns = 24, .rows = 24});
  constexpr double radius = 0.0005;
  const PolygonMesh noisy = generate::add_noise(saddle, radius, 1);
  const double tolerance = 4 * deviation_in_ball(radius);
  ASSERT_GT(estimate_noise(noisy).deviation, tolerance / 6);
  const FitResult result = fit(noisy, held_boundary(noisy), {.positions = noisy.positions()}, within(tolerance));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_GT(result.report.fair.iterations, 0);
  EXPECT_LE(result.report.after.all.greatest, tolerance);
}

TEST(FitNoisyScan, APlainFairShapeThatIsWithinIsTheResult) {
  const PolygonMesh plane = generate::plane({.columns = 24, .rows = 24});
  const PolygonMesh noisy = generate::add_noise(plane, 0.01, 1);
  const Constraints held = held_boundary(noisy);
  const FitResult result = fit(noisy, held, {.positions = noisy.positions()}, within(0.012));
  FairOptions options;
  options.distribution = Distribution::keep;
  EXPECT_EQ(result.positions, fair(noisy, held, options).positions);
}

TEST(FitNoisyScan, NodesWithoutAFaceAreNoPoints) {
  const PolygonMesh torus = generate::torus({.columns = 32, .rows = 16}, 1, minor_radius);
  const PolygonMesh noisy = generate::add_noise(torus, 0.05, 1);
  std::vector<Vector3> positions = noisy.positions();
  positions.emplace_back(3, 0, 0);
  std::vector<Index> begin = {0};
  std::vector<Index> corners;
  for (Index f = 0; f < noisy.face_count(); ++f) {
    corners.insert(corners.end(), noisy.face(f).begin(), noisy.face(f).end());
    begin.push_back(static_cast<Index>(corners.size()));
  }
  const PolygonMesh loose(positions, begin, corners);
  const FitResult result = fit_to_itself(loose, within(0.1));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.points, noisy.node_count());
  EXPECT_EQ(result.report.outliers, 0);
  EXPECT_LE(result.report.after.all.greatest, 0.1);
  EXPECT_EQ(result.positions.back(), positions.back());
}

TEST(FitNoisyScan, TheSameBitsOnAnyNumberOfThreads) {
  const PolygonMesh noisy = folded();
  const auto run = [&](int threads) {
    Context context;
    context.threads = threads;
    return fit(noisy, Constraints(noisy.node_count()), {.positions = noisy.positions()},
               without_noise(deviation_in_ball(0.15)), context);
  };
  const FitResult one = run(1);
  EXPECT_EQ(one.positions, run(3).positions);
  Context alone;
  alone.threads = 1;
  EXPECT_EQ(estimate_noise(noisy).deviation, estimate_noise(noisy, alone).deviation);
}

TEST(FitNoisyScan, ARimIsFittedFirstWhereThatIsAskedFor) {
  const PolygonMesh cap = generate::cap({.nodes = 900});
  const PolygonMesh noisy = generate::add_noise(cap, 0.03, 1, true);
  FitOptions options = without_noise(deviation_in_ball(0.03));
  options.fair.fair_boundary.emplace();
  const FitResult result = fit_to_itself(noisy, options);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  ASSERT_NE(result.report.fair.boundary, nullptr);
  EXPECT_EQ(result.report.fair.moving_nodes, noisy.node_count());
  const std::vector<std::uint8_t> on_rim = boundary_nodes(cap);
  const auto off_rim = [&](const std::vector<Vector3>& positions) {
    double squares = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (on_rim[i] == 0) continue;
      const Vector3& p = positions[i];
      const double radial = std::hypot(p.x(), p.y()) - std::sqrt(0.75);
      squares += radial * radial + (p.z() - 0.5) * (p.z() - 0.5);
    }
    return std::sqrt(squares);
  };
  EXPECT_LT(off_rim(result.positions), 0.5 * off_rim(noisy.positions()));
  EXPECT_LT(distance(result.positions, cap).rms, 0.5 * distance(noisy.positions(), cap).rms);
}

TEST(FitNoisyScan, ARimThatIsFittedFirstKeepsItsCorners) {
  constexpr Index edges = 20;
  const PolygonMesh tile = generate::plane({.columns = edges, .rows = edges});
  const PolygonMesh noisy = generate::add_noise(tile, 0.1 / edges, 3, true);
  const double deviation = deviation_in_ball(0.1 / edges);
  for (const FitCriterion& criterion :
       {FitCriterion(Noise{deviation}), FitCriterion(Within{3 * deviation}), FitCriterion(RootMeanSquare{deviation})}) {
    FitOptions options = without_noise(deviation);
    options.criterion = criterion;
    options.fair.fair_boundary.emplace();
    const FitResult result = fit_to_itself(noisy, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    const std::vector<std::uint8_t> on_rim = boundary_nodes(tile);
    double before = 0;
    double after = 0;
    for (std::size_t i = 0; i < on_rim.size(); ++i) {
      if (on_rim[i] == 0) continue;
      before += (noisy.positions()[i] - tile.positions()[i]).squaredNorm();
      after += (result.positions[i] - tile.positions()[i]).squaredNorm();
    }
    EXPECT_LT(std::sqrt(after / before), 0.8) << criterion.index();
    double furthest = 0;
    for (std::size_t i = 0; i < on_rim.size(); ++i) {
      const Vector3& place = tile.positions()[i];
      if ((place.x() == 0 || place.x() == 1) && (place.y() == 0 || place.y() == 1))
        furthest = std::max(furthest, (result.positions[i] - place).norm());
    }
    EXPECT_LT(furthest, 2 * deviation) << criterion.index();
  }
}

TEST(FitNoisyScan, RefusesWhatHasNoNodesOfItsOwn) {
  const PolygonMesh torus = exact();
  ScatteredPoints others{.positions = torus.positions()};
  others.positions[3].x() += 0.01;
  const Constraints none(torus.node_count());
  EXPECT_THROW((void)fit(torus, none, others, without_noise(0.01)), Error);
  FitOptions spread = without_noise(0.01);
  spread.fair.distribution = Distribution::even;
  EXPECT_THROW((void)fit_to_itself(torus, spread), Error);
  FitOptions rim = without_noise(0.01);
  rim.fair.fair_boundary.emplace();
  EXPECT_THROW((void)fit(torus, none, others, rim), Error);
}

}  // namespace
}  // namespace vspring::fit_noisy_scan_test
