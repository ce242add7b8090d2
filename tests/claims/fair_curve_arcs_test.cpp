// Circles, arcs and straight lines come out exact: from noisy starts, whatever the spacing, in any plane.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_curve_arcs_test {
namespace {

using namespace support;

struct Layout {
  Spacing spacing;
  Distribution distribution;
  double ratio;
};

constexpr Layout layouts[] = {
    {Spacing::even, Distribution::even, 1},    {Spacing::random, Distribution::even, 3},
    {Spacing::graded, Distribution::even, 10}, {Spacing::even, Distribution::keep, 1},
    {Spacing::random, Distribution::keep, 3},  {Spacing::graded, Distribution::keep, 10},
};

std::string described(int nodes, const Layout& layout, bool tilted) {
  return fmt::format("{} nodes, spacing {}, distribution {}, {}", nodes, static_cast<int>(layout.spacing),
                     static_cast<int>(layout.distribution), tilted ? "tilted in space" : "in a plane");
}

/// Calls with every number of nodes, layout and place in space.
void in_every_way(const std::function<void(int nodes, const Layout& layout, bool tilted)>& claim) {
  for (const int nodes : {10, 100, 1000}) {
    for (const Layout& layout : layouts) {
      for (const bool tilted : {false, true}) {
        SCOPED_TRACE(described(nodes, layout, tilted));
        claim(nodes, layout, tilted);
      }
    }
  }
}

/// Exact means: to this share of the diagonal of the box around the nodes.
constexpr double exact = 1e-12;

Vector3 on_circle(double angle) { return heading(angle); }
Vector3 circle_tangent(double angle) { return heading(angle + 90 * degree); }

/// The largest distance from the unit circle about the origin in the plane z = 0.
double distance_from_circle(const std::vector<Vector3>& nodes) {
  double greatest = 0;
  for (const Vector3& p : nodes) greatest = std::max(greatest, std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()));
  return greatest;
}

double distance_from_axis(const std::vector<Vector3>& nodes) {
  double greatest = 0;
  for (const Vector3& p : nodes) greatest = std::max(greatest, std::hypot(p.y(), p.z()));
  return greatest;
}

/// Fairs in the plane z = 0, or turned, with noise in the plane or in space; the result turned back.
std::vector<Vector3> faired_from_noise(const std::vector<Vector3>& nodes, const Constraints& constraints,
                                       double amplitude, const Layout& layout, bool tilted, bool closed = false) {
  Motion motion;
  motion.shift.setZero();
  if (!tilted) motion.turn.setIdentity();
  const auto start = motion.points(noisy(nodes, constraints, amplitude, 5, !tilted));
  const FairResult result =
      fair(PolygonCurve(start, closed), motion.constraints(constraints), to_the_end(layout.distribution));
  motion.turn.transposeInPlace();
  return motion.points(result.positions);
}

TEST(FairCurveArcs, NoisyArcsWithEndTangentsReturnToTheCircle) {
  for (const double turn : {60.0, 180.0, 270.0}) {
    in_every_way([&](int count, const Layout& layout, bool tilted) {
      std::vector<Vector3> nodes;
      for (const double at : places(layout.spacing, count - 1, layout.ratio))
        nodes.push_back(on_circle(at * turn * degree));
      const Constraints constraints = held_ends(nodes, circle_tangent(0), circle_tangent(turn * degree));
      const auto result = faired_from_noise(nodes, constraints, 0.03, layout, tilted);
      EXPECT_LT(distance_from_circle(result), exact * diagonal(nodes));
    });
  }
}

TEST(FairCurveArcs, NoisyClosedCurvesReturnToTheCircleThroughTheirHeldNodes) {
  in_every_way([](int count, const Layout& layout, bool tilted) {
    std::vector<Vector3> nodes;
    for (const double at : places(layout.spacing, count, layout.ratio)) nodes.push_back(on_circle(at * 360 * degree));
    nodes.pop_back();
    Constraints constraints(count);
    for (const Index node : {count / 10, count / 2, 4 * count / 5}) hold(constraints, nodes, node);
    const auto result = faired_from_noise(nodes, constraints, 0.02, layout, tilted, true);
    EXPECT_LT(distance_from_circle(result), exact * diagonal(nodes));
  });
}

