#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/model.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/sharp_edges.hpp"
#include "vspring/warning.hpp"

namespace VSPRING_API vspring {

/// The kinds of methods, see FairingMethod.
enum class Method { equilibrium, multigrid, sweep };

/// The accelerated solver, which goes to the equilibrium itself; see docs/solver.md.
struct EquilibriumMethod {
  /// Stop when no node is expected to be further from its final place than this share of the diagonal of the box around
  /// the moving nodes and their rim. More than 0.
  double tolerance = 1e-5;
  /// Most iterations on each level, 0 or more; with a number given, no other springs, distributions or strategies are
  /// tried. Empty: 200 iterations on each level (30 on the finest if sphere springs are not near their equilibrium by
  /// then) and FairReport::most_work in all; where they find nothing, the other strategies of docs/solver.md.
  std::optional<int> max_iterations = std::nullopt;
  /// Whether another shape may replace an equilibrium that is not found, with a warning. Surfaces: that of
  /// another distribution, if none is given, or one of least bending, near the input if need be. Fits: see
  /// FitOptions::fair.
  bool fallbacks = true;
};

/// The paper's V-cycle over coarser levels (§4.7).
struct MultigridMethod {
  /// The paper's e (§4.6), more than 0. Stop when no node moves further in one iteration than this share of the mean
  /// length of its edges.
  double step_tolerance = 1e-3;
  /// Most iterations on each level, 0 or more.
  int max_iterations = 10'000;
  /// Number of levels, the shape itself among them; fewer if it has too few nodes. Empty: as many as leave at least 60
  /// moving nodes on the coarsest (the paper's 6 for 60,000 to 250,000 nodes), on curves 24 to 47 edges between held
  /// nodes.
  std::optional<int> levels = std::nullopt;
  /// Iterations on each level on the way down.
  int pre_smoothing = 5;
  /// On every level.
  SweepOrder order = SweepOrder::parallel;
  /// As in SweepMethod; on every level.
  bool keep_last = false;
};

/// The paper's plain iteration (§4.1).
struct SweepMethod {
  /// As in MultigridMethod.
  double step_tolerance = 1e-3;
  /// Most iterations, 0 or more.
  int max_iterations = 10'000;
  /// In which order nodes move.
  SweepOrder order = SweepOrder::parallel;
  /// Where steps grow again: true returns the shape of the last iteration, as the paper does, if it is finite; false
  /// returns the shape of the smallest steps, with a warning.
  bool keep_last = false;
};

/// How a shape meets what is held around it.
enum class Continuity {
  tangent,   ///< with the same tangents or tangent planes (G1)
  curvature  ///< and with the same curvature (G2): reflection lines run through without a kink
};

/// What happens to the chains of sharp edges.
enum class SharpCurves {
  fit,  ///< fair() fairs them as curves in space, between their ends; fits draw them to their own nodes
  hold  ///< they stay where they are
};

/// How a shape is made fair, in the order of Method.
using FairingMethod = std::variant<EquilibriumMethod, MultigridMethod, SweepMethod>;

/// How a shape is made fair. Each member says what its default means.
struct FairOptions {
  /// By which solver, with its own options.
  FairingMethod method = EquilibriumMethod{};
  /// Surfaces: how the normal of a node follows from the nodes around.
  PseudoNormals pseudo_normals = PseudoNormals::link;
  /// Surfaces, EquilibriumMethod: which springs. Always edge springs: in other methods and fits; where the boundary
  /// moves; where so little is held that spheres of many sizes are fair; where a node with a given normal has moving
  /// nodes on more than one side; and, with a warning, where sphere springs find no equilibrium.
  Springs springs = Springs::sphere;
  /// Surfaces with sphere springs: what is made even or least. With a warning, the result is fair by curvature where
  /// edge springs take over, and by bending where no shape is found whose curvature changes evenly.
  FairBy fair_by = FairBy::curvature;
  /// How closely forces keep to the paper's equations; `printed` is for comparison with it.
  Forces forces = Forces::steady;
  /// Curves: rules for tangents, weights and the plane of the force.
  CurveRules curve = {};
  /// Where nodes go along the shape. Empty: even for curves, multigrid and sweep; keep in fill_holes() and fits by
  /// Voxels; else smooth. Of surfaces that are faired by EquilibriumMethod with fallbacks, empty also lets even take
  /// the place of smooth where that finds no equilibrium.
  std::optional<Distribution> distribution = std::nullopt;
  /// Surfaces: by which method free boundary nodes are faired first, as closed curves between the held ones (§4.5); the
  /// surface then holds them. Fits use `method` for both. Empty: they move with the surface, which draws them in.
  std::optional<FairingMethod> fair_boundary = std::nullopt;
  /// EquilibriumMethod, no fits: how the shape meets what is beside it and does not move, as around a region or a
  /// filled hole. Where `curvature` is not possible, it is `tangent`, with a warning (tangent_only).
  ///
  /// Surfaces, `curvature`: the tangent plane and the second fundamental form that the faces beside it have at the rim,
  /// by a polynomial of third degree through the held nodes within two to eight rings, and least change of mean
  /// curvature between. Of up to 60,000 moving nodes. The boundary and sharp edges stay as with `tangent`.
  ///
  /// Curves, `curvature`: the tangent and the curvature of the held nodes beside it, three or more, and of the input at
  /// ends whose given tangent is that of the input. Between held nodes curvature is cubic in arc length, quadratic
  /// where it is given at one end only; at held nodes inside its first two derivatives are continuous. Not where moving
  /// nodes have given directions.
  Continuity continuity = Continuity::tangent;
  /// Return a shape that is worse than the input as it is, with a warning, and try nothing else: for comparisons of
  /// methods and distributions. By default the best shape that is not worse takes its place
  /// (Outcome::worse_than_input).
  bool accept_worse = false;
  /// result = input + strength × (fair − input) for moving nodes; 0 to 1.
  double strength = 1;
  /// Curves: nodes inside chains at which direction and curvature may jump, such as those of find_corners(). They keep
  /// their places, and each side is faired by itself. A corner with a given tangent or normal has one direction. In
  /// fits corners move with their points, by EquilibriumMethod only. Constraints may name more corners.
  std::vector<Index> corners = {};

