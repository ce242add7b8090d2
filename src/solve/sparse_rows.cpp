#include "solve/sparse_rows.hpp"

namespace vspring {

double SparseRows::diagonal(std::size_t i) const {
  for (const Entry& entry : row(i)) {
    if (entry.column == i) return entry.value;
  }
  return 0;
}

SparseRows SparseRows::transposed() const {
  SparseRows result;
  result.columns_ = rows();
  result.begin_.assign(columns_ + 1, 0);
  for (const Entry& entry : entries_) ++result.begin_[entry.column + 1];
  std::partial_sum(result.begin_.begin(), result.begin_.end(), result.begin_.begin());
  result.entries_.resize(entries_.size());
  std::vector<std::uint32_t> next(result.begin_.begin(), result.begin_.end() - 1);
  for (std::size_t i = 0; i < rows(); ++i) {
    for (const Entry& entry : row(i))
      result.entries_[next[entry.column]++] = {static_cast<std::uint32_t>(i), entry.value};
  }
  return result;
}

Eigen::SparseMatrix<double> SparseRows::to_eigen() const {
  const std::vector<int> begin(begin_.begin(), begin_.end());
  std::vector<int> columns;
  std::vector<double> values;
  columns.reserve(entries_.size());
  values.reserve(entries_.size());
  for (const Entry& entry : entries_) {
    columns.push_back(static_cast<int>(entry.column));
    values.push_back(entry.value);
  }
  return Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>(
      static_cast<Eigen::Index>(rows()), static_cast<Eigen::Index>(columns_), static_cast<Eigen::Index>(values.size()),
      begin.data(), columns.data(), values.data());
}

SparseRows product(const SparseRows& a, const SparseRows& b, ThreadTeam& team) {
  constexpr auto none = static_cast<std::uint32_t>(-1);
  return SparseRows::build(team, a.rows(), b.columns(), [&] {
    return [&, place = std::vector<std::uint32_t>(b.columns(), none)](std::size_t i, SparseRows::Row& run) mutable {
      const std::size_t before = run.size();
      for (const SparseRows::Entry& outer : a.row(i)) {
        for (const SparseRows::Entry& inner : b.row(outer.column)) {
          std::uint32_t& at = place[inner.column];
          if (at == none) {
            at = static_cast<std::uint32_t>(run.size());
            run.push_back({inner.column, 0});
          }
          run[at].value += outer.value * inner.value;
        }
      }
      for (std::size_t k = before; k < run.size(); ++k) place[run[k].column] = none;
    };
  });
}

}  // namespace vspring
