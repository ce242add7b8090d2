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

/// The paper's k (Eq. 9), for points of weight 1: 0 to 1e50. Small ones smooth, large ones interpolate. On an evenly
/// spaced curve with one point per node, waves of angular frequency ω keep 1/(1 + (λω)⁴) of their height, where k =
/// (ℓ/λ)⁴/8 and ℓ is the length of the edges.
struct Weight {
  double k = 0.01;
};

/// A weight that means the same at every resolution: a length λ, in units of the input, more than 0. About ∫
/// (curvature)² + λ⁻⁴ Σ (share of the point) (distance)² is least. Every point stands for an equal share of the length
/// (area) that moves, times its own weight. Of dense points, waves of angular frequency ω keep 1/(1 + (λω)⁴) of their
/// height. docs/fit.md says which k this is.
struct SmoothingLength {
  double length;
};

/// Surfaces: the shape of least bending from which no point lies further than this, in units of the input, more than 0.
/// Curves: that whose curvature changes least, and which goes no further than this from the polyline of the points
/// either, where these are its own nodes (docs/curves.md). EquilibriumMethod only. Surfaces whose own nodes are the
/// points, with Distribution::keep, fallbacks and no normals given, and noise of a sixth to a half of this and of a
/// hundredth of the median edge or more: a third of this is taken off as noise, by the filters of Noise, and nodes that
/// end further away go back (docs/fit.md).
struct Within {
  double distance;
};

/// Surfaces: the largest smoothing length for which the root mean square of the distances is not above this, in units
/// of the input, more than 0. Curves: that whose curvature changes least, as for Within. EquilibriumMethod only.
/// Surfaces whose own nodes are the points, with Distribution::keep and no normals given, take the filters of Noise
/// instead, with this as its deviation; nodes that end further away, in the root mean square, go back towards where
/// they came from. Where filters leave less than 0.7 of it, they are not used.
struct RootMeanSquare {
  double distance;
};

/// Surfaces whose own nodes are the points, with Distribution::keep: takes noise of this standard deviation in each
/// coordinate off, in the units of the input, more than 0. No equilibrium, but filters, each where it is expected to be
/// nearest to the true shape; nodes go along the surface, too, to where these put them. Where normals are given, an
/// equilibrium next to that. See estimate_noise() and docs/fit.md. Cost: linear. Memory: about 2,500 bytes a node.
///
/// Curves: that whose curvature changes least of those that are as far from the points, in the root mean square, as
/// noise of this deviation leaves: where the expected distance from the truth is least, by Mallows' C_p with every
/// parameter counted three times. It changes little with the deviation. Cost: that of RootMeanSquare.
struct Noise {
  double deviation;
};

/// Surfaces of voxels of this size along x, y and z, whose own nodes are the points: takes their steps off. The fairest
/// surface for a smoothing length of two voxels (the cube root of their volume), with more weight on nodes that would
/// go further than half a voxel across it; so no node does. The volume stays where the surface is closed. Nodes keep
/// their distribution unless another is given. See
/// voxel_size(). Cost: up to six times that of SmoothingLength.
struct Voxels {
  Vector3 size;
};

/// What a fit goes by.
using FitCriterion = std::variant<Weight, SmoothingLength, Within, RootMeanSquare, Noise, Voxels>;

struct FitOptions {
  FitCriterion criterion = Weight{};
  /// As for fair(). Fallbacks, where no equilibrium is found and max_iterations is not given: on surfaces one of
  /// least bending near the points, with a warning; on curves one with nodes of its own, on which the
  /// curve's are put (docs/curves.md). With fair_boundary the boundary of a surface is fitted first, as a curve, and
  /// the surface then holds it: to its own nodes, where these are the points; else to where the points end near it, by
  /// EquilibriumMethod only (BoundaryOfPoints).
  FairOptions fair = {};
  /// The share of the points, from 0 to less than 1, that may be left out. Surfaces: so many, those furthest from the
  /// shape; shape and outliers are found in turns. Curves drawn to a tolerance: at most so many, found before that:
  /// those far aside of the way, and those over 4.5 standard deviations from a curve that single points do not draw
  /// aside.
  double outliers = 0;
  /// Curves whose own nodes are the points, by EquilibriumMethod: of x, y and z those that nodes move in. All nodes
  /// keep the others to the bit. Distances are then those in the coordinates that move, between where a node was and
  /// is: heights of a profile, vertically. Where the others tell no order along the curve, as where one is given in
  /// space, it is drawn over the length of the way in the other two.
  std::array<bool, 3> moving_axes = {true, true, true};
  /// Curves: no node has a smaller radius of curvature, of the circle through it and its neighbours, to 1 %; in units
  /// of the input, 0 for any. Where that cannot be kept, as points ask for less or ends and directions that are held, a
  /// warning names the node that is bent most, and the outcome is not `converged`. With Weight and SmoothingLength the
  /// curve then has nodes of its own, too. EquilibriumMethod only.
  double least_radius = 0;
  /// Curves: places where the way of the curve's nodes turns by more than this within some eight tolerances, degrees,
  /// less than 180, are corners: direction and curvature may jump there, and each side is fair by itself. They move
  /// with their points. 0: only those of FairOptions::corners are. EquilibriumMethod only.
  double sharp = 0;

