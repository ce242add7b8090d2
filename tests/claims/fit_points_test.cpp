// What becomes of points: one, many, far ones, heavy ones; which are refused, and what is said of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "support/fits.hpp"
#include "support/refusal.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fit_points_test {
namespace {

using namespace support;

constexpr double pi = std::numbers::pi;

std::string refusal(const ScatteredPoints& points, const FitOptions& options = {},
                    ErrorCode code = ErrorCode::invalid_argument) {
  const PolygonCurve curve = segment(10);
  try {
    (void)fit(curve, held_ends(curve.positions()), points, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    return error.what();
  }
  return "";
}

TEST(FitPoints, OnePointDrawsTheNearestNodeAndAllOthersFollow) {
  const PolygonCurve curve = segment(20);
  const FitResult result =
      fit(curve, held_ends(curve.positions()), {.positions = {{0.5, 0.1, 0}}}, by_sweeps(1, 1e-10, 100000));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.pulling_points, 1);
  EXPECT_EQ(result.report.pulled_nodes, 1);
  EXPECT_LT(result.report.after.all.greatest, 1e-3);
  for (std::size_t i = 1; i < 20; ++i) EXPECT_GT(result.positions[i].y(), 0);
}

TEST(FitPoints, ThousandsOfPointsOnOneNodePullLikeTheirAverage) {
  const PolygonCurve curve = segment(10);
  ScatteredPoints points;
  points.positions.assign(5000, {0.5, 0.1, 0});
  const FitOptions options = by_sweeps(0.1, 1e-10, 100000);
  const FitResult many = fit(curve, held_ends(curve.positions()), points, options);
  EXPECT_EQ(many.report.most_points, 5000);
  const FitResult one = fit(curve, held_ends(curve.positions()), {.positions = {{0.5, 0.1, 0}}}, options);
  EXPECT_LT(greatest_distance(many.positions, one.positions), 1e-10);
}

TEST(FitPoints, WhereThereAreNoneTheCurveGoesAsItCame) {
  // A slender ellipse, open at one tip, with points everywhere but about the other. With 15 nodes chords cut that off;
  // 31 that are even are too few for the tip, at which one of them would turn by over 120°.
  const auto place = [](double angle) { return Vector3(std::cos(angle), 0.1 * std::sin(angle), 0); };
  for (const int count : {15, 31, 61}) {
    std::vector<Vector3> nodes;
    nodes.reserve(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) nodes.push_back(place(pi * (0.1 + 1.8 * k / (count - 1))));
    for (const double gap : {0.3, 1.0}) {
      ScatteredPoints points;
      for (int k = 0; k < 40; ++k) {
        const int step = k / 2;
        const double angle = 0.1 * pi + (0.9 * pi - gap) * step / 19;
        points.positions.push_back(place(k % 2 == 0 ? angle : 2 * pi - angle) + Vector3(0, 0.007 * std::sin(9 * k), 0));
      }
      FitOptions options;
      options.criterion = Within{0.01};
      options.fair.distribution = Distribution::even;
      const FitResult result = fit(PolygonCurve(nodes), held_ends(nodes), points, options);
      if (count > 15)
        EXPECT_EQ(result.report.fair.outcome, count > 31 ? Outcome::converged : Outcome::worse_than_input)
            << count << ' ' << gap;
      const auto [least, greatest] = std::minmax_element(result.positions.begin(), result.positions.end(),
                                                         [](const auto& a, const auto& b) { return a.x() < b.x(); });
      EXPECT_NEAR(least->x(), -1, count > 15 ? 0.05 : 0.1) << count << ' ' << gap;
      EXPECT_LT(greatest->x(), 1) << count << ' ' << gap;
      for (const Vector3& position : result.positions) EXPECT_LT(std::abs(position.y()), 0.115) << count << ' ' << gap;
    }
  }
}

TEST(FitPoints, FreeEndsGoToWhereThePointsEnd) {
  const auto wave = [](double x) { return Vector3(x, 30 * std::sin(0.02 * x), 0); };
  Draw draw(3);
  std::vector<Vector3> points;
  points.reserve(200);
  for (int k = 0; k < 200; ++k) {
    Vector3 off = draw.in_cube(0.5);
    off.z() = 0;
    points.push_back(wave(5 * k) + off);
  }
  for (const double before_points : {0.0, 8.0, 30.0}) {
    std::vector<Vector3> nodes;
    nodes.reserve(100);
    for (int k = 0; k < 100; ++k) nodes.push_back(wave(before_points + (995 - 2 * before_points) * k / 99));
    const PolygonCurve curve(nodes);
    for (const FitCriterion& criterion : {FitCriterion(Within{2}), FitCriterion(RootMeanSquare{0.7}),
                                          FitCriterion(SmoothingLength{20}), FitCriterion(Weight{0.01})}) {
      const FitResult result =
          fit(curve, Constraints(curve.node_count()), {.positions = points}, {.criterion = criterion});
      EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
      EXPECT_LT(distance(points, PolygonCurve(result.positions)).greatest, 4);
      EXPECT_LT((result.positions.front() - points.front()).norm(), 4);
      EXPECT_LT((result.positions.back() - points.back()).norm(), 4);
    }
  }
}

TEST(FitPoints, SaysWhereTheyAreLeftBehindAndMakesNoBalloon) {
  // A slender loop with its ends held, most of which has no points: what hardly pulls at it lets it become a balloon.
  std::vector<Vector3> nodes;
  for (int k = 0; k <= 24; ++k) nodes.emplace_back(std::cos(k * pi / 12), 0.3 * std::sin(k * pi / 12), 0);
  const PolygonCurve loop(nodes);
  ScatteredPoints points;
  for (const double along : {-0.9, -0.3, 0.3, 0.9})
    points.positions.emplace_back(along, 0.3 * std::sqrt(1 - along * along), 0);
  points.positions.emplace_back(0, -0.3, 0);
  const auto fitted = [&](double weight) { return fit(loop, held_ends(nodes), points, to_equilibrium(weight)); };
  const auto says = [](const FitResult& result, const std::string& words) {
    const auto& warnings = result.report.fair.warnings;
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const Warning& warning) { return warning.text.find(words) != std::string::npos; });
  };
  const FitResult near = fitted(1);
  EXPECT_EQ(near.report.fair.outcome, Outcome::converged);
  EXPECT_TRUE(near.report.fair.warnings.empty());
  const FitResult behind = fitted(0.1);
  EXPECT_EQ(behind.report.fair.outcome, Outcome::converged);
  EXPECT_TRUE(says(behind, "times as far from the shape as before"));
  const FitResult balloon = fitted(1e-3);
  EXPECT_EQ(balloon.report.fair.outcome, Outcome::worse_than_input);
  EXPECT_TRUE(says(balloon, "of the size away from where they were"));
  EXPECT_EQ(balloon.positions, nodes);
}

