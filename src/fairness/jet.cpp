#include "fairness/jet.hpp"

namespace vspring {

namespace {

// The monomials of degree d end before terms[d], and that many points and a few more determine them.
constexpr std::array<std::size_t, 5> terms = {0, 2, 5, 9, 14};
constexpr std::array<std::size_t, 5> points_needed = {0, 2, 5, 11, 17};
// The square of the sine of the angle between a monomial and the space of those before it, as the points see them.
// On one side of a boundary it is some 1e-4; below this the points lie on a curve of lower degree.
constexpr double independent = 1e-6;

}  // namespace

void JetFit::add(double u, double v, double height, double weight) {
  const double uu = u * u;
  const double uv = u * v;
  const double vv = v * v;
  std::array<double, columns> row = {u,      v,       uu,      uv,      vv,      uu * u,  uu * v, vv * u,
                                     vv * v, uu * uu, uu * uv, uu * vv, uv * vv, vv * vv, height};
  for (double& entry : row) entry *= weight;
  for (std::size_t a = 0; a < columns; ++a) {
    for (std::size_t b = a; b < columns; ++b) products_[a][b] += row[a] * row[b];
  }
  ++points_;
}

Jet JetFit::solve() const {
  Jet jet;
  Matrix m = products_;
  std::size_t solved = 0;
  for (std::size_t k = 0; k < unknowns; ++k) {
    if (k == terms[static_cast<std::size_t>(jet.degree)] &&
        points_ < points_needed[static_cast<std::size_t>(jet.degree) + 1])
      break;
    if (!(m[k][k] > independent * products_[k][k])) break;
    for (std::size_t a = k + 1; a < unknowns; ++a) {
      const double factor = m[k][a] / m[k][k];
      for (std::size_t b = a; b < columns; ++b) m[a][b] -= factor * m[k][b];
    }
    if (k + 1 == terms[static_cast<std::size_t>(jet.degree) + 1]) {
      ++jet.degree;
      solved = k + 1;
    }
  }
  std::array<double, unknowns> c{};
  for (std::size_t k = solved; k-- > 0;) {
    double rest = m[k][unknowns];
    for (std::size_t b = k + 1; b < solved; ++b) rest -= m[k][b] * c[b];
    c[k] = rest / m[k][k];
  }
  jet.first = {c[0], c[1]};
  jet.second = {2 * c[2], c[3], 2 * c[4]};
  jet.third = {6 * c[5], 2 * c[6], 2 * c[7], 6 * c[8]};
  return jet;
}

}  // namespace vspring
