// Curves that meet the curvature of what is held beside them.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::curve_continuity_test {
namespace {

using namespace support;

using Curvature = std::function<double(double s)>;

/// A planar curve of this curvature from the origin on, of so many edges, by Simpson's rule.
std::vector<Vector3> of_curvature(const Curvature& curvature, double length, int edges) {
  constexpr int parts = 200;
  const double step = length / edges / parts;
  std::vector<Vector3> nodes = {Vector3::Zero()};
  Vector3 place = Vector3::Zero();
  double angle = 0;
  for (int k = 0; k < edges * parts; ++k) {
    const double s = k * step;
    const double a = curvature(s);
    const double b = curvature(s + step / 2);
    const double c = curvature(s + step);
    const double half = angle + step * (5 * a + 8 * b - c) / 24;
    const double end = angle + step * (a + 4 * b + c) / 6;
    place += step / 6 * (heading(angle) + 4 * heading(half) + heading(end));
    angle = end;
    if ((k + 1) % parts == 0) nodes.push_back(place);
  }
  return nodes;
}

/// Nodes of which those from `first` to `last` move; they start with a bump.
struct Dented {
  Dented(std::vector<Vector3> nodes, Index first, Index last, const Vector3& bump = {0.1, 0.2, 0})
      : truth(std::move(nodes)), dented(truth), constraints(static_cast<Index>(truth.size())) {
    for (Index i = first; i <= last; ++i) region.push_back(i);
    for (const Index i : region) {
      const double u = static_cast<double>(i - first + 1) / static_cast<double>(last - first + 2);
      dented[at(i)] += 10 * u * u * (1 - u) * (1 - u) * bump;
    }
    restrict_to_region(constraints, PolygonCurve(dented), region);
  }

  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  [[nodiscard]] FairResult faired(Continuity continuity) const {
    FairOptions options = to_the_end();
    options.continuity = continuity;
    return fair(PolygonCurve(dented), constraints, options);
  }

  /// The largest distance of a moving node from where it was.
  [[nodiscard]] double off(const std::vector<Vector3>& positions) const {
    double greatest = 0;
    for (const Index i : region) greatest = std::max(greatest, (positions[at(i)] - truth[at(i)]).norm());
    return greatest;
  }

