#include "solve/surface_preconditioner.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "solve/bending_form.hpp"

namespace vspring {

namespace {

constexpr std::size_t nodes_per_task = 2048;
// Of the weights 1/ℓ.
constexpr double greatest_change = 1.15;
// Of how far a surface may be taken to fall away, as a share of the step.
constexpr double steepest = 0.5;

/// How far the surface, curved as the normals around node i tell, falls away from the tangent plane over a step.
double sagitta(const Net& net, std::size_t i, const Vector3& step) {
  const Vector3& normal = net.normals[i];
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
  for (const Link link : net.rings.links(i)) {
    if (!link.spoke()) continue;
    const Vector3 d = net.positions[link.node()] - net.positions[i];
    const Vector3 u = d - d.dot(normal) * normal;
    const Vector3& other = net.normals[link.node()];
    if (other.isZero(0)) continue;
    const Vector3 difference = (other.dot(normal) < 0 ? Vector3(-other) : other) - normal;
    spread += u * u.transpose();
    turn += difference * u.transpose();
  }
  const double size = spread.trace();
  if (!(size > 0)) return 0;
  spread += size * normal * normal.transpose() + 1e-3 * size * Eigen::Matrix3d::Identity();
  const double fall = 0.5 * step.dot(turn * spread.ldlt().solve(step));
  const double most = steepest * step.norm();
  return std::clamp(fall, -most, most);
}

}  // namespace

SurfacePreconditioner::SurfacePreconditioner(const SystemLevels& levels, LinearSolver& spreading, ThreadTeam& team)
    : net_(levels.nets.front()),
      team_(&team),
      factor_(bending_factor(*net_)),
      bending_(levels, team),
      spreading_(&spreading) {}

bool SurfacePreconditioner::refresh() {
  weigh_edges(*net_, *team_, weight_);
  bool fits = !built_weight_.empty();
  for (std::size_t i = 0; i < weight_.size() && fits; ++i) {
    const double change = weight_[i] / built_weight_[i];
    fits = change < greatest_change && change * greatest_change > 1;
  }
  if (fits) return false;
  built_weight_ = weight_;
  bending_.build();
  return true;
}

void SurfacePreconditioner::correct(std::span<const NodeForce> forces, double enough,
                                    std::vector<Vector3>& correction) {
  const Net& net = *net_;
  const auto in_parallel = [&](const auto& body) {
    parallel_ranges(*team_, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) body(i);
    });
  };
  along_.resize(net.moving);
  correction.resize(net.moving);
  in_parallel([&](std::size_t i) { along_[i] = weight_[i] / factor_ * forces[i].spring.dot(net.normals[i]); });
  bending_.solve(along_, enough);
  in_parallel([&](std::size_t i) { correction[i] = asked_across(i, forces[i]); });
  spreading_->solve(correction, enough);
  in_parallel([&](std::size_t i) {
    const Vector3& normal = net.normals[i];
    const Vector3 along_surface = correction[i] - correction[i].dot(normal) * normal;
    // A node without a normal is not sprung, and goes where the regularisation sends it.
    correction[i] = normal.isZero(0) ? forces[i].regularisation
                                     : Vector3((along_[i] - sagitta(net, i, along_surface)) * normal + along_surface);
  });
}

Vector3 SurfacePreconditioner::asked_across(std::size_t i, const NodeForce& force) const {
  const auto links = net_->rings.links(i);
  const auto shares = net_->shares_of(i);
  double spokes = 0;
  Vector3 mean = Vector3::Zero();
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (!links[k].spoke()) continue;
    spokes += 1;
    const std::size_t j = links[k].node();
    if (j < net_->moving) mean += (shares.empty() ? 1 : shares[k]) * along_[j] * net_->normals[j];
  }
  if (shares.empty() && spokes > 0) mean /= spokes;
  const Vector3& normal = net_->normals[i];
  const Vector3 asked = force.regularisation + mean - along_[i] * normal;
  return spokes * (asked - asked.dot(normal) * normal);
}

}  // namespace vspring
