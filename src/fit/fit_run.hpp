#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "equilibrium/account.hpp"
#include "fit/counting_points.hpp"
#include "fit/fit_start.hpp"
#include "fit/fit_subject.hpp"
#include "fit/unfolding.hpp"
#include "fit/warm_started_fit.hpp"
#include "start/curve_noise.hpp"
#include "vspring/fit.hpp"

namespace vspring {

/// Whether another shape may stand for one that was not found.
inline bool may_be_another(const FitOptions& options) {
  const auto* const method = std::get_if<EquilibriumMethod>(&options.fair.method);
  return method && method->fallbacks && !method->max_iterations && !options.fair.accept_worse;
}

/// What all parts of a fit share. Subject: FitSurface or FitCurve.
template <typename Subject>
class FitRun {
 public:
  using Shape = typename Subject::Shape;

  FitRun(const Shape& shape, const Constraints& constraints, const ScatteredPoints& scattered,
         const FitOptions& fit_options, Context& outer)
      : points(scattered),
        options(fit_options),
        context(outer),
        team(outer.thread_count()),
        subject(shape, constraints, scattered.positions, measuring, team),
        counted(scattered.positions.size(), 1) {
    // Distances are measured also after a cancellation.
    measuring.threads = outer.threads;
    if (points_are_nodes()) counted = subject.usable();
    kept = counted;
  }

  /// The result of a fit that begins.
  void start(Method method) {
    result = {};
    FairReport& fair = result.report.fair;
    fair.method = method;
    fair.threads = team.size();
    fair.faces = subject.faces();
    result.report.points = static_cast<Index>(std::count(counted.begin(), counted.end(), 1));
  }

  Net gather() {
    Net net = subject.gather();
    count_nodes(net.moving, subject.constraints(), result.report.fair);
    return net;
  }

  /// With the places that nodes keep.
  Net gather_start() {
    Net net = gather();
    if (options.fair.distribution != Distribution::keep) return net;
    if constexpr (std::is_same_v<Subject, FitCurve>)
      smooth_noise(net);
    else
      unfold(net, subject.shape(), context, team);
    // Without it nodes slide along a surface that noise has crumpled, and it degenerates.
    net.target_positions.assign(net.positions.begin(), net.positions.begin() + static_cast<std::ptrdiff_t>(net.moving));
    return net;
  }

  /// The points that count, and the nodes that are nearest to them at the start.
  UntiedPoints untied_points() {
    std::vector<double> weights = points.weights;
    weights.resize(points.positions.size(), 1);
    const double weight = options.weight().value_or(1);
    for (std::size_t j = 0; j < weights.size(); ++j) weights[j] *= kept[j] * weight;
    if (start_.nearest.empty()) find_start();
    if (start_.sense < 0)
      result.report.fair.warnings.push_back(
          {WarningCode::normals_reversed, "normals of points are opposite to the faces: all of them are reversed"});
    if (start_.sense == 0)
      result.report.fair.warnings.push_back({WarningCode::normals_ignored,
                                             "normals of points are opposite to the faces in some places and not in "
                                             "others, and tell no side: all of them "
                                             "are ignored"});
    const bool are_nodes = points_are_nodes();
    if (are_nodes) std::iota(start_.nearest.begin(), start_.nearest.end(), 0);
    return {points.positions, std::move(weights), start_.nearest, start_.normals, are_nodes};
  }

  /// One entry for every point that is kept, or each of these: 1 where it counts at that distance from the shape.
  std::vector<std::uint8_t> counting(std::span<const double> distances) { return counting(distances, kept); }
  std::vector<std::uint8_t> counting(std::span<const double> distances, const std::vector<std::uint8_t>& of) {
    if (!counting_) counting_.emplace(subject.distances_from_held(), subject.distances_before());
    return counting_->at(distances, of);
  }

  /// Of the points from the result.
  std::vector<double> distances() { return subject.distances(result.positions); }

  /// Of all nodes.
  [[nodiscard]] std::vector<Vector3> positions_of(const Net& net) const {
    return scatter_positions(net, subject.shape().positions(), subject.constraints(), options.fair.strength);
  }

  void finish(const Net& net) {
    count_points(net);
    result.positions = positions_of(net);
    measure_moves(net, subject.shape().positions(), result.positions, result.report.fair);
  }

  /// Makes the input with its constraints the result.
  void finish_unchanged() {
    result.positions = positions_as_held(subject.shape().positions(), subject.constraints());
    // Those of a shape that is given up.
    result.report.fair.greatest_move = result.report.fair.rms_move = 0;
    count_nodes(subject.usable(), subject.constraints(), result.report.fair);
  }

  /// Whether it is that, and no shape that was found.
  [[nodiscard]] bool is_unchanged() const {
    return result.positions == positions_as_held(subject.shape().positions(), subject.constraints());
  }

  /// Whether the points are the nodes of a surface which keep their places.
  [[nodiscard]] bool points_are_nodes() const {
    return std::is_same_v<Subject, FitSurface> && options.fair.distribution == Distribution::keep &&
           points.positions == subject.shape().positions();
  }

  [[nodiscard]] bool may_be_another() const { return vspring::may_be_another(options); }

  const ScatteredPoints& points;
  const FitOptions& options;
  Context& context;
  Context measuring;
  ThreadTeam team;
  Subject subject;
  FitResult result;
  /// Of every point, 0 for nodes of a surface without a face.
  std::vector<std::uint8_t> counted;
  std::vector<std::uint8_t> kept;  ///< of every point, 0 for those left out too

 private:
  void find_start() {
    const Constraints& constraints = subject.constraints();
    std::vector<Vector3> places = subject.shape().positions();
    std::vector<std::uint8_t> usable = subject.usable();
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto node = static_cast<Index>(i);
      if (constraints.position_fixed(node)) places[i] = constraints.position(node);
      if (!places[i].allFinite()) usable[i] = 0;
    }
    start_ = fit_start(points, places, usable, points.normals.empty() ? SurfaceSides() : subject.sides(), team);
  }

  void count_points(const Net& net) {
    FitReport& report = result.report;
    report.pulling_points = report.pulled_nodes = 0;
    for (std::size_t i = 0; i < net.moving && !net.points.empty(); ++i) {
      const auto count = static_cast<Index>(net.points.of(i).size());
      report.pulling_points += count;
      report.pulled_nodes += count > 0 ? 1 : 0;
      report.most_points = std::max(report.most_points, count);
    }
  }

  FitStart start_;
  std::optional<CountingPoints> counting_;  ///< from the first time on that it is asked for
};

}  // namespace vspring
