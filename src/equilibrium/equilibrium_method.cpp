#include "equilibrium/equilibrium_method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/stopwatch.hpp"
#include "checks/result_check.hpp"
#include "checks/spring_energy.hpp"
#include "equilibrium/account.hpp"
#include "equilibrium/equilibrium.hpp"
#include "equilibrium/pseudo_transient.hpp"
#include "equilibrium/sweep_method.hpp"
#include "spring/spacing.hpp"
#include "sweep/sweep.hpp"

namespace vspring {

namespace {

constexpr int default_limit = 200;
// Of the finest level with sphere springs, as edge springs come second: of 67 shapes at random all that these had
// an equilibrium for were there after 18. Only what is nearer than a share of the diagonal then goes on.
constexpr int sphere_limit = 30;
constexpr double sphere_is_near = 1e-4;
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
// What may be tried where nobody gave a number of iterations, in iterations of one moving node: some two seconds for
// 3,000 nodes on one core.
constexpr double most_work = 1.35e6;
constexpr double most_work_a_node = 450;
// Of Newton's steps from a curve that is nearly there.
constexpr int newton_limit = 20;
// Steps along the flow, where corrections lead nowhere: fewer are no use.
constexpr int fewest_steps = 20;
constexpr int most_steps = 100;
// The last resort: sweeps until hardly anything moves, as a share of the edges.
constexpr double still = 1e-9;
// The cosine of 60°.
constexpr double sharpest_turn = 0.5;
constexpr double greatest_displacement_ratio = 4;

/// Places of the moving nodes, as precise as a start need be.
std::vector<Eigen::Vector3f> rounded(const Net& net, std::span<const Vector3> places) {
  std::vector<Eigen::Vector3f> result(net.moving);
  for (std::size_t i = 0; i < net.moving; ++i) result[i] = places[i].cast<float>();
  return result;
}

class Run {
 public:
  Run(Hierarchy& hierarchy, const Model& model, const FairOptions& options, ThreadTeam& team, Context& context,
      ProgressReporter& progress, FairReport& report, PointLevels* points = nullptr)
      : hierarchy_(hierarchy),
        model_(model),
        options_(options),
        // Shares of a shape without extent are nothing or infinite, but something.
        size_(std::max(diagonal(hierarchy.net(hierarchy.count() - 1)), std::numeric_limits<double>::min())),
        team_(team),
        context_(context),
        progress_(progress),
        report_(report),
        points_(points) {
    const auto nodes = static_cast<double>(hierarchy.net(hierarchy.count() - 1).moving);
    if (!options.max_iterations) report.most_work = std::max(most_work, most_work_a_node * nodes);
  }

  /// Without a look at coarser levels.
  void run_on_shape_itself(Preconditioner& preconditioner, Anderson<float>* memory, bool take_last) {
    memory_ = memory;
    take_last_ = take_last;
    relax(hierarchy_.count() - 1, std::min(options_.max_iterations.value_or(near_limit), near_limit), preconditioner);
  }

  /// check: of the start, or null where that is not to be looked at.
  void run(const ResultCheck* check) {
    const std::size_t last = hierarchy_.count() - 1;
    Net& finest = hierarchy_.net(last);
    report_.outcome = context_.cancelled() ? Outcome::cancelled : Outcome::iteration_limit;
    if (context_.cancelled() || options_.max_iterations == 0) return;
    if (!points_) input_ = finest.positions;
    // Coarser levels do not keep a distribution, and where points are, a start is near.
    const bool try_first = points_ && options_.distribution == Distribution::keep;
    const Displacements displacements = greatest_displacements(finest);
    if (try_first || may_have_converged(displacements.all)) {
      const std::vector<Vector3> start = try_first ? finest.positions : std::vector<Vector3>();
      relax(last, try_first ? std::min(options_.max_iterations.value_or(near_limit), near_limit) : 1);
      if (try_first && unfinished()) {
        finest.positions = start;
        report_.outcome = Outcome::iteration_limit;
      }
    }
    if (report_.outcome == Outcome::iteration_limit) go_down();
    if (!points_ && !options_.distribution && unfinished() && may_have_converged(displacements.of_springs))
      stay_with_input();
    if (!points_ && !options_.max_iterations && report_.outcome != Outcome::cancelled) try_winding();
    if (check) stay_sound(*check);
    // Limits that nobody gave.
    if (!options_.max_iterations && report_.outcome == Outcome::iteration_limit) report_.outcome = Outcome::work_limit;
  }

