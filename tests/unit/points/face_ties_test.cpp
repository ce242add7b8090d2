#include "points/face_ties.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "points/nearest_nodes.hpp"
#include "points/point_ties.hpp"
#include "spring/model.hpp"
#include "spring/net.hpp"
#include "support/curves.hpp"
#include "support/surfaces.hpp"
#include "vspring/distance.hpp"

namespace vspring::face_ties_test {
namespace {

using namespace support;

/// A torus, points near it, and the net with these tied.
struct Tied {
  explicit Tied(generate::Faces faces) : mesh(generate::torus({.columns = 24, .rows = 12, .faces = faces})) {
    Draw draw(4);
    for (const Vector3& node : mesh.positions()) points.push_back(node + draw.in_cube(0.06));
    ThreadTeam team(1);
    const std::vector<std::uint8_t> all(points.size(), 1);
    const std::vector<Index> nearest = nearest_nodes(points, mesh.positions(), all, team);
    const std::vector<double> weights(points.size(), 1);
    const PointTies ties(net, points, weights, nearest);
    update_directions(net, *surface_model(PseudoNormals::link), team);
  }

  PolygonMesh mesh;
  Net net = gather_net(mesh, Constraints(mesh.node_count()));
  std::vector<Vector3> points;
};

TEST(FaceTies, MeasureTheDistanceFromFaces) {
  for (const generate::Faces faces : every_kind) {
    const Tied tied(faces);
    const FaceTies ties(tied.mesh, tied.net);
    const std::vector<double> distances = point_distances(tied.points, tied.mesh, Context());
    const double scale = tied.net.frame.scale();
    for (std::size_t i = 0; i < tied.net.moving; ++i) {
      for (const std::uint32_t k : tied.net.points.of(i))
        EXPECT_NEAR(std::abs(ties.of(i, k).height), scale * distances[tied.net.points.numbers[k]], 1e-12 * scale);
    }
  }
}

TEST(FaceTies, RiseAsNodesMoveAlongTheirNormals) {
  Tied tied(generate::Faces::mixed);
  const FaceTies ties(tied.mesh, tied.net);
  constexpr double step = 1e-7;
  for (std::size_t i = 0; i < tied.net.moving; i += 7) {
    for (const std::uint32_t k : tied.net.points.of(i)) {
      const HeightOverFace before = ties.of(i, k);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint32_t node = before.nodes[corner];
        const Vector3 place = tied.net.positions[node];
        tied.net.positions[node] += step * tied.net.normals[node];
        EXPECT_NEAR((ties.of(i, k).height - before.height) / step, before.rise[corner], 1e-4);
        tied.net.positions[node] = place;
      }
    }
  }
}

TEST(FaceTies, HeldNodesDoNotRise) {
  const PolygonMesh mesh = generate::plane({.columns = 2, .rows = 2, .faces = generate::Faces::quads});
  Net net = gather_net(mesh, held_boundary(mesh));
  ASSERT_EQ(net.moving, 1U);
  ThreadTeam team(1);
  const std::vector<Vector3> points = {{0.6, 0.6, 0.1}};
  const std::vector<Index> nearest = {net.node[0]};
  const std::vector<double> weights = {1};
  const PointTies ties(net, points, weights, nearest);
  update_directions(net, *surface_model(PseudoNormals::link), team);
  const HeightOverFace height = FaceTies(mesh, net).of(0, 0);
  EXPECT_NEAR(std::abs(height.height), 0.1 * net.frame.scale(), 1e-12);
  // At a fifth of the way to the corner.
  EXPECT_NEAR(std::accumulate(height.rise.begin(), height.rise.end(), 0.0), 0.8, 1e-12);
}

}  // namespace
}  // namespace vspring::face_ties_test
