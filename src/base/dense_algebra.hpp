#pragma once

#include <Eigen/Core>
#include <optional>

namespace vspring {

// Small dense problems. Eigen's decompositions are long to compile, so all of them stand in one source; what differs
// in size shares them.

/// Up to six by six, without memory elsewhere.
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

struct SymmetricEigen {
  SmallVector values;   ///< rising
  SmallMatrix vectors;  ///< of length 1, one a column
};

[[nodiscard]] SymmetricEigen eigen_of_symmetric(const SmallMatrix& matrix);

/// The smallest x that comes nearest to matrix · x = right, for a symmetric matrix without negative eigenvalues.
[[nodiscard]] SmallVector smallest_solution(const SmallMatrix& matrix, const SmallVector& right);

/// The solution of gram · x = right with columns scaled to one length, and that much added to the diagonal where they
/// hardly differ. Not finite where there is none.
[[nodiscard]] Eigen::VectorXd damped_solution(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right,
                                              double damping);

/// The x nearest to terms · x = right; none where the last pivot is not more than `independent` times the first.
[[nodiscard]] std::optional<Eigen::VectorXd> least_squares(const Eigen::MatrixXd& terms, const Eigen::VectorXd& right,
                                                           double independent);

[[nodiscard]] Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix);

}  // namespace vspring
