#include "linear/ball_program.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

namespace vspring::ball_program_test {
namespace {

/// One block that is drawn to a place and may be at most so far from the origin.
template <int K>
BallProgram<K> drawn_to(const Eigen::Matrix<double, K, 1>& place, double bound) {
  BallProgram<K> program;
  program.blocks = 1;
  program.windows.push_back({0, -1, -1, -1});
  typename BallProgram<K>::Row pull;
  pull.entries.template leftCols<K>().setIdentity();
  typename BallProgram<K>::Row held = pull;
  pull.offset = -place;
  pull.weight = 1;
  held.bound = bound;
  program.rows = {pull, held};
  return program;
}

TEST(BallProgram, EndsAtTheBoundInTheDirectionOfThePull) {
  const BallSolution on_line = solve(drawn_to<1>(Eigen::Matrix<double, 1, 1>(3), 1));
  EXPECT_TRUE(on_line.found);
  EXPECT_NEAR(on_line.x[0], 1, 1e-4);
  EXPECT_GT(on_line.multipliers[1], 0);
  const BallSolution in_plane = solve(drawn_to<2>({3, 4}, 1));
  EXPECT_TRUE(in_plane.found);
  EXPECT_NEAR(in_plane.x[0], 0.6, 1e-4);
  EXPECT_NEAR(in_plane.x[1], 0.8, 1e-4);
}

TEST(BallProgram, ABoundThatIsWideChangesNothing) {
  const BallSolution free = solve(drawn_to<2>({3, 4}, 10));
  EXPECT_TRUE(free.found);
  EXPECT_NEAR(free.x[0], 3, 1e-3);
  EXPECT_NEAR(free.x[1], 4, 1e-3);
}

TEST(BallProgram, BoundsThatAreFarAwayAtFirstAreKept) {
  constexpr std::size_t blocks = 4096;
  constexpr double step = 0.5 / blocks;
  BallProgram<1> program;
  program.blocks = blocks;
  for (std::size_t i = 0; i < blocks; ++i) {
    BallProgram<1> one = drawn_to<1>(Eigen::Matrix<double, 1, 1>(3), 1);
    program.windows.push_back({static_cast<std::int32_t>(i), -1, -1, -1});
    for (auto& row : one.rows) row.window = static_cast<std::uint32_t>(i);
    one.rows[1].offset[0] = step * static_cast<double>(i);
    program.rows.insert(program.rows.end(), one.rows.begin(), one.rows.end());
  }
  const BallSolution solution = solve(program);
  EXPECT_TRUE(solution.found);
  for (std::size_t i = 0; i < blocks; ++i) {
    EXPECT_NEAR(solution.x[i], 1 - step * static_cast<double>(i), 1e-4);
    EXPECT_GT(solution.multipliers[2 * i + 1], 0);
  }
}

TEST(BallProgram, BoundsAtWhoseMiddleAllBeginsAreKept) {
  BallProgram<1> program = drawn_to<1>(Eigen::Matrix<double, 1, 1>(3), 1);
  program.rows.push_back(program.rows[1]);
  EXPECT_NEAR(solve(program).x[0], 1, 1e-4);
}

TEST(BallProgram, SaysWhereBoundsLeaveNothing) {
  BallProgram<1> program = drawn_to<1>(Eigen::Matrix<double, 1, 1>(3), 1);
  auto other = program.rows[1];
  other.offset[0] = -5;
  program.rows.push_back(other);
  EXPECT_FALSE(solve(program).found);
}

TEST(BallProgram, ABoundWithAPriceGivesWayWhereThePullIsWorthMore) {
  BallProgram<1> program = drawn_to<1>(Eigen::Matrix<double, 1, 1>(3), 1);
  // x − 3 + price · x = 0 beyond the bound.
  program.rows[1].price = 0.5;
  const BallSolution cheap = solve(program);
  EXPECT_TRUE(cheap.found);
  EXPECT_NEAR(cheap.x[0], 2, 1e-4);
  EXPECT_NEAR(cheap.distances[1], 2, 1e-4);
  program.rows[1].price = 100;
  EXPECT_NEAR(solve(program).x[0], 1, 1e-4);
}

TEST(BallProgram, OfTwoBoundsThatLeaveNothingTheOneWithoutAPriceIsKept) {
  BallProgram<1> program = drawn_to<1>(Eigen::Matrix<double, 1, 1>(3), 1);
  auto other = program.rows[1];
  other.offset[0] = -5;
  other.price = 1000;
  program.rows.push_back(other);
  const BallSolution solution = solve(program);
  EXPECT_TRUE(solution.found);
  EXPECT_NEAR(solution.x[0], 1, 1e-4);
}

}  // namespace
}  // namespace vspring::ball_program_test
