#pragma once

#include "fit/curve_measures.hpp"
#include "vspring/context.hpp"

namespace vspring {

/// In tolerances, or in distances of another curve from the polyline of the points.
inline constexpr double far_off_way = 2;
/// Share of the tolerance to which nodes beyond it are drawn.
inline constexpr double share_of_nearer = 0.997;

/// Corrects the nodes of a table after they were put on the curve that was found. All arguments have to outlive it.
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
