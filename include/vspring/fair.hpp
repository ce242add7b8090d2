#pragma once

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
#include "vspring/warning.hpp"

namespace VSPRING_API vspring {

enum class Method { equilibrium, multigrid, sweep };

/// The accelerated solver, which goes to the equilibrium itself; see docs/solver.md.
struct EquilibriumMethod {
  /// Stop when no node is expected to be further from its final place than this share of the diagonal of the box around
  /// the moving nodes and their rim. More than 0.
  double tolerance = 1e-5;
  /// Stop after so many iterations, on each level; no other springs, distributions or ways are then tried. Empty:
  /// 200 iterations on each level (30 on the finest with sphere springs that are not near by then), no more work than
  /// FairReport::most_work, and where that leads nowhere the other ways of docs/solver.md.
  std::optional<int> max_iterations = std::nullopt;
  /// Whether another shape may stand for an equilibrium that is not found, with a warning: on surfaces that of another
  /// distribution, where none is given, or one of least bending; in fits what FitOptions::fair says.
  bool fallbacks = true;
};

/// The paper's V-cycle over coarser levels (§4.7).
struct MultigridMethod {
  /// The paper's e (§4.6), more than 0. Stop when no node moves further in one iteration than this share of the mean
  /// length of its edges.
  double step_tolerance = 1e-3;
  /// Stop after so many iterations, on each level. Empty: 10,000.
  std::optional<int> max_iterations = std::nullopt;
  /// Number of levels, the shape itself among them; fewer where it has too few nodes. Empty: as many as leave 60 moving
  /// nodes or more on the coarsest (6 as in the paper for 60,000 to 250,000 nodes); on curves as leave 24 to 47 edges
  /// between held nodes.
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
  /// Stop after so many iterations. Empty: 10,000.
  std::optional<int> max_iterations = std::nullopt;
  SweepOrder order = SweepOrder::parallel;
  /// Return the shape of the last iteration, as the paper does, also where steps grew again; unless the last one is not
  /// finite. Else the shape of the smallest steps is returned then, with a warning.
  bool keep_last = false;
};

/// How a shape is made fair, in the order of Method.
using FairingMethod = std::variant<EquilibriumMethod, MultigridMethod, SweepMethod>;

struct FairOptions {
  FairingMethod method = EquilibriumMethod{};
  /// Surfaces: how normals follow from the nodes around.
  PseudoNormals pseudo_normals = PseudoNormals::link;
  /// Surfaces, EquilibriumMethod: which springs. Edge springs are taken all the same by other methods and fits; where
  /// the boundary moves; where so little is held that spheres of many sizes are fair; where a normal is given at a node
  /// with moving nodes on more sides than one; and, with a warning, where sphere springs find no equilibrium.
  Springs springs = Springs::sphere;
  /// Surfaces with sphere springs: what is made even or least. The result is that of curvature, with a warning, where
  /// edge springs take over; and of least bending where no shape is found whose curvature changes evenly.
  FairBy fair_by = FairBy::curvature;
  /// `printed` is for comparison with the paper.
  Forces forces = Forces::steady;
  /// Curves: tangents, weights and the plane of the force.
  CurveRules curve = {};
  /// Empty: smooth for surfaces, and even where that finds no equilibrium; even for curves, and where multigrid or
  /// sweep is asked for.
  std::optional<Distribution> distribution = std::nullopt;
  /// Surfaces: boundary nodes whose position is free are faired first, as closed curves between the held ones (§4.5),
  /// and stay there while the surface follows: by this method; in fits by `method`, as the surface. Empty: they move
  /// with the surface, which draws them in.
  std::optional<FairingMethod> fair_boundary = std::nullopt;
  /// Return a shape that is worse than the input as it was found, with a warning, and try nothing else: for comparisons
  /// of methods and distributions.
  bool as_found = false;
  /// result = input + strength × (fair − input) for moving nodes; 0 to 1.
  double strength = 1;
  /// Curves: nodes inside of chains at which direction and curvature may jump, as find_corners() finds them. They keep
  /// their places, and each side is faired by itself. Those with a tangent or normal given have one direction all the
  /// same. In fits they move with their points, by EquilibriumMethod only. Constraints may name others.
  std::vector<Index> corners = {};

  /// Throws Error(invalid_argument) naming the option and its range.
  void validate() const;

  /// Which method `method` is.
  [[nodiscard]] Method method_kind() const noexcept { return static_cast<Method>(method.index()); }
  /// That of the method, where it is given one.
  [[nodiscard]] std::optional<int> max_iterations() const;

