#include "equilibrium/equilibrium_method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/cancellation.hpp"
#include "equilibrium/relaxation.hpp"
#include "spring/sliding.hpp"
#include "spring/spacing.hpp"
#include "sweep/sweep.hpp"

namespace vspring {

namespace {

constexpr int default_limit = 200;
// Iterations from a shape that is near: if it takes more, a start on coarser levels is faster.
constexpr int near_limit = 30;
// The coarsest level needs 10 to 40 iterations from any shape that is not tangled up.
constexpr int first_try = 80;
// Number of moving nodes up to which a second start helps where coarser levels found nothing.
constexpr std::size_t not_too_many = 100'000;
constexpr double greatest_displacement_ratio = 4;

/// Places of the moving nodes in single precision, enough for a start.
std::vector<Eigen::Vector3f> rounded(const Net& net, std::span<const Vector3> places) {
  std::vector<Eigen::Vector3f> result(net.moving);
  for (std::size_t i = 0; i < net.moving; ++i) result[i] = places[i].cast<float>();
  return result;
}

/// Finds the equilibrium of a shape: from the shape itself if it may be near, else from coarse levels.
class EquilibriumSearch : private Relaxation {
 public:
  EquilibriumSearch(Hierarchy& hierarchy, const Model& model, const SearchTask& task, const SolverCall& call,
                    PointLevels* points)
      : Relaxation(hierarchy, model, task.method, call, points), task_(task), team_(call.team), report_(call.report) {}

  void run() {
    report_.outcome = call_.context.cancelled() ? Outcome::cancelled : Outcome::iteration_limit;
    if (call_.context.cancelled() || task_.method.max_iterations == 0) return;
    // Directions are those of the start from here on.
    const double displacement = greatest_displacement(shape());
    try {
      if (starts_near() || may_have_converged(displacement)) stay_in_place();
      if (report_.outcome == Outcome::iteration_limit) go_down();
    } catch (const Cancelled&) {
      report_.outcome = Outcome::cancelled;
    }
    if (report_.outcome == Outcome::cancelled) hand_up_roughly();
    // Limits where none are given.
    if (!task_.method.max_iterations && report_.outcome == Outcome::iteration_limit)
      report_.outcome = Outcome::work_limit;
  }

 private:
  /// Coarser levels do not keep a distribution, and with points the start is near.
  [[nodiscard]] bool starts_near() const { return points_ && task_.distribution == Distribution::keep; }

  /// The shape itself, which may be at its equilibrium already.
  void stay_in_place() {
    set_strategy("in place");
    if (!starts_near()) return relax(last(), 1);
    const std::vector<Vector3> start = shape().positions;
    relax(last(), std::min(task_.method.max_iterations.value_or(near_limit), near_limit));
    if (!unfinished()) return;
    shape().positions = start;
    report_.outcome = Outcome::iteration_limit;
  }

  /// Coarse levels first, each to its equilibrium, each the start of the next finer one.
  void go_down() {
    set_strategy("coarse to fine");
    const int limit = task_.method.max_iterations.value_or(default_limit);
    // If noise has folded the finest level, its own start does not help.
    const bool is_folded = !shape().laplacian_weights.empty() && has_crease(last());
    hierarchy_.start();
    std::vector<Eigen::Vector3f> own_start;
    const std::size_t first = hierarchy_.first_of_use();
    for (std::size_t k = first; k <= last(); ++k) {
      level_ = k;
      tie_points(k);
      relax_on_way(k, k == first ? std::min(limit, first_try) : limit);
      if (k == first && limit > first_try && unfinished()) {
        // Points know better, and may be all that holds it.
        if (lost() && !points_) hierarchy_.start_from_membrane(k);
        tie_points(k);
        relax(k, limit);
      }
      if (!own_start.empty() && ((unfinished() && lost()) || has_crease(k))) try_own_start(k, own_start, limit);
      if (k == last() || report_.outcome == Outcome::cancelled) break;
      if (points_ && unfinished() && lost()) {
        // Points are too far away for this level: finer ones do better from the start itself.
        level_.reset();
        tie_points(last());
        relax(last(), limit);
        break;
      }
      own_start = std::vector<Eigen::Vector3f>();
      const Net& finer = hierarchy_.net(k + 1);
      if (finer.moving <= not_too_many)
        own_start = rounded(finer, k + 1 == last() && is_folded ? rest_positions(finer, team_) : finer.positions);
      update_directions(hierarchy_.net(k), model_, team_);
      hierarchy_.prolong_from(k);
      // With points, it may be needed again with other ties.
      if (!points_) hierarchy_.forget(k);
    }
    if (report_.outcome != Outcome::cancelled) level_.reset();
  }