 private:
  void go_down() {
    const int limit = options_.max_iterations.value_or(default_limit);
    const std::size_t last = hierarchy_.count() - 1;
    const Net& finest = hierarchy_.net(last);
    const bool may_follow_flow = !points_ && !options_.max_iterations && finest.tangents.empty() &&
                                 !finest.spheres.on() && !is_underconstrained(finest);
    // Where noise has folded the finest level, its own start is no help.
    const bool is_folded = !finest.laplacian_weights.empty() && has_crease(last);
    hierarchy_.start();
    std::vector<Eigen::Vector3f> own_start;
    const std::size_t first = hierarchy_.first_of_use();
    for (std::size_t k = first; k <= last; ++k) {
      tie_points(k);
      relax(k, k == first ? std::min(limit, first_try) : limit);
      if (k == first && limit > first_try && unfinished()) {
        // Points know better, and may be all that holds it.
        if (lost() && !points_) hierarchy_.start_from_membrane(k);
        tie_points(k);
        relax(k, limit);
      }
      if (!own_start.empty() && ((unfinished() && lost()) || has_crease(k))) try_own_start(k, own_start, limit);
      if (k == last) break;
      if (points_ && unfinished() && lost()) {
        // Points too far out for this level: finer ones do better from the start itself.
        tie_points(last);
        relax(last, limit);
        break;
      }
      own_start = {};
      const Net& finer = hierarchy_.net(k + 1);
      if (finer.moving <= not_too_many)
        own_start = rounded(finer, k + 1 == last && is_folded ? rest_positions(finer, team_) : finer.positions);
      update_directions(hierarchy_.net(k), model_, team_);
      hierarchy_.prolong_from(k);
    }
    if (may_follow_flow && unfinished()) try_flow();
  }

  /// A shape that is fair as it came, but whose nodes find no more even spacing along it, keeps the one that it has.
  void stay_with_input() {
    const std::size_t last = hierarchy_.count() - 1;
    Net& net = hierarchy_.net(last);
    const Reached found = reached(last);
    net.positions = input_;
    update_directions(net, model_, team_);
    hierarchy_.set_laplacian_weights(model_.present_laplacian_weights(net));
    relax(last, 1);
    if (unfinished()) go_back(last, found);
  }

  /// A curve whose ends and tangents are held may unwind on coarse levels, where it should not: then from a start that
  /// winds as the input does, with all that forces depend on.
  void try_winding() {
    const std::size_t last = hierarchy_.count() - 1;
    Net& net = hierarchy_.net(last);
    if (!unfinished() && !hierarchy_.lost_winding(input_)) return;
    has_looked_for_winding_ = true;
    const Reached found = reached(last);
    net.positions = input_;
    if (hierarchy_.wind()) {
      const std::vector<Vector3> wound = net.positions;
      for (const FlowStart start : {FlowStart::near, FlowStart::anywhere}) {
        net.positions = wound;
        relax_along_flow(start == FlowStart::near ? newton_limit : default_limit, start);
        if (report_.outcome == Outcome::cancelled) break;
        if (report_.outcome == Outcome::converged && !hierarchy_.lost_winding(input_)) return;
      }
    }
    const bool cancelled = report_.outcome == Outcome::cancelled;
    go_back(last, found);
    if (cancelled) report_.outcome = Outcome::cancelled;
  }

