// How noisy shapes seem to be.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::noise_test {
namespace {

using namespace support;

/// With Gaussian noise of that standard deviation in each coordinate.
std::vector<Vector3> disturbed(std::vector<Vector3> positions, double deviation, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0, deviation);
  for (Vector3& p : positions) p += Vector3(normal(generator), normal(generator), normal(generator));
  return positions;
}

TEST(Noise, OfSurfacesIsEstimated) {
  for (const generate::Faces faces : every_kind) {
    SCOPED_TRACE(static_cast<int>(faces));
    PolygonMesh mesh = generate::torus({.columns = 60, .rows = 28, .faces = faces}, 1, 0.4);
    const std::vector<Vector3> exact = mesh.positions();
    EXPECT_LT(estimate_noise(mesh).edges, 0.02);
    for (const double deviation : {0.005, 0.02, 0.05}) {
      mesh.set_positions(disturbed(exact, deviation, 7));
      const NoiseEstimate estimate = estimate_noise(mesh);
      EXPECT_NEAR(estimate.deviation, deviation, 0.15 * deviation);
      EXPECT_EQ(estimate.nodes, mesh.node_count());
    }
  }
}

TEST(Noise, IsSeenAcrossTheSurfaceWhereThatIsBent) {
  // Two edges turn by 40° around the pipe: heights over a plane have part of the noise along the surface.
  PolygonMesh mesh = generate::torus({.columns = 60, .rows = 18}, 1, 0.3);
  mesh.set_positions(disturbed(mesh.positions(), 0.02, 5));
  EXPECT_NEAR(estimate_noise(mesh).deviation, 0.02, 0.001);
}

TEST(Noise, IsNotSeenWhereItIsAsWideAsThePlacesThatItIsLookedForIn) {
  // In a quarter of it edges are a fortieth as long as in another, and the noise is longer than they are.
  PolygonMesh mesh = generate::plane({.columns = 50, .rows = 50});
  std::vector<Vector3> positions = mesh.positions();
  const auto graded = [](double x) { return x < 0.5 ? 0.05 * x : 1.95 * x - 0.95; };
  for (Vector3& p : positions) p = Vector3(graded(p.x()), graded(p.y()), 0);
  mesh.set_positions(disturbed(positions, 0.015, 5));
  EXPECT_NEAR(estimate_noise(mesh).deviation, 0.015, 0.001);
}

TEST(Noise, IsFoundAndTakenOffWhicheverWayFacesGoRound) {
  const PolygonMesh exact = generate::torus({.columns = 40, .rows = 20}, 1, 0.4);
  const PolygonMesh noisy(disturbed(exact.positions(), 0.02, 5), exact.face_begin(), exact.corners());
  std::vector<Index> corners = noisy.corners();
  for (Index f = 1; f < noisy.face_count(); f += 2) {
    const auto begin = corners.begin() + noisy.face_begin()[static_cast<std::size_t>(f)];
    std::reverse(begin, corners.begin() + noisy.face_begin()[static_cast<std::size_t>(f) + 1]);
  }
  const PolygonMesh turned(noisy.positions(), noisy.face_begin(), corners);
  const NoiseEstimate estimate = estimate_noise(noisy);
  EXPECT_NEAR(estimate_noise(turned).deviation, estimate.deviation, 1e-9 * estimate.deviation);
  FitOptions options{.criterion = vspring::Noise{estimate.deviation}};
  options.fair.distribution = Distribution::keep;
  const auto without_noise = [&](const PolygonMesh& mesh) {
    return fit(mesh, Constraints(mesh.node_count()), {.positions = mesh.positions()}, options).positions;
  };
  EXPECT_LT(greatest_distance(without_noise(turned), without_noise(noisy)), 0.1 * estimate.deviation);
}

TEST(Noise, GoesWithTheSizeOfTheShape) {
  PolygonMesh mesh = generate::add_noise(generate::torus({.columns = 40, .rows = 16}), 0.03, 1);
  const NoiseEstimate small = estimate_noise(mesh);
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& p : positions) p *= 1e100;
  mesh.set_positions(positions);
  const NoiseEstimate large = estimate_noise(mesh);
  EXPECT_NEAR(large.deviation / 1e100, small.deviation, 1e-9 * small.deviation);
  EXPECT_NEAR(large.edges, small.edges, 1e-9 * small.edges);
}

TEST(Noise, OfCurvesIsEstimatedInThePlaneAndInSpace) {
  for (const double rise : {0.0, 0.5}) {
    std::vector<Vector3> nodes;
    for (int k = 0; k < 600; ++k) {
      const double angle = 4 * std::numbers::pi * k / 600;
      nodes.emplace_back(std::cos(angle), std::sin(angle), rise * angle);
    }
    EXPECT_LT(estimate_noise(PolygonCurve(nodes)).edges, 0.01);
    std::vector<Vector3> noisy = disturbed(nodes, 0.003, 3);
    if (rise == 0) {
      for (Vector3& p : noisy) p.z() = 0;
    }
    EXPECT_NEAR(estimate_noise(PolygonCurve(noisy)).deviation, 0.003, 0.0006) << rise;
  }
}

