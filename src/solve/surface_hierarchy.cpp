#include "solve/surface_hierarchy.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <span>
#include <utility>

#include "solve/bending_form.hpp"
#include "solve/cholesky_solver.hpp"
#include "solve/surface_preconditioner.hpp"

namespace vspring {

namespace {

// Passes of means over the few nodes of the coarsest level, until they lie as on a soap film.
constexpr int film_passes = 500;
// How far shares go from even ones to those that put nodes in their places.
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
void spread(Net& net, ThreadTeam& team) {
  const auto size = static_cast<Eigen::Index>(net.moving);
  Eigen::MatrixXd places = Eigen::MatrixXd::Zero(size, 3);
  for (std::size_t i = 0; i < net.moving; ++i) {
    for (const Link link : net.rings.links(i)) {
      if (link.spoke() && link.node() >= net.moving)
        places.row(static_cast<Eigen::Index>(i)) += net.positions[link.node()].transpose();
    }
  }
  CholeskySolver solver(team);
  solver.factorise(spreading_form(net));
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

}  // namespace

std::unique_ptr<Preconditioner> SurfaceHierarchy::preconditioner(std::size_t level) {
  return std::make_unique<SurfacePreconditioner>(levels_[level].net, *team_);
}

void SurfaceHierarchy::limit(std::size_t levels) {
  if (levels < levels_.size()) levels_.erase(levels_.begin(), levels_.end() - static_cast<std::ptrdiff_t>(levels));
}

void SurfaceHierarchy::even_out() {
  if (levels_.size() < 2 || !levels_.back().net.shares.empty()) return;
  Net film = levels_.back().net;
  spread(film, *team_);
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

}  // namespace vspring
