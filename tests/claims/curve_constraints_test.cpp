// What of curves and their constraints is refused or warned of, and what rules for curves mean.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "support/curves.hpp"
#include "support/refusal.hpp"
#include "vspring/vspring.hpp"

namespace vspring::curve_constraints_test {
namespace {

using namespace support;
using support::refusal;

/// By check_constraints() and by fair(), with the same words.
std::string refusal(const PolygonCurve& curve, const Constraints& constraints, ErrorCode code) {
  std::string message = refusal([&] { (void)check_constraints(curve, constraints); }, code);
  EXPECT_EQ(refusal([&] { (void)fair(curve, constraints); }, code), message);
  return message;
}

std::vector<Vector3> circle(int count) {
  std::vector<Vector3> nodes;
  nodes.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) nodes.push_back(heading(360 * degree * k / count));
  return nodes;
}

std::vector<Vector3> line(int edges) { return straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, edges)); }

std::vector<Index> sequence(Index first, Index last) {
  std::vector<Index> nodes;
  for (Index i = first; i <= last; ++i) nodes.push_back(i);
  return nodes;
}

TEST(CurveConstraints, AFreeEndIsRefusedAndNamed) {
  const PolygonCurve curve(line(10));
  Constraints constraints(11);
  hold(constraints, curve.positions(), 0);
  EXPECT_TRUE(says(refusal(curve, constraints, ErrorCode::unusable_constraint), "end node 10 is free"));
  Constraints other(11);
  hold(other, curve.positions(), 10);
  EXPECT_TRUE(says(refusal(curve, other, ErrorCode::unusable_constraint), "end node 0 is free"));
  // The free end of a chain does not matter where nothing of it moves.
  hold(constraints, curve.positions(), 10);
  EXPECT_TRUE(check_constraints(curve, constraints).empty());
}

TEST(CurveConstraints, OneWarningSaysThatCurvesLoseTheirShapeBetweenTheirEnds) {
  const auto wave = [](double height) {
    std::vector<Vector3> nodes = line(20);
    nodes.push_back({0, 1, 0});
    for (int k = 1; k <= 20; ++k) nodes.push_back({k / 20.0, 1 + height * std::sin(k * 0.3), 0});
    return PolygonCurve(nodes, {{.nodes = sequence(0, 20)}, {.nodes = sequence(21, 41)}});
  };
  const auto texts = [](const PolygonCurve& curve, const Constraints& constraints) {
    std::vector<std::string> result;
    for (const Warning& warning : check_constraints(curve, constraints))
      if (warning.code == WarningCode::only_ends_held) result.push_back(warning.text);
    return result;
  };
  const PolygonCurve curve = wave(0.2);
  Constraints ends(42);
  for (const Index i : {0, 20, 21, 41}) hold(ends, curve.positions(), i);
  ASSERT_EQ(texts(curve, ends).size(), 1U);
  EXPECT_TRUE(says(texts(curve, ends).front(), "the curve through node 22:")) << texts(curve, ends).front();
  EXPECT_EQ(fair(curve, ends).report.warnings, check_constraints(curve, ends));
  EXPECT_TRUE(texts(wave(0.03), ends).empty()) << "it is straight but for noise";
  Constraints inner = ends;
  hold(inner, curve.positions(), 30);
  EXPECT_TRUE(texts(curve, inner).empty());
  Constraints directed = ends;
  directed.fix_tangent(21, {1, 1, 0});
  EXPECT_TRUE(texts(curve, directed).empty());
}

TEST(CurveConstraints, AClosedChainThatNothingHoldsIsRefusedAndNamed) {
  const PolygonCurve curve(circle(20), true);
  Constraints constraints(20);
  constraints.fix_tangent(3, {1, 0, 0});
  const std::string message = refusal(curve, constraints, ErrorCode::unusable_constraint);
  EXPECT_TRUE(says(message, "closed curve through node 0 (20 nodes)")) << message;
}

TEST(CurveConstraints, AMovingNodeWhereChainsMeetIsRefusedAndNamed) {
  // A cross through node 2, and a chain that passes it twice.
  const std::vector<Vector3> nodes = {{-1, 0, 0}, {-0.5, 0, 0}, {0, 0, 0}, {0.5, 0, 0},
                                      {1, 0, 0},  {0, -1, 0},   {0, 1, 0}};
  const PolygonCurve cross(nodes, {{.nodes = {0, 1, 2, 3, 4}}, {.nodes = {5, 2, 6}}});
  Constraints constraints(7);
  for (const Index i : {0, 4, 5, 6}) hold(constraints, nodes, i);
  EXPECT_TRUE(says(refusal(cross, constraints, ErrorCode::unusable_shape), "node 2: chains meet there"));
  hold(constraints, nodes, 2);
  EXPECT_TRUE(check_constraints(cross, constraints).empty());
  EXPECT_EQ(fair(cross, constraints).report.moving_nodes, 2);

  const PolygonCurve twice(nodes, {{.nodes = {0, 1, 2, 3, 4, 6, 2, 5}}});
  Constraints ends(7);
  for (const Index i : {0, 5}) hold(ends, nodes, i);
  EXPECT_TRUE(says(refusal(twice, ends, ErrorCode::unusable_shape), "node 2: chains meet there"));
}

