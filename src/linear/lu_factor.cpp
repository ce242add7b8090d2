#include "linear/lu_factor.hpp"

#include <algorithm>
#include <new>

#include "base/cancellation.hpp"

namespace vspring {

namespace {

// Mean entries from the first one of a column to the diagonal, up to which the matrix counts as a band; closed curves
// have about 15.
constexpr Eigen::Index entries_of_band = 32;

bool is_band(const Eigen::SparseMatrix<double>& matrix) {
  Eigen::Index above = 0;
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    const Eigen::SparseMatrix<double>::InnerIterator first(matrix, column);
    if (first) above += std::max<Eigen::Index>(column - first.row(), 0);
  }
  return above <= entries_of_band * matrix.cols();
}

}  // namespace

void EliminationOrder::operator()(const Eigen::SparseMatrix<double>& matrix, PermutationType& permutation) const {
  permutation.resize(matrix.cols());
  permutation.setIdentity();
  if (is_band(matrix)) return;
  PermutationType inverse;
  Eigen::AMDOrdering<int>()(matrix, inverse);
  permutation = inverse.inverse();
}

// By panels of columns, each updated by the supernodes left of it: J. W. Demmel, S. C. Eisenstat, J. R. Gilbert, X. S.
// Li, J. W. H. Liu, "A supernodal approach to sparse partial pivoting", SIAM J. Matrix Anal. Appl. 20(3), 1999. The
// steps are Eigen's, in the order of Eigen's own.

/// Buffers; those marked have `size` entries for every column of a panel.
struct LuFactor::Workspace {
  Workspace(Eigen::Index columns, const Eigen::internal::perfvalues& widths, const PermutationType& order)
      : size(columns),
        first_of_segment(IndexVector::Constant(columns * widths.panel_size, Eigen::internal::emptyIdxLU)),
        rows(first_of_segment),
        segments(IndexVector::Zero(columns)),
        parent(IndexVector::Zero(columns)),
        reached(IndexVector::Zero(columns)),
        pruned(IndexVector::Zero(columns)),
        marks(IndexVector::Zero(columns * Eigen::internal::LUNoMarker)),
        relaxed_end(columns),
        place(order.inverse()),
        dense(ScalarVector::Zero(columns * widths.panel_size)),
        scratch(ScalarVector::Zero((widths.maxsuper + columns) * widths.panel_size)) {}

  Eigen::Index size;
  IndexVector first_of_segment;  ///< per column of the panel
  IndexVector rows;              ///< likewise
  IndexVector segments;
  Eigen::Index segments_of_panel = 0;
  IndexVector parent;
  IndexVector reached;
  IndexVector pruned;
  IndexVector marks;
  IndexVector relaxed_end;
  PermutationType place;
  ScalarVector dense;  ///< per column of the panel
  ScalarVector scratch;
  Eigen::Index panel = 0;  ///< its first column
};

void LuFactor::begin_panel(Workspace& work, Eigen::Index first, Eigen::Index width) {
  work.panel = first;
  panel_dfs(work.size, width, first, m_mat, m_perm_r.indices(), work.segments_of_panel, work.dense, work.rows,
            work.segments, work.first_of_segment, work.pruned, work.marks, work.parent, work.reached, m_glu);
  panel_bmod(work.size, width, first, work.segments_of_panel, work.dense, work.scratch, work.segments,
             work.first_of_segment, m_glu);
}

bool LuFactor::eliminate(Workspace& work, Eigen::Index column, Eigen::Index place) {
  const auto own = [&](auto& all) { return all.segment(place * work.size, work.size); };
  const auto need_memory = [](Eigen::Index missing) {
    if (missing != 0) throw std::bad_alloc();
  };
  auto first_of_segment = own(work.first_of_segment);
  auto dense = own(work.dense);
  Eigen::Index segments = work.segments_of_panel;
  need_memory(column_dfs(work.size, column, m_perm_r.indices(), m_perfv.maxsuper, segments, own(work.rows),
                         work.segments, first_of_segment, work.pruned, work.marks, work.parent, work.reached, m_glu));
  auto beyond_panel = work.segments.tail(work.size - work.segments_of_panel);
  need_memory(column_bmod(column, segments - work.segments_of_panel, dense, work.scratch, beyond_panel,
                          first_of_segment, work.panel, m_glu));
  need_memory(copy_to_ucol(column, segments, work.segments, first_of_segment, m_perm_r.indices(), dense, m_glu));
  Eigen::Index pivot = 0;
  if (pivotL(column, m_diagpivotthresh, m_perm_r.indices(), work.place.indices(), pivot, m_glu) != 0) return false;
  pruneL(column, m_perm_r.indices(), pivot, segments, work.segments, first_of_segment, work.pruned, m_glu);
  for (const int segment : work.segments.head(segments)) first_of_segment(segment) = Eigen::internal::emptyIdxLU;
  return true;
}

void LuFactor::factorize(const Eigen::SparseMatrix<double>& matrix) {
  constexpr auto nothing = Eigen::internal::emptyIdxLU;
  const Eigen::Index size = matrix.cols();
  m_isInitialized = true;
  m_factorizationIsOk = false;
  m_info = Eigen::NumericalIssue;
  m_mat = matrix * m_perm_c.inverse();
  if (memInit(size, size, m_mat.nonZeros(), 0, m_perfv.fillfactor, m_perfv.panel_size, m_glu) != 0)
    throw std::bad_alloc();
  Workspace work(size, m_perfv, m_perm_c);
  relax_snode(size, m_etree, m_perfv.relax, work.marks, work.relaxed_end);
  work.marks.setConstant(nothing);
  m_perm_r.resize(size);
  m_perm_r.indices().setConstant(nothing);
  m_glu.supno(0) = nothing;
  m_glu.xsup.setZero();
  m_glu.xlsub(0) = m_glu.xusub(0) = m_glu.xlusup(0) = 0;
  for (Eigen::Index first = 0; first < size;) {
    end_if_cancelled();
    // The panel ends before the next relaxed supernode begins.
    Eigen::Index end = first + 1;
    while (end < std::min(first + m_perfv.panel_size, size) && work.relaxed_end(end) == nothing) ++end;
    begin_panel(work, first, end - first);
    for (Eigen::Index column = first; column < end; ++column) {
      end_if_cancelled();
      if (!eliminate(work, column, column - first)) return;
    }
    first = end;
  }
  countnz(size, m_nnzL, m_nnzU, m_glu);
  fixupL(size, m_perm_r.indices(), m_glu);
  m_Lstore.setInfos(size, size, m_glu.lusup, m_glu.xlusup, m_glu.lsub, m_glu.xlsub, m_glu.supno, m_glu.xsup);
  new (&m_Ustore) Eigen::MappedSparseMatrix<double, Eigen::ColMajor, int>(size, size, m_nnzU, m_glu.xusub.data(),
                                                                          m_glu.usub.data(), m_glu.ucol.data());
  m_info = Eigen::Success;
  m_factorizationIsOk = true;
}

}  // namespace vspring
