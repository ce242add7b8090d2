#include "curve_fit/outliers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vspring::outliers_test {
namespace {

std::vector<Vector3> wave(int rows) {
  std::vector<Vector3> places;
  places.reserve(static_cast<std::size_t>(rows));
  for (int k = 0; k < rows; ++k) places.emplace_back(k, 10 * std::sin(0.1 * k), 0);
  return places;
}

TEST(Spikes, ThereAreNoneOnAWayWithSharpTurns) {
  std::vector<Vector3> rows = wave(60);
  for (int k = 58; k >= 0; --k) rows.push_back(rows[static_cast<std::size_t>(k)]);
  const auto spikes = find_spikes(rows, false, 20);
  EXPECT_EQ(std::count(spikes.begin(), spikes.end(), 1), 0);
}

TEST(Spikes, AreFoundAloneAndInRunsOfThreeAndAThousandTimesOff) {
  std::vector<Vector3> rows = wave(100);
  rows[20].y() += 30;
  for (const std::size_t k : {50U, 51U, 52U}) rows[k].y() -= 40;
  rows[80] *= 1000;
  const auto spikes = find_spikes(rows, false, 20);
  for (std::size_t k = 0; k < rows.size(); ++k)
    EXPECT_EQ(spikes[k], k == 20 || (k >= 50 && k <= 52) || k == 80 ? 1 : 0) << k;
  // Of too many the furthest.
  const auto one = find_spikes(rows, false, 1);
  EXPECT_EQ(std::count(one.begin(), one.end(), 1), 1);
  EXPECT_EQ(one[80], 1);
}

TEST(Spikes, LieAtLeastSoFarAsideAsIsAsked) {
  std::vector<Vector3> rows = wave(100);
  rows[20].y() += 30;
  rows[60].y() += 15;
  const auto spikes = find_spikes(rows, false, 20, 20);
  for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_EQ(spikes[k], k == 20 ? 1 : 0) << k;
}

TEST(Spikes, NotTheRowsBetweenTwoOfThem) {
  std::vector<Vector3> rows = wave(100);
  rows[40].y() += 60;
  rows[43].y() += 60;
  const auto spikes = find_spikes(rows, false, 2);
  for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_EQ(spikes[k], k == 40 || k == 43 ? 1 : 0) << k;
}

TEST(Spikes, OfAFewEdgesAreFoundButNotWhereTheWayGoesOnStraight) {
  std::vector<Vector3> rows = wave(100);
  rows[20].y() += 4;
  for (const std::size_t k : {50U, 51U, 52U}) rows[k].y() -= 5;
  const auto spikes = find_spikes(rows, false, 20);
  for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_EQ(spikes[k], k == 20 || (k >= 50 && k <= 52) ? 1 : 0) << k;
  // Out and back, with its tip four edges on.
  std::vector<Vector3> tip;
  tip.reserve(61);
  for (int k = 0; k < 30; ++k) tip.emplace_back(k, 0, 0);
  tip.emplace_back(33, 0, 0);
  for (int k = 29; k >= 0; --k) tip.emplace_back(k, 0.2, 0);
  const auto none = find_spikes(tip, false, 20);
  EXPECT_EQ(std::count(none.begin(), none.end(), 1), 0);
}

}  // namespace
}  // namespace vspring::outliers_test
