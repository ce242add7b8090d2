#include "solve/equilibrium_method.hpp"

#include <algorithm>
#include <atomic>
#include <functional>
#include <span>
#include <vector>

#include "base/stopwatch.hpp"
#include "solve/account.hpp"
#include "solve/equilibrium.hpp"
#include "solve/pseudo_transient.hpp"
#include "solve/spring_energy.hpp"
#include "sweep/sweep.hpp"

namespace vspring {

namespace {

constexpr int default_limit = 200;
// From a shape that is near: beyond, coarser levels are sooner there.
constexpr int near_limit = 30;
// The coarsest level needs 10 to 40 iterations from any shape that is not tangled up.
constexpr int first_try = 80;
// An expected error, as a share of the diagonal, from which a shape on the coarsest level is no use.
constexpr double lost_at = 1e-3;
// What a coarse level leaves undone, the finer ones have to do with more nodes.
constexpr double coarse_share = 0.3;
constexpr int coarse_changes = 2;
// Moving nodes up to which a second start costs next to nothing.
constexpr std::size_t few = 2000;
// Moving nodes up to which a second start is of any use where coarser levels led nowhere.
constexpr std::size_t not_too_many = 100'000;
// Moving nodes up to which the flow is followed where corrections lead nowhere, and how much of that is tried.
constexpr std::size_t few_enough_to_follow = 10'000;
constexpr int fewest_steps = 20;
constexpr int most_steps = 100;
constexpr std::size_t most_node_steps = 200'000;
// The last resort: sweeps until hardly anything moves, as a share of the edges.
constexpr std::size_t most_node_sweeps = 30'000'000;
constexpr double still = 1e-9;
// The cosine of 60°.
constexpr double sharpest_turn = 0.5;
constexpr double greatest_displacement_ratio = 4;

/// The places of the moving nodes, as precise as a start need be.
std::vector<Eigen::Vector3f> rounded(const Net& net) {
  std::vector<Eigen::Vector3f> result(net.moving);
  for (std::size_t i = 0; i < net.moving; ++i) result[i] = net.positions[i].cast<float>();
  return result;
}

/// Whether so little holds it that spheres of many sizes are fair: an equilibrium is one of a family then, and nothing
/// to be found by steps to a single one.
bool leaves_a_family(const Net& net) {
  constexpr std::size_t fixes_a_sphere = 4;
  std::size_t known = net.positions.size() - net.moving;
  for (std::size_t i = 0; i < net.positions.size() && known < fixes_a_sphere; ++i) known += net.normal_given(i) ? 2 : 0;
  return known < fixes_a_sphere;
}

class Run {
 public:
  Run(Hierarchy& hierarchy, const Model& model, const FairOptions& options, ThreadTeam& team, Context& context,
      ProgressReporter& progress, FairReport& report, PointLevels* points = nullptr)
      : hierarchy_(hierarchy),
        model_(model),
        options_(options),
        size_(diagonal(hierarchy.net(hierarchy.count() - 1))),
        team_(team),
        context_(context),
        progress_(progress),
        report_(report),
        points_(points) {}

  /// Without a look at coarser levels.
  void run_on_shape_itself(Preconditioner& preconditioner, Anderson<float>* memory, bool take_last) {
    memory_ = memory;
    take_last_ = take_last;
    relax(hierarchy_.count() - 1, std::min(options_.max_iterations.value_or(near_limit), near_limit), preconditioner);
  }

  void run() {
    const std::size_t last = hierarchy_.count() - 1;
    Net& finest = hierarchy_.net(last);
    report_.outcome = context_.cancelled() ? Outcome::cancelled : Outcome::iteration_limit;
    if (context_.cancelled() || options_.max_iterations == 0) return;
    // Coarser levels do not keep a distribution, and where points are, a start is near.
    const bool try_first = points_ && options_.distribution == Distribution::keep;
    if (try_first || may_be_there(finest)) {
      const std::vector<Vector3> start = try_first ? finest.positions : std::vector<Vector3>();
      relax(last, try_first ? std::min(options_.max_iterations.value_or(near_limit), near_limit) : 1);
      if (try_first && unfinished()) {
        finest.positions = start;
        report_.outcome = Outcome::iteration_limit;
      }
    }
    if (report_.outcome == Outcome::iteration_limit) go_down();
  }

