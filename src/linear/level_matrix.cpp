#include "linear/level_matrix.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "linear/sparse_sum.hpp"

namespace vspring {

namespace {

using Sources = std::span<const FloatRows::Entry>;

template <typename Matrix>
void multiply(Sources row, const Matrix& matrix, SparseSum& image) {
  for (const FloatRows::Entry& outer : row) {
    const auto factor = static_cast<double>(outer.value);
    matrix.for_row(outer.column, [&](std::size_t column, double value) {
      image.add(static_cast<std::uint32_t>(column), factor * value);
    });
  }
}

/// inner: a buffer for row · Gᵀ.
void multiply(Sources row, const FactoredMatrix& matrix, SparseSum& inner, SparseSum& image) {
  inner.clear();
  for (const FloatRows::Entry& outer : row) {
    const auto factor = static_cast<double>(outer.value);
    matrix.for_column(outer.column, [&](std::size_t column, float value) {
      inner.add(static_cast<std::uint32_t>(column), factor * static_cast<double>(value));
    });
  }
  inner.for_each([&](std::uint32_t row_of_factor, double factor) {
    matrix.for_row(row_of_factor, [&](std::size_t column, float value) {
      image.add(static_cast<std::uint32_t>(column), factor * static_cast<double>(value));
    });
  });
}

void multiply(Sources row, const GraphLaplacian& matrix, SparseSum& image) {
  for (const FloatRows::Entry& outer : row) {
    const auto factor = static_cast<double>(outer.value);
    image.add(outer.column, factor * matrix.diagonal(outer.column));
    matrix.for_neighbours(outer.column, [&](std::size_t j) {
      if (j < matrix.size()) image.add(static_cast<std::uint32_t>(j), -factor);
    });
  }
}

std::size_t inner_size_of(const LevelMatrix& matrix) {
  const auto* const factored = std::get_if<FactoredMatrix>(&matrix);
  return factored ? factored->inner_size() : 0;
}

/// Makes rows of upᵀ matrix up, one after the other.
class GalerkinRow {
 public:
  GalerkinRow(const FloatRows& down, const LevelMatrix& matrix, const FloatRows& up)
      : down_(&down),
        matrix_(&matrix),
        up_(&up),
        between_(inner_size_of(matrix)),
        there_(up.rows()),
        row_(up.columns()) {}

  /// Valid until the next call.
  const SparseSum& operator()(std::size_t i) {
    const Sources here = down_->row(i);
    there_.clear();
    const auto multiply_by = [&](const auto& one) {
      if constexpr (std::is_same_v<decltype(one), const FactoredMatrix&>)
        multiply(here, one, between_, there_);
      else
        multiply(here, one, there_);
    };
    std::visit(multiply_by, *matrix_);
    row_.clear();
    there_.for_each([&](std::uint32_t fine, double value) {
      for (const FloatRows::Entry& entry : up_->row(fine))
        row_.add(entry.column, value * static_cast<double>(entry.value));
    });
    return row_;
  }

 private:
  const FloatRows* down_;
  const LevelMatrix* matrix_;
  const FloatRows* up_;
  SparseSum between_;
  SparseSum there_;
  SparseSum row_;
};

/// Lends out as many objects as work at a time, as each is as large as a column of the matrix.
class GalerkinRows {
 public:
  GalerkinRows(const FloatRows& down, const LevelMatrix& matrix, const FloatRows& up)
      : make_([&] { return std::make_unique<GalerkinRow>(down, matrix, up); }) {}

  /// Holds one object until destroyed.
  class Lent {
   public:
    explicit Lent(GalerkinRows& from) : from_(&from), row_(from.take()) {}
    Lent(Lent&&) = default;
    Lent& operator=(Lent&&) = delete;
    Lent(const Lent&) = delete;
    Lent& operator=(const Lent&) = delete;
    ~Lent() {
      if (row_) from_->give_back(std::move(row_));
    }
    const SparseSum& operator()(std::size_t i) { return (*row_)(i); }

   private:
    GalerkinRows* from_;
    std::unique_ptr<GalerkinRow> row_;
  };

 private:
  std::unique_ptr<GalerkinRow> take() {
    {
      const std::scoped_lock lock(mutex_);
      if (!idle_.empty()) {
        auto row = std::move(idle_.back());
        idle_.pop_back();
        return row;
      }
    }
    return make_();
  }
  void give_back(std::unique_ptr<GalerkinRow> row) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(row));
  }

  std::function<std::unique_ptr<GalerkinRow>()> make_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<GalerkinRow>> idle_;
};

/// The diagonal of a row whose other entries are rounded.
class RoundedDiagonal {
 public:
  void add(double entry) { value_ += entry; }
  /// Rounds an entry of the row, and adds the rounding error to the diagonal.
  float add_rounding(double entry) {
    const auto rounded = static_cast<float>(entry);
    value_ += entry;
    value_ -= static_cast<double>(rounded);
    return rounded;
  }
  [[nodiscard]] double value() const noexcept { return value_; }

 private:
  double value_ = 0;
};

/// Collects entries for row i: off-diagonal ones go into the row, their rounding errors to the diagonal.
class RoundedRow {
 public:
  RoundedRow(std::size_t i, FloatRows::Row& row) : i_(i), row_(&row) {}

  void add(std::uint32_t column, double entry) {
    if (column == i_)
      diagonal_.add(entry);
    else
      row_->push_back({column, diagonal_.add_rounding(entry)});
  }
  [[nodiscard]] double diagonal() const noexcept { return diagonal_.value(); }

 private:
  std::size_t i_;
  FloatRows::Row* row_;
  RoundedDiagonal diagonal_;
};

}  // namespace

AssembledMatrix::AssembledMatrix(const FloatRows& down, const LevelMatrix& matrix, const FloatRows& up,
                                 ThreadTeam& team)
    : diagonal_(down.rows()) {
  GalerkinRows rows(down, matrix, up);
  beside_ = FloatRows::build(team, down.rows(), up.columns(), [&] {
    return [&, galerkin_row = GalerkinRows::Lent(rows)](std::size_t i, FloatRows::Row& row) mutable {
      RoundedRow rounded(i, row);
      galerkin_row(i).for_each([&](std::uint32_t column, double value) { rounded.add(column, value); });
      diagonal_[i] = rounded.diagonal();
    };
  });
}

LinkMatrix::LinkMatrix(const Net& net, const SparseRows& matrix, ThreadTeam& team)
    : net_(&net), beside_(net.rings.begin(net.moving), 0.0F), diagonal_(net.moving) {
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto links = net.rings.links(i);
      const auto row = matrix.row(i);
      RoundedDiagonal diagonal;
      auto entry = row.begin();
      for (std::size_t k = 0; k < links.size(); ++k) {
        if (!links[k].spoke() || links[k].node() >= net.moving) continue;
        beside_[net.rings.begin(i) + k] = diagonal.add_rounding(entry->value);
        ++entry;
      }
      diagonal.add(entry->value);
      diagonal_[i] = diagonal.value();
    }
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
  GalerkinRows rows(down, matrix, up);
  return SparseRows::build(team, down.rows(), up.columns(), [&] {
    return [galerkin_row = GalerkinRows::Lent(rows)](std::size_t i, SparseRows::Row& row) mutable {
      galerkin_row(i).for_each([&](std::uint32_t column, double value) { row.push_back({column, value}); });
    };
  });
}

}  // namespace vspring
