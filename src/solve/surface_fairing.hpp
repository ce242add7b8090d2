#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/stopwatch.hpp"
#include "base/threads.hpp"
#include "checks/bending_energy.hpp"
#include "checks/result_check.hpp"
#include "constraints/active_submesh.hpp"
#include "equilibrium/relaxation.hpp"
#include "equilibrium/solver_call.hpp"
#include "equilibrium/surface_hierarchy.hpp"
#include "solve/attempt.hpp"
#include "solve/carried.hpp"
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
    bool looks_at_crossings;
  };

  /// Whether it can go on from the last shape.
  [[nodiscard]] bool fits_last(const Constraints& constraints) const;
  /// Leaves the shape in the net that it returns, or in hierarchy_. None where it was cancelled before there was any
  /// but the input.
  std::optional<Net> run(const Constraints& constraints, Context& context, FairReport& report,
                         const FairOptions& options, bool looks_at_crossings);
  /// The same by the method equilibrium: one attempt after the other until one is final.
  void run_to_equilibrium(const Constraints& constraints, const EquilibriumCall& call);
  /// With sphere springs, where they are wanted and suit, else with edge springs.
  Attempt go_from_coarse_levels(Springs springs, const Constraints& constraints, const EquilibriumCall& call);
  /// The same with nodes at the mean of their neighbours, from the input.
  Attempt go_evenly(const Constraints& constraints, const EquilibriumCall& call);
  /// By steps that bend it less, from the start and from a membrane; then drawn to the start ever more, until that
  /// leads to an end that is no worse.
  void go_by_less_bending(std::vector<Attempt>& attempts, const Constraints& constraints, const EquilibriumCall& call);
  /// From the shape of hierarchy_. smoothing_length: of what draws it to the start, as a share of the size; none:
  /// nothing does.
  Attempt bend_less(Relaxation& relaxation, std::span<const Vector3> start, std::optional<double> smoothing_length,
                    const Constraints& constraints, const EquilibriumCall& call);
  /// Makes that of the attempts the shape which is the result, or the start.
  void take_best(std::vector<Attempt> attempts, const Constraints& constraints, const EquilibriumCall& call);
  /// On the net of hierarchy_, as the next.
  void measure_bending(std::vector<Attempt>& attempts);
  [[nodiscard]] Bent bent_of(const std::vector<Vector3>& positions, const BendingEnergy& bending);
  /// Those that were reached.
  void keep_places(Attempt& attempt) const;
  /// The shape that was reached, looked at.
  Attempt attempt(const Constraints& constraints, const EquilibriumCall& call);
  /// Makes the mesh that it starts from, and whose spacing it keeps: with what is put aside others go along. False
  /// where that is as it was.
  bool carry_along(const Constraints& constraints);
  [[nodiscard]] Net gather(const Constraints& constraints, bool for_spheres) const;
  /// The last shape, for that mesh.
  void space_as_carried(const Constraints& constraints);
  [[nodiscard]] const PolygonMesh& input() const { return carried_ ? *carried_ : *whole_; }
  void make_levels(Net net, const FairOptions& options);
  /// From the last shape. False where that leads nowhere.
  bool go_on(const Constraints& constraints, Context& context, std::optional<double> tolerance, FairReport& report);
  /// Where faces cross each other that did not before, in words.
  std::string crossings(const Net& net, const Constraints& constraints, Context& context);
  void warn_of_crossings(const Net& net, const Constraints& constraints, Context& context, FairReport& report);
  void finish(const Net& net, const Constraints& constraints, FairResult& result);
  /// With the input, which its constraints may have changed.
  FairResult unchanged(const Constraints& constraints, FairResult& result, const Stopwatch& stopwatch) const;

  const PolygonMesh* whole_;
  std::optional<ActiveSubmesh> part_;
  std::vector<Vector3> carrying_moves_;  ///< of the nodes of the part, or of all
  std::optional<CarriedNodes> carrying_;
  std::optional<PolygonMesh> carried_;  ///< where it is not the mesh itself that is started from
  FairOptions options_;
  ThreadTeam team_;
  std::unique_ptr<const Model> model_;
  std::optional<ResultCheck> check_;
  std::optional<SurfaceHierarchy> hierarchy_;
  bool goes_on_ = false;  ///< whether what the hierarchy has may be of use once more
  // Of the last shape, where that is an equilibrium to go on from.
  std::optional<Constraints> last_;
  // Since the last shape that was not a picture of a drag, one led nowhere or to something worse: equilibria that are
  // reached from there may be others than that from the mesh.
  bool went_astray_ = false;
};

}  // namespace vspring
