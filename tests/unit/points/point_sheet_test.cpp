#include "points/point_sheet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "vspring/types.hpp"

namespace vspring::point_sheet_test {
namespace {

/// Of a square of 21 × 21 points one apart, slightly bent.
std::vector<Vector3> square() {
  std::vector<Vector3> points;
  for (int i = 0; i < 21; ++i) {
    for (int j = 0; j < 21; ++j) points.emplace_back(i, j, 0.001 * i * j);
  }
  return points;
}

bool is_outermost(const Vector3& p) { return p.x() == 0 || p.x() == 20 || p.y() == 0 || p.y() == 20; }

TEST(PointSheet, EndsAtItsOutermostPoints) {
  const std::vector<Vector3> points = square();
  const PointSheet sheet(points, {}, 0.5);
  EXPECT_GT(sheet.radius(), 2);
  EXPECT_LT(sheet.radius(), 4);
  for (std::size_t j = 0; j < points.size(); ++j) {
    const auto about = sheet.about(static_cast<Index>(j));
    ASSERT_TRUE(about.has_value()) << j;
    EXPECT_EQ(about->ends, is_outermost(points[j])) << j;
    EXPECT_GT(std::abs(about->normal.z()), 0.99) << j;
    EXPECT_LT((about->foot(points[j] + Vector3(0, 0, 1)) - points[j]).norm(), 0.1) << j;
  }
}

TEST(PointSheet, LooksAsFarAsItIsTold) {
  const std::vector<Vector3> points = square();
  const PointSheet sheet(points, {}, 6);
  EXPECT_EQ(sheet.radius(), 6);
  for (std::size_t j = 0; j < points.size(); ++j)
    EXPECT_EQ(sheet.about(static_cast<Index>(j))->ends, is_outermost(points[j])) << j;
}

TEST(PointSheet, EndsAtAHole) {
  std::vector<Vector3> points = square();
  std::erase_if(points, [](const Vector3& p) { return std::hypot(p.x() - 10, p.y() - 10) < 4.5; });
  const PointSheet sheet(points, {}, 2.5);
  int ends = 0;
  for (std::size_t j = 0; j < points.size(); ++j) {
    if (is_outermost(points[j]) || !sheet.about(static_cast<Index>(j))->ends) continue;
    ++ends;
    EXPECT_LT(std::hypot(points[j].x() - 10, points[j].y() - 10), 6) << j;
  }
  EXPECT_GT(ends, 12);
}

TEST(PointSheet, DoesNotTakeTheOtherSideOfAWallForItself) {
  // Beside the square another one goes on, which faces away.
  std::vector<Vector3> points = square();
  std::vector<Vector3> normals(points.size(), {0, 0, 1});
  const std::size_t first = points.size();
  for (std::size_t j = 0; j < first; ++j) points.push_back(points[j] + Vector3(10, 0, -0.2));
  normals.resize(points.size(), {0, 0, -1});
  const PointSheet with(points, normals, 3);
  const PointSheet without(points, {}, 3);
  for (std::size_t j = 0; j < first; ++j) {
    EXPECT_EQ(with.about(static_cast<Index>(j))->ends, is_outermost(points[j])) << j;
    if (points[j].x() == 20 && points[j].y() > 3 && points[j].y() < 17)
      EXPECT_FALSE(without.about(static_cast<Index>(j))->ends) << j;
  }
}

TEST(PointSheet, SaysNothingOfPointsThatAreAlone) {
  std::vector<Vector3> points = square();
  points.emplace_back(10, 10, 50);
  EXPECT_FALSE(PointSheet(points, {}, 1).about(static_cast<Index>(points.size() - 1)).has_value());
  const std::vector<Vector3> few(points.begin(), points.begin() + 5);
  EXPECT_FALSE(PointSheet(few, {}, 10).about(0).has_value());
}

}  // namespace
}  // namespace vspring::point_sheet_test