/// A circle, or a helix, with that much noise in x, y and z.
std::vector<Vector3> winding(int count, double rise, const Vector3& noise, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<Vector3> nodes;
  for (int k = 0; k < count; ++k) {
    const double angle = 6 * std::numbers::pi * k / count;
    Vector3& node = nodes.emplace_back(std::cos(angle), std::sin(angle), rise * angle);
    for (int axis = 0; axis < 3; ++axis) node[axis] += noise[axis] * normal(generator);
  }
  return nodes;
}

TEST(Noise, OfOneCoordinateIsNotHiddenWhereTheCurveRunsAlongIt) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const NoiseEstimate noise = estimate_noise(PolygonCurve(winding(600, 0, {0, 0.01, 0}, seed)));
    EXPECT_TRUE(noise.coordinates_differ);
    EXPECT_NEAR(noise.by_coordinate[1], 0.01, 0.002);
    EXPECT_LT(noise.by_coordinate[0], 0.002);
    EXPECT_EQ(noise.by_coordinate[2], 0);
    EXPECT_NEAR(noise.deviation, 0.01 / std::numbers::sqrt2, 0.0015);
    EXPECT_GT(greatest_of_noise(noise), 0.025);

    const NoiseEstimate heights = estimate_noise(PolygonCurve(winding(600, 0.1, {0.01, 0.01, 0.03}, seed)));
    EXPECT_TRUE(heights.coordinates_differ);
    EXPECT_NEAR(heights.by_coordinate[0], 0.01, 0.003);
    EXPECT_NEAR(heights.by_coordinate[1], 0.01, 0.003);
    EXPECT_NEAR(heights.by_coordinate[2], 0.03, 0.004);

    const NoiseEstimate same = estimate_noise(PolygonCurve(winding(600, 0, {0.01, 0.01, 0}, seed)));
    EXPECT_FALSE(same.coordinates_differ);
    // Three standard deviations of the estimate.
    EXPECT_NEAR(same.by_coordinate[0], 0.01, 0.004);
    EXPECT_NEAR(same.by_coordinate[1], 0.01, 0.004);
  }
}

TEST(Noise, OfCoordinatesIsNothingWhereItIsNothingAtAll) {
  // Far from the origin what is left of an exact circle is the last digits of x alone.
  std::vector<Vector3> nodes = winding(600, 0, {0, 0, 0}, 1);
  for (Vector3& node : nodes) node.x() += 1e9;
  const NoiseEstimate noise = estimate_noise(PolygonCurve(nodes));
  EXPECT_EQ(noise.deviation, 0);
  EXPECT_EQ(noise.by_coordinate, (std::array<double, 3>{}));
  EXPECT_EQ(greatest_of_noise(noise), 0);
}

TEST(Noise, OfRowsThatComeTwiceALittleApartIsThatOfTheirPlaces) {
  for (const int times : {2, 3}) {
    std::vector<Vector3> rows;
    for (const Vector3& place : winding(300, 0, {0.01, 0.01, 0}, 7)) {
      for (int k = 0; k < times; ++k) rows.push_back(place + 2e-4 * k * Vector3(0.6, k == 1 ? 0.8 : -0.8, 0));
    }
    EXPECT_NEAR(estimate_noise(PolygonCurve(rows)).deviation, 0.01, 0.002) << times;
  }
}

TEST(Noise, OfHeightsIsVertical) {
  for (const bool in_space : {false, true}) {
    std::vector<Vector3> nodes;
    for (int k = 0; k < 600; ++k) {
      const double way = 0.05 * k;
      const double height = 2 * way + std::sin(way);
      if (in_space)
        nodes.emplace_back(std::cos(way / 4) * 4, std::sin(way / 4) * 4, height);
      else
        nodes.emplace_back(way, height, 0);
    }
    const std::size_t axis = in_space ? 2 : 1;
    const std::vector<Vector3> disturbed_nodes = disturbed(nodes, 0.01, 4);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      nodes[i][static_cast<Eigen::Index>(axis)] = disturbed_nodes[i][static_cast<Eigen::Index>(axis)];
    std::array<bool, 3> moving = {false, false, false};
    moving[axis] = true;
    const NoiseEstimate noise = estimate_noise(PolygonCurve(nodes), moving);
    EXPECT_NEAR(noise.deviation, 0.01, 0.002);
    EXPECT_NEAR(noise.edges, noise.deviation / 0.05, 0.01 * noise.edges);
    EXPECT_EQ(noise.directions, 1);
    EXPECT_NEAR(noise.by_coordinate[axis], 0.01, 0.002);
  }
}

