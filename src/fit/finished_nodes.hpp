#pragma once

#include "fit/curve_measures.hpp"
#include "vspring/context.hpp"

namespace vspring {

/// Of the tolerance, or of how far another curve is from the polyline of the points.
inline constexpr double far_off_way = 2;
/// Of the tolerance, where what is beyond it is drawn nearer.
inline constexpr double share_of_nearer = 0.997;

/// What is done to the nodes of a table after these were put on the curve that was found. All arguments have to outlive
/// it.
class FinishedNodes {
 public:
  FinishedNodes(const CurveFitInput& input, const CurveMeasures& measures, CurveFound& found, const Context& context)
      : input_(input), measures_(measures), found_(found), context_(context) {}

  /// Draws nodes to where their chords are within the tolerance, pulls them to their rows where the curve is not, and
  /// takes the rows themselves where these are fairer.
  void finish(MeasuredNodes& nodes);

 private:
  void draw_chords_in(MeasuredNodes& before);
  void pull_to_rows(MeasuredNodes& found);
  void keep_what_is_fairer(MeasuredNodes& found) const;

  const CurveFitInput& input_;
  const CurveMeasures& measures_;
  CurveFound& found_;
  const Context& context_;
};

}  // namespace vspring