  /// What is worse with the shape than with the start; empty where nothing is.
  std::string fault(const ResultCheck& check) {
    std::string fault = check.fault(hierarchy_.net(hierarchy_.count() - 1));
    lost_winding_ = fault.empty() && !points_ && hierarchy_.lost_winding(input_);
    if (lost_winding_)
      fault = has_looked_for_winding_
                  ? "it winds otherwise than the input, as does every fair curve with these ends that was found"
                  : "it winds otherwise than the input";
    return fault;
  }

  /// Where the shape is worse than it came, looks for another: from the start without its noise, from the start itself,
  /// and with the spacing of the start. The best that is no worse stays, at worst the start.
  void stay_sound(const ResultCheck& check) {
    const std::size_t last = hierarchy_.count() - 1;
    Net& net = hierarchy_.net(last);
    if (options_.as_found) return warn_if_worse(check, net, report_);
    const std::string fault = this->fault(check);
    if (fault.empty()) return;
    const bool is_unwound = lost_winding_;
    const bool was_cancelled = report_.outcome == Outcome::cancelled;
    const Reached found = reached(last);
    const bool is_nowhere = !check.misplaced(net).empty();
    // What is held stays where it is held.
    const auto start_smooth = [&] {
      const std::vector<Vector3> places = rest_positions(net, team_);
      std::copy_n(places.begin(), net.moving, net.positions.begin());
    };
    const std::function<void()> ways[] = {start_smooth, [] {},
                                          [&] {
                                            update_directions(net, model_, team_);
                                            hierarchy_.set_laplacian_weights(model_.present_laplacian_weights(net));
                                          }};
    std::optional<Reached> best;
    net.positions = input_;
    // Where constraints are at odds with the input, that with its constraints is no shape to fall back on.
    const bool input_is_better = check.fault_of_places(net).empty() || is_nowhere;
    double least_energy = input_is_better ? energy_of(net).sum : std::numeric_limits<double>::infinity();
    for (const auto& way : ways) {
      if (was_cancelled || out_of_work(net)) break;
      net.positions = input_;
      way();
      relax(last, options_.max_iterations.value_or(default_limit));
      if (report_.outcome == Outcome::cancelled) break;
      if (!this->fault(check).empty()) continue;
      if (report_.outcome == Outcome::converged) return;
      // A curve that is far from an equilibrium has left the input for nothing.
      if (!net.tangents.empty() && lost()) continue;
      const double energy = energy_of(net).sum;
      if (energy >= least_energy) continue;
      least_energy = energy;
      best = reached(last);
    }
    const bool cancelled = report_.outcome == Outcome::cancelled;
    const bool is_input_smoothed = !cancelled && !best && input_is_better && !net.tangents.empty() &&
                                   smooth_a_little(start_smooth, check, least_energy);
    if (is_input_smoothed) best = Reached{net.positions, found.outcome, found.residual};
    go_back(last, best ? *best : input_is_better ? Reached{input_, found.outcome, found.residual} : found);
    report_.outcome = cancelled ? Outcome::cancelled : Outcome::worse_than_input;
    report_.warnings.push_back(fmt::format(
        "no equilibrium was found that is no worse than the input ({}): this is {}; {}", fault,
        is_input_smoothed ? "the input without its noise"
        : best            ? "the fairest shape on the way"
        : input_is_better ? "the input with its constraints"
                          : "that shape, as the input with its constraints is no better",
        is_unwound ? "hold a node in each winding, or fit it to its own nodes with a tolerance to stay within"
                   : "hold more nodes or normals, let a smaller part move, or refine it"));
  }

