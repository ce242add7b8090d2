#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::curve_constraints_test {
namespace {

using namespace support;

std::vector<Index> all_nodes(const PolygonCurve& curve) {
  std::vector<Index> all(static_cast<std::size_t>(curve.node_count()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// On a circle in a tilted plane, unevenly spaced.
struct Arc {
  PolygonCurve curve;
  std::vector<Vector3> tangents;
  std::vector<Vector3> normals;
};

Arc tilted_arc(bool closed) {
  Motion motion;
  motion.scale = 3;
  Arc arc;
  std::vector<Vector3> nodes;
  auto at = places(Spacing::random, 20, 6);
  if (closed) at.pop_back();
  for (const double place : at) {
    const double angle = (closed ? 360 : 250) * degree * place;
    nodes.push_back(motion.point(heading(angle)));
    arc.tangents.emplace_back(motion.turn * heading(angle + 90 * degree));
    arc.normals.emplace_back(motion.turn * heading(angle));
  }
  arc.curve = PolygonCurve(nodes, closed);
  return arc;
}

TEST(EstimateTangents, AreExactOnCirclesEndsIncluded) {
  for (const bool closed : {false, true}) {
    const Arc arc = tilted_arc(closed);
    const auto tangents = estimate_tangents(arc.curve, all_nodes(arc.curve));
    EXPECT_LT(greatest_distance(tangents, arc.tangents), 1e-13);
  }
}

TEST(EstimateTangents, AreOfSecondOrderOnSmoothCurves) {
  std::vector<double> middle;
  std::vector<double> end;
  for (const int edges : {40, 80, 160}) {
    std::vector<Vector3> nodes;
    for (const double t : places(Spacing::alternating, edges, 2)) nodes.emplace_back(t, t * t * t, std::exp(t));
    const PolygonCurve curve(nodes);
    const auto tangents = estimate_tangents(curve, all_nodes(curve));
    double greatest = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double t = nodes[i].x();
      const double error = (tangents[i] - Vector3(1, 3 * t * t, std::exp(t)).normalized()).norm();
      if (i == 0 || i + 1 == nodes.size())
        greatest = std::max(greatest, error);
      else if (i == 1)
        middle.push_back(error);
      else
        middle.back() = std::max(middle.back(), error);
    }
    end.push_back(greatest);
  }
  EXPECT_GT(order(middle[1], middle[2]), 1.9);
  EXPECT_GT(order(end[1], end[2]), 1.8);
}

TEST(EstimateTangents, LookOnlyAtNodesThatMayBeLookedAt) {
  Arc arc = tilted_arc(false);
  auto nodes = arc.curve.positions();
  for (std::size_t i = 8; i < 12; ++i) nodes[i] += Vector3(1, 1, 1);
  arc.curve.set_positions(nodes);
  std::vector<std::uint8_t> usable(nodes.size(), 1);
  for (std::size_t i = 8; i < 12; ++i) usable[i] = 0;
  const auto tangents = estimate_tangents(arc.curve, std::vector<Index>{7, 12}, usable);
  EXPECT_LT((tangents[0] - arc.tangents[7]).norm(), 1e-13);
  EXPECT_LT((tangents[1] - arc.tangents[12]).norm(), 1e-13);
}

TEST(EstimateTangents, GoAlongTheEdgeWhereThereIsNoThirdNodeAndAreZeroWithoutAnEdge) {
  const PolygonCurve edge(std::vector<Vector3>{{0, 0, 0}, {0, 3, 4}});
  for (const Vector3& t : estimate_tangents(edge, std::vector<Index>{0, 1}))
    EXPECT_LT((t - Vector3(0, 0.6, 0.8)).norm(), 1e-15);
  const PolygonCurve alone(std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{.nodes = {0, 1}}});
  EXPECT_EQ(estimate_tangents(alone, std::vector<Index>{2})[0], Vector3(0, 0, 0));
}

TEST(EstimateNormalsOfCurves, LieInThePlaneAcrossTheTangent) {
  const Arc arc = tilted_arc(false);
  const auto normals = estimate_normals(arc.curve, all_nodes(arc.curve));
  for (std::size_t i = 0; i < normals.size(); ++i) EXPECT_NEAR(std::abs(normals[i].dot(arc.normals[i])), 1, 1e-13);
}

TEST(EstimateNormalsOfCurves, OfAHelixPointToItsAxis) {
  std::vector<Vector3> nodes;
  for (const double t : places(Spacing::even, 60)) nodes.emplace_back(heading(5 * t) + Vector3(0, 0, 2 * t));
  const PolygonCurve curve(nodes);
  const auto normals = estimate_normals(curve, all_nodes(curve));
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i)
    EXPECT_NEAR(std::abs(normals[i].dot(Vector3(nodes[i].x(), nodes[i].y(), 0))), 1, 1e-12);
  const PolygonCurve line(straight({0, 0, 0}, {1, 1, 1}, places(Spacing::even, 5)));
  for (const Vector3& normal : estimate_normals(line, all_nodes(line))) EXPECT_EQ(normal, Vector3(0, 0, 0));
}

TEST(LiesInAPlane, WithAllThatHoldsIt) {
  const PolygonCurve curve = tilted_arc(false).curve;
  Constraints constraints(curve.node_count());
  EXPECT_TRUE(lies_in_a_plane(curve, constraints));
  Motion motion;
  const Vector3 across = motion.turn * Vector3::UnitZ();
  Constraints tangent = constraints;
  tangent.fix_tangent(0, across);
  EXPECT_FALSE(lies_in_a_plane(curve, tangent));
  Constraints normal = constraints;
  normal.fix_normal(3, across);
  EXPECT_FALSE(lies_in_a_plane(curve, normal));
  Constraints position = constraints;
  position.fix_position(5, curve.position(5) + 0.01 * across);
  EXPECT_FALSE(lies_in_a_plane(curve, position));
  const PolygonCurve line(straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 10)));
  EXPECT_FALSE(lies_in_a_plane(line, Constraints(11)));
}

