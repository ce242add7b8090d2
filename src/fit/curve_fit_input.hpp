#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "curve_fit/curve_fitter.hpp"
#include "shape/frame.hpp"
#include "vspring/fit.hpp"

namespace vspring {

/// The input of a fit of a curve, as given and in the coordinates of the solver.
class CurveFitInput {
 public:
  /// Throws what check_constraints() does; ends may be free where points pull at them. Throws Error(unusable_shape)
  /// where coordinates that do not move go back and forth along a chain, and Error(invalid_argument) where some do not
  /// and the points are not the nodes.
  CurveFitInput(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                const FitOptions& options, const Context& context);

  /// Finds outliers: first points far aside of the way, then points far from a robust curve, as many as the options
  /// allow. Warns where there are more.
  void leave_outliers_out();
  /// Warns of a few points that seem to be off, and leaves none out.
  void name_outliers();

  [[nodiscard]] CurveFitTask task() const;

  [[nodiscard]] const PolygonCurve& curve() const { return curve_; }
  [[nodiscard]] const Constraints& constraints() const { return constraints_; }
  [[nodiscard]] const ScatteredPoints& points() const { return points_; }
  [[nodiscard]] const FitOptions& options() const { return options_; }
  [[nodiscard]] const std::vector<Warning>& warnings() const { return warnings_; }
  /// Whether the points are the curve's own nodes.
  [[nodiscard]] bool own_nodes() const { return own_nodes_; }
  /// Of every point, 0 for nodes of no chain.
  [[nodiscard]] const std::vector<std::uint8_t>& counted() const { return counted_; }
  /// The same, 0 for outliers too.
  [[nodiscard]] const std::vector<std::uint8_t>& kept() const { return kept_; }
  [[nodiscard]] bool pulls() const;
  /// Points nearest to nodes that move, those nodes, and the most points at one of them.
  [[nodiscard]] Index pulling_points() const { return pulling_points_; }
  [[nodiscard]] Index pulled_nodes() const { return pulled_nodes_; }
  [[nodiscard]] Index most_points() const { return most_points_; }
  /// Where a node is, or is held.
  [[nodiscard]] const Vector3& place(Index node) const {
    return constraints_.position_fixed(node) ? constraints_.position(node) : curve_.position(node);
  }

  [[nodiscard]] Vector3 to_local(const Vector3& place) const { return frame_.to_local(place); }
  [[nodiscard]] Vector3 to_input(const Vector3& place) const { return place / frame_.scale() + centre_; }
  /// 1 for coordinates that move, 0 for others: all of them where all nodes have the same values of the others.
  [[nodiscard]] const Vector3& moving() const { return moving_; }
  /// A node's own values of the coordinates that it keeps, and those of a place of the curve for the others.
  [[nodiscard]] Vector3 moved(Index node, const Vector3& place) const;
  /// Lengths of the input in local ones.
  [[nodiscard]] double scale() const { return frame_.scale(); }

 private:
  [[nodiscard]] double weight(std::size_t j) const { return points_.weights.empty() ? 1 : points_.weights[j]; }
  /// Where the curve goes: no outlier.
  [[nodiscard]] bool is_said(Index node) const {
    return constraints_.position_fixed(node) || constraints_.corner(node);
  }
  /// Nodes of the chains, as many as there may be.
  [[nodiscard]] std::vector<Index> spikes(std::size_t most) const;
  /// Points far from a robust curve, the furthest first.
  [[nodiscard]] std::vector<Index> deviating() const;
  void check(const Context& context);
  void count_point(Index node, std::vector<Index>& points_of);
  void make_frame();
  void find_moving(std::span<const Vector3> places);
  void check_stations() const;
  [[nodiscard]] Vector3 tangent_across(const PolygonCurve::Chain& chain, Index node) const;

  const PolygonCurve& curve_;
  const Constraints& constraints_;
  const ScatteredPoints& points_;
  const FitOptions& options_;
  bool own_nodes_;
  Frame frame_;
  Vector3 centre_ = Vector3::Zero();
  std::optional<Vector3> plane_;  ///< its normal, where all lies in one
  Vector3 moving_ = Vector3::Ones();
  std::vector<std::uint8_t> counted_;
  std::vector<std::uint8_t> kept_;
  std::vector<Warning> warnings_;
  Index pulling_points_ = 0;
  Index pulled_nodes_ = 0;
  Index most_points_ = 0;
};

}  // namespace vspring