TEST(CurveConstraints, CoordinatesThatAreNotFiniteAreRefusedWhereAMovingNodeLooks) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    auto nodes = line(20);
    nodes[10].y() = bad;
    const PolygonCurve curve(nodes);
    EXPECT_TRUE(says(refusal(curve, held_ends(nodes), ErrorCode::unusable_shape), "node 10: a coordinate"));
    // Given a position, it is whole again.
    Constraints mended = held_ends(nodes);
    mended.fix_position(10, {0.5, 0.1, 0});
    EXPECT_TRUE(check_constraints(curve, mended).empty());
    for (const Vector3& p : fair(curve, mended).positions) EXPECT_TRUE(p.allFinite());
    // A moving node sees two nodes on either side, and none further away.
    for (const Index moving : {12, 13}) {
      Constraints few(21);
      for (Index i = 0; i < 21; ++i) {
        if (i != moving) hold(few, nodes, i);
      }
      if (moving == 12) {
        EXPECT_TRUE(says(refusal(curve, few, ErrorCode::unusable_shape), "node 10"));
      } else {
        EXPECT_TRUE(fair(curve, few).positions[13].allFinite());
      }
    }
  }
}

TEST(CurveConstraints, AClosedChainOfFewerThanThreeNodesIsRefusedWhereItMoves) {
  const PolygonCurve curve(std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}}, true);
  Constraints constraints(2);
  hold(constraints, curve.positions(), 0);
  EXPECT_TRUE(says(refusal(curve, constraints, ErrorCode::unusable_shape), "node 0: a closed curve needs three"));
  hold(constraints, curve.positions(), 1);
  EXPECT_EQ(fair(curve, constraints).positions, curve.positions());
}

TEST(CurveConstraints, AFamilyOfCirclesIsWarnedOf) {
  const PolygonCurve curve(circle(20), true);
  Constraints constraints(20);
  hold(constraints, curve.positions(), 5);
  ASSERT_EQ(check_constraints(curve, constraints).size(), 1U);
  EXPECT_TRUE(says(check_constraints(curve, constraints)[0].text, "node 0 leaves a family of shapes"));
  EXPECT_EQ(fair(curve, constraints).report.warnings, check_constraints(curve, constraints));
  hold(constraints, curve.positions(), 9);
  EXPECT_EQ(check_constraints(curve, constraints).size(), 1U);
  Constraints with_tangent = constraints;
  with_tangent.fix_tangent(5, {0, 1, 0});
  EXPECT_TRUE(check_constraints(curve, with_tangent).empty());
  hold(constraints, curve.positions(), 15);
  EXPECT_TRUE(check_constraints(curve, constraints).empty());
}

TEST(CurveConstraints, ConstraintsOfAnotherNodeCountAreRefused) {
  refusal(PolygonCurve(line(10)), Constraints(3), ErrorCode::invalid_argument);
}

TEST(CurveConstraints, TangentsAreMadeUnitLengthAndKeepTheirSense) {
  Constraints constraints(3);
  for (const double size : {1.0, 1e-300, 1e300, -1.0}) {
    constraints.fix_tangent(1, size * Vector3(3, 0, 4));
    EXPECT_LT((constraints.tangent(1) - (size < 0 ? -1 : 1) * Vector3(0.6, 0, 0.8)).norm(), 1e-15);
  }
  for (const Vector3& bad : {Vector3(0, 0, 0), Vector3(NAN, 0, 1), Vector3(INFINITY, 0, 0)})
    EXPECT_TRUE(says(refusal([&] { constraints.fix_tangent(2, bad); }, ErrorCode::unusable_constraint), "node 2"));
  EXPECT_FALSE(constraints.tangent_fixed(2));
  refusal([&] { constraints.fix_tangent(3, {1, 0, 0}); }, ErrorCode::unusable_constraint);
  constraints.free_tangent(1);
  EXPECT_FALSE(constraints.tangent_fixed(1));
}

