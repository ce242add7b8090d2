#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/stopwatch.hpp"
#include "base/threads.hpp"
#include "checks/result_check.hpp"
#include "constraints/active_submesh.hpp"
#include "equilibrium/solver_call.hpp"
#include "equilibrium/surface_hierarchy.hpp"
#include "spring/model.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// Fairs one mesh, once or again and again. Where only a small part of it moves it works on that part.
class SurfaceFairing {
 public:
  /// The mesh must outlive it.
  SurfaceFairing(const PolygonMesh& mesh, const FairOptions& options, int threads);

  /// As fair(), once.
  FairResult fair_once(const Constraints& constraints, Context& context);

  /// The same, and remembers the shape and how it was found. Where the constraints hold the same nodes as the time
  /// before and an equilibrium was found then, it starts from there, with what it has.
  /// tolerance: in place of the options' one, where somebody drags: the report is to have no moves and counts, and a
  /// shape that is worse than the mesh is said to be, but no other is looked for.
  FairResult fair_again(const Constraints& constraints, Context& context, std::optional<double> tolerance = {});

  /// About where fair_again() would lead from the last shape, which stays as it is. None where there is none to go
  /// from.
  std::optional<std::vector<Vector3>> predict(const Constraints& constraints, double tolerance);

 private:
  struct EquilibriumCall : SolverCall {
    const FairOptions& options;
    const EquilibriumMethod& method;  ///< of the options
  };

  /// Whether it can go on from the last shape.
  [[nodiscard]] bool fits_last(const Constraints& constraints) const;
  /// Leaves the shape in the net that it returns, or in hierarchy_. None where it was cancelled before there was any
  /// but the input.
  std::optional<Net> run(const Constraints& constraints, Context& context, FairReport& report,
                         const FairOptions& options);
  /// The same by the method equilibrium. Where no shape of least bending is found that by curvature comes next.
  void run_to_equilibrium(const Constraints& constraints, const EquilibriumCall& call);
  /// The same, made fair by that; with other distributions and, by curvature, the plain iteration if need be.
  void find_equilibrium(FairBy fair_by, const Constraints& constraints, const EquilibriumCall& call);
  /// The same with sphere springs, where they are wanted and suit, and with edge springs where these have no
  /// equilibrium. Iterations and work are added to those that the report has.
  void find_with_springs(FairBy fair_by, const Constraints& constraints, const EquilibriumCall& call);
  /// A try that was cancelled: the input with its constraints, where the shape so far is worse.
  void go_back_if_worse(FairReport& report);
  /// Where no equilibrium was found: one with another distribution may be. Else the nearest shape stays. at_first: the
  /// report before anything was tried.
  bool try_evenly(FairBy fair_by, const Constraints& constraints, const FairReport& at_first,
                  const EquilibriumCall& call);
  /// Where no equilibrium was found: the paper's iteration may lead somewhere. The fairer of both stays.
  void try_sweeps(const Constraints& constraints, double step_tolerance, const SolverCall& call);
  /// From the last shape. False where that leads nowhere.
  bool go_on(const Constraints& constraints, Context& context, std::optional<double> tolerance, FairReport& report);
  /// Says where faces cross each other that did not before. True where they do, and that is not wanted as found.
  bool crosses_itself(const Net& net, const Constraints& constraints, Context& context, FairReport& report);
  void finish(const Net& net, const Constraints& constraints, FairResult& result);
  /// What the result is compared with. The start is made again from these constraints until it is forgotten.
  void look_at_start(Net& net, const Constraints& constraints);
  /// With the input, which its constraints may have changed.
  FairResult unchanged(const Constraints& constraints, FairResult& result, const Stopwatch& stopwatch) const;

  const PolygonMesh* whole_;
  std::optional<ActiveSubmesh> part_;
  FairOptions options_;
  ThreadTeam team_;
  std::unique_ptr<const Model> model_;
  std::optional<ResultCheck> check_;
  std::optional<SurfaceHierarchy> hierarchy_;
  // Of the last shape, where that is an equilibrium to go on from.
  std::optional<Constraints> last_;
  // Since the last shape that was not a picture of a drag, one led nowhere or to something worse: equilibria that are
  // reached from there may be others than that from the mesh.
  bool went_astray_ = false;
};

}  // namespace vspring
