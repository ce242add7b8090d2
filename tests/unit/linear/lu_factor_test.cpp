#include "linear/lu_factor.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/cancellation.hpp"
#include "support/curves.hpp"

namespace vspring::lu_factor_test {
namespace {

using namespace support;
using Matrix = Eigen::SparseMatrix<double>;

/// Of a grid of nodes of so many unknowns, each with its eight neighbours, and one node with all. Small diagonals ask
/// for exchanged rows.
Matrix grid_with_hub(int side, int unknowns) {
  Draw draw(3);
  std::vector<Eigen::Triplet<double>> entries;
  const auto couple = [&](int a, int b) {
    for (int r = 0; r < unknowns; ++r) {
      for (int c = 0; c < unknowns; ++c)
        entries.emplace_back(unknowns * a + r, unknowns * b + c, draw.uniform(-1, 1) * (a == b ? 0.1 : 1));
    }
  };
  for (int i = 0; i < side * side; ++i) {
    for (int di = -1; di <= 1; ++di) {
      for (int dj = -1; dj <= 1; ++dj) {
        const int row = i / side + di;
        const int column = i % side + dj;
        if (row >= 0 && row < side && column >= 0 && column < side) couple(i, row * side + column);
      }
    }
    if (i > side + 1) couple(0, i);
    if (i > side + 1) couple(i, 0);
  }
  const Eigen::Index size = Eigen::Index{unknowns} * side * side;
  Matrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::VectorXd right_side(const Matrix& matrix) { return Eigen::VectorXd::LinSpaced(matrix.rows(), -1, 2); }

TEST(LuFactor, HasTheBitsOfEigens) {
  for (const int side : {1, 2, 5, 12}) {
    for (const int unknowns : {1, 3}) {
      const Matrix matrix = grid_with_hub(side, unknowns);
      Eigen::SparseLU<Matrix, EliminationOrder> expected;
      expected.analyzePattern(matrix);
      expected.factorize(matrix);
      LuFactor factor;
      factor.analyzePattern(matrix);
      factor.factorize(matrix);
      ASSERT_EQ(factor.info(), Eigen::Success);
      const Eigen::VectorXd right = right_side(matrix);
      const Eigen::VectorXd solution = factor.solve(right);
      const Eigen::VectorXd of_eigen = expected.solve(right);
      EXPECT_EQ(solution, of_eigen);
      EXPECT_LT((matrix * solution - right).norm(), 1e-7 * right.norm());
    }
  }
}

/// Of nodes along a curve, each with the next two on both sides.
Matrix band(int nodes, bool is_closed) {
  Draw draw(4);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < nodes; ++i) {
    for (int step = -2; step <= 2; ++step) {
      const int j = is_closed ? (i + step + nodes) % nodes : i + step;
      if (j >= 0 && j < nodes) entries.emplace_back(i, j, draw.uniform(-1, 1) * (step == 0 ? 0.1 : 1));
    }
  }
  Matrix matrix(nodes, nodes);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// By minimum degree curves of a million nodes would take seconds to be put in order, and none of that can be broken
// off.
TEST(LuFactor, TakesCurvesInTheirOwnOrder) {
  const auto is_kept = [](const Matrix& matrix) {
    EliminationOrder::PermutationType order;
    EliminationOrder()(matrix, order);
    return (order.indices().array() == Eigen::ArrayXi::LinSpaced(order.size(), 0, static_cast<int>(order.size()) - 1))
        .all();
  };
  for (const bool is_closed : {false, true}) {
    const Matrix matrix = band(3000, is_closed);
    EXPECT_TRUE(is_kept(matrix));
    LuFactor factor;
    factor.analyzePattern(matrix);
    factor.factorize(matrix);
    ASSERT_EQ(factor.info(), Eigen::Success);
    const Eigen::VectorXd right = right_side(matrix);
    EXPECT_LT((matrix * factor.solve(right) - right).norm(), 1e-7 * right.norm());
    EXPECT_LT(factor.nnzL() + factor.nnzU(), 60 * matrix.cols());
  }
  EXPECT_FALSE(is_kept(grid_with_hub(12, 3)));
}

TEST(LuFactor, SaysWhereThereIsNone) {
  Matrix matrix = grid_with_hub(4, 1);
  for (Matrix::InnerIterator entry(matrix, 5); entry; ++entry) entry.valueRef() = 0;
  LuFactor factor;
  factor.analyzePattern(matrix);
  factor.factorize(matrix);
  EXPECT_NE(factor.info(), Eigen::Success);
}

TEST(LuFactor, EndsWhereItIsCancelledAndIsMadeAnew) {
  const Matrix matrix = grid_with_hub(12, 3);
  const Eigen::VectorXd right = right_side(matrix);
  LuFactor factor;
  factor.analyzePattern(matrix);
  factor.factorize(matrix);
  const Eigen::VectorXd expected = factor.solve(right);
  Context context;
  context.cancel();
  {
    const CancellationScope scope(context);
    EXPECT_THROW(factor.factorize(matrix), Cancelled);
  }
  EXPECT_NE(factor.info(), Eigen::Success);
  factor.factorize(matrix);
  const Eigen::VectorXd solution = factor.solve(right);
  EXPECT_EQ(solution, expected);
}

}  // namespace
}  // namespace vspring::lu_factor_test
