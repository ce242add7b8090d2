#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "spring/link_edges.hpp"
#include "spring/near_nodes.hpp"
#include "spring/net.hpp"

namespace vspring {

/// Calls use(0) … use(n − 1) with compile-time constants, so arrays indexed by them stay in registers.
template <std::size_t n, typename Use>
void unrolled(const Use& use) {
  [&]<std::size_t... k>(std::index_sequence<k...>) { (use(std::integral_constant<std::size_t, k>()), ...); }
  (std::make_index_sequence<n>());
}

/// Value: a number, or one for each of several nodes.
template <std::size_t n, typename Value = double>
using Unknowns = std::array<Value, n>;

/// The lower triangle of a symmetric matrix, row by row.
template <std::size_t n, typename Value = double>
struct LowerTriangle {
  std::array<Value, n*(n + 1) / 2> values = {};

  Value& operator()(std::size_t row, std::size_t column) { return values[row * (row + 1) / 2 + column]; }
};

// Unknowns without data become zero.
inline double inverse_of_pivot(double pivot) { return pivot > 0 ? 1 / pivot : 0; }

template <int count>
Eigen::Array<double, count, 1> inverse_of_pivot(const Eigen::Array<double, count, 1>& pivots) {
  return (pivots > 0).select(pivots.inverse(), 0);
}

/// Replaces b by x of a x = b, for a symmetric positive definite a, and a by its factor L of L D Lᵀ.
template <std::size_t n, typename Value>
void solve_in_place(LowerTriangle<n, Value>& a, Unknowns<n, Value>& b) {
  Unknowns<n, Value> inverse;
  for (std::size_t j = 0; j < n; ++j) {
    // Row j of L D, then of L.
    for (std::size_t k = 0; k < j; ++k) {
      for (std::size_t m = 0; m < k; ++m) a(j, k) -= a(k, m) * a(j, m);
    }
    Value pivot = a(j, j);
    for (std::size_t k = 0; k < j; ++k) {
      const Value entry = a(j, k) * inverse[k];
      pivot -= a(j, k) * entry;
      b[j] -= entry * b[k];
      a(j, k) = entry;
    }
    inverse[j] = inverse_of_pivot(pivot);
  }
  for (std::size_t j = n; j-- > 0;) {
    b[j] *= inverse[j];
    for (std::size_t m = j + 1; m < n; ++m) b[j] -= a(m, j) * b[m];
  }
}

/// Σ r rᵀ of rows r of n numbers and a right side; on and above its diagonal, without the last row. Sums pairs of
/// columns, each as fast as one.
template <std::size_t n>
class RowProducts {
 public:
  RowProducts() {
    for (auto& row : sums_) row.fill(Pair::Zero());
  }

  /// Adds a row and its right side, both times a weight.
  void add(const Unknowns<n>& row, double right, double weight) {
    const auto at = [&](std::size_t c) { return c < n ? row[c] : c == n ? right : 0.0; };
    std::array<Pair, pairs> weighted;
    unrolled<pairs>([&](auto p) { weighted[p] = Pair(at(2 * p), at(2 * p + 1)) * weight; });
    unrolled<n>([&](auto r) {
      const double left = weighted[r / 2][r % 2];
      unrolled<pairs - r / 2>([&](auto p) { sums_[r][r / 2 + p] += left * weighted[r / 2 + p]; });
    });
  }

  [[nodiscard]] double operator()(std::size_t r, std::size_t c) const {
    return sums_[r][c / 2][static_cast<Eigen::Index>(c % 2)];
  }

 private:
  using Pair = Eigen::Array2d;
  static constexpr std::size_t pairs = n / 2 + 1;

  std::array<std::array<Pair, pairs>, n> sums_;
};

/// Calls use(node, e, |e|²) for the nodes that heights are fitted to, see for_near_nodes().
template <typename Use>
void for_near_edges(const Net& net, std::size_t i, const LinkEdges& edges, const Use& use) {
  if (edges.size() >= enough_near_nodes) {
    for (std::size_t k = 0; k < edges.size(); ++k) use(edges.links()[k].node(), edges[k], edges.square(k));
    return;
  }
  for_near_nodes(net, i, [&](std::size_t j) {
    const Vector3 e = net.positions[j] - net.positions[i];
    use(j, e, e.squaredNorm());
  });
}

/// The equations a x = b of n unknowns.
template <std::size_t n>
struct HeightEquations {
  LowerTriangle<n> a;
  Unknowns<n> b;
};

/// Least-squares equations of heights over a node's link, by x and y in its tangent plane: height(j, e) of node j
/// against the n unknowns of row(x, y, |e|²), both weighted by |e|⁻². forms_ridge and slopes_ridge are added to the
/// diagonal for each unknown, times the number of nodes and times Σ |e|⁻², to fit their units.
template <std::size_t n, typename Height, typename Row>
HeightEquations<n> equations_of_heights(const Net& net, std::size_t i, const LinkEdges& edges, const Vector3& t1,
                                        const Vector3& t2, const Unknowns<n>& forms_ridge,
                                        const Unknowns<n>& slopes_ridge, const Height& height, const Row& row_of) {
  RowProducts<n> products;
  double inverses = 0;
  double count = 0;
  for_near_edges(net, i, edges, [&](std::size_t j, const Vector3& e, double length2) {
    if (!(length2 > 0)) return;
    const double inverse = 1 / length2;
    inverses += inverse;
    count += 1;
    products.add(row_of(e.dot(t1), e.dot(t2), length2), height(j, e), inverse);
  });
  HeightEquations<n> equations;
  unrolled<n>([&](auto r) {
    unrolled<r + 1>([&](auto c) { equations.a(r, c) = products(c, r); });
    equations.a(r, r) += count * forms_ridge[r] + inverses * slopes_ridge[r];
    equations.b[r] = products(r, n);
  });
  return equations;
}

}  // namespace vspring
