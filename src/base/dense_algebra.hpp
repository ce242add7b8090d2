#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace vspring {

/// The Cholesky decomposition, with complete pivoting, of a small symmetric matrix without negative eigenvalues; it
/// reveals the rank (N. J. Higham, "Analysis of the Cholesky Decomposition of a Semi-definite Matrix", 1990). Our own,
/// because Eigen's LDLT takes its pivots in the order of the original diagonal, and its other decompositions take long
/// to compile. Cost: n³/3.
class PivotedCholesky {
 public:
  explicit PivotedCholesky(Eigen::MatrixXd matrix);

  /// The number of pivots greater than `least` times the first.
  [[nodiscard]] Eigen::Index rank(double least) const;

  /// A least-squares solution x of matrix · x = right; pivots beyond rank(least) count as zero.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right, double least) const;

 private:
  Eigen::MatrixXd factors_;  // below the diagonal; on it the pivots
  std::vector<Eigen::Index> order_;
};

/// Unit eigenvectors of a symmetric matrix, as columns, by ascending eigenvalues.
[[nodiscard]] Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& symmetric);

/// The smallest least-squares solution x of matrix · x = right, for a symmetric matrix without negative eigenvalues.
[[nodiscard]] Eigen::Vector3d smallest_solution(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& right);

/// The solution of gram · x = right, with columns scaled to length 1 and the damping added to the diagonal where
/// columns hardly differ. Not finite if there is none.
[[nodiscard]] Eigen::VectorXd damped_solution(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right,
                                              double damping);

/// The least-squares solution x of terms · x = right, by the normal equations and one refinement; none if the last
/// pivot of QR would be at most `independent` (1e-5 or more) times the first.
[[nodiscard]] std::optional<Eigen::VectorXd> least_squares(const Eigen::MatrixXd& terms, const Eigen::VectorXd& right,
                                                           double independent);

[[nodiscard]] Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix);

}  // namespace vspring
