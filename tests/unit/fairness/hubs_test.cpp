#include "fairness/hubs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vspring::hubs_test {
namespace {

Triangle triangle(Index a, Index b, Index c) { return {{a, b, c}, 0}; }

TEST(Hubs, EachTriangleBelongsToTheBusiestOfItsNodes) {
  // 70 at node 0, 80 at node 1, of them one at both; three at neither.
  std::vector<Triangle> triangles;
  triangles.reserve(152);
  for (Index k = 0; k < 69; ++k) triangles.push_back(triangle(2 + k, 0, 3 + k));
  for (Index k = 0; k < 79; ++k) triangles.push_back(triangle(2 + k, 3 + k, 1));
  triangles.push_back(triangle(0, 1, 2));
  for (Index k = 0; k < 3; ++k) triangles.push_back(triangle(90, 91, 92 + k));
  const Hubs found = find_hubs(triangles, 95);
  ASSERT_EQ(found.hubs.size(), 2U);
  EXPECT_EQ(found.hubs[0].node, 0);
  EXPECT_EQ(found.hubs[0].triangles.size(), 69U);
  EXPECT_EQ(found.hubs[1].node, 1);
  EXPECT_EQ(found.hubs[1].triangles.size(), 80U);
  EXPECT_EQ(found.hubs[1].triangles.back(), 148);
  EXPECT_EQ(found.others, (std::vector<Index>{149, 150, 151}));
}

TEST(Hubs, AnEdgeIsSeenWithinItsBox) {
  const Vector3 hub(0.3, -0.2, 0.5);
  const Vector3 a = hub + Vector3(2, 0.1, 0);
  for (const Vector3& b : {Vector3(hub + Vector3(-0.5, 1, 0.2)), Vector3(hub + Vector3(2, 0.11, 0)),
                           Vector3(hub + Vector3(-3, -0.1, 0.2))}) {
    const Box box = box_seen_from(hub, a, b);
    for (int k = 0; k <= 100; ++k) {
      const Vector3 at = a + k / 100.0 * (b - a);
      EXPECT_TRUE(box.contains((at - hub).normalized())) << k;
    }
  }
}

TEST(Hubs, BoxesOfAFanMeetOnlyThoseBesideThem) {
  constexpr int sides = 500;
  std::vector<Box> boxes;
  const auto rim = [](int k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    return Vector3(std::cos(angle), std::sin(angle), 0.1 * std::cos(3 * angle));
  };
  boxes.reserve(sides);
  for (int k = 0; k < sides; ++k) boxes.push_back(box_seen_from({0, 0, 1}, rim(k), rim(k + 1)));
  for (int k = 0; k < sides; ++k) {
    const auto meeting = std::count_if(boxes.begin(), boxes.end(), [&](const Box& other) {
      return boxes[static_cast<std::size_t>(k)].intersects(other);
    });
    EXPECT_LE(meeting, 3) << k;
  }
}

}  // namespace
}  // namespace vspring::hubs_test