  std::vector<Vector3> truth;
  std::vector<Vector3> dented;
  Constraints constraints;
  std::vector<Index> region;
};

std::vector<Vector3> on_circle(int edges, double turn) {
  return of_curvature([](double) { return 1.0; }, turn, edges);
}

std::vector<Vector3> on_helix(int edges, double length, double radius, double pitch) {
  std::vector<Vector3> nodes;
  const double along = std::hypot(radius, pitch);
  for (int k = 0; k <= edges; ++k) {
    const double angle = length * k / edges / along;
    nodes.emplace_back(radius * std::cos(angle), radius * std::sin(angle), pitch * angle);
  }
  return nodes;
}

bool only_tangent(const FairReport& report) {
  return std::any_of(report.warnings.begin(), report.warnings.end(),
                     [](const Warning& warning) { return warning.code == WarningCode::tangent_only; });
}

double between(const std::vector<Vector3>& here, const std::vector<Vector3>& there) {
  double greatest = 0;
  for (std::size_t i = 0; i < here.size(); ++i) greatest = std::max(greatest, (here[i] - there[i]).norm());
  return greatest;
}

TEST(CurveContinuity, OfCurvatureIsExactOnCircles) {
  for (const int edges : {24, 120}) {
    const Dented curve(on_circle(edges, 5), edges / 4, edges / 2);
    const FairResult result = curve.faired(Continuity::curvature);
    EXPECT_EQ(result.report.continuity, Continuity::curvature);
    EXPECT_TRUE(result.report.warnings.empty());
    EXPECT_LT(curve.off(result.positions), 1e-9);
  }
}

TEST(CurveContinuity, OfCurvatureIsExactOnEulerSpirals) {
  const Dented curve(of_curvature([](double s) { return -1 + 0.8 * s; }, 5, 100), 30, 69);
  const FairResult result = curve.faired(Continuity::curvature);
  EXPECT_EQ(result.report.continuity, Continuity::curvature);
  EXPECT_LT(curve.off(result.positions), 1e-8);
}

TEST(CurveContinuity, CubicCurvatureIsReproducedToThirdOrder) {
  const Curvature cubic = [](double s) { return -1 + 0.3 * s + 1.2 * s * s - 0.3 * s * s * s; };
  double before = 0;
  for (const int edges : {50, 100, 200}) {
    const Dented curve(of_curvature(cubic, 4, edges), edges * 3 / 10, edges * 7 / 10, {0.02, 0.05, 0});
    const FairResult result = curve.faired(Continuity::curvature);
    ASSERT_EQ(result.report.continuity, Continuity::curvature);
    const double off = curve.off(result.positions);
    EXPECT_LT(off, 0.1 * curve.off(curve.faired(Continuity::tangent).positions)) << edges;
    if (before > 0) EXPECT_GT(before, 4 * off) << edges;
    before = off;
  }
}

TEST(CurveContinuity, AnSBendBetweenArcsHasNextToNoJump) {
  const Curvature bend = [](double s) { return s < 1.5 ? 1 : s > 2.5 ? -1 : 2 * (2 - s); };
  const Dented curve(of_curvature(bend, 4, 120), 42, 78, {0.05, 0.05, 0});
  const FairReport report = curve.faired(Continuity::curvature).report;
  ASSERT_EQ(report.continuity, Continuity::curvature);
  ASSERT_TRUE(report.curvature_jump);
  EXPECT_LT(10 * (*report.curvature_jump)[1], (*report.curvature_jump)[0]);
}

TEST(CurveContinuity, ARoadOfConstantCurvatureBetweenStraightLinesHasNextToNoJump) {
  // A kink that moves.
  std::vector<Vector3> nodes;
  for (int k = 0; k <= 60; ++k)
    nodes.emplace_back(k < 30 ? Vector3(0.1 * k, 0, 0) : Vector3(3, 0, 0) + 0.1 * (k - 30) * heading(1));
  const Dented curve(nodes, 20, 40, {0, 0, 0});
  const FairReport report = curve.faired(Continuity::curvature).report;
  ASSERT_EQ(report.continuity, Continuity::curvature);
  ASSERT_TRUE(report.curvature_jump);
  EXPECT_LT(10 * (*report.curvature_jump)[1], (*report.curvature_jump)[0]);
}

TEST(CurveContinuity, OfCurvatureInSpaceIsOfHigherOrderOnHelices) {
  double before = 0;
  double before_tangent = 0;
  for (const double length : {2.0, 1.0}) {
    const Dented curve(on_helix(120, 3 * length, 1, 0.5), 40, 79, Vector3(0.05, 0.1, 0.1) * length);
    const FairResult result = curve.faired(Continuity::curvature);
    ASSERT_EQ(result.report.continuity, Continuity::curvature);
    const double off = curve.off(result.positions);
    const double off_tangent = curve.off(curve.faired(Continuity::tangent).positions);
    EXPECT_LT(off, 0.05 * off_tangent);
    if (before > 0) {
      EXPECT_GT(order(before, off), 5.5);
      EXPECT_LT(order(before_tangent, off_tangent), 4.5);
    }
    before = off;
    before_tangent = off_tangent;
  }
}

TEST(CurveContinuity, OfCurvatureBearsNoiseOfATenthOfAnEdge) {
  std::vector<Vector3> nodes = on_circle(200, 4);
  Draw draw(3);
  for (Vector3& node : nodes) {
    const double x = draw.uniform(-1, 1);
    node += 0.1 * 0.02 * std::sqrt(3.0) * Vector3(x, draw.uniform(-1, 1), 0);
  }
  const Dented curve(nodes, 80, 119);
  const FairResult result = curve.faired(Continuity::curvature);
  ASSERT_EQ(result.report.continuity, Continuity::curvature);
  double greatest = 0;
  for (const Index i : curve.region)
    greatest = std::max(greatest, std::abs((result.positions[Dented::at(i)] - Vector3(0, 1, 0)).norm() - 1));
  // Noise of 0.002.
  EXPECT_LT(greatest, 0.006);
}

TEST(CurveContinuity, BothOrdersOfNodesGiveTheSameAndMotionsMoveIt) {
  const Curvature wave = [](double s) { return std::sin(3 * s); };
  const Dented curve(of_curvature(wave, 4, 80), 25, 50);
  const std::vector<Vector3> result = curve.faired(Continuity::curvature).positions;
  FairOptions options = to_the_end();
  options.continuity = Continuity::curvature;
  std::vector<Vector3> reversed(curve.dented.rbegin(), curve.dented.rend());
  Constraints back(curve.constraints.node_count());
  std::vector<Index> region;
  for (const Index i : curve.region) region.push_back(back.node_count() - 1 - i);
  restrict_to_region(back, PolygonCurve(reversed), region);
  reversed = faired(reversed, back, options);
  std::reverse(reversed.begin(), reversed.end());
  EXPECT_LT(between(reversed, result), 1e-10);
  const Motion motion = {.scale = 1e4};
  const std::vector<Vector3> moved =
      faired(motion.points(curve.dented), motion.constraints(curve.constraints), options);
  EXPECT_LT(between(moved, motion.points(result)), 1e-6);
}

TEST(CurveContinuity, HeldNodesInsideHaveNoJumpInTheDerivativeOfCurvature) {
  // As with splines of fifth degree the curve is far nearer to a smooth one through the same nodes.
  std::vector<Vector3> nodes;
  for (int k = 0; k <= 120; ++k) {
    const double x = 2 * std::numbers::pi * k / 120;
    nodes.emplace_back(x, std::sin(x), 0);
  }
  Constraints constraints(121);
  for (Index i = 0; i <= 120; i += 10) hold(constraints, nodes, i);
  constraints.fix_tangent(0, Vector3(1, 1, 0));
  constraints.fix_tangent(120, Vector3(1, 1, 0));
  const std::vector<Vector3> start = noisy(nodes, constraints, 0.01, 1, true);
  FairOptions options = to_the_end();
  const auto off = [&](Continuity continuity) {
    options.continuity = continuity;
    const FairResult result = fair(PolygonCurve(start), constraints, options);
    EXPECT_EQ(result.report.continuity, continuity);
    double greatest = 0;
    for (const Vector3& p : result.positions)
      greatest = std::max(greatest, std::abs(p.y() - std::sin(p.x())) / std::hypot(1, std::cos(p.x())));
    return greatest;
  };
  EXPECT_LT(off(Continuity::curvature), 0.2 * off(Continuity::tangent));
}

TEST(CurveContinuity, EndsWithTheTangentsOfTheInputHaveItsCurvature) {
  std::vector<Vector3> nodes = on_circle(60, 2);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double u = static_cast<double>(i) / 60;
    if (u > 0.2 && u < 0.8) nodes[i] += 0.3 * std::pow((u - 0.2) * (0.8 - u), 3) * Vector3(1, 5, 0) * 100;
  }
  Constraints constraints = held_ends(nodes);
  fix_boundary_tangents(constraints, PolygonCurve(nodes));
  FairOptions options = to_the_end();
  options.continuity = Continuity::curvature;
  const FairResult result = fair(PolygonCurve(nodes), constraints, options);
  EXPECT_EQ(result.report.continuity, Continuity::curvature);
  for (const Vector3& p : result.positions) EXPECT_NEAR((p - Vector3(0, 1, 0)).norm(), 1, 1e-9);
  // Other tangents say nothing of the curvature.
  constraints.fix_tangent(0, heading(0.4));
  constraints.fix_tangent(60, heading(1.4));
  const FairResult turned = fair(PolygonCurve(nodes), constraints, options);
  EXPECT_EQ(turned.report.continuity, Continuity::tangent);
  EXPECT_TRUE(only_tangent(turned.report));
  options.continuity = Continuity::tangent;
  EXPECT_EQ(turned.positions, fair(PolygonCurve(nodes), constraints, options).positions);
}

