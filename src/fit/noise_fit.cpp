#include "fit/noise_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "base/cancellation.hpp"
#include "fit/fit_points.hpp"
#include "fit/fit_to_tolerance.hpp"
#include "noise/denoise.hpp"
#include "noise/scan_mesh.hpp"
#include "spring/net.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

// For a shape of size about 1: smaller noise counts as none, and larger noise leaves only the smoothest shape.
constexpr double least_deviation = 1e-12;
constexpr double most_deviation = 1e6;
// As a share of the wanted root mean square distance: shapes that stay nearer need more smoothing than filters of noise
// give.
constexpr double least_rms_taken = 0.7;
// The root mean square, as a share of the wanted one, that is aimed at on the way back to the nodes.
constexpr double aimed_rms = 0.999;
constexpr int most_turns_back = 5;

// Shares of a tolerance: the noise that it allows for, and the most that this may be estimated at; the least and the
// largest noise to which a tolerance fits. Where the estimate is larger, it often comes from the bending of a coarse
// shape.
constexpr double allowed_noise = 1.0 / 3;
constexpr double allowed_noise_at_most = 0.4;
constexpr double most_noise = 1.0 / 2;
constexpr double least_noise = 1.0 / 6;
// In median edges: noise that turns faces by less than some degrees hardly comes from a scan; then the tolerance is for
// a fairer shape.
constexpr double least_noise_in_edges = 0.01;
// Rings of neighbours that move along with a node that is taken back, turn by turn. In the last turn every node moves
// by itself to within the tolerance of its own place, so that all are.
constexpr int rings_taken_back[] = {3, 3, 3, 3, 3, 3, 1, 1, 1, 0};
// As a share of the tolerance.
constexpr double taken_back_to = 0.999;

/// Gives a shape without noise the given normals, by a fit to it that smooths no more than an edge. Nodes keep their
/// places where there is no equilibrium.
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

/// A surface as the filters take it.
class NoisyNodes {
 public:
  NoisyNodes(FitRun<FitSurface>& run, const UntiedPoints& points)
      : run_(run), net_(run.gather()), mesh_(scan_mesh(net_, run.subject.shape())), known_(net_.moving) {
    for (std::size_t i = 0; i < net_.moving; ++i)
      known_[i] = points.weights[static_cast<std::size_t>(net_.node[i])] > 0 ? 1 : 0;
  }

  [[nodiscard]] const Net& net() const { return net_; }
  [[nodiscard]] bool has_normals() const {
    return std::any_of(net_.given.begin(), net_.given.end(), [](std::uint8_t given) { return given != 0; });
  }

  /// noise: in the units of the input.
  [[nodiscard]] Net without(double noise) const {
    Net result = net_;
    const double deviation = std::clamp(noise * net_.frame.scale(), least_deviation, most_deviation);
    try {
      const CancellationScope cancellation(run_.context);
      result.positions = without_noise(
          mesh_, net_.positions, known_, deviation, [&] { return run_.context.cancelled(); }, run_.team);
    } catch (const Cancelled&) {
      // The input: a shape that is half filtered is neither that nor a result.
    }
    return result;
  }

  /// Takes nodes that have moved by more than the tolerance back to within it; nodes near them move along. Outliers
  /// stay. off: distances of all nodes of the input from the shape, as it is then, 0 for outliers. Returns those at the
  /// end. When cancelled, only a part of that is done. Cost of a turn: linear.
  std::vector<double> take_back(Net& found, double tolerance, const std::function<std::vector<double>()>& off) const {
    std::vector<double> now = off();
    for (const int rings : rings_taken_back) {
      if (*std::max_element(now.begin(), now.end()) <= tolerance) break;
      std::vector<Vector3> moves(net_.moving, Vector3::Zero());
      std::vector<double> weights(net_.moving, 0);
      std::vector<std::pair<std::size_t, Vector3>> beyond;
      for (std::size_t i = 0; i < net_.moving; ++i) {
        const auto node = static_cast<std::size_t>(net_.node[i]);
        const Vector3 way = net_.positions[i] - found.positions[i];
        const double distance = rings > 0 ? now[node] : way.norm() / net_.frame.scale();
        if (run_.kept[node] == 0 || distance <= tolerance) continue;
        beyond.emplace_back(i, (1 - taken_back_to * tolerance / distance) * way);
        for_each_around(i, rings, [&](std::size_t j, double weight) {
          moves[j] += weight * beyond.back().second;
          weights[j] += weight;
        });
      }
      for (std::size_t i = 0; i < net_.moving; ++i) moves[i] /= std::max(1.0, weights[i]);
      for (const auto& [i, move] : beyond) moves[i] = move;
      for (std::size_t i = 0; i < net_.moving; ++i) found.positions[i] += moves[i];
      now = off();
    }
    return now;
  }

