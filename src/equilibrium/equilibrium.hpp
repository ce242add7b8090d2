#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "precondition/anderson.hpp"
#include "precondition/preconditioner.hpp"
#include "spring/model.hpp"
#include "vspring/fair.hpp"

namespace vspring {

class FaceTies;

/// A logarithmic barrier on either side of each point, which a surface is to pass within a distance. Near to that
/// distance and beyond it a quadratic goes on (Hauser and Saccon 2006), so that any surface may be a start.
struct PointBounds {
  double distance = 0;  ///< in the coordinates of the net
  double barrier = 0;   ///< factor of the logarithms
  double relaxed = 0;   ///< width of the part that is quadratic, as a share of the distance
};

/// How one level goes to its equilibrium.
struct EquilibriumTask {
  double tolerance = 1e-5;  ///< expected largest distance of a node from its final place, in the net's coordinates
  int max_iterations = 200;
  /// In iterations, as some of which building a preconditioner anew counts; Outcome::work_limit beyond.
  double most_work = std::numeric_limits<double>::infinity();
  /// It ends after so many iterations unless the expected error has been less than `near`; empty: only max_iterations
  /// ends it.
  std::optional<int> most_while_far = std::nullopt;
  double near = 0;
  /// Called after every iteration with the expected distance.
  std::function<void(double)> on_iteration = nullptr;
  /// Ties scattered points to the nodes that are nearest by now, but for a margin, see PointTies::renew().
  std::function<bool(double)> renew_ties = nullptr;
  /// How many changes of ties there may be at the end.
  int most_changes = 20;
  /// The history of an earlier run of similar equations, which is continued; null: none.
  Anderson<float>* memory = nullptr;
  /// Whether the last step is taken, too, once the shape is near enough.
  bool take_last = false;
  /// For descend_bending(): points pull by their distances from faces; null: from the tangent planes of their nodes.
  const FaceTies* face_ties = nullptr;
  /// For descend_bending() with face ties: points do not pull, but hold the surface so near; distance 0: they pull.
  PointBounds bounds = {};
  /// For descend_bending(): whether it may begin without the noise in the spacing.
  bool may_smooth_start = true;
  /// For descend_bending(): places to which the moving nodes are drawn, and the smoothing length L: waves of length 2πL
  /// keep half of their height. Empty: none.
  std::span<const Vector3> home = {};
  double smoothing_length = 0;
};

struct EquilibriumResult {
  Outcome outcome = Outcome::iteration_limit;
  int iterations = 0;
  double work = 0;            ///< as for most_work
  double expected_error = 0;  ///< in the net's coordinates
  std::size_t kept = 0;       ///< moving nodes that stay where they are, as faces would turn over
};

/// Goes to where all displacements of the model vanish: corrections by the preconditioner, Anderson acceleration, steps
/// so short that no edge turns much. Ends with the shape of the smallest expected error, with points where their ties
/// do not change any more. See docs/solver.md.
EquilibriumResult go_to_equilibrium(Net& net, const Model& model, Preconditioner& preconditioner,
                                    const EquilibriumTask& task, ThreadTeam& team, Context& context);

}  // namespace vspring
