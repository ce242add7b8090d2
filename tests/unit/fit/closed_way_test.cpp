#include "fit/closed_way.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vspring::closed_way_test {
namespace {

constexpr std::size_t places = 160;

/// A square of four sides of length 40, with a place at each corner but the first: this one is cut off.
std::vector<Vector3> cut_square() {
  std::vector<Vector3> way;
  for (std::size_t k = 0; k < places; ++k) {
    const auto along = static_cast<double>(k % 40);
    switch (k / 40) {
      case 0:
        way.emplace_back(along, 0, 0);
        break;
      case 1:
        way.emplace_back(40, along, 0);
        break;
      case 2:
        way.emplace_back(40 - along, 40, 0);
        break;
      default:
        way.emplace_back(0, 40 - along, 0);
    }
  }
  way[0] = {0.2, 0.2, 0};
  return way;
}

TEST(ClosedWay, HasACornerWhereOneFaceIsNearIt) {
  for (const std::size_t lone : {std::size_t{0}, std::size_t{3}, places - 4}) {
    const auto faces = [&](std::size_t place) -> std::size_t { return place == lone ? 1 : 3; };
    std::vector<Vector3> way = cut_square();
    std::vector<std::size_t> corners = put_at_corners(way, 4, faces);
    std::sort(corners.begin(), corners.end());
    ASSERT_EQ(corners.size(), 4U);
    EXPECT_TRUE(std::ranges::count(corners, lone) == 1) << lone;
    EXPECT_LT(way[lone].norm(), 1e-12);
    // What makes room stays on the square, in its order.
    for (std::size_t k = 0; k < places; ++k) {
      const Vector3& next = way[(k + 1) % places];
      const Vector3& p = way[k];
      EXPECT_LT(std::min({p.x(), p.y(), 40 - p.x(), 40 - p.y()}), 1e-12) << k;
      EXPECT_GT((next - p).norm(), 0.5) << k;
      EXPECT_LT((next - p).norm(), 1.5) << k;
    }
  }
}

TEST(ClosedWay, LeavesACornerWhereItIsIfNoPlaceNearItHasOneFace) {
  std::vector<Vector3> way = cut_square();
  const auto faces = [](std::size_t place) -> std::size_t { return place == 6 || place == 2 ? 2 : 3; };
  const std::vector<std::size_t> corners = put_at_corners(way, 4, faces);
  EXPECT_EQ(std::ranges::count(corners, std::size_t{0}), 1);
}

}  // namespace
}  // namespace vspring::closed_way_test
