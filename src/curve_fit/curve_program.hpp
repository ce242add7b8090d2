#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "curve_fit/dense_curve.hpp"
#include "linear/ball_program.hpp"

namespace vspring {

/// A point that a curve is drawn to, in the fit's coordinates.
struct CurvePoint {
  Vector3 place = Vector3::Zero();
  double weight = 1;
  CurvePlace at = {};  ///< the place that is nearest to it
  Index number = -1;   ///< among the given points; −1: a place of the polyline through them
  double bound = 0;    ///< greatest distance allowed; 0: any
  double price = 0;    ///< for exceeding the bound, as of rows of a program; 0: not allowed
};

/// One Gauss–Newton step: nodes move across a curve, in one direction in a plane (K = 1), two in space; or along as
/// many coordinates as may change.
template <int K>
class CurveProgram {
 public:
  using Basis = Eigen::Matrix<double, 3, K>;

  /// plane: its normal, for K = 1. ahead: corners move across the edge after them, else across the edge before.
  CurveProgram(const DenseCurve& curve, const Vector3& plane, bool ahead = true);

  /// weights: per edge, of the squared change of curvature along it.
  void add_variation(std::span<const double> weights);
  void add_bending(double weight) { add_bending(weight, false); }
  /// Adds variation without the effect of changing lengths on curvature. Then points balance the second derivative of
  /// curvature, which displaces springs; on circles and clothoids it is zero.
  void add_springs(double weight) { add_bending(weight, true); }
  /// Adds a point; data_weight is multiplied by the point's own. The distance is across the curve, or in the
  /// coordinates that may change. Returns the number of its row.
  std::size_t add_point(const CurvePoint& point, double data_weight);
  /// Bounds the distance of a place from a point, across the curve. Returns the number of its row.
  std::size_t add_bound(const CurvePoint& point);
  /// Bounds the curvature at nodes.
  void add_greatest_curvature(double most);

  [[nodiscard]] BallSolution solve() const { return vspring::solve(program_); }
  /// Calls use() with every moving node and its displacement.
  template <typename Use>
  void for_moves(const BallSolution& solution, Use use) const {
    for (std::uint32_t i = 0; i < curve_.size(); ++i) {
      if (block_[i] < 0) continue;
      Vector3 move = Vector3::Zero();
      for (int k = 0; k < K; ++k) move += bases_[i].col(k) * solution.x[static_cast<std::size_t>(block_[i]) * K + k];
      use(i, move);
    }
  }
  [[nodiscard]] std::size_t blocks() const { return program_.blocks; }

 private:
  void add_bending(double weight, bool as_springs);
  using Row = typename BallProgram<K>::Row;
  void number();
  [[nodiscard]] Basis across(const Vector3& direction) const;
  [[nodiscard]] Basis axes() const;
  [[nodiscard]] Basis ways_of(const Vector3& direction) const;
  [[nodiscard]] Vector3 along(const CurvePoint& point) const;
  std::size_t add_row_of(const CurvePoint& point, double weight, const Basis& ways);
  void add_entry(Row& row, std::uint32_t node, const Eigen::Matrix<double, K, 3>& slope) const;

  const DenseCurve& curve_;
  Vector3 plane_;
  std::vector<std::int32_t> block_;
  std::vector<Basis> bases_;
  BallProgram<K> program_;
};

/// Per edge the weight of the squared change of curvature along it: the inverse length, times the cube of the relative
/// spacing that nodes would have by the inverse root of curvature. So a nose may turn at once, and the curve does not
/// swing next to it. evenly: the inverse length alone.
std::vector<double> weights_of_change(const DenseCurve& curve, bool evenly);

extern template class CurveProgram<1>;
extern template class CurveProgram<2>;

}  // namespace vspring
