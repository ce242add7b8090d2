#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "solve/account.hpp"
#include "solve/even_residuals.hpp"
#include "solve/fit_run.hpp"
#include "spring/bending_factor.hpp"
#include "vspring/error.hpp"

namespace vspring {

/// A fit of a surface to its own nodes that takes FitOptions::noise off: in turns, to the equilibrium and with weights
/// that even_residuals() asks for there.
class NoiseFit {
 public:
  explicit NoiseFit(FitRun<FitSurface>& run) : run_(run) {}

  void fit(LoosePoints points, ProgressReporter& progress) {
    if (!points.are_nodes)
      throw Error(ErrorCode::invalid_argument,
                  "noise can be taken off a surface whose own nodes are the points and keep their places only");
    FairReport& report = run_.result.report.fair;
    Context& context = run_.context;
    Net gathered = run_.gather_start();
    const double noise = *run_.options.noise * gathered.frame.scale();
    const auto length = std::make_shared<double>(first_length(gathered, noise));
    points.by_edges = true;
    PulledShape shape(std::move(gathered), run_.options.fair, std::move(points), length, run_.team);
    Net& net = shape.net();
    if (!run_.options.fair.max_iterations)
      report.most_work = std::max(least_most_work, most_work_a_node * static_cast<double>(net.moving));
    // The last equilibrium, and what was known there.
    const std::vector<Vector3> start = net.positions;
    std::optional<std::vector<Vector3>> best;
    FairReport of_best;
    int evened = 0;
    for (int turn = 0; turn < most_turns; ++turn) {
      FairReport one;
      shape.follow(context, progress, one, false);
      report.iterations += one.iterations;
      report.work += one.work;
      report.history.insert(report.history.end(), one.history.begin(), one.history.end());
      const bool found = one.outcome == Outcome::converged;
      if (found) best = net.positions;
      if (found || !best) of_best = std::move(one);
      if (context.cancelled() || (report.most_work > 0 && report.work >= report.most_work)) break;
      const double excess = shape.rms_residual() / (left_of_noise * noise);
      if (!found) {
        keep(net, start, shape.displacements());
        net.positions = best ? *best : start;
      } else if (evened > 0 || std::abs(excess - 1) < near_enough || turn >= most_global) {
        if (evened++ == enough_turns) break;
        shape.even_out(noise);
      } else {
        const double change = std::clamp(std::pow(excess, 4), 1 / most_change, most_change);
        for (double& weight : net.points.weights) weight *= change;
      }
    }
    if (best) net.positions = *best;
    run_.finish(net);
    report.residual = of_best.residual;
    report.expected_error = of_best.expected_error;
    report.outcome = context.cancelled() ? Outcome::cancelled : best ? Outcome::converged : Outcome::work_limit;
    if (!best && !context.cancelled())
      report.warnings.emplace_back(
          "no equilibrium was found: this is the nearest shape; the noise may be larger than edges are long");
  }

 private:
  // Equilibria with weights that follow each other, and turns to find them.
  static constexpr int enough_turns = 4;
  static constexpr int most_turns = 20;
  static constexpr int most_global = 4;
  static constexpr double left_of_noise = 0.97;
  static constexpr double near_enough = 0.03;
  static constexpr double most_change = 16;
  static constexpr double stronger = 4;
  // Of an edge, where no equilibrium was found.
  static constexpr double unsettled = 0.02;
  static constexpr double most_displaced = 0.3;
  // What may be done, in iterations of one moving node.
  static constexpr double least_most_work = 1.2e6;
  static constexpr double most_work_a_node = 400;

  /// About that which takes such noise off a sphere, in edges: k = 0.006 (noise/edge)^−1.5, as measured on scans.
  static double first_length(const Net& net, double noise) {
    const double edge = mean_edge(net);
    const double weight = std::clamp(0.006 * std::pow(noise / edge, -1.5), 1e-3, 10.0);
    return edge * std::pow(bending_factor(net) / (16 * weight), 0.25);
  }

  /// Has those nodes that are displaced most, and their neighbours, go back to these places.
  static void keep(Net& net, const std::vector<Vector3>& places, const std::vector<double>& displacements) {
    const double greatest = *std::max_element(displacements.begin(), displacements.end());
    const double share = std::min(unsettled, most_displaced * greatest);
    std::vector<std::uint8_t> kept(net.moving, 0);
    for (std::size_t i = 0; i < net.moving; ++i) {
      for (const Link link : net.rings.links(i)) {
        if (link.node() < net.moving && displacements[link.node()] > share) kept[i] = 1;
      }
      if (displacements[i] > share) kept[i] = 1;
    }
    for (std::size_t i = 0; i < net.moving; ++i) {
      if (kept[i] == 0) continue;
      for (const std::uint32_t k : net.points.of(i)) {
        net.points.positions[k] = places[i];
        net.points.weights[k] *= stronger;
      }
    }
  }

  FitRun<FitSurface>& run_;
};

}  // namespace vspring
