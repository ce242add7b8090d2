#include "base/dense_algebra.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <limits>

namespace vspring {

SymmetricEigen eigen_of_symmetric(const SmallMatrix& matrix) {
  const Eigen::SelfAdjointEigenSolver<SmallMatrix> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SmallVector smallest_solution(const SmallMatrix& matrix, const SmallVector& right) {
  const SymmetricEigen eigen = eigen_of_symmetric(matrix);
  const Eigen::Index size = matrix.rows();
  const double rounding =
      std::numeric_limits<double>::epsilon() * static_cast<double>(size) * eigen.values.cwiseAbs().maxCoeff();
  SmallVector solution = SmallVector::Zero(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const auto axis = eigen.vectors.col(k);
    if (eigen.values[k] > rounding) solution += axis.dot(right) / eigen.values[k] * axis;
  }
  return solution;
}

Eigen::VectorXd damped_solution(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right, double damping) {
  const Eigen::VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd scaled = scale.asDiagonal() * gram * scale.asDiagonal();
  scaled.diagonal().array() += damping;
  return scale.asDiagonal() * scaled.ldlt().solve(Eigen::VectorXd(scale.asDiagonal() * right));
}

std::optional<Eigen::VectorXd> least_squares(const Eigen::MatrixXd& terms, const Eigen::VectorXd& right,
                                             double independent) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(terms);
  const auto pivots = qr.matrixR().diagonal().cwiseAbs();
  if (!(pivots[terms.cols() - 1] > independent * pivots[0])) return std::nullopt;
  return qr.solve(right);
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix) { return matrix.inverse(); }

}  // namespace vspring
