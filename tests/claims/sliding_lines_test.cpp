// Lines of a surface that are faired before it, its boundary and sharp edges, slide on supports meanwhile, also where
// points pull.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "support/positions.hpp"
#include "support/refusal.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::sliding_lines_test {
namespace {

using namespace support;

constexpr double half_angle = 60;

Constraints sliding(const PolygonMesh& mesh, const std::vector<Index>& nodes, const Support& support) {
  Constraints constraints(mesh.node_count());
  constraints.slide_on(nodes, support);
  return constraints;
}

double distance_from(const Support& support, const std::vector<Vector3>& positions, const std::vector<Index>& nodes) {
  double greatest = 0;
  for (const Index i : nodes) {
    const Vector3& place = positions[static_cast<std::size_t>(i)];
    greatest = std::max(greatest, (*support.nearest(place) - place).norm());
  }
  return greatest;
}

double rms(const std::vector<Vector3>& positions, const std::function<double(const Vector3&)>& distance) {
  double squares = 0;
  for (const Vector3& place : positions) squares += std::pow(distance(place), 2);
  return std::sqrt(squares / static_cast<double>(positions.size()));
}

double off_unit_sphere(const Vector3& place) { return place.norm() - 1; }

PolygonMesh cap() { return generate::cap({.nodes = 400, .radius = 1, .half_angle = half_angle}); }

/// Of a fit to the nodes' own places.
FitOptions at_home(const FitCriterion& criterion) {
  FitOptions options{.criterion = criterion};
  options.fair.distribution = Distribution::keep;
  return options;
}

struct NamedSupport {
  const char* name;
  Support support;
};

/// Both hold the rim of the cap.
std::vector<NamedSupport> supports_of_rim() {
  return {{"plane", Support::plane({1, 2, std::cos(half_angle * degree)}, {0, 0, 1})},
          {"cylinder", Support::cylinder({0, 0, 5}, {0, 0, -2}, std::sin(half_angle * degree))}};
}

TEST(SlidingLines, ARimStaysOnItsSupportWhileNoiseGoes) {
  const PolygonMesh truth = cap();
  const std::vector<Index> rim = boundary_of(truth);
  constexpr double noise = 0.005;
  const PolygonMesh mesh = generate::add_noise(truth, std::sqrt(5) * noise, 3, true);
  ASSERT_GT(rms(mesh.positions(), off_unit_sphere), 0.9 * noise);
  for (const auto& [name, support] : supports_of_rim()) {
    const Constraints constraints = sliding(mesh, rim, support);
    ASSERT_GT(distance_from(support, mesh.positions(), rim), noise);
    for (const FitCriterion& criterion : std::vector<FitCriterion>{Noise{noise}, SmoothingLength{0.1}}) {
      const FitResult result = fit(mesh, constraints, {.positions = mesh.positions()}, at_home(criterion));
      EXPECT_EQ(result.report.fair.outcome, Outcome::converged) << name << ' ' << criterion.index();
      EXPECT_EQ(result.report.fair.sliding_nodes, std::ssize(rim)) << name;
      EXPECT_EQ(result.report.fair.moving_nodes, mesh.node_count()) << name;
      EXPECT_LT(distance_from(support, result.positions, rim), 1e-15) << name;
      EXPECT_LT(rms(result.positions, off_unit_sphere), 0.6 * noise) << name << ' ' << criterion.index();
    }
  }
}

TEST(SlidingLines, ARimGoesAlongItsSupportToWhereThePointsEnd) {
  const PolygonMesh fine = generate::cap({.nodes = 6000, .radius = 1, .half_angle = half_angle});
  const PolygonMesh truth = cap();
  const std::vector<Index> rim = boundary_of(truth);
  // In its plane, beside the rim of the points.
  std::vector<Vector3> positions = truth.positions();
  for (const Index i : rim) {
    Vector3& place = positions[static_cast<std::size_t>(i)];
    place = {1.03 * place.x() + 0.02, 0.97 * place.y(), place.z() + 0.02};
  }
  const PolygonMesh mesh = with_positions(truth, positions);
  for (const auto& [name, support] : supports_of_rim()) {
    const Constraints constraints = sliding(mesh, rim, support);
    const FitResult result =
        fit(mesh, constraints, {.positions = fine.positions()}, {.criterion = SmoothingLength{0.1}});
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged) << name;
    EXPECT_LT(distance_from(support, result.positions, rim), 1e-15) << name;
    const FitResult held = fit(with_positions(truth, result.positions), held_boundary(truth),
                               {.positions = fine.positions()}, {.criterion = SmoothingLength{0.1}});
    EXPECT_LT(distance_from_unit_sphere(result.positions), 1.2 * distance_from_unit_sphere(held.positions)) << name;
  }
}