  /// The distribution given, or else the default, of surfaces.
  [[nodiscard]] Distribution distribution_taken() const {
    const bool papers_own = method_kind() != Method::equilibrium;
    return distribution.value_or(papers_own ? Distribution::even : Distribution::smooth);
  }
};

/// "edge" or "sphere".
[[nodiscard]] const char* name(Springs springs) noexcept;

/// "curvature" or "bending".
[[nodiscard]] const char* name(FairBy fair_by) noexcept;

/// "equilibrium", "multigrid" or "sweep".
[[nodiscard]] const char* name(Method method) noexcept;

enum class Outcome {
  /// No node is expected to be further from its final place than the tolerance. Where least bending stands in, also:
  /// bending falls no further. Of fits by Within and RootMeanSquare, also: within them, but perhaps not the fairest. A
  /// warning says so (other_fairness, maybe_not_fairest).
  converged,
  iteration_limit,  ///< the method's max_iterations was reached; with multigrid and sweep also its default
  work_limit,       ///< FairReport::most_work, or the default limit of iterations, was reached
  stalled,          ///< further iterations do not come nearer
  /// The shape found has folds, crossings, bending or the like that the input has not; docs/distribution.md has the
  /// list. Unless FairOptions::as_found, the positions are the best shape that is not worse, at worst the input with
  /// its constraints applied.
  worse_than_input,
  cancelled
};

/// "converged", "iteration-limit", "work-limit", "stalled", "worse-than-input" or "cancelled".
[[nodiscard]] const char* name(Outcome outcome) noexcept;

/// The work on one level of the hierarchy.
struct LevelReport {
  Index moving_nodes = 0;
  int iterations = 0;
  Outcome outcome = Outcome::converged;  ///< of the level's own test; `cancelled` where it was not reached
  /// What it was part of: "in place", "coarse to fine", "flow", "spacing of the input", "windings of the input", "from
  /// the input without its noise", "from the input", "from the input, with its spacing", "less bending", "from less
  /// bending", "from the last shape" or "V-cycle" (docs/solver.md).
  const char* strategy = "";
  double seconds = 0;
  /// Of "less bending": moving nodes that stay where they were last, as faces would turn over there.
  Index kept_nodes = 0;
};

struct FairReport {
  Outcome outcome = Outcome::converged;
  Method method = Method::sweep;
  /// Surfaces: the springs that were used in the end, and what they made.
  Springs springs = Springs::edge;
  FairBy fair_by = FairBy::curvature;
  int iterations = 0;
  /// The figure that the stopping test compares. Multigrid and sweep: the largest displacement of the last iteration
  /// over the mean edge length at its node (§4.6). Equilibrium: the expected error.
  double residual = 0;
  /// That figure after every iteration, over all levels.
  std::vector<double> history;
  /// Predicted largest distance of a node from its final place, as a share of the diagonal of the box around the moving
  /// nodes and their rim. Empty with sweep, which cannot tell.
  std::optional<double> expected_error;
  /// The levels that were worked on, the coarsest first. With equilibrium, one iteration on the shape itself may come
  /// before them, which asks whether it is at its equilibrium already. Empty with sweep.
  std::vector<LevelReport> levels;
  /// Work done on all levels, in iterations of the equilibrium solver on one moving node. A step of less bending
  /// counts 6, a step of the flow 60, a sweep 1/16, a new factor of a matrix 0.1 to 6 iterations. most_work is the most
  /// that would have been done; 0 where iterations are limited instead.
  double work = 0;
  double most_work = 0;
  Index nodes = 0;
  Index faces = 0;
  Index moving_nodes = 0;
  Index fixed_positions = 0;
  Index fixed_normals = 0;
  Index fixed_tangents = 0;
  /// Curves: nodes at which direction and curvature may jump.
  Index corners = 0;
  /// How far moving nodes are from the input: largest, and root mean square; in units of the input.
  double greatest_move = 0;
  double rms_move = 0;
  double seconds = 0;
  int threads = 1;
  /// With FairOptions::fair_boundary: the report of the boundary's own fairing.
  std::shared_ptr<const FairReport> boundary;
  std::vector<Warning> warnings;

  /// Whether the positions are an answer to what was asked, for which the command line's exit status is 0: where the
  /// outcome is `converged`. Warnings tell what was taken in place of something that was asked for. Else positions are
  /// finite and obey what is held, too, but somebody has to look at them: a shape on the way (`iteration_limit`,
  /// `work_limit`, `stalled`, `cancelled`), or one in place of a worse one, such as the input (`worse_than_input`).
  [[nodiscard]] bool usable() const noexcept { return outcome == Outcome::converged; }
};

struct FairResult {
  std::vector<Vector3> positions;  ///< one per node; fixed nodes bit for bit
  FairReport report;
};

/// Fairs a polygonal surface or curve under constraints (paper §4.1 and Fig. 3; §4.8 for curves).
///
/// Curves: between constraints curvature becomes linear in arc length, an Euler spiral; see docs/curves.md. An end
/// without a tangent is free to turn. A given normal leaves the tangent free to turn about it; on a planar curve it
/// gives the tangent.
///
/// Surfaces: nodes go to where no node is displaced any more (EquilibriumMethod); see docs/solver.md. With
/// options.fair_boundary the boundary is faired first, as a curve, by the method given there, under the positions and
/// tangents that the constraints give there (normals act on the surface); throws as for a curve.
///
/// Nodes with a fixed position come out exactly at it; isolated nodes stay. The result has the same bits for every
/// number of threads. Cancellation returns the shape so far with outcome `cancelled`. Arguments are unchanged.
///
/// Throws as check_constraints() does for what cannot be faired, and Error(invalid_argument) for options out of range
/// or constraints of another node count.
///
/// Cost: linear in all nodes, once, and in the moving nodes for every iteration; three to six iterations on the finest
/// level where all goes well. Where it does not, the work is bounded by FairReport::most_work: 450 iterations of every
/// moving node, or 1.35 million of one node where that is more, some two seconds for 3,000 nodes.
/// Memory: about 0.7 kB for every moving node, 0.9 with sphere springs.
[[nodiscard]] FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options,
                              Context& context);
[[nodiscard]] FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options = {});
[[nodiscard]] FairResult fair(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options,
                              Context& context);
[[nodiscard]] FairResult fair(const PolygonCurve& curve, const Constraints& constraints,
                              const FairOptions& options = {});

}  // namespace vspring
