#pragma once

#include <array>
#include <cstddef>

namespace vspring {

/// The derivatives at the origin of a height over a plane.
struct Jet {
  int degree = 0;                  ///< of the polynomial fitted; derivatives above it are zero
  std::array<double, 2> first{};   ///< by u, v
  std::array<double, 3> second{};  ///< by uu, uv, vv
  std::array<double, 4> third{};   ///< by uuu, uuv, uvv, vvv
};

/// Fits polynomials of up to fourth degree through the origin to heights by least squares (F. Cazals, M. Pouget,
/// "Estimating differential quantities using polynomial fitting of osculating jets", CAGD 22, 2005). They go through
/// the node itself, so ripples from node to node are not averaged away.
///
/// Uses the normal equations, with the monomials by degree. Elimination solves every lower degree on the way; if the
/// points do not determine a degree, the fit is that of the degree before. In coordinates of size 1 the normal
/// equations lose no more than half of the digits, and cost a third of a QR.
///
/// One object serves one fit after the other.
class JetFit {
 public:
  static constexpr std::size_t most_points = 96;

  void clear() noexcept { points_ = 0; }
  /// Adds a point at (u, v) with its height; `weight` counts squared. Coordinates must be of size 1. At most
  /// most_points.
  void add(double u, double v, double height, double weight) noexcept;

  /// The same bits whatever vector instructions the processor has.
  [[nodiscard]] Jet solve() const noexcept;

 private:
  /// The monomials of a point and its height, all times its weight; padded to whole vectors.
  struct alignas(32) Row {
    std::array<double, 16> entry;
  };

  template <std::size_t lanes>
  friend class NormalEquations;

  std::array<Row, most_points> rows_;
  std::size_t points_ = 0;
};

}  // namespace vspring
