#include "fit/noise_fit.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "scan/denoise.hpp"
#include "scan/scan_mesh.hpp"
#include "spring/net.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

// Of the size of the shape, which is about 1: what is less is none, and more leaves nothing but the smoothest shape.
constexpr double least_deviation = 1e-12;
constexpr double most_deviation = 1e6;

/// Has a shape without noise keep the normals that are given: a fit to it that smooths no more than an edge. Nodes keep
/// their places where there is no equilibrium.
void keep_normals(FitRun<FitSurface>& run, const Net& found, UntiedPoints points, ProgressReporter& progress) {
  FairReport& report = run.result.report.fair;
  const std::vector<Vector3> places =
      scatter_positions(found, run.subject.shape().positions(), run.subject.constraints(), 1);
  points.positions = places;
  points.by_edges = true;
  Net net = found;
  net.target_positions.assign(net.positions.begin(), net.positions.begin() + static_cast<std::ptrdiff_t>(net.moving));
  const auto length = std::make_shared<double>(mean_edge(net));
  WarmStartedFit shape(std::move(net), run.options.fair, std::move(points), length, run.team);
  shape.find(run.context, progress, report);
  run.finish(report.outcome == Outcome::converged ? shape.net() : found);
}

/// Before any outliers are known: takes those for unknown that are furthest from the mean of their neighbours, twice as
/// many as there may be. Else the shape would be drawn to them, as to features.
void suspect(const Net& net, double share, std::vector<std::uint8_t>& known) {
  std::vector<double> off(net.moving);
  for (std::size_t i = 0; i < net.moving; ++i) off[i] = (net.positions[i] - mean_of_neighbours(net, i)).norm();
  const auto count = static_cast<std::size_t>(std::min(1.0, 2 * share) * static_cast<double>(net.moving));
  if (count == 0) return;
  std::vector<double> sorted = off;
  std::nth_element(sorted.begin(), sorted.end() - static_cast<std::ptrdiff_t>(count), sorted.end());
  const double least = sorted[net.moving - count];
  for (std::size_t i = 0; i < net.moving; ++i) {
    if (off[i] >= least) known[i] = 0;
  }
}

}  // namespace

void fit_without_noise(FitRun<FitSurface>& run, UntiedPoints points, ProgressReporter& progress) {
  if (!points.are_nodes)
    throw Error(ErrorCode::invalid_argument,
                "noise can be taken off a surface whose own nodes are the points and keep their places only");
  FairReport& report = run.result.report.fair;
  Net net = run.gather();
  std::vector<std::uint8_t> known(net.moving);
  for (std::size_t i = 0; i < net.moving; ++i)
    known[i] = points.weights[static_cast<std::size_t>(net.node[i])] > 0 ? 1 : 0;
  const bool knows_outliers = std::count(known.begin(), known.end(), 0) > 0;
  if (run.options.outliers > 0 && !knows_outliers) suspect(net, run.options.outliers, known);
  progress.report("taking noise off", 0);
  const double deviation = std::clamp(*run.options.noise * net.frame.scale(), least_deviation, most_deviation);
  net.positions = without_noise(
      scan_mesh(net, run.subject.shape()), net.positions, known, deviation, [&] { return run.context.cancelled(); },
      run.team);
  const bool has_normals =
      std::any_of(net.given.begin(), net.given.end(), [](std::uint8_t given) { return given != 0; });
  if (has_normals && !run.context.cancelled()) {
    keep_normals(run, net, std::move(points), progress);
    return;
  }
  run.finish(net);
  run.result.report.pulled_nodes = run.result.report.pulling_points =
      static_cast<Index>(std::count(known.begin(), known.end(), 1));
  run.result.report.most_points = run.result.report.pulled_nodes > 0 ? 1 : 0;
  report.outcome = run.context.cancelled() ? Outcome::cancelled : Outcome::converged;
}

}  // namespace vspring
