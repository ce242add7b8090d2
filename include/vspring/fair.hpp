#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "vspring/fairness.hpp"
#include "vspring/model.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

enum class Method {
  equilibrium,  ///< the accelerated solver that goes to the true equilibrium
  multigrid,    ///< the paper's V-cycle over coarser levels (§4.7)
  sweep         ///< the paper's plain iteration (§4.1)
};

struct FairOptions {
  /// Where not given: equilibrium; of a surface for which that finds none, and max_iterations is not given, the shape
  /// of sweep, with a warning.
  std::optional<Method> method = std::nullopt;
  /// Of surfaces.
  PseudoNormals pseudo_normals = PseudoNormals::link;
  /// Of surfaces, by the method equilibrium; the others, and fits, take edge. So do, by themselves, shapes whose
  /// boundary moves, which are held so little that spheres of many sizes are fair, or with a normal that is given where
  /// nodes move on more sides than one; and, with a warning, those of which sphere springs find no equilibrium.
  Springs springs = Springs::sphere;
  /// Of surfaces, with sphere springs: edge springs know curvature only. Where no shape of least bending is found, or
  /// sphere springs were asked for and edge springs taken by themselves, the result is that of curvature, with a
  /// warning.
  FairBy fair_by = FairBy::curvature;
  /// Printed ones are for comparisons with the paper.
  Forces forces = Forces::steady;
  /// Of curves.
  CurveRules curve = {};
  /// Where not given: smooth, and even where that finds no equilibrium; of curves, and of multigrid and sweep if they
  /// are asked for, even.
  std::optional<Distribution> distribution = std::nullopt;
  /// Of surfaces: boundary nodes whose position is free are faired first, as the closed curves that they form between
  /// the held ones (§4.5), and stay there while the surface follows. Else they are drawn in with the surface.
  bool fair_boundary = false;
  /// Equilibrium: stop when no node is expected to be further than this share of the diagonal of the box around the
  /// moving nodes and their rim from its final place.
  double tolerance = 1e-5;
  /// Multigrid and sweep: the paper's e (§4.6): stop when no node moves further in one iteration than this share of the
  /// mean length of its edges.
  double step_tolerance = 1e-3;
  /// Where not given: 10,000 sweeps, with multigrid on each level; 200 iterations of the equilibrium solver on each of
  /// its levels (30 on the finest with sphere springs that are not near by then) and no more than
  /// FairReport::most_work, another distribution included, and on surfaces where these lead nowhere steps
  /// along the flow of the plain iteration.
  std::optional<int> max_iterations = std::nullopt;
  /// Multigrid: levels, the shape itself among them; fewer where that has too few nodes. Where not given: 6 as in the
  /// paper, but fewer where the coarsest would have under 60 moving nodes, and more where there are enough for another;
  /// on curves as many as there are, down to 24 to 47 edges between held nodes.
  std::optional<int> levels = std::nullopt;
  /// Multigrid: iterations on each level on the way down.
  int pre_smoothing = 5;
  /// A shape that is worse than the input is returned as it was found, with a warning, and nothing else is tried: for
  /// comparisons of methods and distributions.
  bool as_found = false;
  /// result = input + strength × (fair − input) for moving nodes; 0 to 1.
  double strength = 1;

  /// Throws Error(invalid_argument) naming the option and its range.
  void validate() const;