  /// Throws Error(invalid_argument) naming the option and its range.
  void validate() const;

  // The figure of each criterion, where that is the one given.
  [[nodiscard]] std::optional<double> weight() const;
  [[nodiscard]] std::optional<double> smoothing_length() const;
  [[nodiscard]] std::optional<double> within() const;
  [[nodiscard]] std::optional<double> rms() const;
  [[nodiscard]] std::optional<double> noise() const;
  [[nodiscard]] std::optional<Vector3> voxels() const;
  /// Of within() and rms(), the one that is given.
  [[nodiscard]] std::optional<double> tolerance() const;
  /// Whether all of moving_axes move.
  [[nodiscard]] bool moves_freely() const { return moving_axes == std::array{true, true, true}; }
};

/// Distances of points from a shape: from its polygons or edges, see distance().
struct PointDistances {
  Distance all;  ///< `node` is the number of the furthest point
  /// Distances that 50, 90 and 99 of 100 points do not exceed.
  double median = 0;
  double percentile90 = 0;
  double percentile99 = 0;
};

/// What points tell of the boundary of a surface, where it is fitted to them: with FairOptions::fair_boundary.
struct BoundaryOfPoints {
  Index points = 0;  ///< those at which the points end, near the boundary
  // Of its nodes with a free position:
  Index ends = 0;    ///< near which the points end: they go there
  Index inside = 0;  ///< beyond which the points go on: they go across to the points, and no further
  Index kept = 0;    ///< without points near enough to tell: they stay, with a warning
};

struct FitReport {
  FairReport fair;
  std::optional<BoundaryOfPoints> boundary = std::nullopt;
  Index points = 0;
  /// Points tied to a node that moves, at the end. The others are nearest to nodes that stay, or have no weight.
  Index pulling_points = 0;
  /// Moving nodes with points tied to them, at the end, and the most points on one of them.
  Index pulled_nodes = 0;
  Index most_points = 0;
  Index outliers = 0;                  ///< points left out; `after` does not count them
  std::vector<Index> outlying_points;  ///< these, in order
  /// With Noise on curves: the root mean square distance that it leaves, at which the curve is.
  std::optional<double> noise_leaves = std::nullopt;
  /// The one given or, for a tolerance, found. Empty for the paper's k, and where plain fairing or what
  /// filters of noise give is within the tolerance.
  std::optional<double> smoothing_length = std::nullopt;
  /// With Within: the points at that distance, to 1 %, in order. They keep the shape from becoming fairer.
  std::vector<Index> active_points;
  Index outside_points = 0;  ///< with Within or RootMeanSquare: those further away than that, of the points that count
  /// With FitOptions::least_radius: the least one of the new curve, and the node that has it. Empty where nothing is
  /// bent.
  std::optional<double> least_radius = std::nullopt;
  Index sharpest_node = -1;
  /// Both without a count where the fit was cancelled and had too many points to measure them then.
  PointDistances before;
  PointDistances after;
  /// Of the shape's nodes and places on its edges (the middles, or every tenth of a tolerance) from the polyline of the
  /// points that count, both gone along in their order, so up to a tenth more than the distance to the nearest place:
  /// curves drawn to a tolerance of their own nodes. Surfaces drawn to their own nodes: of their nodes from the input.
  /// Else without a count.
  Distance shape = {};
  /// The greatest way of a node along the shape, where the points are its own nodes.
  double greatest_slide = 0;
};

struct FitResult {
  std::vector<Vector3> positions;  ///< one per node; fixed nodes bit for bit
  /// Of every point from the new shape, in the units of the input; outliers too. Empty where the fit was cancelled and
  /// points and nodes are more than 40,000 together: see point_distances().
  std::vector<double> distances;
  FitReport report;
};