TEST(FitPoints, APointMayBeFarAway) {
  const PolygonCurve curve = segment(20);
  for (const double away : {100.0, 1e12, 1e40}) {
    SCOPED_TRACE(away);
    const FitResult result =
        fit(curve, held_ends(curve.positions()), {.positions = {{0.5, away, 0}}}, by_sweeps(0.01, 1e-3, 200));
    for (const Vector3& position : result.positions) EXPECT_TRUE(position.allFinite());
    EXPECT_TRUE(std::isfinite(result.report.after.all.rms));
  }
  EXPECT_NE(refusal({.positions = {{0, 0, 0}, {0, 1e60, 0}}}).find("point 1 "), std::string::npos);
}

TEST(FitPoints, NodesWithoutPointsAreFairBetweenThoseThatHaveSome) {
  const FitResult result = flat_cap(217, on_the_sphere(30)).fit(by_sweeps(0.1, 1e-8, 50000));
  EXPECT_LE(result.report.pulled_nodes, 30);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 0.02);
}

TEST(FitPoints, PointsNearestToWhatStaysPullAtNothing) {
  const PolygonMesh plane = generate::plane({.columns = 20, .rows = 20});
  Constraints held(plane.node_count());
  const std::vector<Index> region = select_region(plane.positions(), {SphereRegion{{0.25, 0.25, 0}, 0.15}});
  restrict_to_region(held, plane, region);
  const ScatteredPoints points{.positions = {{0.9, 0.9, 0.1}}};
  const FitResult away = fit(plane, held, points, by_sweeps(1));
  EXPECT_EQ(away.report.pulling_points, 0);
  EXPECT_LT(greatest_distance(away.positions, plane.positions()), 1e-12);
  const FitResult near = fit(plane, held, {.positions = {{0.25, 0.25, 0.05}}}, by_sweeps(1));
  EXPECT_EQ(near.report.pulling_points, 1);
  EXPECT_GT(near.report.fair.greatest_move, 0.03);
}

