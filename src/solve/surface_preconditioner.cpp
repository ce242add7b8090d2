#include "solve/surface_preconditioner.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "solve/bending_form.hpp"

namespace vspring {

namespace {

constexpr std::size_t nodes_per_task = 2048;
// Of the weights 1/ℓ.
constexpr double greatest_change = 1.15;
// What conjugate gradients leave of a residual; Anderson acceleration does the rest.
constexpr double bending_reduction = 0.05;
constexpr double spreading_reduction = 0.02;
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

SurfacePreconditioner::SurfacePreconditioner(const Net& net, std::span<const Interpolation> interpolations,
                                             ThreadTeam& team)
    : net_(&net),
      team_(&team),
      factor_(bending_factor(net)),
      bending_(linear_solver(interpolations, bending_reduction, team)),
      spreading_(linear_solver(interpolations, spreading_reduction, team)) {
  spreading_->build(spreading_form(net, team));
}

bool SurfacePreconditioner::refresh() {
  weigh_edges(*net_, *team_, weight_);
  bool fits = !built_weight_.empty();
  for (std::size_t i = 0; i < weight_.size() && fits; ++i) {
    const double change = weight_[i] / built_weight_[i];
    fits = change < greatest_change && change * greatest_change > 1;
  }
  if (fits) return false;
  built_weight_ = weight_;
  bending_->build(bending_form(*net_, *team_));
  return true;
}

void SurfacePreconditioner::correct(std::span<const NodeForce> forces, std::vector<Vector3>& correction) {
  const Net& net = *net_;
  const auto in_parallel = [&](const auto& body) {
    parallel_ranges(*team_, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) body(i, static_cast<Eigen::Index>(i));
    });
  };
  along_.resize(static_cast<Eigen::Index>(net.moving), 1);
  across_.resize(static_cast<Eigen::Index>(net.moving), 3);
  correction.resize(net.moving);
  in_parallel([&](std::size_t i, Eigen::Index row) {
    along_(row, 0) = weight_[i] / factor_ * forces[i].spring.dot(net.normals[i]);
  });
  bending_->solve(along_);
  in_parallel([&](std::size_t i, Eigen::Index row) { correction[i] = along_(row, 0) * net.normals[i]; });
  in_parallel(
      [&](std::size_t i, Eigen::Index row) { across_.row(row) = asked_across(i, forces[i], correction).transpose(); });
  spreading_->solve(across_);
  in_parallel([&](std::size_t i, Eigen::Index row) {
    const Vector3& normal = net.normals[i];
    const Vector3 step = across_.row(row).transpose();
    const Vector3 along_surface = step - step.dot(normal) * normal;
    // A node without a normal is not sprung, and goes where the regularisation sends it.
    correction[i] +=
        normal.isZero(0) ? forces[i].regularisation : Vector3(along_surface - sagitta(net, i, along_surface) * normal);
  });
}

Vector3 SurfacePreconditioner::asked_across(std::size_t i, const NodeForce& force,
                                            const std::vector<Vector3>& correction) const {
  const auto links = net_->rings.links(i);
  const auto shares = net_->shares_of(i);
  double spokes = 0;
  Vector3 mean = Vector3::Zero();
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (!links[k].spoke()) continue;
    spokes += 1;
    if (links[k].node() < net_->moving) mean += (shares.empty() ? 1 : shares[k]) * correction[links[k].node()];
  }
  if (shares.empty() && spokes > 0) mean /= spokes;
  const Vector3 asked = force.regularisation + mean - correction[i];
  const Vector3& normal = net_->normals[i];
  return spokes * (asked - asked.dot(normal) * normal);
}

}  // namespace vspring
