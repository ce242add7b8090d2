#include "solve/surface_hierarchy.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <span>
#include <utility>

#include "solve/bending_form.hpp"
#include "solve/cholesky_solver.hpp"
#include "solve/interpolation.hpp"
#include "solve/surface_preconditioner.hpp"

namespace vspring {

namespace {

// Passes of means over the few nodes of the coarsest level, until they lie as on a soap film.
constexpr int film_passes = 500;
// How far shares go from even ones to those that put nodes in their places.
constexpr double film_reduction = 1e-4;
constexpr double faith = 0.5;
// Between these, half angles have tangents as on meshes that are fit for use.
constexpr double least_tangent = 0.05;
constexpr double greatest_tangent = 20;

/// The mean of a node's neighbours.
Vector3 mean_place(const Net& net, std::size_t i) {
  Vector3 mean = Vector3::Zero();
  double spokes = 0;
  for (const Link link : net.rings.links(i)) {
    if (!link.spoke()) continue;
    mean += net.positions[link.node()];
    spokes += 1;
  }
  return spokes > 0 ? Vector3(mean / spokes) : net.positions[i];
}

/// Moves all nodes to the mean of their neighbours at once: onto a soap film between the held ones.
void spread(Net& net, std::span<const Interpolation> interpolations, ThreadTeam& team) {
  const auto size = static_cast<Eigen::Index>(net.moving);
  Eigen::MatrixXd places = Eigen::MatrixXd::Zero(size, 3);
  for (std::size_t i = 0; i < net.moving; ++i) {
    for (const Link link : net.rings.links(i)) {
      if (link.spoke() && link.node() >= net.moving)
        places.row(static_cast<Eigen::Index>(i)) += net.positions[link.node()].transpose();
    }
  }
  CholeskySolver factor(team);
  MultigridSolver cycles(interpolations, film_reduction, team);
  LinearSolver& solver = interpolations.empty() ? static_cast<LinearSolver&>(factor) : cycles;
  solver.build(spreading_form(net, team));
  solver.solve(places);
  for (std::size_t i = 0; i < net.moving; ++i) net.positions[i] = places.row(static_cast<Eigen::Index>(i)).transpose();
}

/// Shares of the links, all of them spokes: half way between even ones, which keep faces from turning over, and mean
/// value coordinates, which put every node of a flat shape in its place (M. Floater, "Mean value coordinates", Computer
/// Aided Geometric Design 20, 2003). Positive, of sum 1.
std::vector<double> mean_value_shares(const Net& net, const std::vector<Vector3>& positions) {
  std::vector<double> shares(net.rings.link_count(), 0);
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    const std::span<double> of_node(shares.data() + net.rings.begin(i), links.size());
    const auto edge = [&](std::size_t k) -> Vector3 { return positions[links[k].node()] - positions[i]; };
    for (std::size_t k = 0; k < links.size(); ++k) {
      const std::size_t next = (k + 1) % links.size();
      if (links[next].start()) continue;
      const Vector3 a = edge(k);
      const Vector3 b = edge(next);
      const double lengths = a.norm() * b.norm();
      // tan(angle / 2)
      const double tangent = a.cross(b).norm() / std::max(lengths + a.dot(b), 1e-3 * lengths + 1e-300);
      of_node[k] += tangent;
      of_node[next] += tangent;
    }
    double sum = 0;
    for (std::size_t k = 0; k < links.size(); ++k) {
      of_node[k] = std::clamp(of_node[k], least_tangent, greatest_tangent) / std::max(edge(k).norm(), 1e-9);
      sum += of_node[k];
    }
    const double even = (1 - faith) / static_cast<double>(links.size());
    for (double& share : of_node) share = faith * share / sum + even;
  }
  return shares;
}

std::size_t few_enough_to_factor() {
  static const std::size_t n = getenv("FEW") ? atoi(getenv("FEW")) : 5000;
  return n;
}

}  // namespace

std::unique_ptr<Preconditioner> SurfaceHierarchy::preconditioner(std::size_t level) {
  interpolations_ = interpolations(level);
  return std::make_unique<SurfacePreconditioner>(levels_[level].net, interpolations_, *team_);
}

std::vector<Interpolation> SurfaceHierarchy::interpolations(std::size_t level) {
  std::vector<Interpolation> result;
  std::vector<Vector3> positions = levels_[level].net.positions;
  for (std::size_t k = level; k > 0 && levels_[k].net.moving > few_enough_to_factor(); --k) {
    const SurfaceLevel& coarse = levels_[k - 1];
    result.push_back(interpolation(levels_[k].net, positions, coarse.net, coarse.finer, *team_));
    std::vector<Vector3> kept;
    kept.reserve(coarse.finer.size());
    for (const std::uint32_t i : coarse.finer) kept.push_back(positions[i]);
    positions = std::move(kept);
  }
  return result;
}

void SurfaceHierarchy::even_out() {
  Net film = levels_.back().net;
  spread(film, interpolations(levels_.size() - 1), *team_);
  std::vector<Vector3> positions = std::move(film.positions);
  for (std::size_t k = levels_.size() - 1; k-- > 0;) {
    std::vector<Vector3> coarse;
    coarse.reserve(levels_[k].finer.size());
    for (const std::uint32_t i : levels_[k].finer) coarse.push_back(positions[i]);
    positions = std::move(coarse);
    levels_[k].net.shares = mean_value_shares(levels_[k].net, positions);
  }
}

void SurfaceHierarchy::start() {
  if (levels_.size() > 1 && levels_.back().net.shares.empty()) even_out();
  for (std::size_t k = levels_.size(); k-- > 1;) {
    const Net& fine = levels_[k].net;
    SurfaceLevel& coarse = levels_[k - 1];
    for (std::size_t i = 0; i < coarse.net.moving; ++i) {
      const std::size_t at = coarse.finer[i];
      coarse.net.positions[i] = 0.5 * (fine.positions[at] + mean_place(fine, at));
    }
  }
}

void SurfaceHierarchy::forget_shape() {
  Net& net = levels_.front().net;
  for (int pass = 0; pass < film_passes; ++pass) {
    for (std::size_t i = 0; i < net.moving; ++i) net.positions[i] = mean_place(net, i);
  }
}

void SurfaceHierarchy::prolong(std::size_t level) { vspring::prolong(levels_[level], levels_[level + 1], *team_); }

}  // namespace vspring
