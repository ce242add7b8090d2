#include "generate/rings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "unit/generate/counted.hpp"
#include "vspring/error.hpp"
#include "vspring/generate.hpp"

namespace vspring::rings_test {
namespace {

using generate::Profile;

constexpr Profile every_profile[] = {Profile::steps, Profile::cone, Profile::flat};

struct Size {
  Index nodes;
  Index boundary;
  Index faces;
};

// The four meshes of the paper's Table 1.
constexpr Size table[] = {{553, 121, 985}, {1610, 202, 3018}, {3644, 305, 6983}, {14962, 608, 29316}};

Vector3 up(const Vector3&) { return {0, 0, 1}; }

void expect_annulus(const PolygonMesh& mesh, Index nodes) {
  const Counted counted = count(mesh);
  EXPECT_EQ(counted.nodes, nodes);
  EXPECT_EQ(counted.euler(), 0);
  EXPECT_EQ(counted.boundaries.size(), 2U);
  EXPECT_EQ(counted.faces, 2 * nodes - counted.boundary_nodes());
  EXPECT_EQ(counted.isolated_nodes, 0);
  EXPECT_TRUE(counted.oriented);
}

TEST(Annulus, HasTheNumbersOfThePapersTable) {
  for (const Profile profile : every_profile) {
    for (const Size& size : table) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(profile) << ": " << size.nodes);
      const PolygonMesh mesh =
          generate::annulus({.nodes = size.nodes, .boundary_nodes = size.boundary, .profile = profile});
      expect_annulus(mesh, size.nodes);
      EXPECT_EQ(mesh.face_count(), size.faces);
      EXPECT_EQ(count(mesh).boundary_nodes(), size.boundary);
      EXPECT_GT(least_angle(mesh), 30);
      EXPECT_GT(least_outwardness(mesh, up), 0);
    }
  }
}

TEST(Annulus, TakesAnyNumberOfNodes) {
  for (const Profile profile : every_profile) {
    for (Index nodes = profile == Profile::steps ? 12 : 6; nodes < 150; ++nodes)
      expect_annulus(generate::annulus({.nodes = nodes, .profile = profile}), nodes);
    for (const Index boundary : {6, 7, 20, 80, 94}) {
      const PolygonMesh mesh = generate::annulus({.nodes = 100, .boundary_nodes = boundary, .profile = profile});
      expect_annulus(mesh, 100);
      EXPECT_EQ(count(mesh).boundary_nodes(), boundary);
    }
  }
  expect_annulus(generate::annulus({.nodes = 100, .boundary_nodes = 97, .profile = Profile::cone}), 100);
  expect_annulus(generate::annulus({.nodes = 100, .boundary_nodes = 100, .profile = Profile::flat}), 100);
}

TEST(Annulus, BoundariesAreExactCirclesTheInnerOneFirst) {
  for (const Profile profile : every_profile) {
    const PolygonMesh mesh = generate::annulus(
        {.nodes = 700, .inner_radius = 0.3, .outer_radius = 0.7, .height = 0.9, .profile = profile, .jitter = 0.5});
    const auto boundaries = count(mesh).boundaries;
    ASSERT_EQ(boundaries.size(), 2U);
    for (const Index node : boundaries[0]) {
      EXPECT_LT(node, static_cast<Index>(boundaries[0].size()));
      EXPECT_NEAR(std::hypot(mesh.position(node).x(), mesh.position(node).y()), 0.3, 3e-16);
      EXPECT_EQ(mesh.position(node).z(), profile == Profile::flat ? 0 : 0.9);
    }
    for (const Index node : boundaries[1]) {
      EXPECT_GE(node, 700 - static_cast<Index>(boundaries[1].size()));
      EXPECT_NEAR(std::hypot(mesh.position(node).x(), mesh.position(node).y()), 0.7, 7e-16);
      EXPECT_EQ(mesh.position(node).z(), 0);
    }
  }
}

TEST(Annulus, StepsHaveFlatRingsAndSharpCornersOfNodes) {
  const PolygonMesh mesh = generate::annulus({.nodes = 3000, .inner_radius = 1, .outer_radius = 2, .height = 1});
  int upper_corner = 0;
  int lower_corner = 0;
  for (const Vector3& p : mesh.positions()) {
    const double radius = std::hypot(p.x(), p.y());
    const double wall = (1.6 - radius) / 0.2;
    EXPECT_NEAR(p.z(), std::clamp(wall, 0.0, 1.0), 1e-13);
    upper_corner += std::abs(radius - 1.4) < 1e-13 ? 1 : 0;
    lower_corner += std::abs(radius - 1.6) < 1e-13 ? 1 : 0;
  }
  EXPECT_GT(upper_corner, 50);
  EXPECT_GT(lower_corner, upper_corner);
}

TEST(Annulus, ConesAndFunnelsAreStraight) {
  const PolygonMesh funnel = generate::funnel(1610, 202);
  expect_annulus(funnel, 1610);
  EXPECT_EQ(funnel.face_count(), 3018);
  for (const Vector3& p : funnel.positions()) EXPECT_NEAR(p.z(), 0.5 * (1 - std::hypot(p.x(), p.y())) / 0.65, 1e-15);
}

