#pragma once

#include <vector>

#include "vspring/fit.hpp"

namespace vspring {

/// One coordinate of a curve in space over the length of its way in the other two, which stay: its curvature is that of
/// these heights, whatever the way.
class Profile {
 public:
  /// Whether one coordinate moves and the other two do not lie on a line.
  static bool is_needed(const PolygonCurve& curve, const Constraints& constraints, const FitOptions& options);

  /// Throws Error(unusable_shape) naming a node where chains meet or are closed: they have no length of the way there.
  Profile(const PolygonCurve& curve, const Constraints& constraints, const FitOptions& options);

  /// With the length of the way for x, and for y what moves.
  [[nodiscard]] const PolygonCurve& curve() const { return profile_; }
  [[nodiscard]] const Constraints& constraints() const { return held_; }
  [[nodiscard]] const FitOptions& options() const { return options_; }

  /// The positions of the curve's nodes with these places in the profile.
  [[nodiscard]] std::vector<Vector3> lifted(const std::vector<Vector3>& places) const;
  /// The same of new nodes, which lie on the way between the old ones.
  void lift(ResampledFit& made) const;

 private:
  void hold(Index node, const Vector3& way);

  const PolygonCurve& input_;
  const Constraints& constraints_;
  FitOptions options_;
  int axis_ = 0;  ///< that moves
  PolygonCurve profile_;
  Constraints held_;
};

}  // namespace vspring
