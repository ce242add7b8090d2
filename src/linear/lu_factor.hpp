#pragma once

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

namespace vspring {

/// What SparseLU expects of an ordering is the inverse of Eigen's own by minimum degree.
struct MinimumDegree {
  using PermutationType = Eigen::AMDOrdering<int>::PermutationType;
  void operator()(const Eigen::SparseMatrix<double>& matrix, PermutationType& permutation) const {
    PermutationType inverse;
    Eigen::AMDOrdering<int>()(matrix, inverse);
    permutation = inverse.inverse();
  }
};

/// Eigen's factors L U with rows exchanged, but that factorising ends where it is cancelled: of a curve of very many
/// nodes, or of nodes of very many neighbours, that takes long. What it says of determinants is not valid.
class LuFactor : public Eigen::SparseLU<Eigen::SparseMatrix<double>, MinimumDegree> {
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