 private:
  void go_down() {
    const int limit = options_.max_iterations.value_or(default_limit);
    const std::size_t last = hierarchy_.count() - 1;
    const Net& finest = hierarchy_.net(last);
    const bool may_follow_flow = !points_ && !options_.max_iterations && finest.tangents.empty() &&
                                 finest.moving <= few_enough_to_follow && !leaves_a_family(finest);
    const std::vector<Vector3> start = may_follow_flow ? finest.positions : std::vector<Vector3>();
    hierarchy_.start();
    std::vector<Eigen::Vector3f> own_start;
    const std::size_t first = hierarchy_.first_of_use();
    for (std::size_t k = first; k <= last; ++k) {
      tie_points(k);
      relax(k, k == first ? std::min(limit, first_try) : limit);
      if (k == first && limit > first_try && unfinished()) {
        // Points know better, and may be all that holds it.
        if (lost() && !points_) hierarchy_.forget_shape(k);
        tie_points(k);
        relax(k, limit);
      }
      if (!own_start.empty() && ((unfinished() && lost()) || caught_in_a_fold(k))) try_own_start(k, own_start, limit);
      if (k == last) break;
      if (points_ && unfinished() && lost()) {
        // Points too far out for this level: finer ones do better from the start itself.
        tie_points(last);
        relax(last, limit);
        break;
      }
      own_start = hierarchy_.net(k + 1).moving <= not_too_many ? rounded(hierarchy_.net(k + 1))
                                                               : std::vector<Eigen::Vector3f>();
      update_directions(hierarchy_.net(k), model_, team_);
      hierarchy_.prolong_from(k);
    }
    if (may_follow_flow && unfinished()) try_flow(start);
  }

  /// Corrections that take a surface for flat and even may lead nowhere where it has folds. The flow of the plain
  /// iteration, with all that it depends on, may lead somewhere: from the shape that was reached, from where some
  /// sweeps take the start, from a soap film, from the start itself or from where very many sweeps take it.
  void try_flow(const std::vector<Vector3>& start) {
    Net& net = hierarchy_.net(hierarchy_.count() - 1);
    const auto sweep_from_start = [&](std::size_t sweeps) {
      net.positions = start;
      Sweep sweep(net, model_, team_);
      for (std::size_t k = 0; k < sweeps && !context_.cancelled(); ++k) {
        if (sweep.iterate() < still) break;
      }
    };
    const std::function<void()> starts[] = {[] {}, [&] { sweep_from_start(10); },
                                            [&] { hierarchy_.forget_shape(hierarchy_.count() - 1); },
                                            [&] { sweep_from_start(0); }, [&] { sweep_from_start(1000); }};
    int left = static_cast<int>(most_node_steps / net.moving);
    const int at_once = std::clamp(left / 3, fewest_steps, most_steps);
    for (const auto& go_to_start : starts) {
      if (left < at_once) break;
      const int before = report_.iterations;
      if (follow_flow_from(go_to_start, at_once)) return;
      left -= report_.iterations - before;
    }
    (void)follow_flow_from([&] { sweep_from_start(most_node_sweeps / net.moving); }, at_once);
  }

  /// False, and what there was before, where that leads nowhere.
  bool follow_flow_from(const std::function<void()>& go_to_start, int steps) {
    const std::size_t last = hierarchy_.count() - 1;
    Net& net = hierarchy_.net(last);
    const Reached best = reached(last);
    go_to_start();
    relax(last, steps, [&](const EquilibriumTask& task) { return follow_flow(net, model_, task, team_, context_); });
    if (report_.outcome == Outcome::converged) return true;
    const bool cancelled = report_.outcome == Outcome::cancelled;
    go_back(last, best);
    if (cancelled) report_.outcome = Outcome::cancelled;
    return cancelled;
  }

  /// A level too coarse for the shape to have an equilibrium, or to have the right one, hands up what is no help: then
  /// the start itself may be one. The better of both stays.
  void try_own_start(std::size_t level, std::span<const Eigen::Vector3f> start, int limit) {
    Net& net = hierarchy_.net(level);
    const Reached before = reached(level);
    const bool was_unfinished = unfinished();
    const double energy = energy_of(net).sum;
    for (std::size_t i = 0; i < net.moving; ++i) net.positions[i] = start[i].cast<double>();
    tie_points(level);
    relax(level, limit);
    if (report_.outcome == Outcome::cancelled) return;
    const bool better = was_unfinished || unfinished()
                            ? !unfinished() || (was_unfinished && report_.residual < before.residual)
                            : energy_of(net).sum < energy;
    if (!better) go_back(level, before);
  }

  /// A shape, and what is known of it.
  struct Reached {
    std::vector<Vector3> positions;
    Outcome outcome;
    double residual;
  };

  Reached reached(std::size_t level) { return {hierarchy_.net(level).positions, report_.outcome, report_.residual}; }

