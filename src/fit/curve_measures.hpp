#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "curve_fit/curve_fitter.hpp"
#include "fit/counting_points.hpp"
#include "fit/curve_fit_input.hpp"
#include "vspring/context.hpp"
#include "vspring/distance.hpp"
#include "vspring/figures.hpp"
#include "vspring/resample.hpp"

namespace vspring {

/// The nodes that are wanted on a curve, and how good they are.
struct MeasuredNodes {
  Resampled nodes;        ///< with the file's own chains, or new ones
  double figure = 0;      ///< what is to be within the tolerance
  double way_off = 0;     ///< from the polyline of the points
  double way_beyond = 0;  ///< the greatest distance from it as a multiple of the allowed one; 0: none exceeds that
  double radius_kept = 1;
  Index new_folds = 0;  ///< edges that turn back against the one before, more of them than in the input
  CurveFigures figures = {};
};

/// Where a curve is bent most.
struct SharpestNode {
  Index node = -1;  ///< none where nothing is bent
  double radius = std::numeric_limits<double>::infinity();
};

// In distances from the curve: points no further from a held node are at it, and points a little further are about it.
inline constexpr double at_held = 1.001;
inline constexpr double about_held = 1.25;

/// Measures nodes on the curve that was found for an input, by the options. input, found: are looked at in each call,
/// and have to outlive it.
class CurveMeasures {
 public:
  CurveMeasures(const CurveFitInput& input, const CurveFound& found, int threads);

  [[nodiscard]] MeasuredNodes measured(Resampled nodes) const;

  /// The distances of the points; where nodes keep coordinates, how far they moved.
  [[nodiscard]] std::vector<double> distances(const PolygonCurve& from) const;
  /// The same, but 0 for points beyond the tolerance whose distance no fit can lower: those nearest to a held node, or
  /// not much further from it (by the factor as_far) than from the curve.
  [[nodiscard]] std::vector<double> movable_distances(const Resampled& nodes, double as_far = at_held) const;
  [[nodiscard]] bool is_at_held(std::size_t point, double distance, const Resampled& nodes) const;
  /// Of the points at the start.
  [[nodiscard]] const std::vector<double>& distances_before() const { return before_; }
  /// 1 for points of these that count at such distances.
  [[nodiscard]] std::vector<std::uint8_t> counting(const std::vector<double>& distances,
                                                   const std::vector<std::uint8_t>& of) const {
    return counting_->at(distances, of);
  }
  /// What is to be within the tolerance.
  [[nodiscard]] double figure(const std::vector<double>& distances) const;
  /// How far places of the curve are from the polyline of the points, which are its own nodes; without a count where
  /// they are not.
  [[nodiscard]] Distance way_off(const PolygonCurve& moved) const;
  /// The greatest way of a node along the curve.
  [[nodiscard]] double greatest_slide(const PolygonCurve& moved) const;
  /// Where a shape is bent most, if that is asked for.
  [[nodiscard]] SharpestNode sharpest(const PolygonCurve& shape, const Resampled& nodes) const;
  /// The radius as a share of the least radius; 1 where it is no smaller.
  [[nodiscard]] double radius_kept(const SharpestNode& most) const;
  /// Edges that turn by more than 90° against the one before, but at corners.
  [[nodiscard]] Index folds(const Resampled& nodes) const;
  /// The edges of a shape, with the constraints of its nodes.
  [[nodiscard]] DenseCurve chords(const PolygonCurve& shape, const Resampled& nodes) const;
  /// 1 for those of these nodes that are corners of the curve that was found.
  [[nodiscard]] std::vector<std::uint8_t> corners(const Resampled& nodes) const;

 private:
  /// Whether nodes are those of the input, and have moved only as they may.
  [[nodiscard]] bool keep_stations(const PolygonCurve& moved) const;
  [[nodiscard]] double way_beyond(const Resampled& nodes) const;
  /// The polyline of the points, in the order of the way that was found, less what was left out.
  [[nodiscard]] std::optional<PolygonCurve> way() const;

  const CurveFitInput& input_;
  const CurveFound& found_;
  Context context_;  // its own, as it also measures after a cancellation
  std::vector<double> before_;
  std::optional<CountingPoints> counting_;
};

}  // namespace vspring