TEST(CurveContinuity, ACurvatureAtOneEndMakesItQuadratic) {
  // The far end has a tangent that is not of the input.
  const Curvature quadratic = [](double s) { return -0.5 + 0.4 * s + 0.5 * s * s; };
  std::vector<Vector3> nodes = of_curvature(quadratic, 3, 150);
  const double end_angle = -0.5 * 3 + 0.2 * 9 + 0.5 * 9;
  Constraints constraints(151);
  for (Index i = 0; i <= 50; ++i) hold(constraints, nodes, i);
  hold(constraints, nodes, 150);
  constraints.fix_tangent(150, heading(end_angle));
  const std::vector<Vector3> start = noisy(nodes, constraints, 0.004, 1, true);
  FairOptions options = to_the_end();
  options.continuity = Continuity::curvature;
  const FairResult result = fair(PolygonCurve(start), constraints, options);
  ASSERT_EQ(result.report.continuity, Continuity::curvature);
  EXPECT_LT(between(result.positions, nodes), 1e-6);
}

TEST(CurveContinuity, GivenDirectionsInsideAreObeyedAndCurvatureIsContinuousThere) {
  const std::vector<Vector3> nodes = on_helix(80, 6, 1, 0.4);
  Constraints constraints = held_ends(nodes);
  for (const Index i : {20, 40, 60}) hold(constraints, nodes, i);
  const Vector3 normal = Vector3(0.2, 0.1, 1).normalized();
  const Vector3 tangent = Vector3(-1, 0.2, 0.5).normalized();
  constraints.fix_normal(20, normal);
  constraints.fix_tangent(40, tangent);
  FairOptions options = to_the_end();
  options.continuity = Continuity::curvature;
  const FairResult result = fair(PolygonCurve(nodes), constraints, options);
  ASSERT_EQ(result.report.continuity, Continuity::curvature);
  ASSERT_TRUE(result.report.curvature_jump);
  EXPECT_GT((*result.report.curvature_jump)[0], 0.1);
  EXPECT_LT((*result.report.curvature_jump)[1], 1e-6);
  const std::vector<Vector3> tangents = estimate_tangents(PolygonCurve(result.positions), std::vector<Index>{20, 40});
  EXPECT_NEAR(tangents[0].dot(normal), 0, 0.01);
  EXPECT_LT((tangents[1] - tangent).norm(), 0.01);
}