TEST(FairCurveArcs, AClosedCurveMayBeHeldByOneNodeWithATangentAndAnother) {
  for (const int count : {10, 100, 1000}) {
    std::vector<Vector3> nodes;
    for (const double at : places(Spacing::random, count)) nodes.push_back(on_circle(at * 360 * degree));
    nodes.pop_back();
    Constraints constraints(count);
    hold(constraints, nodes, 0);
    constraints.fix_tangent(0, circle_tangent(0));
    hold(constraints, nodes, count / 3);
    EXPECT_TRUE(check_constraints(PolygonCurve(nodes, true), constraints).empty());
    const auto result = faired_from_noise(nodes, constraints, 0.02, layouts[4], true, true);
    EXPECT_LT(distance_from_circle(result), exact * diagonal(nodes)) << count;
  }
}

TEST(FairCurveArcs, NoisyLinesReturnToTheLine) {
  for (const bool tangents : {false, true}) {
    in_every_way([&](int count, const Layout& layout, bool tilted) {
      const auto nodes = straight({0, 0, 0}, {1, 0, 0}, places(layout.spacing, count - 1, layout.ratio));
      Constraints constraints = held_ends(nodes);
      if (tangents) constraints = held_ends(nodes, {1, 0, 0}, {1, 0, 0});
      const auto result = faired_from_noise(nodes, constraints, 0.05, layout, tilted);
      EXPECT_LT(distance_from_axis(result), exact);
    });
  }
}

TEST(FairCurveArcs, NoiseMuchSmallerOrLargerThanTheSpacingIsNoHindrance) {
  for (const int count : {10, 30, 100}) {
    for (const double noise : {0.1, 0.25, 0.5, 1.0, 3.0}) {
      for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(fmt::format("{} nodes, noise {} of the spacing, seed {}", count, noise, seed));
        const auto line = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, count - 1));
        const Constraints ends = held_ends(line);
        const PolygonCurve start(noisy(line, ends, noise / (count - 1), seed, seed % 2 == 0));
        const FairResult result = fair(start, ends, to_the_end());
        EXPECT_EQ(result.report.outcome, Outcome::converged);
        EXPECT_LT(distance_from_axis(result.positions), exact);
      }
    }
  }
}

TEST(FairCurveArcs, FlatStartsBecomeTheArcThatTheTangentsAskFor) {
  for (const double half : {20.0, 60.0, 90.0, 120.0}) {
    for (const Layout& layout : layouts) {
      SCOPED_TRACE(described(100, layout, false) + fmt::format(", half a turn of {}", half));
      const auto nodes = straight({-std::sin(half * degree), 0, 0}, {std::sin(half * degree), 0, 0},
                                  places(layout.spacing, 99, layout.ratio));
      const Constraints constraints = held_ends(nodes, heading(half * degree), heading(-half * degree));
      auto result = faired(nodes, constraints, to_the_end(layout.distribution));
      for (Vector3& p : result) p.y() += std::cos(half * degree);
      EXPECT_LT(distance_from_circle(result), exact * diagonal(nodes));
    }
  }
}

TEST(FairCurveArcs, KeptSpacingIsThatOfTheInput) {
  const auto at = places(Spacing::random, 40, 5, 3);
  const auto nodes = straight({-1, 0, 0}, {1, 0, 0}, at);
  const Constraints constraints = held_ends(nodes, heading(90 * degree), heading(-90 * degree));
  const auto kept = faired(nodes, constraints, to_the_end(Distribution::keep));
  const auto evened = faired(nodes, constraints, to_the_end(Distribution::even));
  const double whole = (kept[1] - kept[0]).norm() / at[1];
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    EXPECT_NEAR((kept[i] - kept[i - 1]).norm(), whole * (at[i] - at[i - 1]), 1e-12);
    EXPECT_NEAR((evened[i] - evened[i - 1]).norm(), 2 * std::sin(90 * degree / 40), 1e-12);
  }
}

}  // namespace
}  // namespace vspring::fair_curve_arcs_test
