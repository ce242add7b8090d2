#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vspring {

/// A convex program over blocks of K unknowns along curves: least Σ weight |row · x + offset|² with |row · x + offset|
/// ≤ bound for some of the rows, or with a price for what some are beyond. Rows see the four blocks of a window.
template <int K>
struct BallProgram {
  static constexpr std::int32_t none = -1;
  /// Four blocks, `none` for what does not move. They lie near each other.
  using Window = std::array<std::int32_t, 4>;

  struct Row {
    std::uint32_t window = 0;
    Eigen::Matrix<double, K, 4 * K> entries = Eigen::Matrix<double, K, 4 * K>::Zero();
    Eigen::Matrix<double, K, 1> offset = Eigen::Matrix<double, K, 1>::Zero();
    double weight = 0;
    double bound = 0;  ///< 0: none
    double price = 0;  ///< of what it is beyond, in halves of the objective a length; 0: it may not be
  };

  std::size_t blocks = 0;
  std::vector<Window> windows;
  std::vector<Row> rows;
};

struct BallSolution {
  std::vector<double> x;  ///< K for each block
  bool found = false;     ///< all bounds without a price are kept, and no x that keeps them is better by more than 1e-5
  int steps = 0;
  /// Of each row: |row · x + offset|.
  std::vector<double> distances;
  /// For each row, the multiplier of its bound.
  std::vector<double> multipliers;
};

/// By a primal-dual interior-point method with a predictor (Mehrotra 1992; Boyd and Vandenberghe, Convex Optimization,
/// §11.7), for constraints (|row · x + offset|² − bound²) / (2 bound) ≤ 0, or ≤ what is paid for. x = 0 need not keep
/// the bounds. Of many bounds those without a price have a part once x comes near
/// them. At most 40 steps. Cost of one: linear.
template <int K>
BallSolution solve(const BallProgram<K>& program);

extern template BallSolution solve<1>(const BallProgram<1>&);
extern template BallSolution solve<2>(const BallProgram<2>&);

}  // namespace vspring
