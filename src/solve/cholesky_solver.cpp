#include "solve/cholesky_solver.hpp"

namespace vspring {

void CholeskySolver::build(const SparseRows& rows) {
  const Eigen::SparseMatrix<double> matrix = rows.to_eigen();
  if (ordered_entries_ != matrix.nonZeros()) {
    factor_.analyzePattern(matrix);
    ordered_entries_ = matrix.nonZeros();
  }
  factor_.factorize(matrix);
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
