// Through fixed nodes a planar curve becomes the Euler-spiral spline: curvature is continuous at them, and linear in
// arc length between.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_curve_spline_test {
namespace {

using namespace support;
using reference::Clothoid;

struct Case {
  std::vector<Eigen::Vector2d> points;
  std::vector<int> shares;  // of the edges, span by span
  std::optional<double> start;
  std::optional<double> end;
};

const std::vector<Case> cases = {
    // Spans of lengths 1 and 1.2, equally many nodes.
    {{{0, 0}, {1, 0}, {1.8, 0.8944}}, {1, 1}, 0.7, 0.9},
    {{{0, 0}, {1, 0}, {1.8, 0.8944}}, {1, 1}, std::nullopt, std::nullopt},
    // As many edges in the short span as in the long ones, and three times as many.
    {{{0, 0}, {1, 0.4}, {1.4, 0.2}, {2.6, 1}}, {1, 1, 1}, -0.4, std::nullopt},
    {{{0, 0}, {1, 0.4}, {1.4, 0.2}, {2.6, 1}}, {1, 3, 2}, 0.9, -0.5},
    {{{0, 0}, {1, 1}, {2, 0}, {3, 1}, {4, 0}}, {1, 2, 1, 2}, std::nullopt, std::nullopt},
};

struct Start {
  std::vector<Vector3> nodes;
  std::vector<Index> joints;  // the nodes at the points
};

/// The polygon of the points.
Start polygon(const Case& c, int edges, Spacing spacing) {
  Start start;
  for (std::size_t k = 0; k + 1 < c.points.size(); ++k) {
    const auto span = straight(lifted(c.points[k]), lifted(c.points[k + 1]), places(spacing, c.shares[k] * edges));
    start.joints.push_back(static_cast<Index>(start.nodes.size()));
    start.nodes.insert(start.nodes.end(), span.begin(), span.end() - 1);
  }
  start.joints.push_back(static_cast<Index>(start.nodes.size()));
  start.nodes.push_back(lifted(c.points.back()));
  return start;
}

std::vector<Vector3> faired_through_points(const Case& c, const Start& start, const FairOptions& options) {
  Constraints constraints(static_cast<Index>(start.nodes.size()));
  for (const Index joint : start.joints) hold(constraints, start.nodes, joint);
  if (c.start) constraints.fix_tangent(start.joints.front(), heading(*c.start));
  if (c.end) constraints.fix_tangent(start.joints.back(), heading(*c.end));
  return faired(start.nodes, constraints, options);
}

double distance_from_spline(const std::vector<Clothoid>& spline, const Start& start,
                            const std::vector<Vector3>& nodes) {
  double greatest = 0;
  for (std::size_t k = 0; k < spline.size(); ++k) {
    const std::vector<Vector3> span(nodes.begin() + start.joints[k], nodes.begin() + start.joints[k + 1] + 1);
    greatest = std::max(greatest, distance_from(spline[k], span));
  }
  return greatest;
}

double curvature(const Vector3& before, const Vector3& at, const Vector3& after) {
  const Vector3 a = at - before;
  const Vector3 b = after - at;
  return 2 * a.cross(b).z() / (a.norm() * b.norm() * (after - before).norm());
}

TEST(FairCurveSpline, FixedNodesInBetweenGiveTheEulerSpiralSpline) {
  for (std::size_t which = 0; which < cases.size(); ++which) {
    const Case& c = cases[which];
    const auto spline = reference::hermite_clothoid_spline(c.points, c.start, c.end);
    for (const Spacing spacing : {Spacing::even, Spacing::alternating, Spacing::jump}) {
      std::vector<double> error;
      for (const int edges : {16, 32, 64, 128}) {
        const Start start = polygon(c, edges, spacing);
        const auto distribution = spacing == Spacing::even ? Distribution::even : Distribution::keep;
        error.push_back(distance_from_spline(spline, start, faired_through_points(c, start, to_the_end(distribution))));
      }
      SCOPED_TRACE(fmt::format("case {}, spacing {}: {:.2e} {:.2e} {:.2e} {:.2e}", which, static_cast<int>(spacing),
                               error[0], error[1], error[2], error[3]));
      EXPECT_LT(error[3], 1e-3);
      EXPECT_GT(order(error[1], error[2]), 1.9);
      EXPECT_GT(order(error[2], error[3]), 1.9);
    }
  }
}

TEST(FairCurveSpline, CurvatureIsContinuousAtFixedNodesAndLinearBetween) {
  const Case& c = cases[3];
  const auto spline = reference::hermite_clothoid_spline(c.points, c.start, c.end);
  std::vector<double> error;
  std::vector<double> bend;
  for (const int edges : {16, 32, 64, 128}) {
    const Start start = polygon(c, edges, Spacing::even);
    const auto nodes = faired_through_points(c, start, to_the_end());
    double greatest = 0;
    double greatest_bend = 0;
    for (std::size_t k = 0; k < spline.size(); ++k) {
      double s = 0;
      const auto last = static_cast<std::size_t>(start.joints[k + 1]);
      std::vector<double> at;
      for (auto i = static_cast<std::size_t>(start.joints[k]); i <= last; ++i) {
        if (i > static_cast<std::size_t>(start.joints[k])) s += (nodes[i] - nodes[i - 1]).norm();
        if (i == 0 || i + 1 == nodes.size()) continue;
        // Fixed nodes are counted with the span before and with the span after.
        at.push_back(curvature(nodes[i - 1], nodes[i], nodes[i + 1]));
        greatest = std::max(greatest, std::abs(at.back() - spline[k].curvature_at(s)));
      }
      for (std::size_t i = 2; i + 2 < at.size(); ++i)
        greatest_bend = std::max(greatest_bend, std::abs(at[i - 1] - 2 * at[i] + at[i + 1]) * edges * edges);
    }
    error.push_back(greatest);
    bend.push_back(greatest_bend);
  }
  SCOPED_TRACE(fmt::format("{:.2e} {:.2e} {:.2e} {:.2e}; second differences {:.2e} {:.2e} {:.2e} {:.2e}", error[0],
                           error[1], error[2], error[3], bend[0], bend[1], bend[2], bend[3]));
  EXPECT_LT(error[3], 1e-3);
  for (std::size_t k = 1; k < 3; ++k) {
    EXPECT_GT(order(error[k], error[k + 1]), 1.9);
    EXPECT_GT(order(bend[k], bend[k + 1]), 1.9);
  }
}

TEST(FairCurveSpline, FixedNodesMayBePutFarFromWhereTheInputHasThem) {
  // A straight start, most of whose nodes have been left behind, gives what the polygon through the points gives.
  for (const int edges : {20, 100, 500, 3000}) {
    for (const double height : {0.02, 0.1, 0.3, 0.6}) {
      SCOPED_TRACE(fmt::format("{} edges, height {}", edges, height));
      const auto start = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, edges));
      Constraints constraints = held_ends(start);
      const std::vector<Vector3> points = {{0, 0, 0}, {0.3, height, 0}, {0.55, height / 2, 0}, {1, 0, 0}};
      const std::vector<Index> joints = {0, edges / 3, edges / 2, edges};
      std::vector<Vector3> polygon;
      for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        constraints.fix_position(joints[k], points[k]);
        const auto span = straight(points[k], points[k + 1], places(Spacing::even, joints[k + 1] - joints[k]));
        polygon.insert(polygon.end(), span.begin(), span.end() - 1);
      }
      polygon.push_back(points.back());
      const FairResult result = fair(PolygonCurve(start), constraints, to_the_end(Distribution::even, 1e-10));
      EXPECT_EQ(result.report.outcome, Outcome::converged);
      EXPECT_LT(greatest_distance(result.positions, faired(polygon, constraints)), 1e-9);
    }
  }
}

TEST(FairCurveSpline, ATangentAtAFixedNodeAllowsAJumpOfCurvature) {
  // Two arcs of one tangent: each span is on its own.
  std::vector<Vector3> nodes = straight({-1, 0, 0}, {0, 1, 0}, places(Spacing::even, 40));
  const auto second = straight({0, 1, 0}, {2, 3, 0}, places(Spacing::even, 40));
  nodes.insert(nodes.end(), second.begin() + 1, second.end());
  Constraints constraints = held_ends(nodes, heading(90 * degree), heading(90 * degree));
  hold(constraints, nodes, 40);
  constraints.fix_tangent(40, heading(0));
  const auto result = faired(nodes, constraints);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double distance = i < 40 ? result[i].norm() - 1 : (result[i] - Vector3(0, 3, 0)).norm() - 2;
    EXPECT_LT(std::abs(distance), 1e-12);
  }
}

}  // namespace
}  // namespace vspring::fair_curve_spline_test
