#include "equilibrium/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/stopwatch.hpp"
#include "equilibrium/account.hpp"
#include "equilibrium/bending_descent.hpp"
#include "equilibrium/newton.hpp"
#include "spring/curve_force.hpp"
#include "spring/v_spring.hpp"
#include "start/smooth_start.hpp"

namespace vspring {

namespace {

// Iterations of the finest level with sphere springs; edge springs are tried next. Of 67 random shapes all with such an
// equilibrium reached it within 18. Only shapes whose expected error is below a share of the diagonal go on.
constexpr int sphere_limit = 30;
constexpr double sphere_is_near = 1e-4;
// An expected error, as a share of the diagonal, from which a shape on the coarsest level is no use.
constexpr double lost_at = 1e-3;
// What a coarse level does not do has to be done on finer ones, with more nodes.
constexpr double coarse_share = 0.3;
constexpr int coarse_changes = 2;
// Number of moving nodes up to which a second start costs hardly anything.
constexpr std::size_t few = 2000;
// The cosine of 60°.
constexpr double sharpest_turn = 0.5;
// Limit of work where no number of iterations is given, in iterations of one moving node: some two seconds for 3,000
// nodes on one core.
constexpr double most_work = 1.35e6;
constexpr double most_work_a_node = 450;

/// Needs directions. Cost: linear.
SpringEnergy spring_energy(const Net& net) {
  SpringEnergy energy;
  if (net.is_curve) {
    for_each_curve_spring(net, [&](const Vector3& spring, const Vector3& d) {
      energy.sum += spring.squaredNorm() / (d.squaredNorm() + net.tiny);
    });
    return energy;
  }
  for (std::size_t i = 0; i < net.computed; ++i) {
    for (const Link link : net.rings.links(i)) {
      const std::size_t j = link.node();
      if (!link.spoke() || j < i || (i >= net.moving && j >= net.computed)) continue;
      const Vector3 d = net.positions[j] - net.positions[i];
      const double difference = steady_difference(d, net.normals[i], net.normals[j]);
      energy.sum += difference * difference / (d.squaredNorm() + net.tiny);
      if (i >= net.moving || net.normals[i].isZero(0) || net.normals[j].isZero(0)) continue;
      const double cosine = net.normals[i].dot(net.normals[j]);
      // The sense of a given normal means nothing.
      const bool given = net.normal_given(i) || net.normal_given(j);
      energy.least_cosine = std::min(energy.least_cosine, given ? std::abs(cosine) : cosine);
    }
  }
  return energy;
}

}  // namespace

Relaxation::Relaxation(Hierarchy& hierarchy, const Model& model, const EquilibriumMethod& method,
                       const SolverCall& call, PointLevels* points)
    : hierarchy_(hierarchy),
      model_(model),
      points_(points),
      call_(call),
      method_(method),
      // So that shares of it are defined for a shape without extent, too.
      size_(std::max(diagonal(shape()), std::numeric_limits<double>::min())) {
  if (!method.max_iterations)
    call.report.most_work = std::max(most_work, most_work_a_node * static_cast<double>(shape().moving));
}

void Relaxation::relax(std::size_t level, int max_iterations, Preconditioner& preconditioner) {
  relax(level, max_iterations, [&](const EquilibriumTask& task) {
    return go_to_equilibrium(hierarchy_.net(level), model_, preconditioner, task, call_.team, call_.context);
  });
}

void Relaxation::bend_less(int max_iterations, std::span<const Vector3> home, double smoothing_length) {
  relax(last(), max_iterations, [&](EquilibriumTask task) {
    task.home = home;
    task.smoothing_length = smoothing_length * size_;
    return descend_bending(shape(), model_, task, call_.team, call_.context);
  });
}

void Relaxation::relax_by_newton(int max_iterations) {
  relax(last(), max_iterations,
        [&](const EquilibriumTask& task) { return go_by_newton(shape(), model_, task, call_.team, call_.context); });
}

void Relaxation::smooth_near(const std::vector<Vector3>& home, double smoothing_length) {
  relax(last(), 1, [&](const EquilibriumTask& task) {
    const bool is_found = vspring::smooth_near(shape(), home, smoothing_length * size_);
    const double expected = is_found ? 0 : size_;
    if (task.on_iteration) task.on_iteration(expected);
    return EquilibriumResult{.outcome = is_found ? Outcome::converged : Outcome::stalled,
                             .iterations = 1,
                             .work = 1,
                             .expected_error = expected};
  });
}

void Relaxation::relax(std::size_t level, int max_iterations,
                       const std::function<EquilibriumResult(const EquilibriumTask&)>& method) {
  const Stopwatch stopwatch;
  FairReport& report = call_.report;
  const bool has_limit = method_.max_iterations.has_value();
  const Net& net = hierarchy_.net(level);
  const auto nodes = static_cast<double>(net.moving);
  const double share = nodes / static_cast<double>(shape().moving);
  EquilibriumTask task;
  task.tolerance = method_.tolerance * size_ * (level == last() ? 1 : coarse_share);
  task.max_iterations = max_iterations;
  if (net.spheres.on() && !has_limit) {
    task.most_while_far = sphere_limit;
    task.near = sphere_is_near * size_;
  }
  if (report.most_work > 0) task.most_work = (report.most_work - report.work) / nodes;
  if (points_) task.renew_ties = [&](double margin) { return points_->renew(margin); };
  if (level != last()) task.most_changes = coarse_changes;
  task.memory = memory_;
  task.take_last = take_last_;
  task.on_iteration = [&](double expected) {
    report.history.push_back(expected / size_);
    call_.progress.report("fairing", share / 2, static_cast<int>(report.history.size()), expected / size_);
  };
  const EquilibriumResult result = method(task);
  report.work += result.work * nodes;
  report.iterations += result.iterations;
  const bool by_default = !has_limit && result.outcome == Outcome::iteration_limit;
  report.levels.push_back({.moving_nodes = static_cast<Index>(net.moving),
                           .iterations = result.iterations,
                           .outcome = by_default ? Outcome::work_limit : result.outcome,
                           .strategy = strategy_,
                           .seconds = stopwatch.seconds(),
                           .kept_nodes = static_cast<Index>(result.kept)});
  report.outcome = result.outcome;
  report.residual = result.expected_error / size_;
  report.expected_error = report.residual;
}

void Relaxation::go_back(std::size_t level, const Reached& reached) {
  hierarchy_.net(level).positions = reached.positions;
  tie_points(level);
  call_.report.outcome = reached.outcome;
  call_.report.residual = reached.residual;
  call_.report.expected_error = reached.residual;
}

SpringEnergy Relaxation::energy_of(Net& net) {
  update_directions(net, model_, call_.team);
  return spring_energy(net);
}

bool Relaxation::has_crease(std::size_t level) {
  Net& net = hierarchy_.net(level);
  return net.moving <= few && !net.is_curve && call_.report.outcome != Outcome::cancelled &&
         energy_of(net).least_cosine < sharpest_turn;
}

bool Relaxation::lost() const { return !(call_.report.residual < lost_at); }

bool Relaxation::unfinished() const {
  const Outcome outcome = call_.report.outcome;
  return outcome == Outcome::iteration_limit || outcome == Outcome::stalled || outcome == Outcome::work_limit;
}

bool Relaxation::out_of_work(const Net& net) const {
  return call_.report.most_work > 0 && call_.report.work + static_cast<double>(net.moving) > call_.report.most_work;
}

}  // namespace vspring
