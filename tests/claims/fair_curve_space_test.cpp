// Space curves: both components of the curvature vector in a frame without spin are linear in arc length, and the ends'
// positions and tangents determine the curve. The paper's own variant, along principal normals only, does not.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_curve_space_test {
namespace {

using namespace support;

struct EndData {
  Vector3 from;
  Vector3 leaving;
  Vector3 to;
  Vector3 arriving;
};

const EndData data[] = {
    {{0, 0, 0}, {1, 0, 0.3}, {1, 0.5, 0.4}, {0.2, 1, 0.5}},
    {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {1, 0, 1}},
    {{0, 0, 0}, {0, 1, 0}, {1, 0, 0.2}, {0, -1, 0.8}},
};

Constraints held(const std::vector<Vector3>& nodes, const EndData& ends) {
  return held_ends(nodes, ends.leaving, ends.arriving);
}

struct Node {
  double s;
  Vector3 tangent;
  Vector3 curvature;
};

/// Tangents and curvature vectors of the inner nodes, of the circles through three nodes.
std::vector<Node> measured(const std::vector<Vector3>& nodes) {
  std::vector<Node> all;
  double s = 0;
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
    const Vector3 a = nodes[i] - nodes[i - 1];
    const Vector3 b = nodes[i + 1] - nodes[i];
    s += a.norm();
    const Vector3 tangent = (a / a.squaredNorm() + b / b.squaredNorm()).normalized();
    const Vector3 across = 2 * a.cross(b) / (a.norm() * b.norm() * (a + b).norm());
    all.push_back({s, tangent, across.cross(tangent)});
  }
  return all;
}

Vector3 mirrored(const Vector3& v, const Vector3& mirror) {
  return v - 2 * mirror.dot(v) / mirror.squaredNorm() * mirror;
}

/// How far the components of the curvature vector in a frame without spin (double reflection) are from the lines that
/// fit them best, relative to the largest curvature.
double deviation_from_linear(const std::vector<Vector3>& nodes) {
  const auto inner = measured(nodes);
  const auto count = static_cast<Eigen::Index>(inner.size());
  Eigen::MatrixXd components(count, 2);
  Eigen::MatrixXd lines(count, 2);
  Vector3 axis = inner[0].tangent.unitOrthogonal();
  for (Eigen::Index k = 0; k < count; ++k) {
    const Node& node = inner[static_cast<std::size_t>(k)];
    if (k > 0) {
      const Node& before = inner[static_cast<std::size_t>(k) - 1];
      const Vector3 edge = nodes[static_cast<std::size_t>(k) + 1] - nodes[static_cast<std::size_t>(k)];
      const Vector3 mirror = node.tangent - mirrored(before.tangent, edge);
      axis = mirror.norm() < 1e-14 ? mirrored(axis, edge) : mirrored(mirrored(axis, edge), mirror);
    }
    components.row(k) << node.curvature.dot(axis), node.curvature.dot(node.tangent.cross(axis));
    lines.row(k) << 1, node.s;
  }
  const Eigen::MatrixXd fit = lines.colPivHouseholderQr().solve(components);
  return (components - lines * fit).rowwise().norm().maxCoeff() / components.rowwise().norm().maxCoeff();
}

TEST(FairCurveSpace, BothComponentsOfTheCurvatureAreLinearInArcLength) {
  for (std::size_t which = 0; which < std::size(data); ++which) {
    const EndData& ends = data[which];
    for (const Spacing spacing : {Spacing::even, Spacing::alternating}) {
      std::vector<double> deviation;
      for (const int edges : {64, 128, 256, 512}) {
        const auto start = straight(ends.from, ends.to, places(spacing, edges, 2));
        const auto distribution = spacing == Spacing::even ? Distribution::even : Distribution::keep;
        deviation.push_back(deviation_from_linear(faired(start, held(start, ends), to_the_end(distribution))));
      }
      SCOPED_TRACE(fmt::format("data {}, spacing {}: {:.2e} {:.2e} {:.2e} {:.2e}", which, static_cast<int>(spacing),
                               deviation[0], deviation[1], deviation[2], deviation[3]));
      EXPECT_LT(deviation[3], 1e-5);
      EXPECT_GT(order(deviation[1], deviation[2]), 1.9);
      EXPECT_GT(order(deviation[2], deviation[3]), 1.9);
    }
  }
}

TEST(FairCurveSpace, EndsWithTangentsDetermineTheCurve) {
  for (const EndData& ends : data) {
    const auto start = straight(ends.from, ends.to, places(Spacing::even, 60));
    const Constraints constraints = held(start, ends);
    const auto expected = faired(start, constraints);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const auto result = faired(noisy(start, constraints, 0.05, seed, false), constraints);
      EXPECT_LT(greatest_distance(result, expected), 1e-11);
    }
    EXPECT_GT(greatest_distance(start, expected), 0.1);
  }
}

