#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vspring/distance.hpp"
#include "vspring/fair.hpp"
#include "vspring/point_file.hpp"
#include "vspring/resample.hpp"

namespace vspring {

struct FitOptions {
  /// With fair_boundary, for a surface whose own nodes are the points, its boundary is fitted to them first, as a
  /// curve, and the surface then holds it. Where no method is given: equilibrium; where that finds none and
  /// max_iterations is not given, with a warning, on surfaces the shape of sweep; of curves the shape that came
  /// nearest, or the smoothing spline of the points, which are not called converged.
  FairOptions fair = {};
  /// The paper's k (Eq. 9), for points of weight 1: 0 to 1e50. Small ones smooth, large ones interpolate. On an evenly
  /// spaced curve with one point per node waves of angular frequency ω keep 1/(1 + (λω)⁴) of their height, where k =
  /// (ℓ/λ)⁴/8 and ℓ is the length of the edges.
  double weight = 0.01;
  // Of these four at most one may be given; it takes the place of `weight`.
  /// A weight that means the same at every resolution: a length λ, in the units of the input, more than 0. The shape is
  /// about the one for which ∫ (curvature)² + λ⁻⁴ (share of each point) Σ (distance)² is least, every point standing
  /// for an equal share of the length (area) that moves, times its own weight: of dense points, waves of angular
  /// frequency ω keep 1/(1 + (λω)⁴) of their height. See docs/fit.md for the k that it comes to.
  std::optional<double> smoothing_length = std::nullopt;
  /// The shape of least bending from which no point lies further than this, in the units of the input, more than 0; on
  /// curves in space the fairest on the way there, by its V-Spring energy (Fairness). By Method::equilibrium only.
  std::optional<double> within = std::nullopt;
  /// The largest smoothing length for which the root mean square of the distances is not above this, in the units of
  /// the input, more than 0. By Method::equilibrium only.
  std::optional<double> rms = std::nullopt;
  /// Surfaces whose own nodes are the points, with Distribution::keep: takes noise of this standard deviation in each
  /// coordinate off, in the units of the input, more than 0. No equilibrium, but filters, each where it is expected to
  /// be nearest to the true shape; nodes go along the surface, too, to where these put them. Where normals are given,
  /// an equilibrium next to that. See estimate_noise() and docs/fit.md. Cost: linear. Memory: about 2,500 bytes a node.
  std::optional<double> noise = std::nullopt;
  /// The share of the points, from 0 to less than 1, that is left out: those furthest from the shape, found in turns
  /// with it.
  double outliers = 0;