  /// Surfaces: edges along which the surface may turn sharply, such as those of find_sharp_edges(). Their chains are
  /// curves of their own, which the surface holds, and it has its own tangent plane on each side of them. Chains end at
  /// corners, boundaries and where a crease runs out; fair() holds these ends. Normals given where sides part are left
  /// out, with a warning.
  MeshEdges sharp_edges = {};
  /// What happens to these chains. Empty: `fit` in fits to the surface's own nodes, else `hold`.
  std::optional<SharpCurves> sharp_curves = std::nullopt;
  /// Surfaces: each side keeps the tangent planes that it has in the input at sharp edges, to second order. Else they
  /// are free.
  bool fix_sharp_normals = false;

  /// Throws Error(invalid_argument) naming the option and its range.
  void validate() const;

  /// The kind of `method`.
  [[nodiscard]] Method method_kind() const noexcept { return static_cast<Method>(method.index()); }
  /// The max_iterations of `method`; empty if none are given to EquilibriumMethod.
  [[nodiscard]] std::optional<int> max_iterations() const;

  /// The distribution of surfaces: the one given, or else the default.
  [[nodiscard]] Distribution distribution_taken() const {
    const bool papers_own = method_kind() != Method::equilibrium;
    return distribution.value_or(papers_own ? Distribution::even : Distribution::smooth);
  }
};

/// "edge" or "sphere".
[[nodiscard]] const char* name(Springs springs) noexcept;

/// "curvature" or "bending".
[[nodiscard]] const char* name(FairBy fair_by) noexcept;

/// "tangent" or "curvature".
[[nodiscard]] const char* name(Continuity continuity) noexcept;

/// "equilibrium", "multigrid" or "sweep".
[[nodiscard]] const char* name(Method method) noexcept;

/// How a run ended. FairReport::usable() tells whether that is an answer.
enum class Outcome {
  /// No node is expected to be further from its final place than the tolerance. Where least bending stands in, also:
  /// bending falls no further (surfaces), or the curve of the same length that is bent least (curves). Of fits by
  /// Within and RootMeanSquare, also: within them, but perhaps not the fairest. A
  /// warning says so (other_fairness, maybe_not_fairest).
  converged,
  iteration_limit,  ///< the method's max_iterations was reached
  work_limit,       ///< FairReport::most_work, or the default limit of iterations, was reached
  stalled,          ///< further iterations do not come nearer
  /// The shape found has folds, crossings, bending or the like that the input does not have (list:
  /// docs/distribution.md). Unless FairOptions::accept_worse, the positions are the best shape that is not worse, if
  /// need
  /// be the input with its constraints applied.
  worse_than_input,
  cancelled  ///< Context::cancel() was called
};

/// "converged", "iteration-limit", "work-limit", "stalled", "worse-than-input" or "cancelled".
[[nodiscard]] const char* name(Outcome outcome) noexcept;

/// The work on one level of the hierarchy.
struct LevelReport {
  Index moving_nodes = 0;                ///< of this level
  int iterations = 0;                    ///< on this level
  Outcome outcome = Outcome::converged;  ///< of the level's own stopping test; `cancelled` if it was not reached
  /// The strategy that the work was part of: "in place", "coarse to fine", "from linear curvature", "less bending",
  /// "less bending, near the input", "from the last shape", "curvature at the rim", "curvature at the ends" or
  /// "V-cycle" (docs/solver.md).
  const char* strategy = "";
  double seconds = 0;  ///< on the clock
  /// Of "less bending": moving nodes that stay, as faces would turn over there. 0 in fits to a tolerance.
  Index kept_nodes = 0;
};

/// What a run did, and how it ended. Of the figures usable() is the first to look at.
struct FairReport {
  Outcome outcome = Outcome::converged;         ///< how the run ended
  Method method = Method::sweep;                ///< the kind of FairOptions::method
  Springs springs = Springs::edge;              ///< surfaces: of the shape returned
  FairBy fair_by = FairBy::curvature;           ///< surfaces: likewise
  Continuity continuity = Continuity::tangent;  ///< how the shape returned meets what is around it
  /// With FairOptions::continuity `curvature`: by how much the curvatures on both sides of the rim differ, root mean
  /// square, 1/length: of the shape with tangents or tangent planes alone, and of the one returned. Of surfaces the
  /// second fundamental forms, by polynomials of third degree; of curves the curvature vectors at ends of what moves
  /// and at held nodes with given directions, each from one side. Empty where the part that moves is too small.
  std::optional<std::array<double, 2>> curvature_jump = std::nullopt;
  int iterations = 0;  ///< on all levels together
  /// The figure that the stopping test compares. Multigrid and sweep: the largest displacement of the last iteration
  /// over the mean edge length at its node (§4.6). Equilibrium: the expected error.
  double residual = 0;
  /// The residual after every iteration, over all levels.
  std::vector<double> history;
  /// Predicted largest distance of a node from its final place, as a share of the diagonal of the box around the moving
  /// nodes and their rim. Empty where that is not known: with sweep, and in fits to a tolerance whose shape may not be
  /// the fairest.
  std::optional<double> expected_error;
  /// The levels in the order of the work, the coarsest first. With equilibrium, one iteration on the shape itself may
  /// come before them: it tests whether the shape is at its equilibrium already. Empty with sweep.
  std::vector<LevelReport> levels;
  /// Work done on all levels, in iterations of the equilibrium solver on one moving node. In these, a step of less
  /// bending counts 6, one of Newton's 60, a sweep 1/16, a new factorisation of a matrix 0.1 to 6.
  double work = 0;
  double most_work = 0;       ///< the limit of `work`; 0 where iterations are limited instead
  Index nodes = 0;            ///< of the shape
  Index faces = 0;            ///< of the shape; 0 for curves
  Index moving_nodes = 0;     ///< nodes that took part
  Index fixed_positions = 0;  ///< nodes whose position is held
  Index sliding_nodes = 0;    ///< moving nodes that slide on a support
  Index fixed_normals = 0;    ///< nodes with a given normal
  Index fixed_tangents = 0;   ///< nodes with a given tangent
  Index corners = 0;          ///< curves: nodes that are corners
  double greatest_move = 0;   ///< the largest distance of a moving node from the input, in its units
  double rms_move = 0;        ///< the root mean square of these distances
  double seconds = 0;         ///< of the whole call, on the clock
  int threads = 1;            ///< that the call used
  /// With FairOptions::fair_boundary: the report of the boundary's own fairing.
  std::shared_ptr<const FairReport> boundary;
  Index sharp_edges = 0;  ///< surfaces: how many edges are kept sharp
  /// Fits by Noise: those of FairOptions::sharp_edges that are not, as the surface would fold at their chains;
  /// ascending, the smaller node first.
  MeshEdges rounded_edges;
  /// With SharpCurves::fit: the report of the chains' own fairing, with fair_boundary also that of the boundary, unless
  /// noise is taken off, of which that has more. Empty where chains stay as the surface would have more folds or
  /// crossings with them elsewhere: a warning says that.
  std::shared_ptr<const FairReport> sharp_curves;
  std::vector<Warning> warnings;  ///< what a user should know of the input or the result

