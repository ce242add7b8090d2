#include "fit/measure_again.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "fit/counting_points.hpp"
#include "fit/fit_points.hpp"
#include "fit/fit_subject.hpp"
#include "fit/fit_warnings.hpp"
#include "spring/net.hpp"
#include "vspring/distance.hpp"

namespace vspring {

namespace {

// Distances of a cut surface and of the whole are measured in frames of their own.
constexpr double as_good_as_within = 1 + 1e-9;

/// Measures the distances of the points again. counted: 1 for those of a face. start, held: the surface and its
/// constraints; points nearest to held places do not count.
void measure_points(const PolygonMesh& mesh, const Constraints& constraints, const PolygonMesh& start,
                    const Constraints& held, std::span<const Vector3> points, const std::vector<std::uint8_t>& counted,
                    const FitOptions& options, const Context& measuring, FitResult& found) {
  ThreadTeam team(measuring.thread_count());
  FitSurface surface(mesh, constraints, points, measuring, team);
  std::optional<FitSurface> at_start;
  if (&held != &constraints) at_start.emplace(start, held, points, measuring, team);
  FitSurface& beside = at_start ? *at_start : surface;
  const CountingPoints points_count(beside.distances_from_held(), beside.distances_before());
  FitReport& report = found.report;
  FairReport& fair = report.fair;
  const std::vector<double> before = surface.distances(positions_as_held(mesh.positions(), constraints));
  report.before = summary(before, points_count.at(before, counted));
  std::vector<std::uint8_t> kept = counted;
  for (const Index point : report.outlying_points) kept[static_cast<std::size_t>(point)] = 0;
  found.distances = surface.distances(found.positions);
  const std::vector<std::uint8_t> counting = points_count.at(found.distances, kept);
  report.after = summary(found.distances, counting);
  const auto tolerance = options.tolerance();
  std::erase_if(fair.warnings, [](const Warning& one) { return one.code == WarningCode::points_at_held; });
  tell_points_at_held(kept, counting, tolerance, found,
                      at_start ? "what is held or a boundary that was fitted first" : "what is held");
  if (!tolerance) return;
  report.outside_points = count_beyond(found.distances, counting, *tolerance);
  if (options.within()) report.active_points = active_points(found.distances, counting, *tolerance);
  const Distance& all = report.after.all;
  if (fair.outcome != Outcome::converged ||
      (options.within() ? all.greatest : all.rms) <= as_good_as_within * *tolerance)
    return;
  fair.outcome = Outcome::stalled;
  fair.warnings.push_back(
      {WarningCode::outside_tolerance,
       fmt::format("points beside lines of the surface that were fitted first are further away than {:g}, up to {:.4g} "
                   "(point {}): allow more, or hold less",
                   *tolerance, all.greatest, all.node)});
}

}  // namespace

void measure_again(const PolygonMesh& mesh, const Constraints& constraints, const FitOptions& options, FitResult& found,
                   int threads) {
  if (found.distances.empty()) return;
  Context measuring;
  measuring.threads = threads;
  std::vector<std::uint8_t> in_faces(found.positions.size(), 0);
  for (const Index node : mesh.corners()) in_faces[static_cast<std::size_t>(node)] = 1;
  FitReport& report = found.report;
  measure_points(mesh, constraints, mesh, constraints, mesh.positions(), in_faces, options, measuring, found);
  PolygonMesh moved = mesh;
  moved.set_positions(found.positions);
  report.shape = distance(moved, mesh, measuring);
  double squares = 0;
  report.fair.greatest_move = 0;
  for (std::size_t i = 0; i < in_faces.size(); ++i) {
    if (constraints.position_fixed(static_cast<Index>(i))) continue;
    const double move = (found.positions[i] - mesh.positions()[i]).norm();
    report.fair.greatest_move = std::max(report.fair.greatest_move, move);
    squares += move * move;
  }
  report.fair.rms_move = std::sqrt(squares / std::max<double>(1, report.fair.moving_nodes));
}

void measure_again(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                   const FitOptions& options, FitResult& found, int threads) {
  measure_again_at_boundary(mesh, constraints, mesh, constraints, points, options, found, threads);
}

void measure_again_at_boundary(const PolygonMesh& mesh, const Constraints& constraints, const PolygonMesh& start,
                               const Constraints& held, const ScatteredPoints& points, const FitOptions& options,
                               FitResult& found, int threads) {
  if (found.distances.empty()) return;
  Context measuring;
  measuring.threads = threads;
  const std::vector<std::uint8_t> all(points.positions.size(), 1);
  measure_points(mesh, constraints, start, held, points.positions, all, options, measuring, found);
}

}  // namespace vspring
