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
/// "Estimating differential quantities using polynomial fitting of osculating jets", CAGD 22, 2005). Through the node
/// itself, so that a ripple from node to node is seen and not averaged away.
///
/// The normal equations, with the monomials in the order of their degree: as elimination goes, every lower degree is
/// solved on the way, and where the points cannot tell a degree from those below it, the fit is that of the degree
/// before. In coordinates of size 1 they lose no more than half of the digits, and cost a third of a QR.
///
/// Room for one fit after the other.
class JetFit {
 public:
  static constexpr std::size_t most_points = 96;

  void clear() noexcept { points_ = 0; }
  /// A point at (u, v) with its height; `weight` counts squared. Coordinates of size 1. No more than most_points.
  void add(double u, double v, double height, double weight) noexcept;

  /// The same bits whatever vector instructions the processor has.
  [[nodiscard]] Jet solve() const noexcept;

 private:
  /// The monomials of a point and its height, all times its weight; filled up to whole vectors.
  struct alignas(32) Row {
    std::array<double, 16> entry;
  };

  template <std::size_t lanes>
  friend class NormalEquations;

  std::array<Row, most_points> rows_;
  std::size_t points_ = 0;
};

}  // namespace vspring
