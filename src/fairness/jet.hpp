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
class JetFit {
 public:
  /// A point at (u, v) with its height; `weight` counts squared. Coordinates of size 1.
  void add(double u, double v, double height, double weight);

  [[nodiscard]] Jet solve() const;

 private:
  static constexpr std::size_t unknowns = 14;
  static constexpr std::size_t columns = unknowns + 1;  // the last one: heights
  using Matrix = std::array<std::array<double, columns>, columns>;

  Matrix products_{};  // upper triangle
  std::size_t points_ = 0;
};

}  // namespace vspring