  /// Whether the positions are a result as asked for, with which the command line ends with exit status 0: where the
  /// outcome is `converged`. Warnings say what replaced something that was asked for. Else the positions are finite and
  /// obey the constraints, too, but have to be looked at: a shape on the way (`iteration_limit`, `work_limit`,
  /// `stalled`, `cancelled`), or one in place of a worse one, such as the input (`worse_than_input`).
  [[nodiscard]] bool usable() const noexcept { return outcome == Outcome::converged; }
};

/// A fair shape, by the positions of its nodes, and how it was found.
struct FairResult {
  std::vector<Vector3> positions;  ///< one per node; fixed nodes bit for bit; see coordinates() for a flat array
  FairReport report;               ///< look at usable() first
};

/// Fairs a polygonal surface or curve under constraints (paper §4.1 and Fig. 3; §4.8 for curves).
///
/// Curves: between constraints curvature becomes linear in arc length (an Euler spiral); see docs/curves.md. The curve
/// may turn at an end without a tangent. A given normal leaves the tangent free to turn about it; on a planar curve it
/// determines the tangent.
///
/// Surfaces: EquilibriumMethod moves nodes until the displacement of every node is zero; see docs/solver.md. With
/// options.fair_boundary the boundary is faired first, as a curve, under the positions and tangents that the
/// constraints give there (normals act on the surface); it throws what fairing a curve throws.
///
/// Nodes with a fixed position come out exactly at it; isolated nodes stay. The result has the same bits for every
/// number of threads. Cancellation returns the shape so far with outcome `cancelled`. Arguments are unchanged.
///
/// Throws what check_constraints() throws, and Error(invalid_argument) for options out of range or constraints of
/// another node count.
///
/// Cost: linear in all nodes once, and in the moving nodes for every iteration. Usually the finest level takes three to
/// six iterations. FairReport::most_work bounds the rest: 450 iterations of every moving node or 1.35 million of one
/// node, whichever is more; about two seconds for 3,000 nodes. Memory: about 0.7 kB per moving node, 0.9 kB with sphere
/// springs.
[[nodiscard]] FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options,
                              Context& context);
[[nodiscard]] FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options = {});
[[nodiscard]] FairResult fair(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options,
                              Context& context);
[[nodiscard]] FairResult fair(const PolygonCurve& curve, const Constraints& constraints,
                              const FairOptions& options = {});

}  // namespace vspring
