#pragma once

#include <array>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "vspring/distance.hpp"
#include "vspring/export.hpp"
#include "vspring/fair.hpp"
#include "vspring/point_file.hpp"
#include "vspring/resample.hpp"

namespace VSPRING_API vspring {

/// The paper's k (Eq. 9), for points of weight 1: 0 to 1e50. A small k smooths, a large one interpolates. On an evenly
/// spaced curve with one point per node, waves of angular frequency ω keep 1/(1 + (λω)⁴) of their height, where k =
/// (ℓ/λ)⁴/8 and ℓ is the length of the edges.
struct Weight {
  double k = 0.01;  ///< without unit
};

/// A weight that means the same at every resolution: a length λ, in units of the input, more than 0. The fit minimises
/// about ∫ (curvature)² + λ⁻⁴ Σ (share of the point) (distance)². Every point stands for an equal share of the moving
/// length (area), times its own weight. In dense points, waves of angular frequency ω keep 1/(1 + (λω)⁴) of their
/// height. docs/fit.md says which k this is.
struct SmoothingLength {
  double length;  ///< λ
};

/// The fairest shape from which no point lies further than `distance`, in units of the input, more than 0. Surfaces:
/// the shape of least bending. Curves: the one whose curvature changes least; if the points are its own nodes, it also
/// stays within `distance` of their polyline (docs/curves.md). EquilibriumMethod only. A surface fitted to its own
/// nodes, with Distribution::keep, fallbacks and no given normals, uses the filters of Noise instead if its noise is
/// 1/6 to 1/2 of `distance` and at least 1/100 of the median edge: they remove noise of a third of `distance`, and
/// nodes that end further away go back (docs/fit.md).
struct Within {
  double distance;  ///< of the furthest point
};

/// The fairest shape whose root mean square distance from the points is at most `distance`, in units of the input, more
/// than 0. Surfaces: the one of the largest smoothing length. Curves: the one whose curvature changes least, as for
/// Within. EquilibriumMethod only. A surface fitted to its own nodes, with Distribution::keep and no given normals,
/// uses the filters of Noise instead, with `distance` as the deviation; if the root mean square is larger then, nodes
/// go back towards their places in the input. The filters are not used if they leave less than 0.7 of `distance`.
struct RootMeanSquare {
  double distance;  ///< the root mean square over the points
};

/// Removes noise. `deviation`: its standard deviation in each coordinate, in units of the input, more than 0;
/// estimate_noise() tells it. Surfaces fitted to their own nodes, with Distribution::keep: filters do it, each where it
/// is expected to come nearest to the true shape, and may move nodes along the surface, too. With given normals, an
/// equilibrium near the filtered shape follows. See docs/fit.md. Cost: linear. Memory: about 2,500 bytes a node.
///
/// Curves: RootMeanSquare, with the distance at which the curve is expected to be nearest to the true one, by Mallows'
/// C_p with every parameter counted three times. The result depends little on the deviation. Cost: that of
/// RootMeanSquare.
struct Noise {
  double deviation;  ///< in each coordinate
};

/// Surfaces of voxels, fitted to their own nodes: removes the steps. size: of a voxel along x, y and z, see
/// voxel_size(). The result is the fairest surface for a smoothing length of twice the cube root of a voxel's volume.
/// Nodes that would move more than half a voxel get more weight, until none does. A closed surface keeps its volume.
/// Nodes keep their distribution unless another is given. Cost: up to six times that of SmoothingLength.
struct Voxels {
  Vector3 size;  ///< along x, y and z, more than 0
};

/// How closely a fit follows the points.
using FitCriterion = std::variant<Weight, SmoothingLength, Within, RootMeanSquare, Noise, Voxels>;

/// How a shape is drawn to points. Each member says what its default means.
struct FitOptions {
  /// What decides how closely.
  FitCriterion criterion = Weight{};
  /// Options as for fair(). Fallbacks, if no equilibrium is found and max_iterations is not given: a surface of least
  /// bending near the points, with a warning; for Weight and SmoothingLength then what half of the length, a quarter,
  /// up to a 32nd leads to, with a warning (smoothed_less); a curve drawn with nodes of its own, on which the given
  /// nodes are then placed (docs/curves.md). With fair_boundary the boundary of a surface is fitted first, as a curve,
  /// and the surface then holds it. If the points are the surface's own nodes, the boundary is fitted to its own; else,
  /// by EquilibriumMethod only, to where the points end near it (BoundaryOfPoints). With sharp_edges, in fits to the
  /// surface's own nodes, chains are fitted before the sides. Noise and RootMeanSquare: to where the sides on both
  /// hands meet, by planes and quadratics fitted to their nodes; corners of three sides or more, and ends inside the
  /// surface, move, too. Fits to scattered points hold them.
  FairOptions fair = {};
  /// The share of the points that may be left out, 0 to less than 1. At most so many, the furthest ones. Of
  /// a surface's own nodes: found beforehand, those more than 3.5 standard deviations off the nodes around them, of the
  /// noise or of what a quadratic leaves there. Of scattered points: those over 4.5 standard deviations from the shape
  /// (1.4826 times the median distance), or further away than the tolerance of Within; shape and outliers are found in
  /// turns. Curves drawn to a tolerance: found beforehand, points far off the way, and points over 4.5 standard
  /// deviations from a robust curve.
  double outliers = 0;
  /// Curves fitted to their own nodes, by EquilibriumMethod: which of x, y and z may change, as the heights of a
  /// profile; nodes keep the others to the bit. Distances are then those between a node's old and new place, in the
  /// coordinates that may change. If one coordinate of a curve in space may change, it is drawn over the length of the
  /// way in the other two.
  std::array<bool, 3> moving_axes = {true, true, true};
  /// Curves: the least radius of curvature of a node, by the circle through it and its neighbours, kept to 1 %; in
  /// units of the input; 0: any. If points, ends or held directions do not allow it, a warning names the node that is
  /// bent most, and the outcome is not `converged`. The curve is then drawn with nodes of its own also for Weight and
  /// SmoothingLength. EquilibriumMethod only.
  double least_radius = 0;
  /// Curves: an angle in degrees, less than 180. A place at which the nodes' way turns by more than this within about
  /// eight tolerances is a corner: direction and curvature may jump there, and each side is fair by itself. Corners
  /// move with their points. 0: only FairOptions::corners. EquilibriumMethod only.
  double sharp = 0;
  /// Surfaces with FairOptions::fair_boundary and scattered points: how far from the boundary points may be to tell
  /// where it is, in units of the input. 0, or less than two median edges of a loop: these two edges. Of a refined mesh
  /// Refined::boundary_reach, that is, two edges of the mesh before.
  double boundary_reach = 0;

