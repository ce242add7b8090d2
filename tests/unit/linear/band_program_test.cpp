#include "linear/band_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.hpp"

namespace vspring::band_program_test {
namespace {

BandRow row(std::uint32_t first, std::initializer_list<double> entries, double offset) {
  BandRow result{.first = first, .offset = offset};
  std::copy(entries.begin(), entries.end(), result.entries.begin());
  return result;
}

/// Values at even places, of least second differences.
BandProgram spline(std::size_t size) {
  BandProgram program;
  program.size = size;
  for (std::uint32_t k = 0; k + 2 < size; ++k) program.terms.push_back(row(k, {1, -2, 1}, 0));
  return program;
}

double at(const BandRow& row, const std::vector<double>& x) {
  double sum = row.offset;
  for (std::size_t k = 0; k < BandRow::most_width && row.first + k < x.size(); ++k)
    sum += row.entries[k] * x[row.first + k];
  return sum;
}

TEST(BandProgram, FindsLeastSquaresThatNoBoundHolds) {
  BandProgram program = spline(20);
  for (std::uint32_t k = 0; k < 20; ++k) program.terms.push_back(row(k, {1}, -0.1 * k));
  program.between.push_back(row(5, {0.01}, 0));
  const BandSolution solution = solve(program);
  ASSERT_TRUE(solution.found);
  for (std::size_t k = 0; k < 20; ++k) EXPECT_NEAR(solution.x[k], 0.1 * static_cast<double>(k), 1e-3);
}

TEST(BandProgram, PassesBetweenBoundsWithTheLeastTerms) {
  // Through three gates of half-width 1 about 0, 3 and 0: the broken line that bends least touches all three.
  BandProgram program = spline(21);
  program.between = {row(0, {1}, 0), row(10, {1}, -3), row(20, {1}, 0)};
  const BandSolution solution = solve(program);
  ASSERT_TRUE(solution.found);
  EXPECT_NEAR(solution.x[0], 1, 1e-3);
  EXPECT_NEAR(solution.x[10], 2, 1e-3);
  EXPECT_NEAR(solution.x[20], 1, 1e-3);
  // Between gates its third differences vanish: a natural cubic spline.
  for (std::size_t k = 1; k < 8; ++k)
    EXPECT_NEAR(solution.x[k + 3] - 3 * solution.x[k + 2] + 3 * solution.x[k + 1] - solution.x[k],
                solution.x[k + 2] - 3 * solution.x[k + 1] + 3 * solution.x[k] - solution.x[k - 1], 1e-4);
}

TEST(BandProgram, KeepsSignsToo) {
  BandProgram program;
  program.size = 30;
  Random random(3);
  for (std::uint32_t k = 0; k < 30; ++k) program.terms.push_back(row(k, {1}, -0.1 * k - random.uniform(-1, 1)));
  for (std::uint32_t k = 0; k + 1 < 30; ++k) program.positive.push_back(row(k, {-1, 1}, 0));
  const BandSolution solution = solve(program);
  ASSERT_TRUE(solution.found);
  double blocks = 0;
  for (const BandRow& rises : program.positive) {
    EXPECT_GE(at(rises, solution.x), -1e-6);
    blocks += at(rises, solution.x) < 1e-3 ? 1 : 0;
  }
  // The isotonic regression of a noisy line is flat over most of it, and its residuals add up to nothing.
  EXPECT_GT(blocks, 10);
  double sum = 0;
  for (const BandRow& term : program.terms) sum += at(term, solution.x);
  EXPECT_NEAR(sum, 0, 1e-2);
}

TEST(BandProgram, SaysWhereBoundsExcludeEachOther) {
  BandProgram program = spline(10);
  program.between = {row(4, {1}, 0), row(4, {1}, -3)};
  const BandSolution solution = solve(program);
  EXPECT_FALSE(solution.found);
  EXPECT_GT(solution.miss, 0.1);
}

TEST(BandProgram, SolvesWhereTheSquareWouldHaveNoFactor) {
  // Third differences of 1,000 values: 1e18 when squared.
  BandProgram program;
  program.size = 1000;
  for (std::uint32_t k = 0; k + 3 < program.size; ++k) program.terms.push_back(row(k, {-1, 3, -3, 1}, 0));
  program.terms.push_back(row(3, {1}, -1));
  program.between = {row(0, {10}, -10), row(999, {10}, -10), row(500, {10}, 0)};
  const BandSolution solution = solve(program);
  ASSERT_TRUE(solution.found);
  for (const BandRow& gate : program.between) EXPECT_LE(std::abs(at(gate, solution.x)), 1 + 1e-5);
  EXPECT_NEAR(solution.x[3], 1, 0.01);
}

}  // namespace
}  // namespace vspring::band_program_test
