#include "linear/cholesky_solver.hpp"

#include <limits>
#include <utility>

namespace vspring {

namespace {

// What is added to the diagonal where it does not do.
constexpr double share_of_greatest = 1e-10;
// In iterations, for a node whose column has one entry; columns of 12 to 118 entries were timed.
constexpr double work_of_products = 4e-4;
constexpr double work_of_entries = 5e-3;

}  // namespace

void CholeskySolver::build(const SparseRows& rows) {
  const Eigen::SparseMatrix<double> matrix = rows.to_eigen();
  // As many entries at other places would be written beyond the factor's memory.
  std::vector<int> pattern(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.outerSize() + 1);
  pattern.insert(pattern.end(), matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
  if (pattern != ordered_pattern_) {
    factor_.analyzePattern(matrix);
    ordered_pattern_ = std::move(pattern);
  }
  factor_.setShift(0);
  factor_.factorize(matrix);
  if (factor_.info() == Eigen::Success) return;
  // Of tangled shapes a pivot may vanish.
  factor_.setShift(share_of_greatest * matrix.diagonal().cwiseAbs().maxCoeff());
  factor_.factorize(matrix);
}

double CholeskySolver::work_of_building() const {
  if (factor_.info() != Eigen::Success || factor_.rows() == 0) return 0;
  const Eigen::SparseMatrix<double>& factor = factor_.matrixL().nestedExpression();
  const double per_node = static_cast<double>(factor.nonZeros()) / static_cast<double>(factor.rows());
  return per_node * per_node * work_of_products + per_node * work_of_entries;
}

Eigen::VectorXd CholeskySolver::solution(const Eigen::VectorXd& column) const {
  // Eigen leaves what it returns as the memory was.
  if (factor_.info() != Eigen::Success)
    return Eigen::VectorXd::Constant(column.size(), std::numeric_limits<double>::quiet_NaN());
  return factor_.solve(column);
}

void CholeskySolver::solve(std::span<double> values, const Accuracy& /*accuracy*/) {
  Eigen::Map<Eigen::VectorXd> column(values.data(), static_cast<Eigen::Index>(values.size()));
  column = solution(column);
}

void CholeskySolver::solve(std::span<Vector3> values, const Accuracy& /*accuracy*/) {
  team_->run(3, [&](std::size_t k) {
    Eigen::VectorXd column(static_cast<Eigen::Index>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
      column[static_cast<Eigen::Index>(i)] = values[i][static_cast<Eigen::Index>(k)];
    column = solution(column);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i][static_cast<Eigen::Index>(k)] = column[static_cast<Eigen::Index>(i)];
  });
}

}  // namespace vspring
