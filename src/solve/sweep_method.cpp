#include "solve/sweep_method.hpp"

#include <cmath>
#include <limits>

#include "sweep/sweep.hpp"

namespace vspring {

namespace {

// Steps may well grow for a while, when a fold opens or a bulge turns over; beyond this they tell of a shape that falls
// apart: under too few constraints nodes can go on drifting to one side of a closed surface until it collapses.
constexpr double lost_factor = 10;
constexpr int patience = 500;

/// Keeps the shape of the smallest steps, in case it gets worse.
class BestShape {
 public:
  explicit BestShape(Net& net) : net_(&net) {}

  void look(double residual) {
    lost_for_ = residual > lost_factor * residual_ ? lost_for_ + 1 : 0;
    // Shapes hardly better than the one kept are not worth a copy.
    if (!(residual < 0.7 * residual_)) return;
    residual_ = residual;
    positions_ = net_->positions;
  }

  /// For how many iterations in a row steps have been far larger than they were.
  [[nodiscard]] int lost_for() const noexcept { return lost_for_; }

  /// Puts the shape back; returns its residual.
  double restore() {
    net_->positions = positions_;
    return residual_;
  }

 private:
  Net* net_;
  double residual_ = std::numeric_limits<double>::infinity();
  std::vector<Vector3> positions_;
  int lost_for_ = 0;
};

/// Steps fall about geometrically, so the logarithm of the step tells how much of the way is done.
double share_done(double first, double now, double last) {
  if (now <= last) return 1;
  return first > now ? std::log(first / now) / std::log(first / last) : 0;
}

}  // namespace

void run_sweeps(Net& net, const Model& model, const FairOptions& options, ThreadTeam& team, Context& context,
                ProgressReporter& progress, FairReport& report) {
  Sweep sweep(net, model, team);
  BestShape best(net);
  report.outcome = Outcome::iteration_limit;
  while (report.outcome == Outcome::iteration_limit && report.iterations < options.max_iterations) {
    if (context.cancelled()) {
      report.outcome = Outcome::cancelled;
      break;
    }
    report.residual = sweep.iterate();
    ++report.iterations;
    report.history.push_back(report.residual);
    best.look(report.residual);
    progress.report("fairing",
                    std::max(share_done(report.history.front(), report.residual, options.step_tolerance),
                             static_cast<double>(report.iterations) / options.max_iterations),
                    report.iterations, report.residual);
    if (report.residual < options.step_tolerance) {
      report.outcome = Outcome::converged;
    } else if (best.lost_for() >= patience) {
      report.outcome = Outcome::stalled;
    }
  }
  if (best.lost_for() > 0) {
    report.residual = best.restore();
    report.warnings.emplace_back(
        "the steps grew again, so the shape has no equilibrium that the iteration can reach: the one with the smallest "
        "steps is "
        "kept; hold more nodes, or normals, or let a smaller region move");
  }
}

}  // namespace vspring