TEST(RegionOfACurve, FixesTheRestAndGivesTheRimTheTangentsOutside) {
  Arc arc = tilted_arc(false);
  auto nodes = arc.curve.positions();
  for (std::size_t i = 8; i < 12; ++i) nodes[i] += Vector3(1, 1, 1);
  arc.curve.set_positions(nodes);
  Constraints constraints(arc.curve.node_count());
  constraints.fix_tangent(9, {1, 0, 0});
  restrict_to_region(constraints, arc.curve, std::vector<Index>{8, 9, 10, 11});
  for (Index i = 0; i < arc.curve.node_count(); ++i) {
    const bool inside = i >= 8 && i < 12;
    EXPECT_EQ(constraints.position_fixed(i), !inside) << i;
    EXPECT_EQ(constraints.tangent_fixed(i), i == 7 || i == 9 || i == 12) << i;
    if (inside) continue;
    EXPECT_EQ(constraints.position(i), arc.curve.position(i));
  }
  EXPECT_LT((constraints.tangent(7) - arc.tangents[7]).norm(), 1e-13);
  EXPECT_LT((constraints.tangent(12) - arc.tangents[12]).norm(), 1e-13);
  EXPECT_EQ(constraints.tangent(9), Vector3(1, 0, 0));
}

TEST(RegionOfACurve, ARimWithNothingOutsideKeepsItsTangentFreeAndGivenOnesStay) {
  const PolygonCurve curve(straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 10)));
  Constraints constraints(11);
  hold(constraints, curve.positions(), 0);
  hold(constraints, curve.positions(), 10);
  constraints.fix_tangent(10, {0, 1, 0});
  const std::vector<Index> region = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  restrict_to_region(constraints, curve, region);
  EXPECT_FALSE(constraints.tangent_fixed(0));
  EXPECT_EQ(constraints.tangent(10), Vector3(0, 1, 0));
}

TEST(RegionOfACurve, ANodeOutOfRangeIsRefusedAndChangesNothing) {
  const PolygonCurve curve(straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 10)));
  Constraints constraints(11);
  for (const Index wrong : {-1, 11}) {
    try {
      restrict_to_region(constraints, curve, std::vector<Index>{3, wrong});
      ADD_FAILURE() << "nothing was refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::unusable_constraint);
      EXPECT_NE(std::string(error.what()).find(std::to_string(wrong)), std::string::npos) << error.what();
    }
    EXPECT_FALSE(constraints.position_fixed(0));
  }
}

}  // namespace
}  // namespace vspring::curve_constraints_test
