#pragma once

#include <vector>

#include "vspring/fit.hpp"

namespace vspring {

/// The chains of one node, and those whose nodes all lie at one place: they have no direction. They stay, their points
/// do not count, and the rest of the curve is fitted without them.
class ChainsAtOnePlace {
 public:
  /// Throws what check_constraints() does if the constraints are not of the curve.
  ChainsAtOnePlace(const PolygonCurve& curve, const Constraints& constraints);

  [[nodiscard]] bool are_all() const { return rest_.chains().empty() && !nodes_.empty(); }
  /// The other chains, with all nodes of the curve.
  [[nodiscard]] const PolygonCurve& rest() const { return rest_; }
  /// With nodes held that are of no other chain.
  [[nodiscard]] const Constraints& held() const { return held_; }
  /// New nodes for the rest.
  [[nodiscard]] Resampling for_rest(const Resampling& how) const;

  /// The result of fit_rest(), completed, with a warning; of the curve as it came, where there is no rest.
  template <typename Fit>
  [[nodiscard]] FitResult complete(const ScatteredPoints& points, Fit fit_rest) const {
    FitResult result = are_all() && points.positions == curve_.positions() ? unchanged() : fit_rest();
    add_to(result, points);
    return result;
  }

  /// The curve as it came, where there is no rest.
  [[nodiscard]] ResampledFit unchanged_nodes() const;
  /// Completes the result of a fit of the rest, with a warning.
  void add_to(ResampledFit& made) const;

 private:
  [[nodiscard]] const Vector3& place(Index node) const {
    return held_.position_fixed(node) ? held_.position(node) : curve_.position(node);
  }
  [[nodiscard]] bool is_at_one_place(const PolygonCurve::Chain& chain) const;
  [[nodiscard]] FitResult unchanged() const;
  void add_to(FitResult& result, const ScatteredPoints& points) const;
  void measure_own(FitResult& result) const;
  void warn(FitReport& report) const;

  const PolygonCurve& curve_;
  Constraints held_;
  PolygonCurve rest_;
  std::vector<Index> first_;  ///< the first node of each of these chains
  std::vector<Index> nodes_;  ///< of no other chain
};

}  // namespace vspring
