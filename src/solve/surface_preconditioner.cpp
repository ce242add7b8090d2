#include "solve/surface_preconditioner.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <atomic>

#include "base/definite3.hpp"
#include "solve/bending_form.hpp"

namespace vspring {

namespace {

constexpr std::size_t nodes_per_task = 2048;
// See Accuracy; the iteration around the solvers does the rest.
constexpr double bending_share = 0.15;
constexpr double spreading_share = 1;
// Of the weights 1/ℓ.
constexpr float greatest_change = 1.15F;
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
  const double fall = 0.5 * step.dot(turn * solve_definite(spread, step));
  const double most = steepest * step.norm();
  return std::clamp(fall, -most, most);
}

}  // namespace

SurfacePreconditioner::SurfacePreconditioner(const SystemLevels& levels, LinearSolver& spreading, ThreadTeam& team)
    : net_(levels.net), team_(&team), factor_(bending_factor(*net_)), bending_(levels, team), spreading_(&spreading) {}

bool SurfacePreconditioner::refresh() {
  weigh_edges(*net_, *team_, weight_);
  std::atomic<bool> fits = !built_weight_.empty();
  if (fits) {
    parallel_ranges(*team_, net_->moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const float change = weight_[i] / built_weight_[i];
        if (!(change < greatest_change && change * greatest_change > 1)) fits = false;
      }
    });
  }
  if (fits) return false;
  built_weight_ = weight_;
  bending_.build();
  return true;
}

void SurfacePreconditioner::correct(const Model& model, double enough, std::vector<Vector3>& correction) {
  const Net& net = *net_;
  along_.resize(net.moving);
  correction.resize(net.moving);
  const auto in_parallel = [&](const auto& body) {
    parallel_ranges(*team_, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) body(i);
    });
  };
  parallel_ranges(*team_, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    std::vector<NodeForce> forces(end - begin);
    model.find_forces(net, {begin, end}, forces);
    for (std::size_t i = begin; i < end; ++i) {
      const NodeForce& force = forces[i - begin];
      along_[i] = static_cast<double>(weight_[i]) / factor_ * force.spring.dot(net.normals[i]);
      correction[i] = force.regularisation;
    }
  });
  bending_.solve(along_, {.enough = enough, .share = bending_share});
  in_parallel([&](std::size_t i) { correction[i] = asked_across(i, correction[i]); });
  spreading_->solve(correction, {.enough = enough, .share = spreading_share});
  in_parallel([&](std::size_t i) {
    const Vector3& normal = net.normals[i];
    const Vector3 along_surface = correction[i] - correction[i].dot(normal) * normal;
    correction[i] = (along_[i] - sagitta(net, i, along_surface)) * normal + along_surface;
  });
}

Vector3 SurfacePreconditioner::asked_across(std::size_t i, const Vector3& regularisation) const {
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
  const Vector3 asked = regularisation + mean - along_[i] * normal;
  return spokes * (asked - asked.dot(normal) * normal);
}

}  // namespace vspring
