#include "noise/low_pass.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace vspring {

namespace {

constexpr std::size_t most_degree = 200;
// Places at which responses are sampled.
constexpr std::size_t samples = 1024;
// Smaller coefficients are left out.
constexpr double negligible = 2e-5;

/// Cuts off what is negligible at the end; the rest gives 1 at the eigenvalue 0.
void finish(std::vector<double>& c) {
  const auto is_kept = [](double one) { return std::abs(one) > negligible; };
  c.resize(std::max<std::size_t>(1, static_cast<std::size_t>(c.rend() - std::find_if(c.rbegin(), c.rend(), is_kept))));
  double constant = 0;
  for (const double one : c) constant += one;
  for (double& one : c) one /= constant;
}

}  // namespace

// The responses' expansions in Chebyshev's polynomials, by sums over their zeros: waves are the same for all bands.
LowPass::LowPass(std::span<const Band> bands) : coefficients_(bands.size()) {
  std::vector<double> angles;
  for (std::size_t k = 0; k < samples; ++k)
    angles.push_back(std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(samples));
  std::vector<std::vector<double>> divisors;
  for (const Band& band : bands) {
    divisors.emplace_back();
    for (const double angle : angles)
      divisors.back().push_back(1 + std::pow((1 - std::cos(angle)) / band.half, band.order));
  }
  std::vector<double> wave(samples);
  for (std::size_t n = 0; n <= most_degree; ++n) {
    for (std::size_t k = 0; k < samples; ++k) wave[k] = std::cos(static_cast<double>(n) * angles[k]);
    for (std::size_t b = 0; b < bands.size(); ++b) {
      double sum = 0;
      for (std::size_t k = 0; k < samples; ++k) sum += wave[k] / divisors[b][k];
      coefficients_[b].push_back((n == 0 ? 1 : 2) * sum / static_cast<double>(samples));
    }
  }
  for (std::vector<double>& c : coefficients_) {
    finish(c);
    most_ = std::max(most_, c.size());
  }
}

}  // namespace vspring
