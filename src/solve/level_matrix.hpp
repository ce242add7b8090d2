#pragma once

#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "base/threads.hpp"
#include "solve/sparse_rows.hpp"
#include "spring/net.hpp"

namespace vspring {

class WholeMatrix;
class FactoredMatrix;
class GraphLaplacian;
using LevelMatrix = std::variant<WholeMatrix, FactoredMatrix, GraphLaplacian>;

/// Symmetric, in single precision but for the diagonal, which makes up for the rounding of the entries beside it: what
/// the matrix makes of a constant stays exact.
class WholeMatrix {
 public:
  /// upᵀ matrix up. Cost: linear; nothing between is kept.
  WholeMatrix(const FloatRows& down, const LevelMatrix& matrix, const FloatRows& up, ThreadTeam& team);
  /// From all entries, in double precision.
  WholeMatrix(const SparseRows& matrix, ThreadTeam& team);

  [[nodiscard]] std::size_t size() const noexcept { return diagonal_.size(); }
  [[nodiscard]] double diagonal(std::size_t i) const { return diagonal_[i]; }
  /// use(column, value) for the entries of row i.
  template <typename Use>
  void for_row(std::size_t i, const Use& use) const {
    use(i, diagonal_[i]);
    for (const FloatRows::Entry& entry : beside_.row(i)) use(entry.column, static_cast<double>(entry.value));
  }

 private:
  FloatRows beside_;
  std::vector<double> diagonal_;
};

/// Gᵀ G. A product that is not multiplied out stays positive and exact for what the rows of G take to zero, in single
/// precision too.
class FactoredMatrix {
 public:
  explicit FactoredMatrix(FloatRows rows) : rows_(std::move(rows)), columns_(rows_.transposed()) {}

  [[nodiscard]] std::size_t size() const noexcept { return rows_.columns(); }
  [[nodiscard]] double diagonal(std::size_t i) const {
    double sum = 0;
    for (const FloatRows::Entry& entry : columns_.row(i)) sum += static_cast<double>(entry.value * entry.value);
    return sum;
  }
  [[nodiscard]] const FloatRows& rows() const noexcept { return rows_; }        ///< G
  [[nodiscard]] const FloatRows& columns() const noexcept { return columns_; }  ///< Gᵀ

 private:
  FloatRows rows_;
  FloatRows columns_;
};

/// The Laplacian of the moving nodes' graph with weights of one, which takes no memory of its own. The net must outlive
/// it.
class GraphLaplacian {
 public:
  explicit GraphLaplacian(const Net& net) : net_(&net) {}

  [[nodiscard]] std::size_t size() const noexcept { return net_->moving; }
  [[nodiscard]] double diagonal(std::size_t i) const {
    double spokes = 0;
    for (const Link link : net_->rings.links(i)) spokes += link.spoke() ? 1 : 0;
    return spokes > 0 ? spokes : 1;
  }
  template <typename Use>
  void for_neighbours(std::size_t i, const Use& use) const {
    for (const Link link : net_->rings.links(i)) {
      if (link.spoke()) use(link.node());
    }
  }

 private:
  const Net* net_;
};

/// upᵀ matrix up in double precision. Cost: linear; nothing between is kept.
SparseRows galerkin(const FloatRows& down, const LevelMatrix& matrix, const FloatRows& up, ThreadTeam& team);

}  // namespace vspring
