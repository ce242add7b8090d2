#pragma once

#include <string>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "vspring/fairness.hpp"
#include "vspring/model.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

enum class Method {
  sweep  ///< the paper's plain iteration (§4.1)
};

struct FairOptions {
  Method method = Method::sweep;
  PseudoNormals pseudo_normals = PseudoNormals::link;
  Distribution distribution = Distribution::even;
  /// The paper's e (§4.6): stop when no node moves further in one iteration than this share of the mean length of its
  /// edges.
  double step_tolerance = 1e-3;
  int max_iterations = 10000;
  /// result = input + strength × (fair − input) for moving nodes; 0 to 1.
  double strength = 1;

  /// Throws Error(invalid_argument) naming the option and its range.
  void validate() const;
};

enum class Outcome { converged, iteration_limit, stalled, cancelled };

/// "converged", "iteration-limit", "stalled" or "cancelled".
[[nodiscard]] const char* name(Outcome outcome) noexcept;

struct FairReport {
  Outcome outcome = Outcome::converged;
  int iterations = 0;
  /// Largest displacement of the last iteration, relative to the mean edge length at its node (§4.6).
  double residual = 0;
  /// That figure for every iteration.
  std::vector<double> history;
  Index nodes = 0;
  Index faces = 0;
  Index moving_nodes = 0;
  Index fixed_positions = 0;
  Index fixed_normals = 0;
  /// How far nodes moved from the input: largest, and root mean square over the moving nodes; in units of the input.
  double greatest_move = 0;
  double mean_move = 0;
  double seconds = 0;
  int threads = 1;
  Fairness before;
  Fairness after;
  std::vector<std::string> warnings;
};

struct FairResult {
  std::vector<Vector3> positions;  ///< one per node; fixed nodes bit for bit
  FairReport report;
};

/// Fairs a polygonal surface under constraints (paper §4.1, Fig. 3).
///
/// Nodes with a fixed position come out exactly at it; isolated nodes stay. Nothing is silently lost: throws as
/// check_constraints() does for what cannot be faired; Error(invalid_argument) for options out of range or constraints
/// of another node count. Arguments are unchanged. Cancellation ends with the shape so far and outcome `cancelled`. The
/// result is the same, bit for bit, for every number of threads. Cost: linear in the nodes, once, and in the moving
/// nodes for every iteration.
[[nodiscard]] FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options,
                              Context& context);
[[nodiscard]] FairResult fair(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options = {});

}  // namespace vspring