  /// The input without its noise, where that is little, and the shape then is fairer than such an energy and no worse.
  bool smooth_a_little(const std::function<void()>& start_smooth, const ResultCheck& check, double energy) {
    Net& net = hierarchy_.net(hierarchy_.count() - 1);
    net.positions = input_;
    start_smooth();
    double greatest = 0;
    for (std::size_t i = 0; i < net.moving; ++i)
      greatest = std::max(greatest, (net.positions[i] - input_[i]).squaredNorm());
    const double edge = mean_edge(net);
    return greatest < edge * edge && fault(check).empty() && energy_of(net).sum < energy;
  }

  [[nodiscard]] bool out_of_work(const Net& net) const {
    return report_.most_work > 0 && report_.work + static_cast<double>(net.moving) > report_.most_work;
  }

  /// Corrections that take a surface for flat and even may lead nowhere where it has folds. The flow of the plain
  /// iteration, with all that it depends on, may lead somewhere: from the shape that was reached, from where some
  /// sweeps take the start, from a soap film, from the start itself or from where very many sweeps take it.
  void try_flow() {
    Net& net = hierarchy_.net(hierarchy_.count() - 1);
    const auto sweep_from_start = [&](std::size_t sweeps) {
      net.positions = input_;
      Sweep sweep(net, model_, team_);
      for (std::size_t k = 0; k < sweeps && !context_.cancelled(); ++k) {
        report_.work += work_of_sweep * static_cast<double>(net.moving);
        if (sweep.iterate() < still) break;
      }
    };
    const std::function<void()> starts[] = {[] {}, [&] { sweep_from_start(10); },
                                            [&] { hierarchy_.start_from_membrane(hierarchy_.count() - 1); },
                                            [&] { sweep_from_start(0); }, [&] { sweep_from_start(1000); }};
    const auto nodes = static_cast<double>(net.moving);
    const auto steps_left = [&] {
      return static_cast<int>((report_.most_work - report_.work) / (work_of_flow_step * nodes));
    };
    const int at_once = std::clamp(steps_left() / 3, fewest_steps, most_steps);
    for (const auto& go_to_start : starts) {
      if (steps_left() < at_once) break;
      if (follow_flow_from(go_to_start, at_once)) return;
    }
    // Steps of the flow from where sweeps end need as much again.
    const double sweeps =
        (report_.most_work - report_.work) / (work_of_sweep * nodes) - at_once * work_of_flow_step / work_of_sweep;
    if (sweeps > 0) (void)follow_flow_from([&] { sweep_from_start(static_cast<std::size_t>(sweeps)); }, at_once);
  }