  /// Throws Error(invalid_argument) naming the option and its range.
  void validate() const;

  /// The k of Weight; empty for another criterion.
  [[nodiscard]] std::optional<double> weight() const;
  /// Likewise of SmoothingLength.
  [[nodiscard]] std::optional<double> smoothing_length() const;
  /// Likewise the distance of Within.
  [[nodiscard]] std::optional<double> within() const;
  /// Likewise the distance of RootMeanSquare.
  [[nodiscard]] std::optional<double> rms() const;
  /// Likewise the deviation of Noise.
  [[nodiscard]] std::optional<double> noise() const;
  /// Likewise the size of Voxels.
  [[nodiscard]] std::optional<Vector3> voxels() const;
  /// The one of within() and rms() that is given, if any.
  [[nodiscard]] std::optional<double> tolerance() const;
  /// Whether all coordinates may change.
  [[nodiscard]] bool moves_freely() const { return moving_axes == std::array{true, true, true}; }
};

/// Distances of points from the polygons or edges of a shape, see distance(), in units of the input.
struct PointDistances {
  Distance all;             ///< `node` is the number of the furthest point
  double median = 0;        ///< half of the points are nearer
  double percentile90 = 0;  ///< 90 % are nearer
  double percentile99 = 0;  ///< 99 % are nearer
};

/// How the boundary of a surface was fitted to points, with FairOptions::fair_boundary.
struct BoundaryOfPoints {
  Index points = 0;  ///< points near the boundary at which the points end
  // Counts of boundary nodes with a free position:
  Index ends = 0;    ///< the points end near them; they move there
  Index inside = 0;  ///< the points go on beyond them; they move across, onto the points
  Index kept = 0;    ///< no points are near enough to tell; they stay, with a warning
};

/// What a fit did, and how it ended.
struct FitReport {
  FairReport fair;  ///< as of fair(); look at usable() first
  /// With FairOptions::fair_boundary, for a surface and scattered points.
  std::optional<BoundaryOfPoints> boundary = std::nullopt;
  Index points = 0;  ///< that were given
  /// Points tied to a moving node at the end. The others are nearest to fixed nodes, or have no weight.
  Index pulling_points = 0;
  Index pulled_nodes = 0;              ///< moving nodes with points tied to them at the end
  Index most_points = 0;               ///< the most points that are tied to one of them
  Index outliers = 0;                  ///< points left out; `after` does not count them
  std::vector<Index> outlying_points;  ///< their numbers, ascending
  /// With Noise on curves: the root mean square distance that the curve is drawn to.
  std::optional<double> noise_leaves = std::nullopt;
  /// The smoothing length, given or, for a tolerance, found. Empty for the paper's k, and where plain fairing or the
  /// filters of noise stay within the tolerance.
  std::optional<double> smoothing_length = std::nullopt;
  /// With Within: the points at that distance, to 1 %, ascending. They prevent a fairer shape.
  std::vector<Index> active_points;
  Index outside_points = 0;  ///< with Within or RootMeanSquare: points further away than that, of those that count
  /// Points nearest to something held, at the start and at the end, outliers apart, and how far away they are; none of
  /// those that are a curve's own nodes. Nothing that moves comes nearer to them, so `before`, `after`, outside_points
  /// and tolerances do not count them, unless there are no others.
  Distance at_held = {};
  /// With FitOptions::least_radius: the least radius of curvature of the new curve. Empty if nothing is bent.
  std::optional<double> least_radius = std::nullopt;
  Index sharpest_node = -1;  ///< the node of that radius, or −1
  /// Distances of the points from the shape as it came. The count is 0 if the fit was cancelled and had too many points
  /// to measure.
  PointDistances before;
  /// Likewise from the new shape.
  PointDistances after;
  /// Distances of the shape from the points, for shapes fitted to their own nodes; else the count is 0. Surfaces: of
  /// nodes from the input. Curves drawn to a tolerance: of nodes and places on edges (the middles, or every tenth of a
  /// tolerance) from the polyline of the points, outliers apart, both followed in their order; that is up to a tenth
  /// more than the distance to the nearest place.
  Distance shape = {};
  /// How far a node moved along the shape at most, if the points are its own nodes; in units of the input.
  double greatest_slide = 0;
};

/// A shape that was drawn to points, by the positions of its nodes, and how it was found.
struct FitResult {
  std::vector<Vector3> positions;  ///< one per node; fixed nodes bit for bit; see coordinates() for a flat array
  /// The distance of every point from the new shape, in units of the input; of outliers, too. Empty if the fit was
  /// cancelled and points and nodes together are more than 40,000; see point_distances().
  std::vector<double> distances;
  FitReport report;  ///< look at fair.usable() first
};

/// Fairs a polygonal surface or curve and draws it to scattered points (paper §4.5, indirect constraints; Eq. 9, Fig.
/// 5).
///
/// Every point is tied to the node nearest to it and pulls at it along the node's normal (on curves across its tangent)
/// with k_j times its distance. A node averages the pulls of its points; points near the normal line count more. Every
/// few iterations each point is tied anew, to the nearest among its node and the first- and second-order neighbours of
/// that node (nodes of the same faces, and of their faces).
///
/// A point does not pull if its nearest node at the start takes no part in fairing. On surfaces, a point with a normal
/// pulls only at nodes whose normal is within 90° of its own, so each side of a thin wall has its own points. Faces
/// need not be oriented outwards: if points are clearly nearer with all their normals reversed, they are reversed, with
/// a warning.
///
/// Constraints hold as in fair(). If no point has weight, the result is that of fair(), bit for bit. Points alone may
/// hold a closed shape, though its nodes can then slide (docs/fit.md); boundaries and ends must be held, or be fitted
/// first (FairOptions::fair_boundary). A boundary with nodes that slide is fitted first in any case, along what they
/// slide on; nodes inside cannot slide, and throw Error(unusable_constraint). Between nodes with points, nodes without
/// points are fair.
///
/// Surfaces: nodes where more than two faces meet at an edge, or several fans at a node, are held. With
/// EquilibriumMethod, a surface fitted to its own nodes has lines of edges of three faces fitted first, as curves;
/// nodes near them move along.
///
/// EquilibriumMethod ends where springs and points balance at every node and ties do not change any more. Where ties
/// would alternate, a point changes only to a node that is nearer by a margin. The other methods divide the pull by 1 +
/// k, unless with Forces::printed, so any weight is stable. They end when no node moves further in one iteration than
/// step_tolerance times the mean length of its edges; with small weights nodes may then still be about a step over k
/// from their places.
///
/// For Within and RootMeanSquare a surface is brought to equilibrium ten to a hundred times. If no shape within the
/// tolerance is found, the nearest one is returned, or the input if that is within it, with a warning and an outcome
/// that is not `converged`. Curves are drawn by convex programs instead, with nodes of their own (docs/curves.md);
/// their ends may be free.
///
/// The result has the same bits for every number of threads. Cancellation returns the shape so far with outcome
/// `cancelled`. Arguments are unchanged.
///
/// Throws what fair() throws; Error(invalid_argument) for options out of range, for no points, for weights or normals
/// not as many as points, and, naming the point, for a position further away than 1e50 times the size of the shape, a
/// weight not from 0 to 1e50, and a normal neither zero nor of length 1; Error(unusable_shape) for a shape without a
/// face (edge), and naming a point that is not finite, or the node if it is the same.
///
/// Cost: that of fair(), n log n for the nodes, and linear in the points for every iteration. Memory: under 100 bytes a
/// point, with its position and weight.
[[nodiscard]] FitResult fit(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                            const FitOptions& options, Context& context);
[[nodiscard]] FitResult fit(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                            const FitOptions& options = {});
[[nodiscard]] FitResult fit(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                            const FitOptions& options, Context& context);
[[nodiscard]] FitResult fit(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                            const FitOptions& options = {});

/// A curve with new nodes, drawn to the nodes of the given one.
struct ResampledFit {
  Resampled resampled;  ///< resample() of the fair curve, or of the given one if none was found
  FitResult fit;        ///< positions of the new nodes; the points are the nodes of the given curve
};

/// Puts new nodes, spaced as by resample(), on the fair curve that fits the nodes of `curve`. So a table with rounding
/// or noise becomes a denser or sparser one without.
///
/// With Within, RootMeanSquare and SmoothingLength the new nodes lie on the curve that fit() finds. If chords between
/// them leave the tolerance, nodes move until the chords keep it; if there are too few nodes for that, outcome and a
/// warning say so. Distances are measured from the chords. Moves in the report are distances from the given curve.
///
/// With Weight and no least radius, and with methods other than equilibrium, the curve is resampled first and the new
/// nodes are fitted.
///
/// Throws what resample() and fit() throw. Cost: that of fit().
[[nodiscard]] ResampledFit fit_resampled(const PolygonCurve& curve, const Constraints& constraints,
                                         const Resampling& how, const FitOptions& options, Context& context);
[[nodiscard]] ResampledFit fit_resampled(const PolygonCurve& curve, const Constraints& constraints,
                                         const Resampling& how, const FitOptions& options = {});

/// Returns for every node the greatest distance among the points of which it is the nearest node; 0 if there is none.
/// distances: one per point, as in FitResult. The same bits for every number of threads. Throws Error(invalid_argument)
/// unless points and distances are finite and equal in number, and for points too far away, as fit() does. Cost: n log
/// n.
[[nodiscard]] std::vector<double> node_deviations(std::span<const Vector3> nodes, std::span<const Vector3> points,
                                                  std::span<const double> distances, const Context& context);

}  // namespace vspring
