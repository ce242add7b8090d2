#include "solve/cholesky_solver.hpp"

namespace vspring {

namespace {

// In iterations, for a node whose column has one entry; columns of 12 to 118 entries were timed.
constexpr double work_of_products = 4e-4;
constexpr double work_of_entries = 5e-3;

}  // namespace

void CholeskySolver::build(const SparseRows& rows) {
  const Eigen::SparseMatrix<double> matrix = rows.to_eigen();
  if (ordered_entries_ != matrix.nonZeros()) {
    factor_.analyzePattern(matrix);
    ordered_entries_ = matrix.nonZeros();
  }
  factor_.factorize(matrix);
}

double CholeskySolver::work_of_building() const {
  if (factor_.info() != Eigen::Success || factor_.rows() == 0) return 0;
  const Eigen::SparseMatrix<double>& factor = factor_.matrixL().nestedExpression();
  const double per_node = static_cast<double>(factor.nonZeros()) / static_cast<double>(factor.rows());
  return per_node * per_node * work_of_products + per_node * work_of_entries;
}

void CholeskySolver::solve(std::span<double> values, const Accuracy& /*accuracy*/) {
  Eigen::Map<Eigen::VectorXd> column(values.data(), static_cast<Eigen::Index>(values.size()));
  column = factor_.solve(column).eval();
}

void CholeskySolver::solve(std::span<Vector3> values, const Accuracy& /*accuracy*/) {
  team_->run(3, [&](std::size_t k) {
    Eigen::VectorXd column(static_cast<Eigen::Index>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
      column[static_cast<Eigen::Index>(i)] = values[i][static_cast<Eigen::Index>(k)];
    column = factor_.solve(column).eval();
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i][static_cast<Eigen::Index>(k)] = column[static_cast<Eigen::Index>(i)];
  });
}

}  // namespace vspring
