#pragma once

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

namespace vspring {

/// The order in which unknowns are eliminated: as they are where the matrix is a band but for a few columns, as along
/// a curve, open or closed; else by minimum degree, which takes long and cannot be broken off.
struct EliminationOrder {
  using PermutationType = Eigen::AMDOrdering<int>::PermutationType;
  void operator()(const Eigen::SparseMatrix<double>& matrix, PermutationType& permutation) const;
};

/// Eigen's factors L U with rows exchanged, but that factorising ends where it is cancelled: of a curve of very many
/// nodes, or of nodes of very many neighbours, that takes long. What it says of determinants is not valid.
class LuFactor : public Eigen::SparseLU<Eigen::SparseMatrix<double>, EliminationOrder> {
 public:
  void factorize(const Eigen::SparseMatrix<double>& matrix);

 private:
  struct Workspace;
  /// Leaves in the workspace what updates its columns, from column `first` on, once it has found that.
  void begin_panel(Workspace& work, Eigen::Index first, Eigen::Index width);
  /// False where the column has no pivot. place: in the panel.
  bool eliminate(Workspace& work, Eigen::Index column, Eigen::Index place);
};

}  // namespace vspring
