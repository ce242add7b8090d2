// The paper's sums, by hand: Eq. 8 and its weights, the regularisation (§4.4), normals of faces (§4.2), the feet of
// points (Eq. 9), the size of a step (§4.6).

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "spring/model.hpp"
#include "spring/net.hpp"
#include "spring/point_force.hpp"
#include "spring/pseudo_normal.hpp"
#include "spring/v_spring.hpp"
#include "vspring/generate.hpp"

namespace vspring::equations_test {
namespace {

constexpr Link spoke_to(std::uint32_t node) { return {node | Link::spoke_bit}; }
constexpr Link first_spoke_to(std::uint32_t node) { return {node | Link::spoke_bit | Link::start_bit}; }
constexpr Link corner_at(std::uint32_t node) { return {node}; }

/// A node at the origin, and four neighbours 1, 2, 5 and 4 away; node 5 is the far corner of a quad.
struct Around {
  std::vector<Vector3> positions = {{0, 0, 0},      {0.6, 0, 0.8},    {0, 1.2, -1.6},
                                    {-4.8, 0, 1.4}, {0, -3.84, 1.12}, {7, 8, 9}};
  std::vector<Vector3> normals = std::vector<Vector3>(6, Vector3(0, 0, 1));
  std::array<Link, 5> links = {spoke_to(1), corner_at(5), spoke_to(2), spoke_to(3), spoke_to(4)};
};

TEST(NodeForce, IsTheMeanOfEquationEightByInverseLengths) {
  const Around around;
  const NodeForce force = node_force(0, std::span<const Link>(around.links), around.positions, around.normals, {}, 0);
  // Between parallel normals t_j − t_i is the height of j.
  const double mean = (0.8 / 1 - 1.6 / 2 + 1.4 / 5 + 1.12 / 4) / (1.0 / 1 + 1.0 / 2 + 1.0 / 5 + 1.0 / 4);
  EXPECT_LT((force.spring - Vector3(0, 0, mean)).norm(), 1e-15);
  EXPECT_LT((force.regularisation - Vector3((0.6 - 4.8) / 4, (1.2 - 3.84) / 4, 0)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(force.mean_edge, (1 + 2 + 5 + 4) / 4.0);
}

TEST(NodeForce, GoesAcrossTheNormalToWhereSharesSay) {
  Around around;
  around.normals[0] = Vector3(0.6, 0, 0.8);
  const std::vector<double> shares = {0.1, 0, 0.2, 0.3, 0.4};
  const NodeForce force =
      node_force(0, std::span<const Link>(around.links), around.positions, around.normals, shares, 0);
  const Vector3 mean =
      0.1 * around.positions[1] + 0.2 * around.positions[2] + 0.3 * around.positions[3] + 0.4 * around.positions[4];
  EXPECT_LT(std::abs(force.regularisation.dot(around.normals[0])), 1e-15);
  EXPECT_LT((force.regularisation - mean).cross(around.normals[0]).norm(), 1e-15);
  EXPECT_LT(force.spring.cross(around.normals[0]).norm(), 1e-15);
}

TEST(PseudoNormals, OfFacesAreThatAverage) {
  // Two triangles, half a square in the plane z = 0 and one of twice its area and half its angle in the plane x = 0; a
  // third closes the fan.
  const std::vector<Vector3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 2, 2}};
  const std::array<Link, 3> open = {first_spoke_to(1), spoke_to(2), spoke_to(3)};
  const std::array<Link, 3> closed = {spoke_to(1), spoke_to(2), spoke_to(3)};
  const auto expect = [&](const auto& normal, const Vector3& weights) {
    const Vector3 two = weights[0] * Vector3(0, 0, 1) + weights[1] * Vector3(1, 0, 0);
    const Vector3 three = two + weights[2] * Vector3(0, 1, -1).normalized();
    EXPECT_LT((normal(positions[0], std::span<const Link>(open), positions) - two.normalized()).norm(), 1e-15);
    EXPECT_LT((normal(positions[0], std::span<const Link>(closed), positions) - three.normalized()).norm(), 1e-15);
  };
  expect(AverageNormal(), {1, 1, 1});
  expect(AreaNormal(), {1, 2, std::sqrt(8)});
  expect(AngleNormal(), {2, 1, 2});
}

TEST(PseudoNormals, OfAQuadCountItsWholeArea) {
  // A unit square in the plane z = 0, and half of one in the plane x = 0.
  const std::vector<Vector3> positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::array<Link, 4> links = {first_spoke_to(1), corner_at(2), spoke_to(3), spoke_to(4)};
  const auto normal = [&](const auto& of) { return of(positions[0], std::span<const Link>(links), positions); };
  EXPECT_LT((normal(AverageNormal()) - Vector3(1, 0, 1).normalized()).norm(), 1e-15);
  EXPECT_LT((normal(AreaNormal()) - Vector3(1, 0, 2).normalized()).norm(), 1e-15);
  EXPECT_LT((normal(AngleNormal()) - Vector3(1, 0, 1).normalized()).norm(), 1e-15);
}

/// One node at the origin with its normal upwards, and points that are tied to it.
Net tied(std::vector<Vector3> points, std::vector<double> weights) {
  Net net;
  net.positions = {{0, 0, 0}};
  for (std::uint32_t k = 0; k < points.size(); ++k) net.points.order.push_back(k);
  net.points.begin = {0, static_cast<std::uint32_t>(points.size())};
  net.points.positions = std::move(points);
  net.points.weights = std::move(weights);
  return net;
}

Vector3 upwards(const Vector3& d) { return {0, 0, d.z()}; }

TEST(PointForce, IsTheMeanOfEquationNineByTheInverseDistancesOfFeet) {
  Net net = tied({{3, 0, 1}, {0, 1, -2}}, {0.5, 0.25});
  const double weights = 1.0 / 3 + 1;
  PointForce force = point_force(net, 0, 1, upwards);
  EXPECT_LT((force.displacement - Vector3(0, 0, (0.5 * 1 / 3 - 0.25 * 2) / weights)).norm(), 1e-15);
  EXPECT_NEAR(force.stiffness, (0.5 / 3 + 0.25) / weights, 1e-15);
  net.points.factors = {3};
  force = point_force(net, 0, 1, upwards);
  EXPECT_LT((force.displacement - Vector3(0, 0, 3 * (0.5 * 1 / 3 - 0.25 * 2) / weights)).norm(), 1e-15);
}

TEST(PointForce, BoundsTheWeightOfAPointOverTheNode) {
  // As if a hundredth of the mean edge away.
  const Net net = tied({{0, 0, 1}, {0.04, 0, -1}, {0, 0.01, 0}}, {1, 1, 1});
  const double weights = 1 / 0.02 + 1 / 0.04 + 1 / 0.02;
  EXPECT_LT((point_force(net, 0, 2, upwards).displacement - Vector3(0, 0, (1 / 0.02 - 1 / 0.04) / weights)).norm(),
            1e-15);
}

TEST(Step, IsToldRelativeToTheMeanEdge) {
  const PolygonMesh plane = generate::plane({.columns = 2, .rows = 2, .faces = generate::Faces::quads}, 3, 1);
  Constraints constraints(plane.node_count());
  fix_boundary_positions(constraints, plane);
  Net net = gather_net(plane, constraints);
  ASSERT_EQ(net.moving, 1U);
  ThreadTeam team(1);
  const auto model = surface_model(PseudoNormals::link);
  const Vector3 place = net.positions[0];
  const Vector3 shift(0.03, 0.02, 0);
  net.positions[0] += shift;
  double mean_edge = 0;
  for (const Link link : net.rings.links(0)) {
    if (link.spoke()) mean_edge += (net.positions[link.node()] - net.positions[0]).norm() / 4;
  }
  update_directions(net, *model, team);
  EXPECT_NEAR(model->move(net, {0, 1}), shift.norm() / mean_edge, 1e-14);
  EXPECT_LT((net.positions[0] - place).norm(), 1e-15);
}

}  // namespace
}  // namespace vspring::equations_test
