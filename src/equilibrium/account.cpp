#include "equilibrium/account.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "constraints/sides.hpp"

namespace vspring {

double diagonal(const Net& net) {
  Eigen::AlignedBox<double, 3> box;
  for (const Vector3& position : net.positions) box.extend(position);
  return box.isEmpty() ? 1 : box.diagonal().norm();
}

std::string distance_from_equilibrium(const FairReport& report) {
  if (!(report.expected_error.value_or(1) < 1)) return "far from one";
  return fmt::format("expected to be {:.2g} % of the size away from one", 100 * *report.expected_error);
}

std::string words_of_kept(const FairReport& report) {
  const Index kept = report.levels.empty() ? 0 : report.levels.back().kept_nodes;
  return kept > 0 ? fmt::format("; {} nodes stay where they were, as faces would turn over there", kept) : "";
}

void count_nodes(std::size_t moving, const Constraints& constraints, FairReport& report) {
  report.nodes = constraints.node_count();
  report.moving_nodes = static_cast<Index>(moving);
  report.fixed_positions = report.fixed_normals = report.fixed_tangents = 0;
  report.sliding_nodes = constraints.sliding_count();
  for (Index i = 0; i < constraints.node_count(); ++i) {
    report.fixed_positions += constraints.position_fixed(i) ? 1 : 0;
    report.fixed_normals += constraints.normal_fixed(i) ? 1 : 0;
    report.fixed_tangents += tangents_given(constraints, i);
  }
}

void count_nodes(std::span<const std::uint8_t> usable, const Constraints& constraints, FairReport& report) {
  std::size_t moving = 0;
  for (Index i = 0; i < constraints.node_count(); ++i)
    moving += constraints.position_fixed(i) ? 0U : usable[static_cast<std::size_t>(i)];
  count_nodes(moving, constraints, report);
}

void measure_moves(const Net& net, const std::vector<Vector3>& before, const std::vector<Vector3>& after,
                   FairReport& report) {
  double squares = 0;
  double greatest = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto node = static_cast<std::size_t>(net.node[i]);
    const double square = ((after[node] - before[node]) * net.frame.scale()).squaredNorm();
    squares += square;
    greatest = std::max(greatest, square);
  }
  report.greatest_move = std::sqrt(greatest) / net.frame.scale();
  if (net.moving > 0) report.rms_move = std::sqrt(squares / static_cast<double>(net.moving)) / net.frame.scale();
}

}  // namespace vspring
