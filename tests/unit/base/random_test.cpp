#include "base/random.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace vspring::random_test {
namespace {

TEST(Random, FollowsThePublishedAlgorithm) {
  // splitmix64 from 0 begins with these words; xoshiro256++ then gives rotl(s0 + s3, 23) + s0.
  const std::uint64_t s0 = 0xe220a8397b1dcdafU;
  const std::uint64_t s3 = 0xf88bb8a8724c81ecU;
  EXPECT_EQ(Random(0).next(), std::rotl(s0 + s3, 23) + s0);
  Random one(42);
  Random same(42);
  Random other(43);
  for (int k = 0; k < 100; ++k) {
    const std::uint64_t drawn = one.next();
    EXPECT_EQ(drawn, same.next());
    EXPECT_NE(drawn, other.next());
  }
}

TEST(Random, UniformNumbersFillTheirIntervalEvenly) {
  Random random(1);
  const int draws = 100000;
  std::vector<int> tenths(10, 0);
  double sum = 0;
  for (int k = 0; k < draws; ++k) {
    const double drawn = random.uniform();
    ASSERT_TRUE(drawn >= 0 && drawn < 1);
    ++tenths[static_cast<std::size_t>(drawn * 10)];
    sum += drawn;
  }
  // Five standard deviations.
  for (const int count : tenths) EXPECT_NEAR(count, draws / 10.0, 5 * std::sqrt(draws * 0.09));
  EXPECT_NEAR(sum / draws, 0.5, 5 / std::sqrt(12.0 * draws));
  const double between = random.uniform(-3, -2);
  EXPECT_TRUE(between >= -3 && between < -2);
}

TEST(Random, NormalDeviatesHaveTheirMoments) {
  Random random(2);
  const int draws = 100000;
  double sum = 0;
  double squares = 0;
  double fourth = 0;
  for (int k = 0; k < draws; ++k) {
    const double drawn = random.normal();
    sum += drawn;
    squares += drawn * drawn;
    fourth += std::pow(drawn, 4);
  }
  EXPECT_NEAR(sum / draws, 0, 5 / std::sqrt(1.0 * draws));
  EXPECT_NEAR(squares / draws, 1, 5 * std::sqrt(2.0 / draws));
  EXPECT_NEAR(fourth / draws, 3, 5 * std::sqrt(96.0 / draws));
}

TEST(Random, WholeNumbersAreEquallyLikely) {
  Random random(3);
  const int draws = 70000;
  std::vector<int> counts(7, 0);
  for (int k = 0; k < draws; ++k) ++counts.at(random.below(7));
  for (const int count : counts) EXPECT_NEAR(count, 10000, 5 * std::sqrt(10000.0 * 6 / 7));
  EXPECT_EQ(random.below(1), 0U);
  // The remainder of any 64-bit number by 3 · 2⁶² lies in the lowest third half of the time.
  const std::uint64_t most = std::uint64_t{3} << 62;
  int low = 0;
  for (int k = 0; k < draws; ++k) low += random.below(most) < (most / 3) ? 1 : 0;
  EXPECT_NEAR(low, draws / 3.0, 5 * std::sqrt(draws * 2.0 / 9));
}

}  // namespace
}  // namespace vspring::random_test
