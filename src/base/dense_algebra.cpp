#include "base/dense_algebra.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <limits>
#include <numeric>
#include <utility>

namespace vspring {

PivotedCholesky::PivotedCholesky(Eigen::MatrixXd matrix)
    : factors_(std::move(matrix)), order_(static_cast<std::size_t>(factors_.rows())) {
  const Eigen::Index size = factors_.rows();
  std::iota(order_.begin(), order_.end(), Eigen::Index{0});
  for (Eigen::Index k = 0; k < size; ++k) {
    Eigen::Index greatest = k;
    for (Eigen::Index i = k + 1; i < size; ++i) {
      if (factors_(i, i) > factors_(greatest, greatest)) greatest = i;
    }
    factors_.row(k).swap(factors_.row(greatest));
    factors_.col(k).swap(factors_.col(greatest));
    std::swap(order_[static_cast<std::size_t>(k)], order_[static_cast<std::size_t>(greatest)]);
    const double pivot = factors_(k, k);
    for (Eigen::Index i = k + 1; i < size; ++i) {
      const double share = pivot > 0 ? factors_(i, k) / pivot : 0;
      for (Eigen::Index j = k + 1; j < size; ++j) factors_(i, j) -= share * factors_(k, j);
      factors_(i, k) = share;
    }
  }
}

Eigen::Index PivotedCholesky::rank(double least) const {
  Eigen::Index rank = 0;
  while (rank < factors_.rows() && factors_(rank, rank) > least * factors_(0, 0)) ++rank;
  return rank;
}

Eigen::VectorXd PivotedCholesky::solve(const Eigen::VectorXd& right, double least) const {
  const Eigen::Index known = rank(least);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(right.size());
  for (Eigen::Index k = 0; k < known; ++k) {
    x[k] = right[order_[static_cast<std::size_t>(k)]];
    for (Eigen::Index j = 0; j < k; ++j) x[k] -= factors_(k, j) * x[j];
  }
  for (Eigen::Index k = 0; k < known; ++k) x[k] /= factors_(k, k);
  for (Eigen::Index k = known; k-- > 0;) {
    for (Eigen::Index i = k + 1; i < known; ++i) x[k] -= factors_(i, k) * x[i];
  }
  Eigen::VectorXd solution(right.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) solution[order_[static_cast<std::size_t>(k)]] = x[k];
  return solution;
}

Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric).eigenvectors();
}

Eigen::Vector3d smallest_solution(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& right) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(matrix);
  const double rounding = 3 * std::numeric_limits<double>::epsilon() * eigen.eigenvalues()[2];
  Eigen::Vector3d solution = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = eigen.eigenvectors().col(k);
    if (eigen.eigenvalues()[k] > rounding) solution += axis.dot(right) / eigen.eigenvalues()[k] * axis;
  }
  return solution;
}

Eigen::VectorXd damped_solution(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right, double damping) {
  const Eigen::VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd scaled = scale.asDiagonal() * gram * scale.asDiagonal();
  scaled.diagonal().array() += damping;
  return scale.cwiseProduct(PivotedCholesky(std::move(scaled)).solve(scale.cwiseProduct(right), 0));
}

std::optional<Eigen::VectorXd> least_squares(const Eigen::MatrixXd& terms, const Eigen::VectorXd& right,
                                             double independent) {
  const Eigen::Index unknowns = terms.cols();
  Eigen::MatrixXd normal(unknowns, unknowns);
  for (Eigen::Index a = 0; a < unknowns; ++a) {
    for (Eigen::Index b = 0; b < unknowns; ++b) normal(a, b) = terms.col(a).dot(terms.col(b));
  }
  const auto across = [&](const Eigen::VectorXd& heights) {
    Eigen::VectorXd products(unknowns);
    for (Eigen::Index a = 0; a < unknowns; ++a) products[a] = terms.col(a).dot(heights);
    return products;
  };
  const PivotedCholesky factors(std::move(normal));
  if (factors.rank(independent * independent) < unknowns) return std::nullopt;
  Eigen::VectorXd solution = factors.solve(across(right), 0);
  Eigen::VectorXd left = right;
  for (Eigen::Index a = 0; a < unknowns; ++a) left -= solution[a] * terms.col(a);
  solution += factors.solve(across(left), 0);
  return solution;
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix) { return matrix.inverse(); }

}  // namespace vspring
