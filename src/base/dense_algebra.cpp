#include "base/dense_algebra.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <limits>

namespace vspring {

namespace {

using Cholesky = Eigen::LDLT<Eigen::MatrixXd>;

Eigen::VectorXd solve(const Cholesky& factors, Eigen::VectorXd x, double least) {
  const Eigen::VectorXd pivots = factors.vectorD();
  x = factors.transpositionsP() * x;
  factors.matrixL().solveInPlace(x);
  for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = pivots[k] > least * pivots[0] ? x[k] / pivots[k] : 0;
  factors.matrixU().solveInPlace(x);
  return factors.transpositionsP().transpose() * x;
}

}  // namespace

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

Eigen::VectorXd pivots(const Eigen::MatrixXd& matrix) { return Cholesky(matrix).vectorD(); }

Eigen::VectorXd some_solution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right, double least) {
  return solve(Cholesky(matrix), right, least);
}

Eigen::VectorXd damped_solution(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right, double damping) {
  const Eigen::VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd scaled = scale.asDiagonal() * gram * scale.asDiagonal();
  scaled.diagonal().array() += damping;
  return scale.cwiseProduct(solve(Cholesky(scaled), scale.cwiseProduct(right), 0));
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
  const Cholesky factors(normal);
  if (!(factors.vectorD()[unknowns - 1] > independent * independent * factors.vectorD()[0])) return std::nullopt;
  Eigen::VectorXd solution = solve(factors, across(right), 0);
  Eigen::VectorXd left = right;
  for (Eigen::Index a = 0; a < unknowns; ++a) left -= solution[a] * terms.col(a);
  solution += solve(factors, across(left), 0);
  return solution;
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix) { return matrix.inverse(); }

}  // namespace vspring
