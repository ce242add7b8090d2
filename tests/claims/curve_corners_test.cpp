// Corners that constraints name: the curve arrives in one direction and leaves in another, and each side is fair by
// itself.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "support/curves.hpp"
#include "support/refusal.hpp"
#include "vspring/vspring.hpp"

namespace vspring::curve_corners_test {
namespace {

using namespace support;
using reference::Clothoid;

/// From one place to the next, so many edges each.
std::vector<Vector3> polyline(const std::vector<Vector3>& through, int edges, bool closed = false) {
  std::vector<Vector3> nodes;
  const std::size_t sides = through.size() - (closed ? 0 : 1);
  for (std::size_t side = 0; side < sides; ++side) {
    const Vector3& from = through[side];
    const Vector3& to = through[(side + 1) % through.size()];
    for (int k = 0; k < edges; ++k) nodes.emplace_back(from + (to - from) * k / edges);
  }
  if (!closed) nodes.push_back(through.back());
  return nodes;
}

/// What a corner is told.
struct Told {
  std::optional<Vector3> in = std::nullopt;
  std::optional<Vector3> out = std::nullopt;
};

void tell(Constraints& constraints, Index corner, const Told& told) {
  constraints.make_corner(corner);
  if (told.in) constraints.fix_tangent(corner, *told.in, NodeSide::before);
  if (told.out) constraints.fix_tangent(corner, *told.out, NodeSide::after);
}

/// By how many degrees nodes beside a corner leave out of a direction.
double miss(const PolygonCurve& curve, Index corner, NodeSide side, const Vector3& told) {
  const Vector3 tangent = estimate_tangents(curve, std::vector<Index>{corner}, side)[0];
  return std::atan2(tangent.cross(told).norm(), tangent.dot(told)) / degree;
}

std::vector<Vector3> part(const std::vector<Vector3>& nodes, std::size_t begin, std::size_t end) {
  return {nodes.begin() + static_cast<std::ptrdiff_t>(begin), nodes.begin() + static_cast<std::ptrdiff_t>(end)};
}

double greatest_distance(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double greatest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) greatest = std::max(greatest, (a[k] - b[k]).norm());
  return greatest;
}

TEST(CurveCorners, BothSidesAreTheEulerSpiralsOfTheirDirections) {
  const Vector3 in = heading(-40 * degree);
  const Vector3 out = heading(100 * degree);
  const Clothoid first = reference::hermite_clothoid({0, 0}, 60 * degree, {1, 0}, -40 * degree);
  const Clothoid second = reference::hermite_clothoid({1, 0}, 100 * degree, {1.5, 0.8}, 20 * degree);
  std::vector<double> errors;
  for (const int edges : {32, 64, 128}) {
    const std::vector<Vector3> nodes = polyline({{0, 0, 0}, {1, 0, 0}, {1.5, 0.8, 0}}, edges);
    Constraints constraints = held_ends(nodes, heading(60 * degree), heading(20 * degree));
    tell(constraints, edges, {in, out});
    const FairResult result = fair(PolygonCurve(nodes), constraints, to_the_end());
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_EQ(result.report.corners, 1);
    EXPECT_EQ(result.report.fixed_tangents, 4);
    const auto corner = static_cast<std::size_t>(edges);
    EXPECT_EQ(result.positions[corner], nodes[corner]);
    errors.push_back(std::max(distance_from(first, part(result.positions, 0, corner + 1)),
                              distance_from(second, part(result.positions, corner, result.positions.size()))));
    const CurveFigures figures = measure_curve(PolygonCurve(result.positions), &constraints);
    ASSERT_TRUE(figures.normal_error.has_value());
    EXPECT_LT(*figures.normal_error, 0.5);
  }
  SCOPED_TRACE(fmt::format("{:.2e} {:.2e} {:.2e}", errors[0], errors[1], errors[2]));
  EXPECT_LT(errors[2], 1e-4);
  EXPECT_GT(order(errors[0], errors[1]), 1.9);
  EXPECT_GT(order(errors[1], errors[2]), 1.9);
}

TEST(CurveCorners, OfArcsAreExact) {
  // Half a circle about the origin, then a quarter about (1, 1).
  std::vector<Vector3> nodes;
  nodes.reserve(61);
  for (int k = 0; k < 40; ++k) nodes.push_back(heading(std::numbers::pi * (1 - k / 40.0)));
  for (int k = 0; k <= 20; ++k) nodes.emplace_back(Vector3(1, 1, 0) + heading(std::numbers::pi * (-0.5 + k / 40.0)));
  Constraints constraints = held_ends(nodes, heading(std::numbers::pi / 2), heading(std::numbers::pi / 2));
  tell(constraints, 40, {heading(-std::numbers::pi / 2), heading(0)});
  hold(constraints, nodes, 40);
  const std::vector<Vector3> found = faired(noisy(nodes, constraints, 0.01, 5, true), constraints);
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_NEAR(k <= 40 ? found[k].norm() : (found[k] - Vector3(1, 1, 0)).norm(), 1, 1e-9) << k;
}

TEST(CurveCorners, SidesAreWhatTheyAreAlone) {
  const std::vector<Vector3> through = {{0, 0, 0}, {10, 1, 2}, {8, 9, -1}};
  const Vector3 in = Vector3(1, 1, 0.5).normalized();
  const Vector3 out = Vector3(1, 2, -1).normalized();
  for (const bool planar : {true, false}) {
    std::vector<Vector3> nodes = polyline(through, 30);
    if (planar) {
      for (Vector3& node : nodes) node.z() = 0;
    }
    const auto in_plane = [&](Vector3 v) {
      if (planar) v.z() = 0;
      return v;
    };
    for (const Told& told :
         {Told{in_plane(in), in_plane(out)}, Told{in_plane(in), {}}, Told{{}, in_plane(out)}, Told{}}) {
      SCOPED_TRACE(fmt::format("planar {}, in {}, out {}", planar, told.in.has_value(), told.out.has_value()));
      Constraints constraints = held_ends(nodes, in_plane({1, -1, 1}), in_plane({-1, 1, 1}));
      tell(constraints, 30, told);
      const std::vector<Vector3> found = faired(nodes, constraints);
      const std::vector<Vector3> first = part(nodes, 0, 31);
      const std::vector<Vector3> second = part(nodes, 30, 61);
      Constraints of_first = held_ends(first);
      of_first.fix_tangent(0, in_plane({1, -1, 1}));
      if (told.in) of_first.fix_tangent(30, *told.in);
      Constraints of_second = held_ends(second);
      of_second.fix_tangent(30, in_plane({-1, 1, 1}));
      if (told.out) of_second.fix_tangent(0, *told.out);
      EXPECT_LT(greatest_distance(part(found, 0, 31), faired(first, of_first)), 1e-8);
      EXPECT_LT(greatest_distance(part(found, 30, 61), faired(second, of_second)), 1e-8);
      if (told.in || told.out) continue;
      FairOptions options = to_the_end();
      options.corners = {30};
      Constraints unsaid = constraints;
      unsaid.free_corner(30);
      EXPECT_EQ(found, faired(nodes, unsaid, options)) << "as one that is found";
    }
  }
}

TEST(CurveCorners, HoldAClosedCurveByEveryMethod) {
  // An oval becomes a drop, which leaves its tip one way and comes back another.
  std::vector<Vector3> nodes;
  for (int k = 0; k < 60; ++k) {
    const double angle = 2 * std::numbers::pi * k / 60;
    nodes.emplace_back(10 * (1 - std::cos(angle)), 6 * std::sin(angle), 0);
  }
  const Vector3 in = heading(140 * degree);
  const Vector3 out = heading(40 * degree);
  for (const bool from_the_tip : {true, false}) {
    if (!from_the_tip) std::rotate(nodes.begin(), nodes.begin() + 45, nodes.end());
    const Index tip = from_the_tip ? 0 : 15;
    for (const FairingMethod& method :
         {FairingMethod(EquilibriumMethod{.tolerance = 1e-12}), FairingMethod(SweepMethod{.max_iterations = 20000})}) {
      SCOPED_TRACE(fmt::format("tip {}, method {}", tip, method.index()));
      Constraints constraints(60);
      hold(constraints, nodes, tip + 30);
      tell(constraints, tip, {in, out});
      EXPECT_TRUE(check_constraints(PolygonCurve(nodes, true), constraints).empty());
      FairOptions options;
      options.method = method;
      const FairResult result = fair(PolygonCurve(nodes, true), constraints, options);
      EXPECT_EQ(result.report.outcome, Outcome::converged);
      EXPECT_EQ(result.positions[static_cast<std::size_t>(tip)], nodes[static_cast<std::size_t>(tip)]);
      const PolygonCurve found(result.positions, true);
      EXPECT_LT(miss(found, tip, NodeSide::before, in), 3);
      EXPECT_LT(miss(found, tip, NodeSide::after, out), 3);
    }
  }
}

TEST(CurveCorners, ResultsHaveTheSameBitsOnAnyNumberOfThreads) {
  const std::vector<Vector3> nodes = polyline({{0, 0, 0}, {10, 1, 2}, {8, 9, -1}}, 300);
  Constraints constraints = held_ends(nodes);
  tell(constraints, 300, {Vector3(1, 1, 0), Vector3(0, 1, -1)});
  std::vector<std::vector<Vector3>> found;
  for (const int threads : {1, 3}) {
    Context context;
    context.threads = threads;
    found.push_back(fair(PolygonCurve(nodes), constraints, {}, context).positions);
  }
  EXPECT_EQ(found[0], found[1]);
}

/// Rows of a box, from its lower left corner around, with noise in the plane.
std::vector<Vector3> noisy_box(bool in_space = false) {
  std::vector<Vector3> rows = polyline({{0, 0, 0}, {40, 0, 0}, {40, 40, 0}, {0, 40, 0}}, 40, true);
  if (in_space) {
    for (Vector3& row : rows) row.z() = 10 * std::sin(0.05 * row.x()) + 0.2 * row.y();
  }
  const Constraints none(static_cast<Index>(rows.size()));
  return noisy(std::move(rows), none, 0.4, 11, !in_space);
}

FitOptions drawn(const FitCriterion& criterion) {
  FitOptions options{.criterion = criterion};
  options.fair.distribution = Distribution::keep;
  return options;
}

TEST(CurveCorners, OfANoisyBoxMeetTheirDirectionsAndMoveWithTheirPoints) {
  const std::vector<Vector3> rows = noisy_box();
  const PolygonCurve curve(rows, true);
  // The sides of the second corner bow outwards.
  const Vector3 in = heading(-8 * degree);
  const Vector3 out = heading(82 * degree);
  for (const FitCriterion& criterion : {FitCriterion(Within{1}), FitCriterion(RootMeanSquare{0.4}),
                                        FitCriterion(Weight{0.001}), FitCriterion(SmoothingLength{4})}) {
    SCOPED_TRACE(criterion.index());
    Constraints constraints(160);
    for (const Index corner : {0, 80, 120}) constraints.make_corner(corner);
    tell(constraints, 40, {in, out});
    const FitResult result = fit(curve, constraints, {.positions = rows}, drawn(criterion));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_EQ(result.report.fair.corners, 4);
    EXPECT_EQ(result.report.fair.fixed_tangents, 2);
    const PolygonCurve found(result.positions, true);
    EXPECT_EQ(find_corners(found, 60), (std::vector<Index>{0, 40, 80, 120}));
    EXPECT_EQ(find_corners(found, 10), (std::vector<Index>{0, 40, 80, 120}));
    EXPECT_LT(miss(found, 40, NodeSide::before, in), 1.5);
    EXPECT_LT(miss(found, 40, NodeSide::after, out), 1.5);
    if (std::holds_alternative<Within>(criterion)) {
      EXPECT_EQ(result.report.outside_points, 0);
    }
    EXPECT_NE(result.positions[40], rows[40]);
    EXPECT_LT((result.positions[40] - Vector3(40, 0, 0)).norm(), 2);
    // Nor does it move where it is held.
    constraints.fix_position(40, Vector3(40, 0, 0));
    const FitResult held = fit(curve, constraints, {.positions = rows}, drawn(criterion));
    EXPECT_EQ(held.report.fair.outcome, Outcome::converged);
    EXPECT_EQ(held.positions[40], Vector3(40, 0, 0));
    EXPECT_LT(miss(PolygonCurve(held.positions, true), 40, NodeSide::before, in), 1.5);
    EXPECT_LT(miss(PolygonCurve(held.positions, true), 40, NodeSide::after, out), 1.5);
  }
}

TEST(CurveCorners, OfANoisyCurveInSpaceMeetTheirDirections) {
  const std::vector<Vector3> rows = noisy_box(true);
  const Vector3 in = Vector3(1, 0, 0.1).normalized();
  const Vector3 out = Vector3(-0.1, 1, 0.2).normalized();
  Constraints constraints(160);
  for (const Index corner : {0, 80, 120}) constraints.make_corner(corner);
  for (const bool both : {true, false}) {
    SCOPED_TRACE(both);
    constraints.free_corner(40);
    tell(constraints, 40, {both ? std::optional(in) : std::nullopt, out});
    const FitResult result = fit(PolygonCurve(rows, true), constraints, {.positions = rows}, drawn(Within{1}));
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_EQ(result.report.fair.corners, 4);
    EXPECT_EQ(result.report.outside_points, 0);
    const PolygonCurve found(result.positions, true);
    EXPECT_EQ(find_corners(found, 30), (std::vector<Index>{0, 40, 80, 120}));
    if (both) {
      EXPECT_LT(miss(found, 40, NodeSide::before, in), 1.5);
    }
    EXPECT_LT(miss(found, 40, NodeSide::after, out), 1.5);
  }
}

TEST(CurveCorners, AreKeptByNewNodesWithTheirDirections) {
  const Vector3 in = heading(-8 * degree);
  const Vector3 out = heading(82 * degree);
  const auto check = [&](const Resampled& made, const std::vector<Vector3>& positions) {
    const auto place = std::find(made.from.begin(), made.from.end(), 40);
    ASSERT_NE(place, made.from.end());
    const auto corner = static_cast<Index>(place - made.from.begin());
    EXPECT_TRUE(made.constraints.corner(corner));
    EXPECT_EQ(made.constraints.tangent(corner, NodeSide::before), in);
    EXPECT_EQ(made.constraints.tangent(corner, NodeSide::after), out);
    const PolygonCurve found(positions, true);
    EXPECT_LT(miss(found, corner, NodeSide::before, in), 1);
    EXPECT_LT(miss(found, corner, NodeSide::after, out), 1);
    EXPECT_EQ(find_corners(found, 30).size(), 4U);
  };
  const std::vector<Vector3> rows = noisy_box();
  const std::vector<Vector3> even = polyline({{0, 0, 0}, {40, 0, 0}, {40, 40, 0}, {0, 40, 0}}, 40, true);
  Constraints constraints(160);
  for (const Index corner : {0, 80, 120}) constraints.make_corner(corner);
  tell(constraints, 40, {in, out});
  for (const Resampling& how : {Resampling{.nodes = 90}, Resampling{.spacing = 0.4}}) {
    const ResampledFit made = fit_resampled(PolygonCurve(rows, true), constraints, how, drawn(Within{1}));
    EXPECT_EQ(made.fit.report.fair.corners, 4);
    EXPECT_EQ(made.fit.report.fair.outcome, Outcome::converged);
    check(made.resampled, made.fit.positions);
    const Resampled plain = resample(PolygonCurve(even, true), constraints, how);
    const FairResult result = fair(plain.curve, plain.constraints);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_EQ(result.report.corners, 4);
    check(plain, result.positions);
  }
  // They lie on curves that have these directions before anything is faired.
  const Resampled dense = resample(PolygonCurve(even, true), constraints, {.spacing = 0.05});
  check(dense, dense.curve.positions());
}

TEST(CurveCorners, ThatAreNamedAreNotFoundAgainBesideThem) {
  const std::vector<Vector3> rows = noisy_box();
  Constraints constraints(160);
  // As far off as noise puts the places where stretches meet.
  for (const Index corner : {0, 41, 79}) constraints.make_corner(corner);
  FitOptions options = drawn(Within{1});
  options.sharp = 40;
  const FitResult result = fit(PolygonCurve(rows, true), constraints, {.positions = rows}, options);
  EXPECT_EQ(result.report.fair.corners, 4);
  const std::vector<Index> corners = find_corners(PolygonCurve(result.positions, true), 45);
  for (const Index named : {0, 41, 79}) EXPECT_TRUE(std::ranges::find(corners, named) != corners.end()) << named;
}

TEST(CurveCorners, AreNoOutliers) {
  std::vector<Vector3> rows = polyline({{0, 0, 0}, {20, 0, 0}, {40, 0, 0}}, 20);
  rows[20].y() = 6;
  Constraints constraints = held_ends(rows);
  FitOptions options = drawn(Within{0.5});
  options.outliers = 0.05;
  EXPECT_EQ(fit(PolygonCurve(rows), constraints, {.positions = rows}, options).report.outliers, 1);
  constraints.make_corner(20);
  const FitResult kept = fit(PolygonCurve(rows), constraints, {.positions = rows}, options);
  EXPECT_EQ(kept.report.fair.corners, 1);
  EXPECT_LT((kept.positions[20] - rows[20]).norm(), 0.51);
}

TEST(CurveCorners, OfProfilesKeepTheirStations) {
  // Heights over a way that turns: the slope jumps where it is said.
  std::vector<Vector3> rows;
  for (int k = 0; k <= 80; ++k)
    rows.emplace_back(30 * std::sin(0.02 * k), 30 * (1 - std::cos(0.02 * k)),
                      k < 40 ? 0.06 * k : 2.4 - 0.03 * (k - 40));
  Draw draw(4);
  for (Vector3& row : rows) row.z() += draw.uniform(-0.1, 0.1);
  Constraints constraints = held_ends(rows);
  // By 0.1 of the way up, which is 0.6 a row.
  const Vector3 along(std::cos(0.8), std::sin(0.8), 0);
  tell(constraints, 40, {along + Vector3(0, 0, 0.1), along - Vector3(0, 0, 0.05)});
  FitOptions options = drawn(Within{0.2});
  options.moving_axes = {false, false, true};
  const FitResult result = fit(PolygonCurve(rows), constraints, {.positions = rows}, options);
  EXPECT_EQ(result.report.fair.corners, 1);
  EXPECT_EQ(result.report.outside_points, 0);
  const auto rise = [&](std::size_t k) { return (result.positions[k + 1].z() - result.positions[k].z()) / 0.6; };
  EXPECT_NEAR(rise(39), 0.1, 0.01);
  EXPECT_NEAR(rise(40), -0.05, 0.01);
}

TEST(CurveCorners, StayWhereOnlyARegionMoves) {
  std::vector<Vector3> nodes = polyline({{0, 0, 0}, {1, 0, 0}, {1.5, 0.8, 0}}, 20);
  nodes[30] += Vector3(0.1, 0, 0);
  Constraints constraints(41);
  tell(constraints, 20, {{}, heading(1.2)});
  std::vector<Index> region;
  for (Index i = 21; i < 35; ++i) region.push_back(i);
  restrict_to_region(constraints, PolygonCurve(nodes), region);
  EXPECT_TRUE(constraints.corner(20)) << "at its rim";
  EXPECT_TRUE(constraints.tangent_fixed(35));
  const std::vector<Vector3> found = faired(nodes, constraints);
  EXPECT_LT(miss(PolygonCurve(found), 20, NodeSide::after, heading(1.2)), 1);
  for (std::size_t k = 0; k <= 20; ++k) EXPECT_EQ(found[k], nodes[k]);
}

TEST(CurveCorners, HaveEitherOneTangentOrSides) {
  Constraints constraints(4);
  EXPECT_EQ(constraints.corner_count(), 0);
  constraints.fix_tangent(1, {3, 0, 0}, NodeSide::before);
  EXPECT_TRUE(constraints.corner(1));
  EXPECT_FALSE(constraints.tangent_fixed(1));
  EXPECT_TRUE(constraints.tangent_fixed(1, NodeSide::before));
  EXPECT_FALSE(constraints.tangent_fixed(1, NodeSide::after));
  EXPECT_EQ(constraints.tangent(1, NodeSide::before), Vector3(1, 0, 0));
  constraints.fix_tangent(1, {0, 2, 0}, NodeSide::after);
  EXPECT_EQ(constraints.tangent(1, NodeSide::before), Vector3(1, 0, 0));
  EXPECT_EQ(constraints.tangent(1, NodeSide::after), Vector3(0, 1, 0));
  Constraints other(2);
  other.hold_as(0, constraints, 1);
  EXPECT_EQ(other.tangent(0, NodeSide::after), Vector3(0, 1, 0));
  EXPECT_EQ(other.corner_count(), 1);
  other.hold_as(0, constraints, 2);
  EXPECT_EQ(other.corner_count(), 0);
  // The later one counts.
  constraints.fix_tangent(1, {0, 0, 1});
  EXPECT_FALSE(constraints.corner(1));
  EXPECT_EQ(constraints.corner_count(), 0);
  for (const NodeSide side : node_sides) EXPECT_EQ(constraints.tangent(1, side), Vector3(0, 0, 1));
  constraints.make_corner(1);
  EXPECT_FALSE(constraints.tangent_fixed(1));
  for (const NodeSide side : node_sides) EXPECT_FALSE(constraints.tangent_fixed(1, side));
  constraints.fix_tangent(1, {1, 0, 0}, NodeSide::after);
  constraints.free_tangent(1, NodeSide::after);
  EXPECT_TRUE(constraints.corner(1));
  constraints.fix_tangent(1, {1, 0, 0}, NodeSide::after);
  constraints.free_corner(1);
  EXPECT_FALSE(constraints.tangent_fixed(1, NodeSide::after));
  for (const Vector3& bad : {Vector3(0, 0, 0), Vector3(std::nan(""), 0, 0)}) {
    const auto told = [&] { constraints.fix_tangent(2, bad, NodeSide::after); };
    EXPECT_TRUE(says(refusal(told, ErrorCode::unusable_constraint), "node 2: the tangent out"));
  }
  EXPECT_FALSE(constraints.corner(2));
  EXPECT_THROW(constraints.make_corner(4), Error);
}

TEST(CurveCorners, WrongOnesAreRefusedByName) {
  const std::vector<Vector3> nodes = polyline({{0, 0, 0}, {1, 0, 0}, {1.5, 0.8, 0}}, 4);
  const PolygonCurve curve(nodes);
  const auto refused = [&](const PolygonCurve& of, const Constraints& constraints, const char* what) {
    const std::string message =
        refusal([&] { (void)check_constraints(of, constraints); }, ErrorCode::unusable_constraint);
    EXPECT_TRUE(says(message, what)) << message;
    EXPECT_EQ(message, refusal([&] { (void)fair(of, constraints); }, ErrorCode::unusable_constraint));
    EXPECT_EQ(message,
              refusal([&] { (void)resample(of, constraints, {.nodes = 30}); }, ErrorCode::unusable_constraint));
    const auto fitted = [&] { (void)fit(of, constraints, {.positions = of.positions()}, drawn(Within{1})); };
    EXPECT_EQ(message, refusal(fitted, ErrorCode::unusable_constraint));
  };
  for (const Index end : {0, 8}) {
    Constraints constraints = held_ends(nodes);
    constraints.make_corner(end);
    refused(curve, constraints, fmt::format("node {} cannot be a corner: a chain ends there", end).c_str());
  }
  Constraints with_normal = held_ends(nodes);
  with_normal.make_corner(4);
  with_normal.fix_normal(4, {0, 1, 0});
  refused(curve, with_normal, "node 4 cannot be a corner: its normal");
  Constraints meeting = held_ends(nodes);
  meeting.fix_position(4, nodes[4]);
  meeting.make_corner(4);
  refused(PolygonCurve(nodes, {{{0, 1, 2, 3, 4, 5, 6}, false}, {{7, 4, 8}, false}}), meeting, "chains meet there");
  Constraints outside = held_ends(nodes);
  outside.make_corner(4);
  refused(PolygonCurve(nodes, {{{0, 1, 2, 3, 8}, false}}), outside, "node 4 cannot be a corner: no chain");
  // By other methods points have no corners.
  Constraints constraints = held_ends(nodes);
  constraints.make_corner(4);
  FitOptions options = drawn(Weight{0.01});
  options.fair.method = SweepMethod{};
  EXPECT_TRUE(
      says(refusal([&] { (void)fit(curve, constraints, {.positions = nodes}, options); }, ErrorCode::invalid_argument),
           "corners can be kept by the method equilibrium only"));
  // Nor have surfaces.
  const PolygonMesh mesh = generate::plane({.columns = 4, .rows = 4});
  Constraints of_mesh(mesh.node_count());
  fix_boundary_positions(of_mesh, mesh);
  of_mesh.make_corner(6);
  for (const auto& call : {std::function<void()>([&] { (void)check_constraints(mesh, of_mesh); }),
                           std::function<void()>([&] { (void)fair(mesh, of_mesh); })})
    EXPECT_TRUE(says(refusal(call, ErrorCode::unusable_constraint), "node 6 cannot be a corner: it is of a surface"));
}

TEST(CurveCorners, AreRules) {
  const std::vector<Vector3> nodes = polyline({{0, 0, 0}, {1, 0, 0}, {1.5, 0.8, 0}}, 4);
  const PolygonCurve curve(nodes);
  const auto ruled = [&](const std::string& rules) {
    Constraints constraints(curve.node_count());
    apply_rules(constraints, curve, R"({"rules": [)" + rules + "]}");
    return constraints;
  };
  const Constraints told = ruled(R"({"nodes": [4], "tangent_in": [2, 0], "tangent_out": [0, 0, 3]},
                                    {"nodes": [2, 6], "tangent_out": [[0, 1], [1, 0]]},
                                    {"nodes": [3], "corner": true, "position": "fixed"})");
  EXPECT_EQ(told.tangent(4, NodeSide::before), Vector3(1, 0, 0));
  EXPECT_EQ(told.tangent(4, NodeSide::after), Vector3(0, 0, 1));
  EXPECT_EQ(told.tangent(6, NodeSide::after), Vector3(1, 0, 0));
  EXPECT_FALSE(told.tangent_fixed(6, NodeSide::before));
  EXPECT_TRUE(told.corner(3));
  EXPECT_TRUE(told.position_fixed(3));
  EXPECT_EQ(told.corner_count(), 4);
  const Constraints fixed = ruled(R"({"nodes": [4], "tangent_in": "fixed", "tangent_out": "fixed"})");
  EXPECT_LT((fixed.tangent(4, NodeSide::before) - Vector3(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((fixed.tangent(4, NodeSide::after) - Vector3(0.5, 0.8, 0).normalized()).norm(), 1e-15);
  // The later rule counts.
  const Constraints later = ruled(R"({"nodes": "all", "tangent": "fixed"},
                                     {"nodes": [3, 4, 5], "tangent_in": "fixed"}, {"nodes": [3], "corner": false},
                                     {"nodes": [4], "tangent_in": "free"}, {"nodes": [5], "tangent": "fixed"})");
  EXPECT_EQ(later.corner_count(), 1);
  EXPECT_TRUE(later.corner(4));
  EXPECT_FALSE(later.tangent_fixed(3) || later.tangent_fixed(4, NodeSide::before));
  EXPECT_TRUE(later.tangent_fixed(5));
  const auto refused = [&](const std::string& rules, const char* what) {
    const std::string message = refusal([&] { (void)ruled(rules); }, ErrorCode::unusable_constraint);
    EXPECT_TRUE(says(message, "rule 1: ") && says(message, what)) << message;
  };
  refused(R"({"nodes": [4], "tangent": [1, 0], "tangent_in": [1, 0]})", "node 4: it either goes on in one");
  refused(R"({"nodes": [4], "tangent": [1, 0], "corner": true})", "node 4");
  refused(R"({"nodes": [4], "tangent_out": [1, 0], "corner": false})", "node 4: without a corner");
  refused(R"({"nodes": [4], "tangent_out": [0, 0]})", "node 4: a tangent of zero");
  refused(R"({"nodes": [0], "tangent_in": "fixed"})", "node 0: no edge");
  refused(R"({"nodes": [4], "tangent_out": "file"})", "is no tangent");
  refused(R"({"nodes": [4], "corner": "fixed"})", "is no corner; write true or false");
  const PolygonMesh mesh = generate::plane({.columns = 4, .rows = 4});
  Constraints of_mesh(mesh.node_count());
  for (const char* key : {"tangent_in", "tangent_out", "corner"}) {
    const auto call = [&] {
      apply_rules(of_mesh, mesh, fmt::format(R"({{"rules": [{{"nodes": [4], "{}": true}}]}})", key));
    };
    EXPECT_TRUE(says(refusal(call, ErrorCode::unusable_constraint), "is for curves")) << key;
  }
}

}  // namespace
}  // namespace vspring::curve_corners_test