TEST(FitPoints, NodesGoNoFurtherFromTheLineThroughThemThanTheToleranceForTheirChords) {
  // 13 nodes of a spiral; what chords cut off is nearly the tolerance.
  const auto place = [](double share) {
    return Vector3((1 + 1.5 * share) * std::cos(9 * share), (1 + 1.5 * share) * std::sin(9 * share), 0);
  };
  std::vector<Vector3> nodes;
  for (int k = 0; k <= 12; ++k) nodes.push_back(place(k / 12.0));
  ScatteredPoints points;
  for (int k = 0; k < 11; ++k) points.positions.push_back(place((k + 0.5) / 11));
  const PolygonCurve curve(nodes);
  std::vector<Vector3> arc;
  for (int k = 0; k <= 400; ++k) arc.push_back(place(k / 400.0));
  const PolygonCurve truth(arc);
  for (const double tolerance : {0.1, 0.14, 0.18}) {
    FitOptions options;
    options.criterion = Within{tolerance};
    const FitResult result = fit(curve, held_ends(nodes), points, options);
    // A node sticks out of its chords by 1 / cos of half its turn.
    EXPECT_LT(distance(result.positions, truth).greatest, 1.5 * tolerance) << tolerance;
  }
}

TEST(FitPoints, NodesAreSpacedAsTheyCameWhereEvenOnesCutOffANose) {
  // An ellipse of 14 : 1, with nodes as close at its nose as it is sharp there.
  const auto place = [](double angle) { return Vector3(7 * (1 - std::cos(angle)), 0.5 * std::sin(angle), 0); };
  std::vector<Vector3> nodes;
  for (int k = 0; k <= 24; ++k) nodes.push_back(place(-pi + (k + 0.5) / 25 * 2 * pi));
  ScatteredPoints points;
  for (int k = 0; k <= 200; ++k) points.positions.push_back(place(-2.9 + 5.8 * k / 200.0));
  FitOptions options{.criterion = Within{0.04}};
  const FitResult result = fit(PolygonCurve(nodes), held_ends(nodes), points, options);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LE(result.report.after.all.greatest, 0.04);
  options.fair.distribution = Distribution::even;
  const FitResult even = fit(PolygonCurve(nodes), held_ends(nodes), points, options);
  EXPECT_GT(even.report.after.all.greatest, 0.04) << "asked for, they stay even";
}