  /// The result so far when the run is cancelled, on the shape itself.
  void hand_up_roughly() {
    if (!level_) return;
    const UncancelledScope whole;
    for (std::size_t k = *level_; k < last(); ++k) {
      update_directions(hierarchy_.net(k), model_, team_);
      hierarchy_.prolong_roughly_from(k);
    }
  }

  /// On a coarser level, which only gives a start, sphere springs need not reach an equilibrium.
  void relax_on_way(std::size_t level, int limit) {
    const bool is_on_way = level != last() && hierarchy_.net(level).spheres.on();
    relax(level, is_on_way ? std::min(limit, near_limit) : limit);
  }

  /// A level that is too coarse has no equilibrium, or another one, and its shape does not help: then the start itself
  /// may. The better of both stays.
  void try_own_start(std::size_t level, std::span<const Eigen::Vector3f> start, int limit) {
    Net& net = hierarchy_.net(level);
    const Reached before = reached(level);
    const bool was_unfinished = unfinished();
    const double energy = energy_of(net).sum;
    for (std::size_t i = 0; i < net.moving; ++i) net.positions[i] = start[i].cast<double>();
    put_on_supports(net, net.positions);
    tie_points(level);
    relax(level, limit);
    if (report_.outcome == Outcome::cancelled) return;
    const bool better = was_unfinished || unfinished()
                            ? !unfinished() || (was_unfinished && report_.residual < before.residual)
                            : energy_of(net).sum < energy;
    if (!better) go_back(level, before);
  }

  /// The length of the greatest displacement of the model.
  double greatest_displacement(Net& net) {
    model_.prepare(net);
    update_directions(net, model_, team_);
    const auto find = [&](std::size_t begin, std::size_t end, double& greatest) {
      std::vector<NodeForce> forces(end - begin);
      model_.find_forces(net, {begin, end}, forces);
      for (const NodeForce& force : forces) greatest = std::max(greatest, (force.spring + force.regularisation).norm());
    };
    double greatest = 0;
    for (const double one : parallel_parts(team_, net.moving, nodes_per_task, 0.0, find))
      greatest = std::max(greatest, one);
    return greatest;
  }

  /// False where displacements are so large that corrections exceed the tolerance: displacements are at most a few
  /// times as large as corrections.
  [[nodiscard]] bool may_have_converged(double displacement) const {
    return displacement <= greatest_displacement_ratio * task_.method.tolerance * size();
  }

  const SearchTask& task_;
  ThreadTeam& team_;
  FairReport& report_;
  std::optional<std::size_t> level_;  ///< while coarser levels are iterated, the one to which the shape was handed up
};

}  // namespace

bool is_underconstrained(const Net& net) {
  constexpr std::size_t fixes_a_sphere = 4;
  std::size_t known = net.positions.size() - net.moving;
  for (std::size_t i = 0; i < net.positions.size() && known < fixes_a_sphere; ++i) known += net.normal_given(i) ? 2 : 0;
  return known < fixes_a_sphere;
}

void run_equilibrium(Hierarchy& hierarchy, const Model& model, const SearchTask& task, const SolverCall& call,
                     PointLevels* points) {
  EquilibriumSearch(hierarchy, model, task, call, points).run();
}

void run_equilibrium_from_near(Hierarchy& hierarchy, Preconditioner& preconditioner, const Model& model,
                               const EquilibriumMethod& method, const SolverCall& call, PointLevels* points,
                               Anderson<float>* memory, bool take_last) {
  Relaxation relaxation(hierarchy, model, method, call, points);
  relaxation.remember(memory, take_last);
  relaxation.set_strategy("from the last shape");
  relaxation.relax(hierarchy.count() - 1, std::min(method.max_iterations.value_or(near_limit), near_limit),
                   preconditioner);
}

}  // namespace vspring
