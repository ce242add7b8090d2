#include "fairness/jet.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/random.hpp"

namespace vspring::jet_test {
namespace {

constexpr std::size_t unknowns = 14;

struct Point {
  double u;
  double v;
  double height;
  double weight;
};

/// The normal equations without any room for haste: all sums, then elimination from the top.
std::array<double, unknowns> by_the_book(const std::vector<Point>& points) {
  std::array<std::array<double, unknowns + 1>, unknowns + 1> m{};
  for (const auto& [u, v, height, weight] : points) {
    const double uu = u * u;
    const double uv = u * v;
    const double vv = v * v;
    std::array<double, unknowns + 1> row = {u,      v,       uu,      uv,      vv,      uu * u,  uu * v, vv * u,
                                            vv * v, uu * uu, uu * uv, uu * vv, uv * vv, vv * vv, height};
    for (double& entry : row) entry *= weight;
    for (std::size_t a = 0; a <= unknowns; ++a) {
      for (std::size_t b = a; b <= unknowns; ++b) m[a][b] += row[a] * row[b];
    }
  }
  for (std::size_t k = 0; k < unknowns; ++k) {
    for (std::size_t a = k + 1; a < unknowns; ++a) {
      const double factor = m[k][a] / m[k][k];
      for (std::size_t b = a; b <= unknowns; ++b) m[a][b] -= factor * m[k][b];
    }
  }
  std::array<double, unknowns> c{};
  for (std::size_t k = unknowns; k-- > 0;) {
    double rest = m[k][unknowns];
    for (std::size_t b = k + 1; b < unknowns; ++b) rest -= m[k][b] * c[b];
    c[k] = rest / m[k][k];
  }
  return c;
}

std::vector<Point> scattered(std::size_t count, Random& random) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < count; ++k) {
    const double u = random.uniform(-1.5, 1.5);
    const double v = random.uniform(-1.5, 1.5);
    points.push_back({u, v, random.uniform(-1, 1), 1 / std::sqrt(0.25 + u * u + v * v)});
  }
  return points;
}

Jet fitted(const std::vector<Point>& points) {
  JetFit fit;
  for (const Point& point : points) fit.add(point.u, point.v, point.height, point.weight);
  return fit.solve();
}

TEST(JetFit, HasTheBitsOfPlainElimination) {
  Random random(7);
  for (const std::size_t count : {17U, 20U, 36U, 96U}) {
    const std::vector<Point> points = scattered(count, random);
    const std::array<double, unknowns> c = by_the_book(points);
    const Jet jet = fitted(points);
    EXPECT_EQ(jet.degree, 4);
    EXPECT_EQ(jet.first, (std::array{c[0], c[1]}));
    EXPECT_EQ(jet.second, (std::array{2 * c[2], c[3], 2 * c[4]}));
    EXPECT_EQ(jet.third, (std::array{6 * c[5], 2 * c[6], 2 * c[7], 6 * c[8]}));
  }
}

TEST(JetFit, HasTheDegreeThatPointsTell) {
  Random random(3);
  const std::pair<std::size_t, int> degrees[] = {{1, 0}, {2, 1}, {4, 1}, {5, 2}, {10, 2}, {11, 3}, {16, 3}, {17, 4}};
  for (const auto& [count, degree] : degrees) EXPECT_EQ(fitted(scattered(count, random)).degree, degree) << count;
  // On a circle u² + v² is no unknown of its own.
  std::vector<Point> circle;
  circle.reserve(40);
  for (int k = 0; k < 40; ++k) circle.push_back({std::cos(0.15 * k), std::sin(0.15 * k), 0.1 * k, 1});
  EXPECT_LT(fitted(circle).degree, 4);
}

TEST(JetFit, BeginsAnew) {
  Random random(5);
  const std::vector<Point> points = scattered(30, random);
  JetFit fit;
  for (const Point& point : scattered(40, random)) fit.add(point.u, point.v, point.height, point.weight);
  fit.clear();
  for (const Point& point : points) fit.add(point.u, point.v, point.height, point.weight);
  EXPECT_EQ(fit.solve().third, fitted(points).third);
}

}  // namespace
}  // namespace vspring::jet_test
