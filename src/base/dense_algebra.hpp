#pragma once

#include <Eigen/Core>
#include <optional>

namespace vspring {

// Small dense problems. Eigen's decompositions are long to compile, so all stand in one source and few are used.

/// Eigenvectors of a symmetric matrix in columns of length 1, in the order of rising eigenvalues.
[[nodiscard]] Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& symmetric);

/// The smallest x that comes nearest to matrix · x = right, for a symmetric matrix without negative eigenvalues.
[[nodiscard]] Eigen::Vector3d smallest_solution(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& right);

/// The Cholesky decomposition of a symmetric matrix without negative eigenvalues, largest pivots first: squares of the
/// pivots that QR would find in a matrix of which this is the product with its transpose.
[[nodiscard]] Eigen::VectorXd pivots(const Eigen::MatrixXd& matrix);

/// Some x that comes nearest to matrix · x = right, where pivots below `least` times the first count as zero.
[[nodiscard]] Eigen::VectorXd some_solution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right, double least);

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
