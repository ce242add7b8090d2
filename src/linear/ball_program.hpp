#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vspring {

/// A convex program over blocks of K unknowns along curves: minimise Σ weight |row · x + offset|², with |row · x +
/// offset| ≤ bound for some rows, or with a price for exceeding it. A row involves the four blocks of a window.
template <int K>
struct BallProgram {
  static constexpr std::int32_t none = -1;
  /// Four blocks, `none` if fixed. They lie near each other.
  using Window = std::array<std::int32_t, 4>;

  struct Row {
    std::uint32_t window = 0;
    Eigen::Matrix<double, K, 4 * K> entries = Eigen::Matrix<double, K, 4 * K>::Zero();
    Eigen::Matrix<double, K, 1> offset = Eigen::Matrix<double, K, 1>::Zero();
    double weight = 0;
    double bound = 0;  ///< 0: none
    double price = 0;  ///< for exceeding the bound, in halves of the objective per length; 0: not allowed
  };

  std::size_t blocks = 0;
  std::vector<Window> windows;
  std::vector<Row> rows;
};

struct BallSolution {
  std::vector<double> x;  ///< K for each block
  bool found = false;     ///< whether x keeps all bounds without a price, and no such x is better by more than 1e-5
  int steps = 0;
  /// Per row: |row · x + offset|.
  std::vector<double> distances;
  /// Per row, the multiplier of its bound.
  std::vector<double> multipliers;
};

/// Solves a program by a primal-dual interior-point method with a predictor (Mehrotra 1992; Boyd and Vandenberghe,
/// Convex Optimization, §11.7), for constraints (|row · x + offset|² − bound²) / (2 bound) ≤ 0, or ≤ what is paid for.
/// x = 0 need not keep the bounds. If bounds are many, those without a price take part only once x comes near them. At
/// most 40 steps; each is linear.
template <int K>
BallSolution solve(const BallProgram<K>& program);

extern template BallSolution solve<1>(const BallProgram<1>&);
extern template BallSolution solve<2>(const BallProgram<2>&);

}  // namespace vspring
