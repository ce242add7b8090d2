#include "fit/noise_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "fit/fit_points.hpp"
#include "scan/denoise.hpp"
#include "scan/scan_mesh.hpp"
#include "spring/net.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

// Of the size of the shape, which is about 1: what is less is none, and more leaves nothing but the smoothest shape.
constexpr double least_deviation = 1e-12;
constexpr double most_deviation = 1e6;
// Of a root mean square distance that is asked for: nearer to their nodes than that shapes ask for more smoothing than
// filters of noise do.
constexpr double least_rms_taken = 0.7;
// What is aimed at on the way back to the nodes.
constexpr double aimed_rms = 0.999;
constexpr int most_turns_back = 5;

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

/// What filters are given of a surface.
class NoisyNodes {
 public:
  NoisyNodes(FitRun<FitSurface>& run, const UntiedPoints& points)
      : run_(run), net_(run.gather()), mesh_(scan_mesh(net_, run.subject.shape())), known_(net_.moving) {
    for (std::size_t i = 0; i < net_.moving; ++i)
      known_[i] = points.weights[static_cast<std::size_t>(net_.node[i])] > 0 ? 1 : 0;
    const bool knows_outliers = std::count(known_.begin(), known_.end(), 0) > 0;
    if (run.options.outliers > 0 && !knows_outliers) suspect(net_, run.options.outliers, known_);
  }

  [[nodiscard]] const Net& net() const { return net_; }
  [[nodiscard]] bool has_normals() const {
    return std::any_of(net_.given.begin(), net_.given.end(), [](std::uint8_t given) { return given != 0; });
  }

  /// noise: in the units of the input.
  [[nodiscard]] Net without(double noise) const {
    Net result = net_;
    const double deviation = std::clamp(noise * net_.frame.scale(), least_deviation, most_deviation);
    result.positions = without_noise(
        mesh_, net_.positions, known_, deviation, [&] { return run_.context.cancelled(); }, run_.team);
    return result;
  }

  /// Makes a shape the result.
  void finish(const Net& found) {
    run_.finish(found);
    FitReport& report = run_.result.report;
    report.pulled_nodes = report.pulling_points = static_cast<Index>(std::count(known_.begin(), known_.end(), 1));
    report.most_points = report.pulled_nodes > 0 ? 1 : 0;
    report.fair.outcome = run_.context.cancelled() ? Outcome::cancelled : Outcome::converged;
  }

 private:
  FitRun<FitSurface>& run_;
  Net net_;
  ScanMesh mesh_;
  std::vector<std::uint8_t> known_;
};

}  // namespace

void fit_without_noise(FitRun<FitSurface>& run, UntiedPoints points, ProgressReporter& progress) {
  if (!points.are_nodes)
    throw Error(ErrorCode::invalid_argument,
                "noise can be taken off a surface whose own nodes are the points and keep their places only");
  progress.report("taking noise off", 0);
  NoisyNodes noisy(run, points);
  const Net found = noisy.without(*run.options.noise);
  if (noisy.has_normals() && !run.context.cancelled())
    keep_normals(run, found, std::move(points), progress);
  else
    noisy.finish(found);
}

bool fit_to_rms_by_filters(FitRun<FitSurface>& run, const UntiedPoints& points, ProgressReporter& progress) {
  if (!points.are_nodes) return false;
  progress.report("taking noise off", 0);
  NoisyNodes noisy(run, points);
  if (noisy.has_normals()) return false;
  const double tolerance = *run.options.rms;
  Net found = noisy.without(tolerance);
  const auto distance = [&] {
    run.finish_positions(found);
    return summary(run.distances(), run.kept).all.rms;
  };
  double now = run.context.cancelled() ? tolerance : distance();
  if (now < least_rms_taken * tolerance) return false;
  const std::vector<Vector3>& nodes = noisy.net().positions;
  for (int turn = 0; turn < most_turns_back && now > tolerance; ++turn) {
    for (std::size_t i = 0; i < found.moving; ++i)
      found.positions[i] = nodes[i] + aimed_rms * tolerance / now * (found.positions[i] - nodes[i]);
    now = distance();
  }
  if (now > tolerance) return false;
  noisy.finish(found);
  return true;
}

}  // namespace vspring
