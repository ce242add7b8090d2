#include "spring/spacing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "spring/model.hpp"
#include "spring/shares.hpp"
#include "spring/surface_force.hpp"
#include "support/surfaces.hpp"

namespace vspring::spacing_test {
namespace {

using namespace support;
using generate::Faces;

Net net_of(const PolygonMesh& mesh) {
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  return gather_net(mesh, constraints);
}

/// A full cylinder of radius 1; rows of that height.
PolygonMesh rings(Faces faces, int columns, int rows, double height) {
  return generate::tube({.columns = columns, .rows = rows, .faces = faces}, 1, rows * height);
}

TEST(Spacing, TheSharesAtPlacesHoldNodesThere) {
  ThreadTeam team(2);
  for (const Faces faces : every_kind) {
    Net net = net_of(generate::plane({.columns = 20, .rows = 20, .faces = faces, .jitter = 0.2}));
    const std::vector<Vector3> places = net.positions;
    net.laplacian_weights = laplacian_weights_at(net, places, team);
    net.normals.assign(net.normals.size(), Vector3::UnitZ());
    for (std::size_t i = 0; i < net.moving; ++i) {
      double sum = 0;
      for (const double share : net.weights_of(i)) {
        EXPECT_GE(share, 0);
        sum += share;
      }
      EXPECT_NEAR(sum, 1, 1e-12);
      const NodeForce force = surface_force(net, i);
      // With three neighbours a node may lie outside them.
      if (faces == Faces::triangles || faces == Faces::quads) {
        EXPECT_LT(force.regularisation.norm(), 1e-3 * force.mean_edge);
      }
    }
  }
}

TEST(Spacing, WideCellsDoNotSink) {
  ThreadTeam team(2);
  for (const Faces faces : {Faces::triangles, Faces::quads}) {
    for (const int columns : {12, 24}) {
      // Up to 17 times as wide as high.
      const double height = 0.03;
      const PolygonMesh mesh = rings(faces, columns, 20, height);
      const Net net = net_of(mesh);
      const std::vector<Vector3> places = rest_positions(net, team);
      for (std::size_t i = 0; i < net.moving; ++i)
        EXPECT_LT((places[i] - net.positions[i]).norm(), 0.3 * height * net.frame.scale());
    }
  }
}

/// How unlike edges that follow each other up the rings are: root mean square of the logarithm of their ratio.
double roughness(const Net& net, const std::vector<Vector3>& places) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    double up = 0;
    double down = 0;
    for (const Link link : net.rings.links(i)) {
      const Vector3 d = places[link.node()] - places[i];
      if (!link.spoke() || std::abs(d.z()) < 2 * d.head<2>().norm()) continue;
      (d.z() > 0 ? up : down) = std::abs(d.z());
    }
    if (!(up > 0 && down > 0)) continue;
    sum += std::pow(std::log(up / down), 2);
    count += 1;
  }
  return std::sqrt(sum / count);
}

TEST(Spacing, NoiseGoesAndGradingStays) {
  ThreadTeam team(2);
  const PolygonMesh exact = rings(Faces::quads, 48, 24, 0.1);
  const Net rough = net_of(generate::add_noise(exact, 0.04, 3));
  EXPECT_GT(roughness(rough, rough.positions), 0.3);
  EXPECT_LT(roughness(rough, rest_positions(rough, team)), 0.06);
  // Rows that grow by a tenth from one to the next go on doing so.
  PolygonMesh graded = exact;
  std::vector<Vector3> positions = exact.positions();
  for (Vector3& p : positions) p.z() = std::expm1(std::log(1.1) * p.z() / 0.1);
  graded.set_positions(positions);
  const Net net = net_of(graded);
  const std::vector<Vector3> places = rest_positions(net, team);
  EXPECT_NEAR(roughness(net, places), std::log(1.1), 0.02);
}

