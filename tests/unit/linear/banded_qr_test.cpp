#include "linear/banded_qr.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "base/random.hpp"

namespace vspring::bending_matrix_test {
namespace {

struct Row {
  std::size_t first;
  std::array<double, BandedQr::width> entries;
};

/// Solves for two random right-hand sides; returns the largest error of GᵀG x against them, relative to theirs.
double residual(const std::vector<Row>& rows, std::size_t size, double closing_first = 0, double closing_last = 0) {
  BandedQr matrix(size);
  const bool closing = closing_first != 0 || closing_last != 0;
  const auto n = static_cast<Eigen::Index>(size);
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()) + 1, n);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    matrix.add_row(rows[r].first, rows[r].entries);
    for (std::size_t k = 0; k < BandedQr::width && rows[r].first + k < size; ++k)
      g(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(rows[r].first + k)) = rows[r].entries[k];
  }
  if (closing) {
    matrix.add_low_rank_row({{0, closing_first}, {size - 1, closing_last}});
    g(g.rows() - 1, 0) += closing_first;
    g(g.rows() - 1, n - 1) += closing_last;
  }
  Random random(7);
  std::vector<Eigen::Vector2d> x(size);
  for (Eigen::Vector2d& value : x) value = {random.uniform(-1, 1), random.uniform(-1, 1)};
  Eigen::MatrixXd right(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) right.row(i) = x[static_cast<std::size_t>(i)];
  matrix.solve(x);
  Eigen::MatrixXd solved(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) solved.row(i) = x[static_cast<std::size_t>(i)];
  const Eigen::MatrixXd expected = (g.transpose() * g).ldlt().solve(right);
  return (solved - expected).norm() / expected.norm();
}

/// Curvatures along a chain that is held at both ends and has tangents there, of unit spacing.
std::vector<Row> clamped(std::size_t size) {
  std::vector<Row> rows = {{0, {1, 0, 0}}, {0, {-2, 1, 0}}};
  for (std::size_t i = 0; i + 2 < size; ++i) rows.push_back({i, {1, -2, 1}});
  rows.push_back({size - 2, {1, -2, 0}});
  rows.push_back({size - 1, {1, 0, 0}});
  return rows;
}

TEST(BandedQr, SolvesAsTheDenseMatrixDoes) {
  for (const std::size_t size : {2U, 3U, 10U, 40U}) EXPECT_LT(residual(clamped(size), size), 1e-8) << size;
  Random random(3);
  for (const std::size_t size : {1U, 2U, 3U, 8U, 30U}) {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < size; ++i) {
      for (int twice = 0; twice < 2; ++twice) {
        Row row = {i, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}};
        for (std::size_t k = size - i; k < BandedQr::width; ++k) row.entries[k] = 0;
        rows.push_back(row);
      }
    }
    EXPECT_LT(residual(rows, size), 1e-9) << size;
  }
}

TEST(BandedQr, AClosingRowJoinsTheFirstColumnWithTheLast) {
  for (const std::size_t size : {1U, 2U, 3U, 10U, 40U}) {
    std::vector<Row> rows = size < 2 ? std::vector<Row>{{0, {1, 0, 0}}} : clamped(size);
    EXPECT_LT(residual(rows, size, 0.7, -1.3), 1e-8) << size;
    EXPECT_LT(residual(rows, size, 0, 2), 1e-8) << size;
  }
}

TEST(BandedQr, AColumnThatNoRowTouchesIsLeftAlone) {
  BandedQr matrix(3);
  matrix.add_row(0, {2, 0, 0});
  matrix.add_row(2, {4, 0, 0});
  std::vector<Eigen::Vector2d> x(3, Eigen::Vector2d(8, 16));
  matrix.solve(x);
  EXPECT_EQ(x[0], Eigen::Vector2d(2, 4));
  EXPECT_EQ(x[1], Eigen::Vector2d(8, 16));
  EXPECT_EQ(x[2], Eigen::Vector2d(0.5, 1));
}

TEST(BandedQr, SolvesWhereTheProductInDoublePrecisionIsNoLongerDefinite) {
  // The deflection of a clamped beam of n + 1 edges under even load is x²(n + 1 − x)²/24; the condition of GᵀG is about
  // (n/π)⁴, so that from 30,000 nodes on its factorisation breaks down.
  for (const std::size_t size : {1000U, 30000U, 100000U}) {
    BandedQr matrix(size);
    // Half a curvature at each clamped end.
    matrix.add_row(0, {std::sqrt(2.0), 0, 0});
    for (const Row& row : clamped(size)) {
      if (row.first == 0 && row.entries[0] == 1 && row.entries[1] == 0) continue;
      if (row.first == size - 1) continue;
      matrix.add_row(row.first, row.entries);
    }
    matrix.add_row(size - 1, {std::sqrt(2.0), 0, 0});
    std::vector<Eigen::Vector2d> x(size, Eigen::Vector2d(1, -1));
    matrix.solve(x);
    const double middle = static_cast<double>(size + 1) / 2;
    const double expected = std::pow(middle, 4) / 24;
    EXPECT_NEAR(x[(size - 1) / 2].x() / expected, 1, 1e-3) << size;
    EXPECT_EQ(x[size / 2].x(), -x[size / 2].y());
  }
}

}  // namespace
}  // namespace vspring::bending_matrix_test