TEST(Noise, IsNothingWhereNothingIsKnown) {
  EXPECT_EQ(estimate_noise(PolygonMesh(std::vector<Vector3>(4, Vector3::Zero()), {0, 3}, {0, 1, 2})).nodes, 0);
  EXPECT_EQ(estimate_noise(PolygonCurve(std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {2, 1, 0}})).deviation, 0);
  PolygonMesh mesh = generate::plane({.columns = 8, .rows = 8});
  std::vector<Vector3> positions = mesh.positions();
  positions[40].x() = std::nan("");
  mesh.set_positions(positions);
  EXPECT_TRUE(std::isfinite(estimate_noise(mesh).deviation));
  positions.assign(30, Vector3(0, std::nan(""), 0));
  EXPECT_EQ(estimate_noise(PolygonCurve(positions)).nodes, 0);
}

TEST(Noise, OfAFewRowsIsUnknownAsTheirBendsWouldCount) {
  // The upper side of NACA 0012 and the lower one, cosine-spaced: exact.
  const auto aerofoil = [](int half) {
    std::vector<Vector3> rows;
    for (int k = -half; k <= half; ++k) {
      const double x = 0.5 - 0.5 * std::cos(std::numbers::pi * k / half);
      const double height =
          0.6 * (0.2969 * std::sqrt(x) - 0.126 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1015 * x * x * x * x);
      rows.emplace_back(x, k < 0 ? height : -height, 0);
    }
    return PolygonCurve(rows);
  };
  EXPECT_EQ(estimate_noise(aerofoil(6)).deviation, 0);
  EXPECT_EQ(estimate_noise(aerofoil(10)).deviation, 0);
  EXPECT_GT(estimate_noise(aerofoil(11)).nodes, 0);
}

TEST(Noise, OfARegionIsThatOfItsNodes) {
  PolygonMesh mesh = generate::torus({.columns = 60, .rows = 28}, 1, 0.4);
  const std::vector<Vector3> noisy = disturbed(mesh.positions(), 0.01, 7);
  std::vector<Vector3> positions = mesh.positions();
  std::vector<Index> region;
  std::vector<Index> rest;
  for (Index i = mesh.node_count() - 1; i >= 0; --i) {
    const auto at = static_cast<std::size_t>(i);
    (positions[at].x() > 0.7 ? region : rest).push_back(i);
    if (positions[at].x() > 0.7) positions[at] = noisy[at];
  }
  mesh.set_positions(positions);
  EXPECT_NEAR(estimate_noise(mesh, region).deviation, 0.01, 0.001);
  EXPECT_LT(estimate_noise(mesh, rest).deviation, 0.001);
  EXPECT_EQ(estimate_noise(mesh, std::vector<Index>(region.begin(), region.begin() + 5)).deviation,
            estimate_noise(mesh).deviation);
  EXPECT_THROW((void)estimate_noise(mesh, std::vector<Index>{mesh.node_count()}), Error);
}

TEST(Noise, OfARegionOfACurveIsThatOfItsNodes) {
  // Closed; the region goes on past node 0.
  std::vector<Vector3> nodes = winding(600, 0, Vector3::Zero(), 1);
  const std::vector<Vector3> noisy = winding(600, 0, {0.01, 0.01, 0}, 1);
  std::vector<Index> region;
  std::vector<Index> rest;
  for (Index i = 0; i < 600; ++i) (i < 60 || i >= 500 ? region : rest).push_back(i);
  for (const Index i : region) nodes[static_cast<std::size_t>(i)] = noisy[static_cast<std::size_t>(i)];
  std::vector<Index> ring(600);
  std::iota(ring.begin(), ring.end(), 0);
  const PolygonCurve curve(nodes, {{.nodes = ring, .closed = true}});
  const std::array all = {true, true, true};
  EXPECT_NEAR(estimate_noise(curve, region, all).deviation, 0.01, 0.002);
  EXPECT_LT(estimate_noise(curve, rest, all).deviation, 0.001);
  EXPECT_EQ(estimate_noise(curve, std::vector<Index>{1, 2, 3}, all).deviation, estimate_noise(curve).deviation);
  EXPECT_THROW((void)estimate_noise(curve, std::vector<Index>{600}, all), Error);
}

TEST(Noise, HalfOfAllShapesStayWithinItsGreatest) {
  const auto greatest = [](Index nodes, int directions) {
    return greatest_of_noise({.deviation = 2, .edges = 0, .nodes = nodes, .directions = directions}) / 2;
  };
  for (const Index nodes : {1000, 1000000}) {
    EXPECT_NEAR(std::pow(std::erf(greatest(nodes, 1) / std::sqrt(2)), nodes), 0.5, 1e-3);
    EXPECT_NEAR(std::pow(1 - std::exp(-std::pow(greatest(nodes, 2), 2) / 2), nodes), 0.5, 1e-3);
  }
  EXPECT_NEAR(greatest(10, 1), 3, 1e-3);
  EXPECT_EQ(greatest_of_noise({}), 0);
}

}  // namespace
}  // namespace vspring::noise_test
