#include "linear/cholesky_solver.hpp"

#include <limits>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"

namespace vspring {

namespace {

// Added to the diagonal if a pivot vanishes.
constexpr double share_of_greatest = 1e-10;
// In iterations, per node and entry of its column; timed for columns of 12 to 118 entries.
constexpr double work_of_products = 4e-4;
constexpr double work_of_entries = 5e-3;

}  // namespace

// Computes L row by row; each row is a solution with the rows before, columns in the order of the elimination tree: T.
// A. Davis, "Algorithm 849: a concise sparse Cholesky factorization package", ACM Transactions on Mathematical Software
// 31(4), 2005. Eigen's own does the same operations in the same order.
void CholeskySolver::Factor::factorize(const Matrix& matrix) {
  const auto size = static_cast<int>(matrix.rows());
  Matrix permuted(size, size);
  permuted.selfadjointView<Eigen::Upper>() = matrix.selfadjointView<Eigen::Lower>().twistedBy(m_P);
  const int* const begin = m_matrix.outerIndexPtr();
  int* const rows = m_matrix.innerIndexPtr();
  double* const values = m_matrix.valuePtr();
  std::vector<double> row(static_cast<std::size_t>(size), 0);
  std::vector<int> pattern(static_cast<std::size_t>(size));
  std::vector<int> reached_from(static_cast<std::size_t>(size), -1);
  m_diag.resize(size);
  m_info = Eigen::Success;
  for (int k = 0; k < size; ++k) {
    end_if_cancelled();
    std::size_t top = pattern.size();
    reached_from[static_cast<std::size_t>(k)] = k;
    m_nonZerosPerCol[k] = 0;
    for (Matrix::InnerIterator entry(permuted, k); entry; ++entry) {
      auto column = static_cast<int>(entry.index());
      row[static_cast<std::size_t>(column)] += entry.value();
      std::size_t length = 0;
      for (; reached_from[static_cast<std::size_t>(column)] != k; column = m_parent[column]) {
        pattern[length++] = column;
        reached_from[static_cast<std::size_t>(column)] = k;
      }
      while (length > 0) pattern[--top] = pattern[--length];
    }
    double pivot = row[static_cast<std::size_t>(k)] + m_shiftOffset;
    row[static_cast<std::size_t>(k)] = 0;
    for (; top < pattern.size(); ++top) {
      const int column = pattern[top];
      const double above = std::exchange(row[static_cast<std::size_t>(column)], 0);
      const double entry = above / m_diag[column];
      const int end = begin[column] + m_nonZerosPerCol[column];
      for (int place = begin[column]; place < end; ++place)
        row[static_cast<std::size_t>(rows[place])] -= values[place] * above;
      pivot -= entry * above;
      rows[end] = k;
      values[end] = entry;
      ++m_nonZerosPerCol[column];
    }
    m_diag[k] = pivot;
    if (pivot == 0) {
      m_info = Eigen::NumericalIssue;
      break;
    }
  }
  m_factorizationIsOk = true;
}

void CholeskySolver::build(const Eigen::SparseMatrix<double>& matrix) {
  // Equally many entries at other places would be written beyond the factor's memory.
  std::vector<int> pattern(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.outerSize() + 1);
  pattern.insert(pattern.end(), matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
  if (pattern != ordered_pattern_) {
    factor_.analyzePattern(matrix);
    ordered_pattern_ = std::move(pattern);
  }
  factor_.setShift(0);
  factor_.factorize(matrix);
  if (factor_.info() == Eigen::Success) return;
  // With tangled shapes a pivot may vanish.
  factor_.setShift(share_of_greatest * matrix.diagonal().cwiseAbs().maxCoeff());
  factor_.factorize(matrix);
}

double CholeskySolver::work_of_building() const {
  if (factor_.info() != Eigen::Success || factor_.rows() == 0) return 0;
  const Matrix& factor = factor_.matrixL().nestedExpression();
  const double per_node = static_cast<double>(factor.nonZeros()) / static_cast<double>(factor.rows());
  return per_node * per_node * work_of_products + per_node * work_of_entries;
}

Eigen::VectorXd CholeskySolver::solution(const Eigen::VectorXd& column) const {
  // Eigen returns uninitialised memory then.
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