  /// Makes a shape the result, be it on its way or not.
  void finish(const Net& found) const {
    run_.finish(found);
    FitReport& report = run_.result.report;
    report.pulled_nodes = report.pulling_points = static_cast<Index>(std::count(known_.begin(), known_.end(), 1));
    report.most_points = report.pulled_nodes > 0 ? 1 : 0;
    report.fair.outcome = run_.context.cancelled() ? Outcome::cancelled : Outcome::converged;
  }

 private:
  /// visit(node, weight): a node, and the moving ones of so many rings around it. The weight falls from 1 to near 0.
  template <typename Visit>
  void for_each_around(std::size_t node, int rings, const Visit& visit) const {
    std::vector<std::uint32_t> seen = {static_cast<std::uint32_t>(node)};
    std::size_t ring_begin = 0;
    for (int ring = 0;; ++ring) {
      const double share = static_cast<double>(ring) / (rings + 1);
      const std::size_t ring_end = seen.size();
      for (std::size_t k = ring_begin; k < ring_end; ++k) visit(seen[k], std::pow(1 - share * share, 2));
      if (ring == rings) return;
      for (std::size_t k = ring_begin; k < ring_end; ++k) {
        for (const std::uint32_t j : mesh_.moving_neighbours.of(seen[k])) {
          if (std::find(seen.begin(), seen.end(), j) == seen.end()) seen.push_back(j);
        }
      }
      ring_begin = ring_end;
    }
  }

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
  const Net found = noisy.without(*run.options.noise());
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
  const double tolerance = *run.options.rms();
  Net found = noisy.without(tolerance);
  const auto distance = [&] {
    const std::vector<double> all = run.subject.distances(run.positions_of(found));
    return summary(all, run.counting(all)).all.rms;
  };
  const auto go_back = [&] {
    double now = run.context.cancelled() ? tolerance : distance();
    if (now < least_rms_taken * tolerance) return false;
    const std::vector<Vector3>& nodes = noisy.net().positions;
    for (int turn = 0; turn < most_turns_back && now > tolerance; ++turn) {
      for (std::size_t i = 0; i < found.moving; ++i)
        found.positions[i] = nodes[i] + aimed_rms * tolerance / now * (found.positions[i] - nodes[i]);
      now = distance();
    }
    return now <= tolerance;
  };
  try {
    if (!go_back()) return false;
  } catch (const Cancelled&) {
    // What has come so far has its noise off.
  }
  noisy.finish(found);
  return true;
}

NoiseEstimate noise_of_moving_nodes(FitRun<FitSurface>& run) {
  std::vector<Index> moving;
  for (Index i = 0; i < run.subject.shape().node_count(); ++i) {
    if (!run.subject.constraints().position_fixed(i)) moving.push_back(i);
  }
  return estimate_noise(run.subject.shape(), moving, run.measuring);
}

bool fit_within_by_filters(FitRun<FitSurface>& run, const UntiedPoints& points, bool only_smooth,
                           ProgressReporter& progress) {
  const auto& method = std::get<EquilibriumMethod>(run.options.fair.method);
  if (!points.are_nodes || !method.fallbacks) return false;
  const double tolerance = *run.options.within();
  const NoiseEstimate estimate = noise_of_moving_nodes(run);
  const double noise = estimate.deviation;
  if (noise < least_noise * tolerance || noise > most_noise * tolerance || estimate.edges < least_noise_in_edges)
    return false;
  const NoisyNodes noisy(run, points);
  if (noisy.has_normals()) return false;
  if (!only_smooth && FitToTolerance(run).plain_fairing_is_within(run.options.fair, true)) return true;
  progress.report("taking noise off", 0);
  Net found = noisy.without(noise > allowed_noise_at_most * tolerance ? noise : allowed_noise * tolerance);
  const auto distances = [&] {
    std::vector<double> all = run.subject.distances(run.positions_of(found));
    const std::vector<std::uint8_t> counting = run.counting(all);
    for (std::size_t j = 0; j < all.size(); ++j) all[j] *= counting[j];
    return all;
  };
  std::vector<double> off;
  try {
    if (!only_smooth && !run.context.cancelled()) off = noisy.take_back(found, tolerance, distances);
  } catch (const Cancelled&) {
    // The shape so far is nearer to the nodes than the one without noise.
  }
  noisy.finish(found);
  if (only_smooth || run.context.cancelled()) return true;
  FitReport& report = run.result.report;
  const double left = *std::max_element(off.begin(), off.end());
  if (left <= tolerance) return true;
  report.fair.outcome = Outcome::stalled;
  report.fair.warnings.push_back(
      {WarningCode::outside_tolerance,
       fmt::format("held nodes keep other nodes {:g} away from where they were, further than {:g}", left, tolerance)});
  return true;
}

}  // namespace vspring