struct Extent {
  double least = 1e300;
  double greatest = -1e300;
  void add(double value) {
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
};

/// The least and greatest angle between successive edges at nodes in the middle of a unit square.
Extent angles(const Net& net, const std::vector<Vector3>& places) {
  Extent all;
  for (std::size_t i = 0; i < net.moving; ++i) {
    std::vector<Vector3> edges;
    for (const Link link : net.rings.links(i)) {
      if (link.spoke()) edges.push_back(places[link.node()] - places[i]);
    }
    const Vector3 place = places[i] / net.frame.scale();
    if (place.head<2>().lpNorm<Eigen::Infinity>() > 0.25) continue;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const Vector3& next = edges[(k + 1) % edges.size()];
      all.add(std::atan2(edges[k].cross(next).norm(), edges[k].dot(next)) / degree);
    }
  }
  return all;
}

TEST(Spacing, BricksBecomeHexagons) {
  ThreadTeam team(1);
  for (const auto& [columns, rows] : {std::pair(16, 32), std::pair(48, 16)}) {
    const Net net = net_of(generate::plane({.columns = columns, .rows = rows, .faces = Faces::hexagons}));
    EXPECT_NEAR(angles(net, net.positions).greatest, 180, 1e-9);
    const Extent after = angles(net, rest_positions(net, team));
    EXPECT_GT(after.least, 85);
    EXPECT_LT(after.greatest, 165);
  }
}

TEST(Spacing, IsThatOfTheInputWhereNodesArePulledOutOfIt) {
  const PolygonMesh mesh = generate::plane({.columns = 20, .rows = 20, .jitter = 0.3});
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  const Index middle = mesh.node_count() / 2;
  constraints.fix_position(middle, mesh.position(middle));
  ThreadTeam team(1);
  const Net still = gather_net(mesh, constraints);
  constraints.fix_position(middle, mesh.position(middle) + Vector3(0, 0, 0.4));
  const Net pulled = gather_net(mesh, constraints);
  const std::vector<double> before = laplacian_weights_at(still, rest_positions(still, team), team);
  const std::vector<double> after = laplacian_weights_at(pulled, rest_positions(pulled, team), team);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t k = 0; k < before.size(); ++k) EXPECT_NEAR(before[k], after[k], 1e-12);
}

TEST(Spacing, IsTheSameOnAnyNumberOfThreads) {
  const Net net = net_of(generate::add_noise(generate::annulus({.nodes = 5000}), 0.02, 3));
  ThreadTeam alone(1);
  ThreadTeam four(4);
  const std::vector<Vector3> places = rest_positions(net, alone);
  EXPECT_EQ(places, rest_positions(net, four));
  EXPECT_EQ(laplacian_weights_at(net, places, alone), laplacian_weights_at(net, places, four));
}

TEST(Spacing, NoiseOfEdgesIsSweptOutAndOfSeveralEdgesLeavesNothingToKeep) {
  ThreadTeam team(2);
  for (const Faces faces : every_kind) {
    SCOPED_TRACE(static_cast<int>(faces));
    const int cells = 30;
    const PolygonMesh plane = generate::plane({.columns = cells, .rows = cells, .faces = faces});
    const auto disturbed = [&](double edges) { return net_of(generate::add_noise(plane, edges / cells, 5)); };
    EXPECT_TRUE(told_rest_positions(net_of(plane), team));
    EXPECT_TRUE(told_rest_positions(disturbed(0.3), team));
    EXPECT_FALSE(told_rest_positions(disturbed(6), team));
    const Net noisy = disturbed(1.4);
    const std::vector<Vector3> places = rest_positions(noisy, team);
    ASSERT_EQ(told_rest_positions(noisy, team), places);
    double least = 1;
    for (std::size_t i = 0; i < noisy.moving; ++i) {
      for (const Link link : noisy.rings.links(i)) {
        if (link.spoke()) least = std::min(least, (places[link.node()] - places[i]).norm() / noisy.frame.scale());
      }
    }
    EXPECT_GT(least, 0.3 / cells);
  }
}

}  // namespace
}  // namespace vspring::spacing_test
