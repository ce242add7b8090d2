#include "scan/low_pass.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace vspring {

namespace {

constexpr std::size_t most_degree = 200;
// Places at which responses are sampled.
constexpr std::size_t samples = 1024;
// Coefficients below are left out.
constexpr double negligible = 2e-5;

/// The response's expansion in Chebyshev's polynomials, by sums over their zeros; 1 at the eigenvalue 0.
std::vector<double> coefficients_of(const Band& band) {
  std::vector<double> c;
  std::size_t degree = 0;
  for (std::size_t n = 0; n <= most_degree; ++n) {
    double sum = 0;
    for (std::size_t k = 0; k < samples; ++k) {
      const double angle = std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(samples);
      sum += std::cos(static_cast<double>(n) * angle) / (1 + std::pow((1 - std::cos(angle)) / band.half, band.order));
    }
    c.push_back((n == 0 ? 1 : 2) * sum / static_cast<double>(samples));
    if (std::abs(c.back()) > negligible) degree = n;
  }
  c.resize(degree + 1);
  double constant = 0;
  for (const double one : c) constant += one;
  for (double& one : c) one /= constant;
  return c;
}

}  // namespace

LowPass::LowPass(std::span<const Band> bands) {
  for (const Band& one : bands) {
    coefficients_.push_back(coefficients_of(one));
    most_ = std::max(most_, coefficients_.back().size());
  }
}

}  // namespace vspring
