#pragma once

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

namespace vspring {

/// The order in which unknowns are eliminated: as they are if the matrix is a band except for a few columns, as along a
/// curve; else by minimum degree, which is slow and cannot be cancelled.
struct EliminationOrder {
  using PermutationType = Eigen::AMDOrdering<int>::PermutationType;
  void operator()(const Eigen::SparseMatrix<double>& matrix, PermutationType& permutation) const;
};

/// Eigen's factors L U with row exchanges, but cancellation ends the factorisation, which is long for very many nodes
/// or neighbours. Its determinants are not valid.
///
/// Eigen's public calls factorise as a whole, and call nothing of ours on the way; so this goes by members of
/// Eigen::SparseLU that are open to derived classes only, as they are in Eigen 3.4.
class LuFactor : public Eigen::SparseLU<Eigen::SparseMatrix<double>, EliminationOrder> {
 public:
  void factorize(const Eigen::SparseMatrix<double>& matrix);

 private:
  struct Workspace;
  /// Finds the updates of the panel's columns, from column `first` on, and leaves them in the workspace.
  void begin_panel(Workspace& work, Eigen::Index first, Eigen::Index width);
  /// Returns false if the column has no pivot. place: in the panel.
  bool eliminate(Workspace& work, Eigen::Index column, Eigen::Index place);
};

}  // namespace vspring
