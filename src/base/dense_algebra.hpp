#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace vspring {

/// The Cholesky decomposition of a small symmetric matrix without negative eigenvalues that takes the largest pivot
/// that is left, so that it tells of its rank (N. J. Higham, "Analysis of the Cholesky Decomposition of a Semi-definite
/// Matrix", 1990). By hand since Eigen's LDLT takes its pivots in the order of the matrix's own diagonal, and its other
/// decompositions take long to compile. Cost: n³/3.
class PivotedCholesky {
 public:
  explicit PivotedCholesky(Eigen::MatrixXd matrix);

  /// How many pivots are more than `least` times the first.
  [[nodiscard]] Eigen::Index rank(double least) const;

  /// Some x that comes nearest to matrix · x = right, where further pivots count as zero.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right, double least) const;

 private:
  Eigen::MatrixXd factors_;  // below the diagonal; on it the pivots
  std::vector<Eigen::Index> order_;
};

/// Eigenvectors of a symmetric matrix in columns of length 1, in the order of rising eigenvalues.
[[nodiscard]] Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& symmetric);

/// The smallest x that comes nearest to matrix · x = right, for a symmetric matrix without negative eigenvalues.
[[nodiscard]] Eigen::Vector3d smallest_solution(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& right);

/// The solution of gram · x = right with columns scaled to one length, and that much added to the diagonal where they
/// hardly differ. Not finite where there is none.
[[nodiscard]] Eigen::VectorXd damped_solution(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right,
                                              double damping);

/// The x nearest to terms · x = right, by the normal equations and one refinement; none where the last pivot of QR
/// would not be more than `independent` (1e-5 or more) times the first.
[[nodiscard]] std::optional<Eigen::VectorXd> least_squares(const Eigen::MatrixXd& terms, const Eigen::VectorXd& right,
                                                           double independent);

[[nodiscard]] Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix);

}  // namespace vspring
