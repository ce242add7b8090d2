#include "equilibrium/surface_spreading.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "equilibrium/edge_turns.hpp"
#include "levels/surface_slide.hpp"

namespace vspring {

namespace {

constexpr int most_passes = 6;
// In edges at a node: steps up to which no pass is made, and steps after which none follows, as about a quarter of them
// is left; on the coarser level the passes of the finer one do the rest. Distances along the surface that are left make
// the first corrections long, and long corrections bend the surface: to undo that takes longer than the passes.
constexpr double worth_a_pass = 0.05;
constexpr double last_pass = 0.15;
constexpr double last_pass_on_coarser = 1;
constexpr Accuracy one_cycle = {.share = 1};

template <typename Body>
void for_moving(const Net& net, ThreadTeam& team, const Body& body) {
  parallel_each(team, net.moving, nodes_per_task, body);
}

/// What the regularisation asks of node i of a net whose nodes are at `places`, times its neighbours: the residual of
/// the tangential Laplacian, not yet without what it has along the normal.
Vector3 pull_at(const Net& net, std::span<const Vector3> places, std::size_t i) {
  const auto links = net.rings.links(i);
  const auto shares = net.weights_of(i);
  Vector3 sum = Vector3::Zero();
  double spokes = 0;
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (!links[k].spoke()) continue;
    spokes += 1;
    const Vector3 d = places[links[k].node()] - places[i];
    sum += shares.empty() ? d : Vector3(shares[k] * d);
  }
  if (!shares.empty()) sum *= spokes;
  if (!net.target_positions.empty()) sum += spokes * (net.target_positions[i] - places[i]);
  return sum;
}

Vector3 across_normal(const Net& net, std::size_t i, const Vector3& vector) {
  return vector - vector.dot(net.normals[i]) * net.normals[i];
}

/// The greatest step, in edges at its node.
double greatest_in_edges(const Net& net, std::span<const Vector3> steps, ThreadTeam& team) {
  return greatest_over_nodes(net, team,
                             [&](std::size_t i) { return steps[i].norm() / (mean_edge(net, i) + net.tiny); });
}

}  // namespace

void spread_along(Net& net, LinearSolver& spreading, const TangentialRigidModes& rigid_modes, ThreadTeam& team) {
  std::vector<Vector3> steps(net.moving);
  for (int pass = 0; pass < most_passes; ++pass) {
    for_moving(net, team, [&](std::size_t i) {
      steps[i] = net.slides(i) ? Vector3::Zero() : across_normal(net, i, pull_at(net, net.positions, i));
    });
    rigid_modes.hold(steps);
    spreading.solve(steps, one_cycle);
    for_moving(net, team, [&](std::size_t i) { steps[i] = across_normal(net, i, steps[i]); });
    rigid_modes.hold(steps);
    const double greatest = greatest_in_edges(net, steps, team);
    if (!(greatest > worth_a_pass)) return;
    slide(net, steps, team);
    if (greatest < last_pass) return;
  }
}

bool spread_coarser(Net& coarse, const Net& fine, const Interpolation& between, LinearSolver& spreading,
                    ThreadTeam& team) {
  const std::vector<Vector3> began = coarse.positions;
  std::vector<Vector3> places = fine.positions;
  std::vector<Vector3> pulls(fine.moving);
  std::vector<Vector3> steps(coarse.moving);
  for (int pass = 0; pass < most_passes; ++pass) {
    for_moving(fine, team, [&](std::size_t i) { pulls[i] = pull_at(fine, places, i); });
    for_moving(coarse, team, [&](std::size_t i) {
      Vector3 sum = Vector3::Zero();
      for (const auto& entry : between.down.row(i)) sum += static_cast<double>(entry.value) * pulls[entry.column];
      steps[i] = coarse.slides(i) ? Vector3::Zero() : across_normal(coarse, i, sum);
    });
    if (!spreading.solve_coarser(steps)) return false;
    for_moving(coarse, team, [&](std::size_t i) {
      steps[i] = coarse.slides(i) ? Vector3::Zero() : across_normal(coarse, i, steps[i]);
    });
    const double greatest = greatest_in_edges(coarse, steps, team);
    if (!(greatest > worth_a_pass)) return pass > 0;
    slide(coarse, steps, team);
    if (greatest < last_pass_on_coarser) break;
    for_moving(fine, team, [&](std::size_t i) {
      Vector3 way = Vector3::Zero();
      for (const auto& entry : between.up.row(i))
        way += static_cast<double>(entry.value) * (coarse.positions[entry.column] - began[entry.column]);
      places[i] = fine.positions[i] + way;
    });
  }
  return true;
}

}  // namespace vspring