  /// What is given, or else taken, for the distribution of surfaces.
  [[nodiscard]] Distribution distribution_taken() const {
    const bool papers_own = method && *method != Method::equilibrium;
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
  converged,         ///< nothing is expected to be further away than the tolerance
  iteration_limit,   ///< FairOptions::max_iterations; of multigrid and sweep also where it was left at its default
  work_limit,        ///< FairReport::most_work, or a limit nobody gave: what is left is not worth more time
  stalled,           ///< further iterations do not lead nearer
  worse_than_input,  ///< what was found has folds, crossing or collapsed faces, places, bending or an energy that the
                     ///< input had not, or lacks windings that it had, see docs/distribution.md; unless
                     ///< FairOptions::as_found, the positions are the best shape that is not worse, at worst the input
                     ///< with its constraints applied
  cancelled
};

/// "converged", "iteration-limit", "work-limit", "stalled", "worse-than-input" or "cancelled".
[[nodiscard]] const char* name(Outcome outcome) noexcept;

/// The work on one level of the hierarchy, the coarsest first. Outcome: of that level's own test; `cancelled` where it
/// was not reached.
struct LevelReport {
  Index moving_nodes = 0;
  int iterations = 0;
  Outcome outcome = Outcome::converged;
  double seconds = 0;
};

struct FairReport {
  Outcome outcome = Outcome::converged;
  Method method = Method::sweep;
  /// Of surfaces.
  Springs springs = Springs::edge;
  FairBy fair_by = FairBy::curvature;
  int iterations = 0;
  /// Multigrid and sweep: largest displacement of the last iteration, relative to the mean edge length at its node
  /// (§4.6). Equilibrium: predicted largest distance of a node from its final place, relative to the diagonal of the
  /// box.
  double residual = 0;
  /// That figure for every iteration, over all levels.
  std::vector<double> history;
  /// Predicted largest distance of a node from its final place, relative to the diagonal of the box around the moving
  /// nodes and their rim; none where the method cannot tell.
  std::optional<double> expected_error;
  /// What was done on coarser versions of the shape and at last on itself.
  std::vector<LevelReport> levels;
  /// What was done on all levels together, in iterations of the equilibrium solver on one moving node (a step of the
  /// flow counts 60, a sweep 1/16, a new factor of a matrix 0.1 to 6), and the most that would have been done, sweeps
  /// as a last resort not counted; 0 where iterations are limited instead.
  double work = 0;
  double most_work = 0;
  Index nodes = 0;
  Index faces = 0;
  Index moving_nodes = 0;
  Index fixed_positions = 0;
  Index fixed_normals = 0;
  Index fixed_tangents = 0;
  /// How far nodes moved from the input: largest, and root mean square over the moving nodes; in units of the input.
  double greatest_move = 0;
  double mean_move = 0;
  double seconds = 0;
  int threads = 1;
  Fairness before;
  Fairness after;
  /// Of the boundary's own fairing, where it was asked for.
  std::shared_ptr<const FairReport> boundary;
  std::vector<std::string> warnings;
};

struct FairResult {
  std::vector<Vector3> positions;  ///< one per node; fixed nodes bit for bit
  FairReport report;
};

/// Fairs a polygonal surface or curve under constraints (paper §4.1 and Fig. 3; §4.8 for curves).
///
/// Curves go to the equilibrium of the V-Spring equations: between constraints curvature is linear in arc length, an
/// Euler spiral; see docs/curves.md. An end without a tangent is free to turn. A given normal leaves the tangent free
/// to turn about it; on a planar curve it gives the tangent.
///
/// Surfaces by Method::equilibrium go to where no node is displaced any more; the report says how far off they are
/// expected to be. Memory: about 0.7 kB for every
/// moving node, all in.
///
/// With options.fair_boundary the boundary of a surface is faired first as a curve, under the positions and tangents
/// that the constraints give there (normals act on the surface), always to its equilibrium; throws as for a curve.
///
/// Nodes with a fixed position come out exactly at it; isolated nodes stay. Nothing is silently lost: throws as
/// check_constraints() does for what cannot be faired; Error(invalid_argument) for options out of range or constraints
/// of another node count. Arguments are unchanged. Cancellation ends with the shape so far and outcome `cancelled`. The
/// result is the same, bit for bit, for every number of threads. Cost: linear in the nodes, once, and in the moving
/// nodes for every iteration.
[[nodiscard]] FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options,
                              Context& context);
[[nodiscard]] FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options = {});
[[nodiscard]] FairResult fair(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options,
                              Context& context);
[[nodiscard]] FairResult fair(const PolygonCurve& curve, const Constraints& constraints,
                              const FairOptions& options = {});

}  // namespace vspring