TEST(CurveContinuity, NodesKeepTheirSpacing) {
  std::vector<Vector3> nodes;
  for (const double u : places(Spacing::graded, 60, 4)) nodes.emplace_back(heading(4 * u));
  const Dented curve(nodes, 20, 40, {0, 0, 0});
  FairOptions options = to_the_end(Distribution::keep);
  options.continuity = Continuity::curvature;
  EXPECT_LT(curve.off(faired(curve.dented, curve.constraints, options)), 1e-3);
}

TEST(CurveContinuity, TwoNodesBesideTellNoCurvature) {
  const std::vector<Vector3> nodes = of_curvature([](double s) { return s; }, 2, 40);
  Constraints constraints = held_ends(nodes);
  for (const Index i : {1, 33, 34, 35, 36, 37, 38, 39}) hold(constraints, nodes, i);
  FairOptions options = to_the_end();
  options.continuity = Continuity::curvature;
  const FairResult result = fair(PolygonCurve(nodes), constraints, options);
  EXPECT_EQ(result.report.continuity, Continuity::curvature);
  EXPECT_TRUE(only_tangent(result.report));
  EXPECT_LT(between(result.positions, nodes), 1e-3);
}

TEST(CurveContinuity, ClosedCurvesMeetWhatIsHeldAndGoThroughHeldNodes) {
  std::vector<Vector3> ellipse;
  for (int k = 0; k < 120; ++k) {
    const double angle = 2 * std::numbers::pi * k / 120;
    ellipse.emplace_back(1.3 * std::cos(angle), std::sin(angle), 0);
  }
  const auto off = [](const std::vector<Vector3>& positions) {
    double greatest = 0;
    for (const Vector3& p : positions) {
      const Vector3 unit(p.x() / 1.3, p.y(), 0);
      greatest =
          std::max(greatest, std::abs(unit.squaredNorm() - 1) / (2 * Vector3(unit.x() / 1.3, unit.y(), 0).norm()));
    }
    return greatest;
  };
  const PolygonCurve closed(ellipse, true);
  Constraints region(120);
  std::vector<Index> nodes;
  for (Index i = 100; i < 125; ++i) nodes.push_back(i % 120);
  restrict_to_region(region, closed, nodes);
  Constraints many(120);
  for (Index i = 2; i < 120; i += 5) hold(many, ellipse, i);
  for (const Constraints& constraints : {region, many}) {
    FairOptions options = to_the_end();
    const double with_tangents = off(fair(closed, constraints, options).positions);
    options.continuity = Continuity::curvature;
    const FairResult result = fair(closed, constraints, options);
    EXPECT_EQ(result.report.continuity, Continuity::curvature);
    EXPECT_LT(off(result.positions), 0.3 * with_tangents);
  }
}

TEST(CurveContinuity, SayingTangentChangesNothingAndThreadsChangeNoBit) {
  const Dented curve(of_curvature([](double s) { return std::sin(3 * s); }, 4, 80), 25, 50);
  EXPECT_EQ(curve.faired(Continuity::tangent).positions, faired(curve.dented, curve.constraints));
  FairOptions options = to_the_end();
  options.continuity = Continuity::curvature;
  Context context;
  context.threads = 1;
  const std::vector<Vector3> one = fair(PolygonCurve(curve.dented), curve.constraints, options, context).positions;
  context.threads = 4;
  EXPECT_EQ(fair(PolygonCurve(curve.dented), curve.constraints, options, context).positions, one);
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (curve.constraints.position_fixed(static_cast<Index>(i))) EXPECT_EQ(one[i], curve.dented[i]);
    EXPECT_EQ(one[i].z(), 0);
  }
}

TEST(CurveContinuity, WhereNothingIsBesideTangentsAreMetWithAWarning) {
  const std::vector<Vector3> nodes = of_curvature([](double s) { return s; }, 2, 40);
  const Constraints constraints = held_ends(nodes);
  FairOptions options = to_the_end();
  options.continuity = Continuity::curvature;
  const FairResult result = fair(PolygonCurve(nodes), constraints, options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.continuity, Continuity::tangent);
  EXPECT_TRUE(only_tangent(result.report));
  EXPECT_EQ(result.positions, faired(nodes, constraints));
}

}  // namespace
}  // namespace vspring::curve_continuity_test