TEST(CurveRules, TangentsWithTwoOrThreeNumbersOneForAllOrNodeByNode) {
  const PolygonCurve curve(line(4));
  Constraints constraints(5);
  apply_rules(constraints, curve, R"({"rules": [
      {"nodes": "boundary", "position": "fixed", "tangent": [0, 2]},
      {"nodes": [3, 1], "tangent": [[1, 1], [0, 0, -5]]},
      {"nodes": [2], "position": [0.5, 0.25], "normal": [0, 1]}]})");
  EXPECT_EQ(constraints.tangent(0), Vector3(0, 1, 0));
  EXPECT_EQ(constraints.tangent(4), Vector3(0, 1, 0));
  EXPECT_LT((constraints.tangent(3) - Vector3(1, 1, 0).normalized()).norm(), 1e-15);
  EXPECT_EQ(constraints.tangent(1), Vector3(0, 0, -1));
  EXPECT_EQ(constraints.position(2), Vector3(0.5, 0.25, 0));
  EXPECT_EQ(constraints.normal(2), Vector3(0, 1, 0));
  EXPECT_FALSE(constraints.tangent_fixed(2));
  apply_rules(constraints, curve, R"({"rules": [{"nodes": "all", "tangent": "free"}]})");
  for (Index i = 0; i < 5; ++i) EXPECT_FALSE(constraints.tangent_fixed(i));
  EXPECT_TRUE(constraints.position_fixed(4));
}

TEST(CurveRules, FixedTangentsAreThoseOfTheInput) {
  std::vector<Vector3> arc;
  for (const double at : places(Spacing::random, 12)) arc.push_back(heading(2 * at));
  const PolygonCurve curve(arc);
  Constraints constraints(13);
  apply_rules(constraints, curve, R"({"rules": [{"nodes": "all", "tangent": "fixed"}]})");
  for (Index i = 0; i < 13; ++i) {
    const Vector3& p = curve.position(i);
    EXPECT_LT((constraints.tangent(i) - Vector3(-p.y(), p.x(), 0)).norm(), 1e-13) << i;
  }
  Constraints boundary(13);
  fix_boundary_positions(boundary, curve);
  fix_boundary_tangents(boundary, curve);
  for (const Index end : {0, 12}) {
    EXPECT_EQ(boundary.position(end), curve.position(end));
    EXPECT_EQ(boundary.tangent(end), constraints.tangent(end));
  }
  EXPECT_FALSE(boundary.tangent_fixed(6));
}

TEST(CurveRules, WrongOnesAreRefusedByNumberAndChangeNothing) {
  const PolygonCurve curve(line(4));
  const PolygonCurve knot(std::vector<Vector3>(3, Vector3(1, 1, 1)));
  struct Wrong {
    const char* rule;
    const char* reason;
  };
  for (const Wrong& wrong : {
           Wrong{R"({"nodes": [1], "tangent": "file"})", "is no tangent"},
           {R"({"nodes": [1]})", "none of \"position\", \"normal\" and \"tangent\""},
           {R"({"nodes": [1], "position": "here"})", "write \"fixed\", \"free\" or two or three numbers"},
           {R"({"nodes": [1], "normal": "up"})", "write \"fixed\", \"file\", \"free\" or two or three numbers"},
           {R"({"nodes": [1], "tangent": 3})", "is no tangent"},
           {R"({"nodes": [1], "tangent": [1]})", "is no tangent"},
           {R"({"nodes": [1], "tangent": [1, 2, 3, 4]})", "is no tangent"},
           {R"({"nodes": [1], "tangent": ["x", 0]})", "is no tangent"},
           {R"({"nodes": [1], "tangent": [0, 0]})", "node 1: a tangent of zero"},
           {R"({"nodes": [1, 2], "tangent": [[1, 0]]})", "1 tangents are given for 2 nodes"},
           {R"({"nodes": [5], "tangent": [1, 0]})", "5 is not a node"},
           {R"({"nodes": [1], "tangents": [1, 0]})", "known: nodes, position, normal, tangent"},
           {R"({"nodes": [1], "normal": "fixed"})", "straight run has no normal"},
       }) {
    Constraints constraints(5);
    constraints.fix_tangent(2, {0, 0, 1});
    const std::string rules = std::string(R"({"rules": [{"nodes": "all", "tangent": [1, 0]}, )") + wrong.rule + "]}";
    const std::string message =
        refusal([&] { apply_rules(constraints, curve, rules); }, ErrorCode::unusable_constraint);
    EXPECT_TRUE(says(message, "rule 2")) << message;
    EXPECT_TRUE(says(message, wrong.reason)) << message;
    EXPECT_FALSE(constraints.tangent_fixed(0));
    EXPECT_EQ(constraints.tangent(2), Vector3(0, 0, 1));
  }
  Constraints constraints(3);
  const std::string message =
      refusal([&] { apply_rules(constraints, knot, R"({"rules": [{"nodes": [1], "tangent": "fixed"}]})"); },
              ErrorCode::unusable_constraint);
  EXPECT_TRUE(says(message, "rule 1")) << message;
  EXPECT_TRUE(says(message, "node 1: no edge gives it a tangent")) << message;
}

}  // namespace
}  // namespace vspring::curve_constraints_test