  /// Throws Error(invalid_argument) naming the option and its range.
  void validate() const;
};

/// How far points lie from a shape: from its polygons or edges, see distance().
struct PointDistances {
  Distance all;  ///< `node` is the number of the furthest point
  /// Distances that 50, 90 and 99 of 100 points do not exceed.
  double median = 0;
  double percentile90 = 0;
  double percentile99 = 0;
};

struct FitReport {
  FairReport fair;
  Index points = 0;
  /// Points tied to a node that moves, at the end; the others are nearest to what stays, or have no weight.
  Index pulling_points = 0;
  /// Moving nodes that points are tied to, at the end, and the most points of one of them.
  Index pulled_nodes = 0;
  Index most_points = 0;
  Index outliers = 0;  ///< points left out; `after` does not count them
  /// The one given or, for a tolerance, found; none for the paper's k and where plain fairing is within the tolerance.
  std::optional<double> smoothing_length = std::nullopt;
  Index active_points = 0;   ///< with `within`: those at that distance, to 1 %
  Index outside_points = 0;  ///< with `within` or `rms`: those further away than that, of the points that count
  PointDistances before;
  PointDistances after;
};

struct FitResult {
  std::vector<Vector3> positions;  ///< one per node; fixed nodes bit for bit
  std::vector<double> distances;   ///< of every point from the new shape, in the units of the input; outliers too
  FitReport report;
};

/// Fairs a polygonal surface or curve and draws it towards scattered points (paper §4.5, indirect constraints; Eq. 9,
/// Fig. 5).
///
/// Every point pulls at the node nearest to it, along the node's normal (on curves across its tangent), with k_j times
/// its distance; the points of one node are averaged, near feet of their perpendiculars counting more. Every few
/// iterations each point changes over to a nearer node among the first- and second-order neighbours of its own (nodes
/// of the same faces, and of theirs). A point whose nearest node at the start is none of the shape's that move or are
/// looked at in moving pulls at nothing. On surfaces nodes whose normal is more than 90° from the point's own, where it
/// has one, do not count: of the two sides of a thin wall each has its own points. Where no node is left in reach the
/// point pulls at nothing. Faces need not look outwards: if points are clearly nearer with all normals turned round,
/// they are, with a warning.
///
/// Constraints hold as in fair(), whose result comes out, bit for bit, if no point has weight. A closed shape may be
/// held by points alone, though its nodes can then slide, see docs/fit.md; boundaries and ends must be held all the
/// same. Nodes without points are fair between those that have some.
///
/// By Method::equilibrium it goes to where springs and points balance at every node, with ties that do not change any
/// more; where they would go to and fro, points stay with a node although another is nearer by a margin. By
/// Method::sweep and multigrid what pulls is divided by 1 + k, so that any weight is stable, but with Forces::printed;
/// it ends when no node moves further in
/// one iteration than options.fair.step_tolerance times the mean length of its edges. Small weights then still have far
/// to go: their last steps are about k times their distance.
///
/// Where no shape of this mesh is within options.within or options.rms, the nearest one found is the result, with a
/// warning and an outcome that is not `converged`. Either takes the equilibrium some ten to a hundred times.
///
/// Throws as fair() does; Error(invalid_argument) for options out of range, no points, a point that is not finite or
/// further away than 1e50 times the size of the shape, weights that are not as many as points or not from 0 to 1e50,
/// normals that are not as many as points or neither zero nor of length 1, each naming the point; Error(unusable_shape)
/// for a shape without a face (edge). Arguments are unchanged. Cancellation ends with the shape so far and outcome
/// `cancelled`. The result is the same, bit for bit, for every number of threads. Cost: that of fair(), n log n for the
/// nodes, linear in the points for every iteration. Memory: under 100 bytes a point, its position and weight among
/// them.
[[nodiscard]] FitResult fit(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                            const FitOptions& options, Context& context);
[[nodiscard]] FitResult fit(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                            const FitOptions& options = {});
[[nodiscard]] FitResult fit(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                            const FitOptions& options, Context& context);
[[nodiscard]] FitResult fit(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                            const FitOptions& options = {});

struct ResampledFit {
  Resampled resampled;  ///< what resample() gives: what the fit began with
  FitResult fit;        ///< positions of its nodes; its points are the nodes of the curve that was given
};

/// New nodes along the fair curve that fits the nodes of `curve`, as fit() finds it, where resample() puts them along
/// the cubics through these nodes: a table with rounding or noise so gets nodes that have none of it, between its own
/// nodes too.
///
/// With within, rms or smoothing_length a curve of up to eight nodes for each new one is fitted, so that between the
/// points, too, curvature changes gently; the new nodes are some of its nodes. Distances are those from the chords
/// between new nodes: where the curve rises over them it passes the points that much further out. How far nodes moved
/// is said as their distance from the resampled curve.
///
/// Where these chords are not within a tolerance, with a weight, outliers, a strength or another method, and of curves
/// of more than 5,000 nodes or eight for each new one, new nodes are fitted to the points as they are, from where
/// resample() puts them. Where they are not within it either, the result is the nearest of all that was tried whose
/// curvature varies no more than that of the resampled curve, if there is one, with outcome `stalled` and a warning.
///
/// Throws as resample() and fit() do. Cost: that of three to eight fits, with more nodes than come out.
[[nodiscard]] ResampledFit fit_resampled(const PolygonCurve& curve, const Constraints& constraints,
                                         const Resampling& how, const FitOptions& options, Context& context);
[[nodiscard]] ResampledFit fit_resampled(const PolygonCurve& curve, const Constraints& constraints,
                                         const Resampling& how, const FitOptions& options = {});

/// How far points lie from a shape, node by node: at each of its nodes the greatest distance of the points that are
/// nearest to it, 0 where there are none. distances: of every point, as FitResult has them. Throws
/// Error(invalid_argument) unless points and distances are finite and as many, and for points too far away, as fit()
/// does. The same bits for every number of threads. Cost: n log n.
[[nodiscard]] std::vector<double> node_deviations(std::span<const Vector3> nodes, std::span<const Vector3> points,
                                                  std::span<const double> distances, const Context& context);

}  // namespace vspring
