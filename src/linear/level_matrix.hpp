#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "base/threads.hpp"
#include "linear/sparse_rows.hpp"
#include "spring/net.hpp"

namespace vspring {

class AssembledMatrix;
class FactoredMatrix;
class GraphLaplacian;
class LinkMatrix;
using LevelMatrix = std::variant<AssembledMatrix, LinkMatrix, FactoredMatrix, GraphLaplacian>;

/// A symmetric matrix in single precision. The diagonal is in double precision and compensates the rounding of the
/// other entries, so the product with a constant is exact.
class AssembledMatrix {
 public:
  /// The matrix upᵀ matrix up. Cost: linear; stores no intermediate matrix.
  AssembledMatrix(const FloatRows& down, const LevelMatrix& matrix, const FloatRows& up, ThreadTeam& team);

  [[nodiscard]] std::size_t size() const noexcept { return diagonal_.size(); }
  [[nodiscard]] double diagonal(std::size_t i) const { return diagonal_[i]; }
  /// Calls use(column, value) for the entries of row i.
  template <typename Use>
  void for_row(std::size_t i, const Use& use) const {
    use(i, diagonal_[i]);
    for (const FloatRows::Entry& entry : beside_.row(i)) use(entry.column, static_cast<double>(entry.value));
  }

 private:
  FloatRows beside_;
  std::vector<double> diagonal_;
};

/// Such a matrix whose off-diagonal entries join neighbours. The net gives their columns, so it takes half the memory.
class LinkMatrix {
 public:
  /// From a matrix whose row i has the entries of its neighbours, in the order of its links, and the diagonal last. The
  /// net must outlive it.
  LinkMatrix(const Net& net, const SparseRows& matrix, ThreadTeam& team);

  [[nodiscard]] std::size_t size() const noexcept { return diagonal_.size(); }
  [[nodiscard]] double diagonal(std::size_t i) const { return diagonal_[i]; }
  /// Calls use(column, value) for the entries of row i.
  template <typename Use>
  void for_row(std::size_t i, const Use& use) const {
    use(i, diagonal_[i]);
    const float* value = beside_.data() + net_->rings.begin(i);
    for (const Link link : net_->rings.links(i)) {
      const auto one = static_cast<double>(*value++);
      if (link.spoke() && link.node() < size()) use(link.node(), one);
    }
  }

 private:
  const Net* net_;
  std::vector<float> beside_;  // one for every link of a moving node
  std::vector<double> diagonal_;
};

/// A matrix with a row and a column for every moving node of a net, whose off-diagonal entries join neighbours, and
/// with further rows below.
struct EdgeAlignedRows {
  std::vector<float> diagonal;
  std::vector<float> beside;  ///< one for every link of a moving node; zero for those to held ones
  FloatRows further;
};

/// Gᵀ G, stored as G. So it stays positive, and exact for vectors that the rows of G take to zero, also in single
/// precision; and the net gives the columns of its entries.
class FactoredMatrix {
 public:
  /// rows: G. The net must outlive it. Cost: linear.
  FactoredMatrix(const Net& net, EdgeAlignedRows rows, ThreadTeam& team);

  [[nodiscard]] std::size_t size() const noexcept { return net_->moving; }
  /// The number of rows of G.
  [[nodiscard]] std::size_t inner_size() const noexcept { return size() + rows_.further.rows(); }
  [[nodiscard]] double diagonal(std::size_t i) const {
    double sum = 0;
    for_column(i, [&](std::size_t, float value) { sum += static_cast<double>(value * value); });
    return sum;
  }
  /// Calls use(column, value) for the entries of row i of G.
  template <typename Use>
  void for_row(std::size_t i, const Use& use) const {
    if (i < size()) {
      use(i, rows_.diagonal[i]);
      for_links(i, rows_.beside, use);
    } else {
      for (const FloatRows::Entry& entry : rows_.further.row(i - size())) use(entry.column, entry.value);
    }
  }
  /// Calls use(row, value) for the entries of column i of G.
  template <typename Use>
  void for_column(std::size_t i, const Use& use) const {
    use(i, rows_.diagonal[i]);
    for_links(i, across_, use);
    for (const FloatRows::Entry& entry : further_columns_.row(i)) use(size() + entry.column, entry.value);
  }

 private:
  template <typename Use>
  void for_links(std::size_t i, const std::vector<float>& values, const Use& use) const {
    const auto links = net_->rings.links(i);
    const float* value = values.data() + net_->rings.begin(i);
    for (const Link link : links) {
      const float one = *value++;
      if (link.spoke() && link.node() < size()) use(link.node(), one);
    }
  }

  const Net* net_;
  EdgeAlignedRows rows_;
  std::vector<float> across_;  // per link the entry in the neighbour's row
  FloatRows further_columns_;
};

/// The Laplacian of the moving nodes' graph with weights of one; needs no memory. The net must outlive it.
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

/// upᵀ matrix up in double precision. Cost: linear; stores no intermediate matrix.
SparseRows galerkin(const FloatRows& down, const LevelMatrix& matrix, const FloatRows& up, ThreadTeam& team);

}  // namespace vspring
