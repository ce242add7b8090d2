#include "solve/cholesky_solver.hpp"

namespace vspring {

void CholeskySolver::build(SparseRows rows) {
  const Eigen::SparseMatrix<double> matrix = rows.to_eigen();
  if (ordered_entries_ != matrix.nonZeros()) {
    factor_.analyzePattern(matrix);
    ordered_entries_ = matrix.nonZeros();
  }
  factor_.factorize(matrix);
}

void CholeskySolver::solve(Eigen::MatrixXd& columns) {
  team_->run(static_cast<std::size_t>(columns.cols()), [&](std::size_t k) {
    const auto column = static_cast<Eigen::Index>(k);
    columns.col(column) = factor_.solve(columns.col(column)).eval();
  });
}

}  // namespace vspring
