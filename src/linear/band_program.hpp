#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vspring {

/// Linear in the unknowns: Σ entries[k] x[first + k] + offset.
struct BandRow {
  static constexpr std::size_t most_width = 7;
  std::uint32_t first = 0;
  std::array<double, most_width> entries{};
  double offset = 0;
};

/// A least-squares problem with bounds, whose rows join unknowns that are near each other in their order.
struct BandProgram {
  std::size_t size = 0;   ///< number of unknowns
  std::size_t width = 4;  ///< of rows, at most BandRow::most_width
  std::vector<BandRow> terms;
  std::vector<BandRow> between;   ///< from −1 to 1
  std::vector<BandRow> positive;  ///< 0 or more
};

struct BandSolution {
  std::vector<double> x;
  double miss = 0;  ///< by how much the bound is missed that is missed most
  bool found = false;
};

/// The x of least Σ terms² within all bounds, by a primal-dual interior-point method with a predictor (S. Mehrotra, "On
/// the implementation of a primal-dual interior point method", SIAM J. Optim. 2, 1992), each of whose steps is solved
/// by an orthogonal factorisation. From x = 0, which need not be within. Cost: linear in the rows, times some 10 to 30
/// steps.
BandSolution solve(const BandProgram& program);

}  // namespace vspring
