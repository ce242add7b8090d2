#include "fit/measure_again.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "fit/fit_points.hpp"
#include "spring/net.hpp"
#include "vspring/distance.hpp"

namespace vspring {

void measure_again(const PolygonMesh& mesh, const Constraints& constraints, FitResult& found, int threads) {
  Context measuring;
  measuring.threads = threads;
  FitReport& report = found.report;
  PolygonMesh moved = mesh;
  moved.set_positions(found.positions);
  found.distances = point_distances(mesh.positions(), moved, measuring);
  std::vector<std::uint8_t> counted(found.positions.size(), 0);
  for (const Index node : mesh.corners())
    counted[static_cast<std::size_t>(node)] = constraints.position_fixed(node) ? 0 : 1;
  report.after = summary(found.distances, counted);
  report.shape = distance(found.positions, mesh, measuring);
  double squares = 0;
  report.fair.greatest_move = 0;
  for (std::size_t i = 0; i < counted.size(); ++i) {
    if (constraints.position_fixed(static_cast<Index>(i))) continue;
    const double move = (found.positions[i] - mesh.positions()[i]).norm();
    report.fair.greatest_move = std::max(report.fair.greatest_move, move);
    squares += move * move;
  }
  report.fair.rms_move = std::sqrt(squares / std::max<double>(1, report.fair.moving_nodes));
}

void measure_again(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                   const FitOptions& options, FitResult& found, int threads) {
  if (found.distances.empty()) return;
  Context measuring;
  measuring.threads = threads;
  const auto distances_at = [&](std::vector<Vector3> positions) {
    PolygonMesh shape = mesh;
    shape.set_positions(std::move(positions));
    return point_distances(points.positions, shape, measuring);
  };
  std::vector<std::uint8_t> counted(points.positions.size(), 1);
  FitReport& report = found.report;
  FairReport& fair = report.fair;
  report.before = summary(distances_at(positions_as_held(mesh.positions(), constraints)), counted);
  for (const Index point : report.outlying_points) counted[static_cast<std::size_t>(point)] = 0;
  found.distances = distances_at(found.positions);
  report.after = summary(found.distances, counted);
  report.at_held = {};
  std::erase_if(fair.warnings, [](const Warning& one) { return one.code == WarningCode::points_at_held; });
  if (!options.tolerance()) return;
  report.outside_points = 0;
  for (std::size_t j = 0; j < counted.size(); ++j)
    report.outside_points += counted[j] != 0 && found.distances[j] > *options.tolerance() ? 1 : 0;
  const Distance& all = report.after.all;
  if (fair.outcome != Outcome::converged || (options.within() ? all.greatest : all.rms) <= *options.tolerance()) return;
  fair.outcome = Outcome::stalled;
  fair.warnings.push_back(
      {WarningCode::outside_tolerance,
       fmt::format(
           "points beyond the boundary are further away than {:g}, up to {:.4g} (point {}): allow more, or hold "
           "less of the boundary",
           *options.tolerance(), all.greatest, all.node)});
}

}  // namespace vspring