TEST(FitPoints, AShapeThatIsFoldedWhereTheInputIsNotIsNoAnswer) {
  // A slender ellipse, whose tip few nodes cannot go around.
  const auto place = [](double share, double height) {
    const double angle = pi * (0.1 + 1.8 * share);
    return Vector3(std::cos(angle), height * std::sin(angle), 0);
  };
  ScatteredPoints points;
  for (int k = 0; k <= 80; ++k) points.positions.push_back(place(k / 80.0, 0.1));
  // By over 120°: where few nodes go around a tip one of them turns by more than a right angle.
  const auto turns_back = [](const std::vector<Vector3>& nodes) {
    for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
      const Vector3 before = nodes[k] - nodes[k - 1];
      const Vector3 after = nodes[k + 1] - nodes[k];
      if (before.dot(after) < -0.5 * before.norm() * after.norm()) return true;
    }
    return false;
  };
  bool some_worse = false;
  for (const int count : {6, 8, 9, 12, 24}) {
    std::vector<Vector3> nodes;
    nodes.reserve(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) nodes.push_back(place(k / (count - 1.0), 0.5));
    for (const double tolerance : {0.02, 0.05}) {
      FitOptions options;
      options.criterion = Within{tolerance};
      const FitResult result = fit(PolygonCurve(nodes), Constraints(count), points, options);
      const bool is_worse = result.report.fair.outcome == Outcome::worse_than_input;
      EXPECT_FALSE(turns_back(result.positions)) << count << ' ' << tolerance;
      if (is_worse) EXPECT_EQ(result.positions, nodes) << count << ' ' << tolerance;
      some_worse = some_worse || is_worse;
    }
  }
  EXPECT_TRUE(some_worse);
}

TEST(FitPoints, BeyondAHeldEndTheyCountInNoTolerance) {
  const PolygonCurve curve = segment(40);
  ScatteredPoints points;
  for (int k = -20; k <= 100; ++k) points.positions.emplace_back(k / 100.0, 0.004 * std::sin(k / 10.0), 0);
  for (const FitCriterion& criterion : {FitCriterion(Within{0.002}), FitCriterion(RootMeanSquare{0.0015})}) {
    FitOptions options;
    options.criterion = criterion;
    const FitResult result = fit(curve, held_ends(curve.positions()), points, options);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    // 20, and those at the ends themselves.
    EXPECT_EQ(result.report.at_held.count, 22);
    EXPECT_NEAR(result.report.at_held.greatest, 0.2, 0.001);
    EXPECT_EQ(result.report.after.all.count, 99);
    EXPECT_LE(result.report.after.all.rms, 0.002);
    EXPECT_EQ(result.report.fair.warnings.front().code, WarningCode::points_at_held);
  }
}

TEST(FitPoints, TiesGoWithTheNodes) {
  // All points begin at the end node that is nearest to them, and are then passed on along the curve.
  const PolygonCurve curve = segment(40);
  ScatteredPoints points;
  for (int j = 0; j <= 100; ++j) points.positions.emplace_back(Vector3(0.5, 0, 0) + 0.5 * heading(pi * j / 100));
  const FitResult result = fit(curve, held_ends(curve.positions()), points, by_sweeps(0.05, 1e-7, 50000));
  EXPECT_LT(result.report.after.percentile99, 0.01);
  EXPECT_GT(result.report.pulled_nodes, 35);
}

TEST(FitPoints, HeavierPointsCountMore) {
  const PolygonCurve curve = segment(10);
  const auto height = [&](double upper, double lower) {
    const ScatteredPoints points{.positions = {{0.5, 0.1, 0}, {0.5, -0.1, 0}}, .weights = {upper, lower}};
    return fit(curve, held_ends(curve.positions()), points, by_sweeps(0.1, 1e-9, 100000)).positions[5].y();
  };
  EXPECT_NEAR(height(1, 1), 0, 1e-9);
  const double above = height(3, 1);
  EXPECT_GT(above, 0.01);
  EXPECT_NEAR(above, -height(1, 3), 1e-6);
}

TEST(FitPoints, PointsLiftAPlanarCurveOutOfItsPlane) {
  for (const NormalPlane plane : {NormalPlane::full, NormalPlane::principal}) {
    const PolygonCurve curve = segment(20);
    FitOptions options = by_sweeps(1, 1e-7);
    options.fair.curve.normal_plane = plane;
    const FitResult result = fit(curve, held_ends(curve.positions()), {.positions = {{0.5, 0, 0.1}}}, options);
    EXPECT_NEAR(result.positions[10].z(), 0.1, 0.01);
  }
}

