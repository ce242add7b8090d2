#include "linear/level_matrix.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "linear/sparse_sum.hpp"

namespace vspring {

namespace {

using Entry = SparseRows::Entry;

void multiply(std::span<const Entry> row, const AssembledMatrix& matrix, SparseSum& image) {
  image.clear();
  for (const Entry& outer : row) {
    matrix.for_row(outer.column, [&](std::size_t column, double value) {
      image.add(static_cast<std::uint32_t>(column), outer.value * value);
    });
  }
}

/// inner: row · Gᵀ.
void multiply(std::span<const Entry> row, const FactoredMatrix& matrix, SparseSum& inner, SparseSum& image) {
  inner.clear();
  for (const Entry& outer : row) {
    matrix.for_column(outer.column, [&](std::size_t column, float value) {
      inner.add(static_cast<std::uint32_t>(column), outer.value * static_cast<double>(value));
    });
  }
  image.clear();
  for (const Entry& outer : inner.entries()) {
    matrix.for_row(outer.column, [&](std::size_t column, float value) {
      image.add(static_cast<std::uint32_t>(column), outer.value * static_cast<double>(value));
    });
  }
}

void multiply(std::span<const Entry> row, const GraphLaplacian& matrix, SparseSum& image) {
  image.clear();
  for (const Entry& outer : row) {
    image.add(outer.column, outer.value * matrix.diagonal(outer.column));
    matrix.for_neighbours(outer.column, [&](std::size_t j) {
      if (j < matrix.size()) image.add(static_cast<std::uint32_t>(j), -outer.value);
    });
  }
}

/// Rows of upᵀ matrix up, one after the other.
class GalerkinRow {
 public:
  GalerkinRow(const FloatRows& down, const LevelMatrix& matrix, const FloatRows& up)
      : down_(&down), matrix_(&matrix), up_(&up) {}

  /// Valid until the next one.
  std::span<const Entry> operator()(std::size_t i) {
    here_.clear();
    for (const FloatRows::Entry& entry : down_->row(i)) here_.add(entry.column, static_cast<double>(entry.value));
    if (const auto* factored = std::get_if<FactoredMatrix>(matrix_)) {
      multiply(here_.entries(), *factored, between_, there_);
    } else if (const auto* whole = std::get_if<AssembledMatrix>(matrix_)) {
      multiply(here_.entries(), *whole, there_);
    } else {
      multiply(here_.entries(), std::get<GraphLaplacian>(*matrix_), there_);
    }
    multiply(there_.entries(), *up_, here_);
    return here_.entries();
  }

 private:
  const FloatRows* down_;
  const LevelMatrix* matrix_;
  const FloatRows* up_;
  SparseSum here_;
  SparseSum between_;
  SparseSum there_;
};

/// Puts the entries beside the diagonal into the row; returns the diagonal that makes up for their rounding.
double round_row(std::size_t i, std::span<const Entry> entries, FloatRows::Row& row) {
  double diagonal = 0;
  for (const Entry& entry : entries) {
    diagonal += entry.value;
    if (entry.column == i) continue;
    const auto value = static_cast<float>(entry.value);
    diagonal -= static_cast<double>(value);
    row.push_back({entry.column, value});
  }
  return diagonal;
}

}  // namespace

AssembledMatrix::AssembledMatrix(const FloatRows& down, const LevelMatrix& matrix, const FloatRows& up,
                                 ThreadTeam& team)
    : diagonal_(down.rows()) {
  beside_ = FloatRows::build(team, down.rows(), up.columns(), [&] {
    return [&, galerkin_row = GalerkinRow(down, matrix, up)](std::size_t i, FloatRows::Row& row) mutable {
      diagonal_[i] = round_row(i, galerkin_row(i), row);
    };
  });
}

AssembledMatrix::AssembledMatrix(const SparseRows& matrix, ThreadTeam& team) : diagonal_(matrix.rows()) {
  beside_ = FloatRows::build(team, matrix.rows(), matrix.columns(), [&] {
    return [&](std::size_t i, FloatRows::Row& row) { diagonal_[i] = round_row(i, matrix.row(i), row); };
  });
}

FactoredMatrix::FactoredMatrix(const Net& net, EdgeAlignedRows rows, ThreadTeam& team)
    : net_(&net), rows_(std::move(rows)), further_columns_(rows_.further.transposed()) {
  across_.assign(rows_.beside.size(), 0);
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    net.rings.for_spoke_pairs(begin, end, net.moving, [&](std::size_t, std::size_t k, std::size_t, std::size_t back) {
      across_[k] = rows_.beside[back];
      across_[back] = rows_.beside[k];
    });
  });
}

SparseRows galerkin(const FloatRows& down, const LevelMatrix& matrix, const FloatRows& up, ThreadTeam& team) {
  return SparseRows::build(team, down.rows(), up.columns(), [&] {
    return [galerkin_row = GalerkinRow(down, matrix, up)](std::size_t i, SparseRows::Row& row) mutable {
      const auto entries = galerkin_row(i);
      row.insert(row.end(), entries.begin(), entries.end());
    };
  });
}

}  // namespace vspring