TEST(FairCurveSpace, ThroughFixedNodesToo) {
  std::vector<Vector3> nodes = straight({0, 0, 0}, {1, 0.2, 0}, places(Spacing::even, 40));
  const auto second = straight({1, 0.2, 0}, {1.5, 1, 0.8}, places(Spacing::even, 40));
  nodes.insert(nodes.end(), second.begin() + 1, second.end());
  Constraints constraints = held_ends(nodes, {1, 0, 0.5}, {-0.3, 0.2, 1});
  hold(constraints, nodes, 40);
  const auto expected = faired(nodes, constraints);
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_LT(greatest_distance(faired(noisy(nodes, constraints, 0.03, seed, false), constraints), expected), 1e-11);
  // The curvature vector does not jump at the fixed node: no more than between its neighbours.
  const auto inner = measured(expected);
  EXPECT_LT((inner[39].curvature - inner[38].curvature).norm(), 0.1 * inner[39].curvature.norm());
  EXPECT_LT((inner[40].curvature - inner[39].curvature).norm(), 0.1 * inner[39].curvature.norm());
}

constexpr double radius = 1;
constexpr double rise = 0.4;  // per radian

Vector3 on_helix(double angle) { return {radius * std::cos(angle), radius * std::sin(angle), rise * angle}; }
Vector3 helix_tangent(double angle) { return {-radius * std::sin(angle), radius * std::cos(angle), rise}; }
constexpr double helix_end = 4;

std::vector<Vector3> helix(int edges) {
  std::vector<Vector3> nodes;
  for (const double at : places(Spacing::even, edges)) nodes.push_back(on_helix(at * helix_end));
  return nodes;
}

/// Ends held, with tangents and principal normals.
Constraints held_helix(const std::vector<Vector3>& nodes) {
  Constraints constraints = held_ends(nodes, helix_tangent(0), helix_tangent(helix_end));
  constraints.fix_normal(0, heading(0));
  constraints.fix_normal(constraints.node_count() - 1, heading(helix_end));
  return constraints;
}

FairOptions along_principal_normals() {
  FairOptions options = to_the_end();
  options.curve.normal_plane = NormalPlane::principal;
  return options;
}

TEST(FairCurveSpace, AHelixIsAnEquilibriumAlongPrincipalNormals) {
  const auto nodes = helix(60);
  const Constraints constraints = held_helix(nodes);
  for (const CurveRules& rules : {CurveRules{.normal_plane = NormalPlane::principal}, CurveRules::paper()}) {
    FairOptions options = to_the_end();
    options.curve = rules;
    const FairResult result = fair(PolygonCurve(nodes), constraints, options);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LT(greatest_distance(result.positions, nodes), 1e-12);
  }
}

TEST(FairCurveSpace, ButNotTheOnlyOne) {
  // Nothing asks for a torsion: other curves with the same ends are left alone as well.
  const auto nodes = helix(60);
  const Constraints constraints = held_helix(nodes);
  std::vector<std::vector<Vector3>> results;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    std::vector<Vector3> start = nodes;
    for (std::size_t i = 1; i + 1 < start.size(); ++i)
      start[i].z() += 0.05 * static_cast<double>(seed) * std::sin(std::numbers::pi * static_cast<double>(i) / 60);
    const FairResult result = fair(PolygonCurve(start), constraints, along_principal_normals());
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    for (const auto& other : results) EXPECT_GT(greatest_distance(other, result.positions), 1e-2);
    results.push_back(result.positions);
    const auto again = faired(result.positions, constraints, along_principal_normals());
    EXPECT_LT(greatest_distance(again, result.positions), 1e-11);
    // In the whole normal plane all come to one curve.
    EXPECT_LT(greatest_distance(faired(start, constraints), faired(nodes, constraints)), 1e-11);
  }
}

TEST(FairCurveSpace, InTheWholeNormalPlaneAHelixMovesByItsTorsion) {
  // One step is about ℓ⁴κτ²/8; the sweep, whose nodes see the last one's step already, makes up to twice that.
  const double curvature = radius / (radius * radius + rise * rise);
  const double torsion = rise / (radius * radius + rise * rise);
  for (const int edges : {30, 60, 120}) {
    const auto nodes = helix(edges);
    const FairOptions once = {.method = SweepMethod{.max_iterations = 1}};
    const double edge = (nodes[1] - nodes[0]).norm();
    const double step = std::pow(edge, 4) * curvature * torsion * torsion / 8;
    Constraints constraints = held_helix(nodes);
    // Away from the ends, whose tangents are not those of circles.
    for (Index i = 1; i < 5; ++i) hold(constraints, nodes, i);
    for (Index i = edges - 4; i < edges; ++i) hold(constraints, nodes, i);
    const double moved = fair(PolygonCurve(nodes), constraints, once).report.greatest_move;
    EXPECT_GT(moved, 0.95 * step);
    EXPECT_LT(moved, 2.1 * step);
  }
  const auto nodes = helix(60);
  EXPECT_GT(greatest_distance(faired(nodes, held_helix(nodes)), nodes), 1e-2);
}

}  // namespace
}  // namespace vspring::fair_curve_space_test