TEST(SlidingLines, ABoundaryIsMadeFairInItsPlane) {
  const PolygonMesh truth = cap();
  const std::vector<Index> rim = boundary_of(truth);
  const Support plane = supports_of_rim().front().support;
  Constraints constraints = sliding(truth, rim, plane);
  std::vector<Vector3> positions = truth.positions();
  for (std::size_t k = 0; k < rim.size(); ++k) {
    const Vector3& place = truth.position(rim[k]);
    constraints.fix_normal(rim[k], place);
    if (k % 6 == 0)
      constraints.fix_position(rim[k], place);
    else
      positions[static_cast<std::size_t>(rim[k])] +=
          Vector3(0.02, 0.04, -0.03) * std::sin(17.0 * static_cast<double>(k));
  }
  const PolygonMesh mesh = with_positions(truth, positions);
  FairOptions options;
  options.distribution = Distribution::even;
  options.fair_boundary = EquilibriumMethod{.tolerance = 1e-12};
  options.method = *options.fair_boundary;
  const FairResult result = fair(mesh, constraints, options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_LT(distance_from(plane, result.positions, rim), 1e-15);
  EXPECT_LT(distance_from_unit_sphere(result.positions), 1e-9);
  options.strength = 0.5;
  EXPECT_LT(distance_from(plane, fair(mesh, constraints, options).positions, rim), 1e-15);
}

TEST(SlidingLines, ADeckEdgeStaysInItsPlaneAndTheChinesAreSharp) {
  const generate::HullOptions sizes;
  const PolygonMesh truth = generate::hull(sizes);
  constexpr double noise = 0.003;
  std::vector<Vector3> positions = generate::add_noise(truth, noise, 1, true).positions();
  for (Index i = 0; i < truth.node_count(); ++i) {
    if (truth.position(i).y() == 0) positions[static_cast<std::size_t>(i)].y() = 0;
  }
  const PolygonMesh mesh = with_positions(truth, positions);
  std::vector<Index> deck;
  for (Index i = sizes.rows * (sizes.columns + 1); i < truth.node_count(); ++i) deck.push_back(i);
  const Support plane =
      Support::plane(truth.position(deck.front()), (truth.position(deck.back()) - truth.position(deck.front()))
                                                       .cross(truth.position(deck[30]) - truth.position(deck.front())));
  ASSERT_LT(distance_from(plane, truth.positions(), deck), 1e-12);
  ASSERT_GT(distance_from(plane, positions, deck), 0.5 * noise);
  FitOptions options = at_home(Noise{noise / std::sqrt(5)});
  options.fair.fair_boundary.emplace();
  options.fair.sharp_edges = find_sharp_edges(truth, 15).edges;
  const auto fitted = [&](const Constraints& constraints) {
    return fit(find_symmetry(mesh, parse_plane("y")), constraints, {.positions = mesh.positions()}, options);
  };
  const FitResult result = fitted(sliding(mesh, deck, plane));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LT(distance_from(plane, result.positions, deck), 1e-14);
  EXPECT_GT(result.report.fair.sharp_edges, 0);
  std::vector<Vector3> true_edge;
  true_edge.reserve(deck.size());
  for (const Index i : deck) true_edge.push_back(truth.position(i));
  const Support edge = Support::polyline(true_edge);
  const auto off = [&](const std::vector<Vector3>& places) {
    const std::vector<Vector3> of_deck(places.begin() + deck.front(), places.begin() + deck.back() + 1);
    return rms(of_deck, [&](const Vector3& place) { return (*edge.nearest(place) - place).norm(); });
  };
  EXPECT_LT(off(result.positions), 0.45 * off(positions));
  const FitResult free = fitted(Constraints(mesh.node_count()));
  EXPECT_GT(distance_from(plane, free.positions, deck), 0.3 * noise) << "it stays there as it slides";
  EXPECT_LT(off(result.positions), 0.9 * off(free.positions));
  EXPECT_LT(off(free.positions), 0.6 * off(positions)) << "all of the noise goes";
}

/// Two planes, which meet at y = 0.5 at a right angle.
PolygonMesh roof() {
  const PolygonMesh flat = generate::plane({.columns = 16, .rows = 16});
  std::vector<Vector3> positions = flat.positions();
  for (Vector3& p : positions) p.z() = -std::abs(p.y() - 0.5);
  return with_positions(flat, positions);
}

TEST(SlidingLines, ASharpEdgeStaysInItsPlane) {
  const PolygonMesh truth = roof();
  const PolygonMesh mesh = with_positions(truth, generate::add_noise(truth, 0.01, 7).positions());
  std::vector<Index> ridge;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (truth.position(i).z() == 0) ridge.push_back(i);
  }
  ASSERT_EQ(ridge.size(), 17U);
  const Support plane = Support::plane({0, 0.5, 0}, {0, 1, 0});
  Constraints constraints = held_boundary(truth);
  for (const Index i : ridge) {
    if (!constraints.position_fixed(i)) constraints.slide_on(i, plane);
  }
  FairOptions options{.method = EquilibriumMethod{.tolerance = 1e-12}};
  options.sharp_edges = find_sharp_edges(truth, 40).edges;
  for (const SharpCurves curves : {SharpCurves::hold, SharpCurves::fit}) {
    options.sharp_curves = curves;
    const FairResult result = fair(mesh, constraints, options);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_LT(distance_from(plane, result.positions, ridge), 1e-15);
    FitOptions of_fit = at_home(Noise{0.01 / std::sqrt(5)});
    of_fit.fair.sharp_edges = options.sharp_edges;
    of_fit.fair.sharp_curves = curves;
    const FitResult fitted = fit(mesh, constraints, {.positions = mesh.positions()}, of_fit);
    EXPECT_EQ(fitted.report.fair.outcome, Outcome::converged);
    EXPECT_LT(distance_from(plane, fitted.positions, ridge), 1e-15);
  }
}

TEST(SlidingLines, NodesInsideAreRefusedWherePointsPull) {
  const PolygonMesh mesh = cap();
  const Constraints constraints = sliding(mesh, {0}, Support::plane({0, 0, 0}, {1, 0, 0}));
  const std::string message = refusal([&] { (void)fit(mesh, constraints, {.positions = mesh.positions()}, {}); },
                                      ErrorCode::unusable_constraint);
  EXPECT_TRUE(says(message, "node 0 cannot slide: points, or its own nodes, pull")) << message;
  EXPECT_TRUE(says(message, "let these alone do so")) << message;
}

TEST(SlidingLines, ANodeOnTheAxisOfItsSupportIsRefused) {
  const PolygonMesh mesh = cap();
  const Index node = boundary_of(mesh).front();
  const Constraints constraints = sliding(mesh, {node}, Support::cylinder(mesh.position(node), {0, 0, 1}, 1));
  const std::string message = refusal([&] { (void)fit(mesh, constraints, {.positions = mesh.positions()}, {}); },
                                      ErrorCode::unusable_constraint);
  EXPECT_TRUE(says(message, "lies on the axis")) << message;
}

}  // namespace
}  // namespace vspring::sliding_lines_test
