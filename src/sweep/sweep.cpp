#include "sweep/sweep.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "spring/pseudo_normal.hpp"
#include "spring/v_spring.hpp"

namespace vspring {

namespace {

constexpr std::size_t nodes_per_task = 2048;

template <typename Normal>
void update_normals_of(Net& net, ThreadTeam& team) {
  parallel_ranges(team, net.computed, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (net.normal_fixed[i] == 0) net.normals[i] = Normal()(net.positions[i], net.rings.links(i), net.positions);
    }
  });
}

}  // namespace

void update_normals(Net& net, PseudoNormals kind, ThreadTeam& team) {
  switch (kind) {
    case PseudoNormals::link:
      return update_normals_of<LinkNormal>(net, team);
    case PseudoNormals::average:
      return update_normals_of<AverageNormal>(net, team);
    case PseudoNormals::area:
      return update_normals_of<AreaNormal>(net, team);
    case PseudoNormals::angle:
      return update_normals_of<AngleNormal>(net, team);
  }
}

std::vector<double> present_shares(const Net& net) {
  std::vector<double> shares(net.rings.link_count(), 0.0);
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    const Vector3 normal = net.normals[i];
    // Of all shares of sum 1 that leave the node in its place across the normal, those nearest to even ones: share_j =
    // 1/m − (d_j − mean)·a.
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    Vector3 mean = Vector3::Zero();
    double spokes = 0;
    const auto across = [&](Link link) -> Vector3 {
      const Vector3 d = net.positions[link.node()] - net.positions[i];
      return d - d.dot(normal) * normal;
    };
    for (const Link link : links) {
      if (!link.spoke()) continue;
      mean += across(link);
      spokes += 1;
    }
    mean /= std::max(spokes, 1.0);
    for (const Link link : links) {
      if (link.spoke()) spread += (across(link) - mean) * (across(link) - mean).transpose();
    }
    spread += spread.trace() * normal * normal.transpose();
    // Neighbours all on a line or at a point leave directions open; the smallest solution is meant, so they get none of
    // it.
    const Vector3 a = spread.completeOrthogonalDecomposition().solve(mean);
    for (std::size_t k = 0; k < links.size(); ++k) {
      if (links[k].spoke()) shares[net.rings.begin(i) + k] = 1 / spokes - (across(links[k]) - mean).dot(a);
    }
  }
  return shares;
}

Sweep::Sweep(Net& net, PseudoNormals pseudo_normals, Distribution distribution, ThreadTeam& team)
    : net_(&net), pseudo_normals_(pseudo_normals), team_(&team), groups_(parallel_order(net)) {
  std::size_t most = 0;
  for (const auto& group : groups_) most = std::max(most, group.size());
  greatest_.resize(most);
  if (distribution == Distribution::keep) {
    update_normals(net, pseudo_normals_, team);
    shares_ = present_shares(net);
  }
}

double Sweep::sweep_block(Block block) {
  double greatest = 0;
  for (std::size_t i = block.begin; i < block.end; ++i) {
    const auto links = net_->rings.links(i);
    const std::span<const double> shares =
        shares_.empty() ? std::span<const double>() : std::span(shares_).subspan(net_->rings.begin(i), links.size());
    const NodeForce force = node_force(i, links, net_->positions, net_->normals, shares, net_->tiny);
    const Vector3 displacement = force.spring + force.regularisation;
    net_->positions[i] += displacement;
    if (force.mean_edge > 0) greatest = std::max(greatest, displacement.norm() / force.mean_edge);
  }
  return greatest;
}

double Sweep::iterate() {
  update_normals(*net_, pseudo_normals_, *team_);
  double greatest = 0;
  for (const auto& group : groups_) {
    team_->run(group.size(), [&](std::size_t k) { greatest_[k] = sweep_block(group[k]); });
    greatest = std::max(
        greatest, *std::max_element(greatest_.begin(), greatest_.begin() + static_cast<std::ptrdiff_t>(group.size())));
  }
  return greatest;
}

}  // namespace vspring