  void go_back(std::size_t level, const Reached& reached) {
    hierarchy_.net(level).positions = reached.positions;
    tie_points(level);
    report_.outcome = reached.outcome;
    report_.residual = reached.residual;
    report_.expected_error = reached.residual;
  }

  void tie_points(std::size_t level) {
    if (points_) points_->tie(level);
  }

  SpringEnergy energy_of(Net& net) {
    update_directions(net, model_, team_);
    return spring_energy(net);
  }

  /// Coarse levels may fold a shape where it has no need to.
  bool caught_in_a_fold(std::size_t level) {
    Net& net = hierarchy_.net(level);
    return net.moving <= few && net.tangents.empty() && report_.outcome != Outcome::cancelled &&
           energy_of(net).least_cosine < sharpest_turn;
  }

  [[nodiscard]] bool lost() const { return !(report_.residual < lost_at); }

  /// False where displacements are so large that corrections cannot be within the tolerance: as displacements of an
  /// equilibrium that is off by one correction they are at most a few times as large.
  bool may_be_there(Net& net) {
    model_.prepare(net);
    update_directions(net, model_, team_);
    const double greatest = greatest_displacement_ratio * options_.tolerance * size_;
    std::atomic<bool> may_be = true;
    parallel_ranges(team_, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      std::vector<NodeForce> forces(end - begin);
      model_.find_forces(net, {begin, end}, forces);
      for (const NodeForce& force : forces) {
        if ((force.spring + force.regularisation).squaredNorm() > greatest * greatest) may_be = false;
      }
    });
    return may_be;
  }

  [[nodiscard]] bool unfinished() const {
    return report_.outcome == Outcome::iteration_limit || report_.outcome == Outcome::stalled;
  }

  void relax(std::size_t level, int max_iterations) { relax(level, max_iterations, hierarchy_.preconditioner(level)); }

  void relax(std::size_t level, int max_iterations, Preconditioner& preconditioner) {
    relax(level, max_iterations, [&](const EquilibriumTask& task) {
      return go_to_equilibrium(hierarchy_.net(level), model_, preconditioner, task, team_, context_);
    });
  }

  void relax(std::size_t level, int max_iterations,
             const std::function<EquilibriumResult(const EquilibriumTask&)>& method) {
    const Stopwatch stopwatch;
    const std::size_t last = hierarchy_.count() - 1;
    const Net& net = hierarchy_.net(level);
    const double share = static_cast<double>(net.moving) / static_cast<double>(hierarchy_.net(last).moving);
    EquilibriumTask task;
    task.tolerance = options_.tolerance * size_ * (level == last ? 1 : coarse_share);
    task.max_iterations = max_iterations;
    if (points_) task.renew_ties = [&](double margin) { return points_->renew(margin); };
    if (level != last) task.most_changes = coarse_changes;
    task.memory = memory_;
    task.take_last = take_last_;
    task.on_iteration = [&](double expected) {
      report_.history.push_back(expected / size_);
      progress_.report("fairing", share / 2, static_cast<int>(report_.history.size()), expected / size_);
    };
    const EquilibriumResult result = method(task);
    report_.iterations += result.iterations;
    report_.levels.push_back({.moving_nodes = static_cast<Index>(net.moving),
                              .iterations = result.iterations,
                              .seconds = stopwatch.seconds()});
    report_.outcome = result.outcome;
    report_.residual = result.expected_error / size_;
    report_.expected_error = report_.residual;
  }

  Hierarchy& hierarchy_;
  const Model& model_;
  const FairOptions& options_;
  double size_;
  ThreadTeam& team_;
  Context& context_;
  ProgressReporter& progress_;
  FairReport& report_;
  PointLevels* points_;
  Anderson<float>* memory_ = nullptr;
  bool take_last_ = false;
};

}  // namespace

void run_equilibrium(Hierarchy& hierarchy, const Model& model, const FairOptions& options, ThreadTeam& team,
                     Context& context, ProgressReporter& progress, FairReport& report, PointLevels* points) {
  Run(hierarchy, model, options, team, context, progress, report, points).run();
}

void run_equilibrium_from_near(Hierarchy& hierarchy, Preconditioner& preconditioner, const Model& model,
                               const FairOptions& options, ThreadTeam& team, Context& context,
                               ProgressReporter& progress, FairReport& report, PointLevels* points,
                               Anderson<float>* memory, bool take_last) {
  Run(hierarchy, model, options, team, context, progress, report, points)
      .run_on_shape_itself(preconditioner, memory, take_last);
}

}  // namespace vspring