TEST(FitPoints, SaysHowFarPointsLie) {
  const PolygonCurve curve = segment(4);
  ScatteredPoints points;
  for (int j = 1; j <= 100; ++j) points.positions.emplace_back(0.5, 0.001 * j, 0);
  const FitResult result = fit(curve, held_ends(curve.positions()), points, by_sweeps(0));
  for (const PointDistances& distances : {result.report.before, result.report.after}) {
    EXPECT_NEAR(distances.all.greatest, 0.1, 1e-15);
    EXPECT_EQ(distances.all.node, 99);
    EXPECT_EQ(distances.all.count, 100);
    EXPECT_NEAR(distances.all.rms, 0.001 * std::sqrt(338350.0 / 100), 1e-15);
    EXPECT_NEAR(distances.median, 0.05, 1e-15);
    EXPECT_NEAR(distances.percentile90, 0.09, 1e-15);
    EXPECT_NEAR(distances.percentile99, 0.099, 1e-15);
  }
  ASSERT_EQ(result.distances.size(), 100U);
  EXPECT_NEAR(result.distances[16], 0.017, 1e-15);
}

TEST(FitPoints, DeviationsAtNodesAreThoseOfTheFurthestOfTheirPoints) {
  const std::vector<Vector3> nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<Vector3> points = {{0.1, 0, 1}, {0.2, 0, 3}, {-5, 0, 2}, {2.2, 0, 0.5}};
  const std::vector<double> distances = {1, 3, 2, 0.5};
  EXPECT_EQ(node_deviations(nodes, points, distances, {}), (std::vector<double>{3, 0, 0.5}));
  const std::vector<double> odd = {1, 3, 2, std::numeric_limits<double>::quiet_NaN()};
  for (const auto& wrong : {std::vector<double>{1, 2, 3}, odd})
    EXPECT_THROW((void)node_deviations(nodes, points, wrong, {}), Error);
}

TEST(FitPoints, RefusalsNameTheNodeThatIsThePoint) {
  PolygonCurve curve = segment(10);
  std::vector<Vector3> positions = curve.positions();
  positions[4].z() = std::numeric_limits<double>::infinity();
  curve.set_positions(positions);
  EXPECT_EQ(support::refusal([&] { (void)fit(curve, held_ends(positions), {.positions = positions}, by_sweeps(1)); },
                             ErrorCode::unusable_shape),
            "node 4: a coordinate is not finite; correct it");
}

TEST(FitPoints, RefusalsNameThePoint) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ScatteredPoints points;
  EXPECT_NE(refusal(points).find("no points"), std::string::npos);
  points.positions.assign(30, {0.5, 0, 0});
  points.weights.assign(29, 1);
  EXPECT_NE(refusal(points).find("29 weights"), std::string::npos);
  points.weights.assign(30, 1);
  points.weights[12] = -0.5;
  EXPECT_NE(refusal(points).find("the weight of point 12"), std::string::npos);
  points.weights[12] = nan;
  EXPECT_NE(refusal(points).find("the weight of point 12"), std::string::npos);
  points.weights.clear();
  points.positions[17].y() = nan;
  EXPECT_EQ(refusal(points, {}, ErrorCode::unusable_shape), "point 17: a coordinate is not finite; leave it out");
  points.positions[17].y() = 0;
  EXPECT_NE(refusal(points, by_sweeps(-1)).find("weight"), std::string::npos);
  FitOptions options;
  options.fair.method = MultigridMethod{};
  options.criterion = Within{0.01};
  EXPECT_NE(refusal(points, options).find("multigrid"), std::string::npos);
  options.criterion = Noise{0.01};
  EXPECT_NE(refusal(points, options).find("multigrid"), std::string::npos);
}

}  // namespace
}  // namespace vspring::fit_points_test
