#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "curve_fit/way.hpp"
#include "support/curves.hpp"

namespace vspring::way_corners_test {
namespace {

using Places = std::vector<std::size_t>;
using support::Draw;
using support::heading;

constexpr double angle = 40 / 180.0 * std::numbers::pi;

/// Of lengths, each turned from the one before, with a place every `step`; noise: up to that in each coordinate.
std::vector<Vector3> way_of(const std::vector<double>& lengths, double turn, double step, double noise = 0) {
  Draw draw(3);
  std::vector<Vector3> way = {Vector3::Zero()};
  double direction = 0;
  for (const double length : lengths) {
    const auto count = static_cast<int>(std::lround(length / step));
    for (int k = 0; k < count; ++k) way.emplace_back(way.back() + step * heading(direction));
    direction += turn;
  }
  for (Vector3& place : way) place += Vector3(draw.uniform(-noise, noise), draw.uniform(-noise, noise), 0);
  return way;
}

TEST(WayCorners, AreFoundInNoiseAsLongAsEdges) {
  const std::vector<Vector3> way = way_of({40, 30, 40}, std::numbers::pi / 2, 1, 0.5);
  const Places corners = corners_of_way(way, false, angle, 1);
  ASSERT_EQ(corners.size(), 2U);
  EXPECT_NEAR(static_cast<double>(corners[0]), 40, 1);
  EXPECT_NEAR(static_cast<double>(corners[1]), 70, 1);
  EXPECT_EQ(corners_of_way(way_of({110}, 0, 1, 0.5), false, angle, 1), Places{});
}

TEST(WayCorners, AreNotWhereABendIsEven) {
  for (const double radius : {6.0, 12.0, 50.0}) {
    const double step = 0.8;
    const auto count = static_cast<int>(2 * std::numbers::pi * radius / step);
    const std::vector<Vector3> circle =
        way_of(std::vector<double>(static_cast<std::size_t>(count), step), 2 * std::numbers::pi / count, step, 0.2);
    EXPECT_EQ(corners_of_way(circle, true, angle, 1), Places{}) << radius;
  }
}

TEST(WayCorners, TurnByMoreThanTheAngle) {
  for (const double turn : {30.0, 50.0, 90.0, 135.0, 180.0}) {
    const std::vector<Vector3> way = way_of({40, 40}, turn / 180 * std::numbers::pi, 1);
    EXPECT_EQ(corners_of_way(way, false, angle, 1), turn > 40 ? Places{40} : Places{}) << turn;
  }
}

TEST(WayCorners, AreNoNearerToEachOtherThanFourTolerances) {
  const double half = std::numbers::pi / 2;
  EXPECT_EQ(corners_of_way(way_of({40, 6, 40}, half, 0.5), false, angle, 1), (Places{80, 92}));
  EXPECT_EQ(corners_of_way(way_of({40, 6}, half, 0.5), false, angle, 1), Places{80}) << "next to an end";
}

TEST(WayCorners, MayBeEveryPlace) {
  const std::vector<Vector3> square = way_of({10, 10, 10}, std::numbers::pi / 2, 10);
  EXPECT_EQ(corners_of_way(square, true, angle, 0.1), (Places{0, 1, 2, 3}));
  EXPECT_EQ(corners_of_way(square, true, angle, 0), (Places{0, 1, 2, 3})) << "without noise";
  EXPECT_EQ(corners_of_way(square, false, angle, 0.1), (Places{1, 2}));
}

TEST(WayCorners, NeedStretchesOfSoManyEdges) {
  std::vector<Vector3> ring;
  ring.reserve(6);
  for (int k = 0; k < 6; ++k)
    ring.emplace_back(10 * std::cos(k * std::numbers::pi / 3), 10 * std::sin(k * std::numbers::pi / 3), 0);
  EXPECT_EQ(corners_of_way(ring, true, 1, 0.1).size(), 6U);
  EXPECT_EQ(corners_of_way(ring, true, 1, 0.1, {}, 2), Places{});
  const std::vector<Vector3> square = way_of({10, 10, 10, 7.5}, std::numbers::pi / 2, 2.5);
  EXPECT_EQ(corners_of_way(square, true, angle, 0.1, {}, 2), (Places{0, 4, 8, 12}));
}

}  // namespace
}  // namespace vspring::way_corners_test