  /// False, and what there was before, where that leads nowhere.
  bool follow_flow_from(const std::function<void()>& go_to_start, int steps) {
    const std::size_t last = hierarchy_.count() - 1;
    const Reached best = reached(last);
    go_to_start();
    relax_along_flow(steps, FlowStart::anywhere);
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
  bool has_crease(std::size_t level) {
    Net& net = hierarchy_.net(level);
    return net.moving <= few && net.tangents.empty() && report_.outcome != Outcome::cancelled &&
           energy_of(net).least_cosine < sharpest_turn;
  }

  [[nodiscard]] bool lost() const { return !(report_.residual < lost_at); }

  /// Lengths of the greatest displacements that the model asks for, and of those that its springs alone do.
  struct Displacements {
    double all = 0;
    double of_springs = 0;
  };

  Displacements greatest_displacements(Net& net) {
    model_.prepare(net);
    update_directions(net, model_, team_);
    const auto find = [&](std::size_t begin, std::size_t end, Displacements& greatest) {
      std::vector<NodeForce> forces(end - begin);
      model_.find_forces(net, {begin, end}, forces);
      for (const NodeForce& force : forces) {
        greatest.all = std::max(greatest.all, (force.spring + force.regularisation).norm());
        greatest.of_springs = std::max(greatest.of_springs, force.spring.norm());
      }
    };
    Displacements greatest;
    for (const Displacements& one : parallel_parts(team_, net.moving, nodes_per_task, Displacements(), find)) {
      greatest.all = std::max(greatest.all, one.all);
      greatest.of_springs = std::max(greatest.of_springs, one.of_springs);
    }
    return greatest;
  }

  /// False where displacements are so large that corrections cannot be within the tolerance: as displacements of an
  /// equilibrium that is off by one correction they are at most a few times as large.
  [[nodiscard]] bool may_have_converged(double displacement) const {
    return displacement <= greatest_displacement_ratio * options_.tolerance * size_;
  }

  [[nodiscard]] bool unfinished() const {
    return report_.outcome == Outcome::iteration_limit || report_.outcome == Outcome::stalled ||
           report_.outcome == Outcome::work_limit;
  }

  void relax(std::size_t level, int max_iterations) { relax(level, max_iterations, hierarchy_.preconditioner(level)); }

  void relax(std::size_t level, int max_iterations, Preconditioner& preconditioner) {
    relax(level, max_iterations, [&](const EquilibriumTask& task) {
      return go_to_equilibrium(hierarchy_.net(level), model_, preconditioner, task, team_, context_);
    });
  }

  /// The finest level.
  void relax_along_flow(int max_iterations, FlowStart start) {
    const std::size_t last = hierarchy_.count() - 1;
    relax(last, max_iterations, [&](const EquilibriumTask& task) {
      return follow_flow(hierarchy_.net(last), model_, task, start, team_, context_);
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
    if (net.spheres.on() && !options_.max_iterations) {
      task.most_while_far = sphere_limit;
      task.near = sphere_is_near * size_;
    }
    if (report_.most_work > 0) task.most_work = (report_.most_work - report_.work) / static_cast<double>(net.moving);
    if (points_) task.renew_ties = [&](double margin) { return points_->renew(margin); };
    if (level != last) task.most_changes = coarse_changes;
    task.memory = memory_;
    task.take_last = take_last_;
    task.on_iteration = [&](double expected) {
      report_.history.push_back(expected / size_);
      progress_.report("fairing", share / 2, static_cast<int>(report_.history.size()), expected / size_);
    };
    EquilibriumResult result = method(task);
    report_.work += result.work * static_cast<double>(net.moving);
    report_.iterations += result.iterations;
    const bool by_default = !options_.max_iterations && result.outcome == Outcome::iteration_limit;
    report_.levels.push_back({.moving_nodes = static_cast<Index>(net.moving),
                              .iterations = result.iterations,
                              .outcome = by_default ? Outcome::work_limit : result.outcome,
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
  std::vector<Vector3> input_;
  Anderson<float>* memory_ = nullptr;
  bool take_last_ = false;
  bool has_looked_for_winding_ = false;
  bool lost_winding_ = false;  ///< what fault() found last
};

}  // namespace

bool is_underconstrained(const Net& net) {
  constexpr std::size_t fixes_a_sphere = 4;
  std::size_t known = net.positions.size() - net.moving;
  for (std::size_t i = 0; i < net.positions.size() && known < fixes_a_sphere; ++i) known += net.normal_given(i) ? 2 : 0;
  return known < fixes_a_sphere;
}

void run_equilibrium(Hierarchy& hierarchy, const Model& model, const FairOptions& options, ThreadTeam& team,
                     Context& context, ProgressReporter& progress, FairReport& report, const ResultCheck* check,
                     PointLevels* points) {
  Run(hierarchy, model, options, team, context, progress, report, points).run(check);
}

void run_equilibrium_from_near(Hierarchy& hierarchy, Preconditioner& preconditioner, const Model& model,
                               const FairOptions& options, ThreadTeam& team, Context& context,
                               ProgressReporter& progress, FairReport& report, PointLevels* points,
                               Anderson<float>* memory, bool take_last) {
  Run(hierarchy, model, options, team, context, progress, report, points)
      .run_on_shape_itself(preconditioner, memory, take_last);
}

}  // namespace vspring
