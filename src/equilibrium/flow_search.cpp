#include "equilibrium/flow_search.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>

#include "base/cancellation.hpp"
#include "equilibrium/pseudo_transient.hpp"
#include "equilibrium/sweep_method.hpp"
#include "sweep/sweep.hpp"

namespace vspring {

namespace {

// Steps along the flow from one start: fewer are no use.
constexpr int fewest_steps = 20;
constexpr int most_steps = 100;
// Sweeps until hardly anything moves, as a share of the edges.
constexpr double still = 1e-9;

/// False, and what there was before, where steps from that start lead nowhere.
bool follow_from(const std::function<void()>& go_to_start, int steps, Relaxation& relaxation, FairReport& report) {
  const Relaxation::Reached best = relaxation.reached(relaxation.last());
  try {
    go_to_start();
    relaxation.relax_along_flow(steps, FlowStart::anywhere);
  } catch (const Cancelled&) {
    report.outcome = Outcome::cancelled;
  }
  if (report.outcome == Outcome::converged) return true;
  const bool cancelled = report.outcome == Outcome::cancelled;
  relaxation.go_back(relaxation.last(), best);
  if (cancelled) report.outcome = Outcome::cancelled;
  return cancelled;
}

}  // namespace

void search_along_flow(Relaxation& relaxation, Hierarchy& hierarchy, const Model& model, const StartPlaces& start,
                       const SolverCall& call) {
  Net& net = relaxation.shape();
  FairReport& report = call.report;
  const auto sweep_from_start = [&](std::size_t sweeps) {
    net.positions = start.of(net);
    Sweep sweep(net, model, call.team);
    for (std::size_t k = 0; k < sweeps && !call.context.cancelled(); ++k) {
      report.work += work_of_sweep * static_cast<double>(net.moving);
      if (sweep.iterate() < still) break;
    }
  };
  const std::function<void()> starts[] = {[] {}, [&] { sweep_from_start(10); },
                                          [&] { hierarchy.start_from_membrane(relaxation.last()); },
                                          [&] { sweep_from_start(0); }, [&] { sweep_from_start(1000); }};
  const auto nodes = static_cast<double>(net.moving);
  const auto steps_left = [&] {
    return static_cast<int>((report.most_work - report.work) / (work_of_flow_step * nodes));
  };
  const int at_once = std::clamp(steps_left() / 3, fewest_steps, most_steps);
  for (const auto& go_to_start : starts) {
    if (steps_left() < at_once) break;
    if (follow_from(go_to_start, at_once, relaxation, report)) return;
  }
  // Steps of the flow from where sweeps end need as much again.
  const double sweeps =
      (report.most_work - report.work) / (work_of_sweep * nodes) - at_once * work_of_flow_step / work_of_sweep;
  if (sweeps > 0)
    (void)follow_from([&] { sweep_from_start(static_cast<std::size_t>(sweeps)); }, at_once, relaxation, report);
}

}  // namespace vspring
