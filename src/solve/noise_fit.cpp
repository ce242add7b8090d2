#include "solve/noise_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "solve/account.hpp"
#include "solve/even_residuals.hpp"
#include "spring/bending_factor.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

// Turns with weights that follow what is left, and all turns.
constexpr int enough_turns = 3;
constexpr int most_turns = 24;
// Before them weights change alike, by this factor, as long as less of the true shape is expected to be missed.
constexpr double change_alike = 4;
// Of a node, in squared edges, a half more than on a lattice: weights that follow what is left follow noise, too.
constexpr double area_of_edges = 1.3;
// Of weights, where no equilibrium was found.
constexpr double stronger = 4;
// Of an edge, and of the greatest displacement there.
constexpr double unsettled = 0.02;
constexpr double most_displaced = 0.3;
// What may be done, in iterations of one moving node.
constexpr double least_work_allowed = 1.35e6;
constexpr double most_work_of_a_node = 450;

/// About that which takes such noise off: k = 0.006 (noise/edge)^−1.5, as measured on scans.
double first_length(const Net& net, double noise) {
  const double edge = mean_edge(net);
  const double weight = std::clamp(0.006 * std::pow(noise / edge, -1.5), 1e-3, 10.0);
  return edge * std::pow(bending_factor(net) / (16 * weight), 0.25);
}

/// How far off the true shape a fit is expected to be, in mean squares and but for a constant: what is left, and twice
/// the noise that the shape follows (C. M. Stein, "Estimation of the mean of a multivariate normal distribution", Ann.
/// Stat. 9, 1981). Of waves of all directions 1/(1 + (λω)⁴) lets by 1/(8 λ²) an area.
double expected_risk(const Net& net, double residual, double noise) {
  const double kappa = bending_factor(net);
  double followed = 0;
  double count = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    for (const std::uint32_t k : net.points.of(i)) {
      const double weight = net.points.weights[k] * net.points.factor(i);
      followed += std::min(1.0, area_of_edges / 8 * std::sqrt(16 * weight / kappa));
      count += 1;
    }
  }
  return residual * residual + 2 * noise * noise * followed / std::max(count, 1.0);
}

/// Has those nodes that are displaced most, and their neighbours, go back to these places.
void keep(Net& net, const std::vector<Vector3>& places, const std::vector<double>& displacements) {
  const double greatest = *std::max_element(displacements.begin(), displacements.end());
  const double share = std::min(unsettled, most_displaced * greatest);
  std::vector<std::uint8_t> kept(net.moving, 0);
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    kept[i] = displacements[i] > share || std::any_of(links.begin(), links.end(), [&](Link link) {
                return link.node() < net.moving && displacements[link.node()] > share;
              });
  }
  for (std::size_t i = 0; i < net.moving; ++i) {
    if (kept[i] == 0) continue;
    for (const std::uint32_t k : net.points.of(i)) {
      net.points.positions[k] = places[i];
      net.points.weights[k] *= stronger;
    }
  }
}

}  // namespace

void fit_without_noise(FitRun<FitSurface>& run, LoosePoints points, ProgressReporter& progress) {
  if (!points.are_nodes)
    throw Error(ErrorCode::invalid_argument,
                "noise can be taken off a surface whose own nodes are the points and keep their places only");
  const FairOptions& options = run.options.fair;
  FairReport& report = run.result.report.fair;
  Net gathered = run.gather_start();
  const double noise = *run.options.noise * gathered.frame.scale();
  const auto length = std::make_shared<double>(first_length(gathered, noise));
  points.by_edges = true;
  PulledShape shape(std::move(gathered), options, std::move(points), length, run.team);
  Net& net = shape.net();
  if (!options.max_iterations)
    report.most_work = std::max(least_work_allowed, most_work_of_a_node * static_cast<double>(net.moving));
  const auto ended = [&] {
    return run.context.cancelled() || (options.max_iterations && report.iterations >= *options.max_iterations) ||
           (report.most_work > 0 && report.work >= report.most_work);
  };
  const std::vector<Vector3> start = net.positions;
  // The last equilibrium, and what was known there.
  std::optional<std::vector<Vector3>> best;
  FairReport of_best;
  // Weights first change alike, by a factor as long as that is better.
  bool alike = true;
  double factor = 1 / change_alike;
  double least_risk = std::numeric_limits<double>::infinity();
  std::vector<Vector3> best_alike;
  int better = 0;
  int turns_of_weights = 0;
  for (int turn = 0; turn < most_turns && !ended(); ++turn) {
    FairReport one;
    shape.follow(run.context, progress, one, false);
    report.iterations += one.iterations;
    report.work += one.work;
    report.history.insert(report.history.end(), one.history.begin(), one.history.end());
    const bool found = one.outcome == Outcome::converged;
    if (found) best = net.positions;
    if (found || !best) of_best = std::move(one);
    if (ended()) break;
    if (alike && best) {
      const double risk =
          found ? expected_risk(net, shape.rms_residual(), noise) : std::numeric_limits<double>::infinity();
      if (risk < least_risk) {
        least_risk = risk;
        best_alike = *best;
        ++better;
      } else {
        best = best_alike;
        net.positions = best_alike;
        for (double& weight : net.points.weights) weight /= factor;
        alike = better == 1 && factor < 1;
        factor = 1 / factor;
      }
      if (alike) {
        for (double& weight : net.points.weights) weight *= factor;
      } else {
        shape.even_out(noise);
      }
    } else if (!found) {
      keep(net, start, shape.displacements());
      net.positions = best ? *best : start;
    } else {
      if (turns_of_weights++ == enough_turns) break;
      shape.even_out(noise);
    }
  }
  const bool found_none = !best && !run.context.cancelled();
  if (best) net.positions = *best;
  // The filter alone may be far from what was given.
  if (found_none) net.positions = run.subject.gather().positions;
  run.finish(net);
  report.residual = of_best.residual;
  if (!found_none) report.expected_error = of_best.expected_error;
  report.outcome = run.context.cancelled()  ? Outcome::cancelled
                   : best                   ? Outcome::converged
                   : options.max_iterations ? Outcome::iteration_limit
                                            : Outcome::work_limit;
  if (report.outcome == Outcome::work_limit)
    report.warnings.emplace_back(
        "no equilibrium was found: this is the input with its constraints; the noise may be larger than edges are "
        "long, or "
        "faces may be folded without it");
}

}  // namespace vspring