TEST(Cap, HasAnyNumberOfNodesAndLiesOnTheSphere) {
  for (const double half_angle : {0.01, 30.0, 90.0, 170.0}) {
    for (const Index nodes : {4, 5, 6, 7, 8, 19, 100, 127, 999, 5000}) {
      for (const double jitter : {0.0, 0.5}) {
        SCOPED_TRACE(testing::Message() << nodes << " nodes, " << half_angle << "°, jitter " << jitter);
        const PolygonMesh mesh =
            generate::cap({.nodes = nodes, .radius = 2, .half_angle = half_angle, .jitter = jitter});
        const Counted counted = count(mesh);
        EXPECT_EQ(counted.nodes, nodes);
        EXPECT_EQ(counted.euler(), 1);
        EXPECT_EQ(counted.isolated_nodes, 0);
        EXPECT_TRUE(counted.oriented);
        EXPECT_EQ(mesh.position(0), Vector3(0, 0, 2));
        for (const Vector3& p : mesh.positions()) EXPECT_NEAR(p.norm(), 2, 2e-15);
        ASSERT_EQ(counted.boundaries.size(), 1U);
        const double rim = half_angle * std::numbers::pi / 180;
        for (const Index node : counted.boundaries[0]) EXPECT_NEAR(mesh.position(node).z(), 2 * std::cos(rim), 1e-15);
      }
    }
  }
}

TEST(Cap, TrianglesAreNearlyEvenAndLookOutwards) {
  for (const double half_angle : {10.0, 60.0, 120.0, 170.0}) {
    for (const Index nodes : {200, 1000, 5000}) {
      SCOPED_TRACE(testing::Message() << nodes << " nodes, " << half_angle << "°");
      const PolygonMesh mesh = generate::cap({.nodes = nodes, .half_angle = half_angle});
      EXPECT_GT(least_angle(mesh), 35);
      double least = 1e300;
      double greatest = 0;
      for (Index f = 0; f < mesh.face_count(); ++f) {
        const double area = face_vector(mesh, f).norm();
        least = std::min(least, area);
        greatest = std::max(greatest, area);
      }
      EXPECT_LT(greatest / least, 1.7);
      const auto outward = [](const Vector3& p) { return p; };
      EXPECT_GT(least_outwardness(mesh, outward), 0.9);
      EXPECT_GT(least_outwardness(generate::cap({.nodes = nodes, .half_angle = half_angle, .jitter = 0.5}), outward),
                0.9);
    }
  }
}

TEST(Disc, IsFlatAndEvenAndKeepsItsRim) {
  for (const Index nodes : {4, 10, 400, 5000}) {
    for (const double jitter : {0.0, 0.5}) {
      const PolygonMesh mesh = generate::flat_disc({.nodes = nodes, .radius = 3, .jitter = jitter});
      const Counted counted = count(mesh);
      EXPECT_EQ(counted.nodes, nodes);
      EXPECT_EQ(counted.euler(), 1);
      EXPECT_TRUE(counted.oriented);
      EXPECT_EQ(counted.isolated_nodes, 0);
      EXPECT_GT(least_outwardness(mesh, up), 0.999);
      EXPECT_GT(least_angle(mesh), jitter > 0 ? 10 : 29);
      EXPECT_EQ(mesh.position(0), Vector3(0, 0, 0));
      for (const Index node : counted.boundaries[0]) EXPECT_NEAR(mesh.position(node).norm(), 3, 3e-15);
    }
  }
}

TEST(Rings, AMillionNodesAreNoTrouble) {
  const PolygonMesh annulus = generate::annulus({.nodes = 1'000'000});
  EXPECT_EQ(annulus.node_count(), 1'000'000);
  const PolygonMesh cap = generate::cap({.nodes = 1'000'000, .jitter = 0.3});
  EXPECT_EQ(cap.node_count(), 1'000'000);
  for (const PolygonMesh* mesh : {&annulus, &cap}) {
    std::vector<std::uint8_t> used(1'000'000, 0);
    for (const Index node : mesh->corners()) used[static_cast<std::size_t>(node)] = 1;
    EXPECT_EQ(std::accumulate(used.begin(), used.end(), 0), 1'000'000);
  }
}

TEST(Rings, OneSeedGivesTheSameBits) {
  const auto with_seed = [](std::uint64_t seed) {
    return generate::cap({.nodes = 500, .jitter = 0.3, .seed = seed}).positions();
  };
  EXPECT_EQ(with_seed(3), with_seed(3));
  EXPECT_NE(with_seed(3), with_seed(4));
}

TEST(ShareOut, GivesWholePartsThatAddUp) {
  const std::vector<double> weights = {0.1, 5, 2, 2, 2, 0, 7.3};
  const double sum = 18.4;
  for (const Index total : {7, 21, 22, 100, 1'000'003}) {
    const Index least = total >= 21 ? 3 : 1;
    const auto parts = generate::share_out(total, weights, least);
    EXPECT_EQ(std::accumulate(parts.begin(), parts.end(), 0), total);
    for (const Index part : parts) EXPECT_GE(part, least);
    if (total > 1000) {
      // Two parts are raised to the least; the others share the rest.
      for (std::size_t k = 1; k < 5; ++k) EXPECT_NEAR(parts[k], total * weights[k] / sum, 2);
    }
  }
  EXPECT_EQ(generate::share_out(10, {1, 1, 1, 1}, 1), (std::vector<Index>{3, 2, 3, 2}));
}

}  // namespace
}  // namespace vspring::rings_test