/// Fairs a polygonal surface or curve and draws it to scattered points (paper §4.5, indirect constraints; Eq. 9, Fig.
/// 5).
///
/// Every point is tied to the node nearest to it and pulls at it along the node's normal (on curves across its tangent)
/// with k_j times its distance. The points of one node are averaged; those that lie near the normal line count more.
/// Every few iterations each point looks whether one of the first- and second-order neighbours of its node (nodes of
/// the same faces, and of theirs) is nearer, and is tied to that.
///
/// A point pulls at nothing where its nearest node at the start takes no part in fairing. On surfaces, where it has a
/// normal, it pulls only at nodes whose normal is within 90° of its own, so each side of a thin wall has its own
/// points. Faces need not look outwards: if points are clearly nearer with all normals turned round, they are, with a
/// warning.
///
/// Constraints hold as in fair(). If no point has weight, the result is that of fair(), bit for bit. A closed shape may
/// be held by points alone, though its nodes can then slide (docs/fit.md); boundaries and ends must be held all the
/// same, or be fitted first (FairOptions::fair_boundary). Nodes without points are fair between those that have some.
///
/// Surfaces: where more than two faces meet at edges, or several fans at a node, nodes are held, and each sheet goes by
/// its own faces. With EquilibriumMethod and points that are the surface's own nodes, lines of edges of three faces are
/// fitted first, as curves, and what is near goes along with them.
///
/// EquilibriumMethod goes to where springs and points balance at every node and ties do not change any more. Where
/// ties would go to and fro, a point changes only to a node that is nearer by a margin. The other methods
/// divide what pulls by 1 + k, unless with Forces::printed, so that any weight is stable. They end when no node moves
/// further in one iteration than their step_tolerance times the mean length of its edges; with small weights nodes then
/// still have far to go, about a step over k.
///
/// For Within and RootMeanSquare the equilibrium of a surface is found some ten to a hundred times. If no shape
/// within them is found and the input is not either, the nearest one is returned, with a warning and an outcome that is
/// not `converged`; nor is that where nothing within them is fairer than an input that is, which is returned then.
/// Curves are drawn to them by convex programs instead, on nodes of their own (docs/curves.md); ends may then be free.
///
/// The result has the same bits for every number of threads. Cancellation returns the shape so far with outcome
/// `cancelled`. Arguments are unchanged.
///
/// Throws as fair() does; Error(invalid_argument), naming the point, for options out of range, no points, a point that
/// is not finite or further away than 1e50 times the size of the shape, weights or normals that are not as many as
/// points, weights not from 0 to 1e50, and normals that are neither zero nor of length 1; Error(unusable_shape) for a
/// shape without a face (edge).
///
/// Cost: that of fair(), n log n for the nodes, and linear in the points for every iteration. Memory: under 100 bytes a
/// point, its position and weight among them.
[[nodiscard]] FitResult fit(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                            const FitOptions& options, Context& context);
[[nodiscard]] FitResult fit(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                            const FitOptions& options = {});
[[nodiscard]] FitResult fit(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                            const FitOptions& options, Context& context);
[[nodiscard]] FitResult fit(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                            const FitOptions& options = {});

struct ResampledFit {
  Resampled resampled;  ///< as resample() gives it, of the fair curve; of the curve given where nothing was found
  FitResult fit;        ///< positions of its nodes; its points are the nodes of the curve that was given
};

/// Puts new nodes, as resample() spaces them, on the fair curve that fits the nodes of `curve`. So a table with
/// rounding or noise gets nodes that have none, between its own nodes too.
///
/// With Within, RootMeanSquare and SmoothingLength they are places on the curve that fit() finds, so they are as fair.
/// Where the chords between them cut off more than a tolerance allows for, they go to where these are within it; if
/// there are too few for that, outcome and a warning say so. Distances are those from the chords. How far nodes moved
/// is reported as their distance from the curve that was given.
///
/// With Weight, unless a least radius is to be kept, and by other methods, the curve is resampled first, and the new
/// nodes are fitted themselves.
///
/// Throws as resample() and fit() do. Cost: that of fit().
[[nodiscard]] ResampledFit fit_resampled(const PolygonCurve& curve, const Constraints& constraints,
                                         const Resampling& how, const FitOptions& options, Context& context);
[[nodiscard]] ResampledFit fit_resampled(const PolygonCurve& curve, const Constraints& constraints,
                                         const Resampling& how, const FitOptions& options = {});

/// For every node the greatest distance of the points that are nearest to it; 0 where there are none. distances: one
/// per point, as in FitResult. The same bits for every number of threads. Throws Error(invalid_argument) unless points
/// and distances are finite and as many, and for points too far away, as fit() does. Cost: n log n.
[[nodiscard]] std::vector<double> node_deviations(std::span<const Vector3> nodes, std::span<const Vector3> points,
                                                  std::span<const double> distances, const Context& context);

}  // namespace vspring
