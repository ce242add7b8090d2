#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "vspring/types.hpp"

namespace vspring {

/// Random numbers that are the same on every platform, unlike those of the distributions in <random>.
/// xoshiro256++ (Blackman and Vigna 2021) with its state filled by splitmix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) {
    for (std::uint64_t& word : state_) {
      seed += 0x9e3779b97f4a7c15U;
      word = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9U;
      word = (word ^ (word >> 27)) * 0x94d049bb133111ebU;
      word ^= word >> 31;
    }
  }

  /// Uniform among all 64-bit numbers.
  std::uint64_t next() {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// Uniform in [0, 1): multiples of 2⁻⁵³.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Uniform among 0 … count − 1, for count > 0.
  std::uint64_t below(std::uint64_t count) {
    // Numbers from the largest multiple of count upwards would favour small remainders.
    const std::uint64_t excess = (~std::uint64_t{0} % count + 1) % count;
    std::uint64_t drawn = next();
    while (drawn > ~std::uint64_t{0} - excess) drawn = next();
    return drawn % count;
  }

  /// Normally distributed with mean 0 and variance 1 (Marsaglia's polar method).
  double normal() {
    for (;;) {
      const double x = uniform(-1, 1);
      const double y = uniform(-1, 1);
      const double square = x * x + y * y;
      if (square > 0 && square < 1) return x * std::sqrt(-2 * std::log(square) / square);
    }
  }

  /// Uniform in the unit ball.
  Vector3 in_ball() {
    for (;;) {
      const double x = uniform(-1, 1);
      const double y = uniform(-1, 1);
      const double z = uniform(-1, 1);
      if (x * x + y * y + z * z <= 1) return {x, y, z};
    }
  }

 private:
  std::array<std::uint64_t, 4> state_{};
};

}  // namespace vspring
