#include "precondition/surface_preconditioner.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <atomic>

#include "precondition/bending_operator.hpp"
#include "spring/bending_factor.hpp"
#include "spring/sliding.hpp"
#include "spring/surface_force.hpp"

namespace vspring {

namespace {

// See Accuracy; the outer iteration does the rest.
constexpr double bending_share = 0.15;
constexpr double spreading_share = 1;
constexpr double following_share = 0.01;
// A ratio of weights 1/ℓ.
constexpr float greatest_change_of_shape = 1.15F;
// Limits the stiffness of points relative to that of springs, for single precision; nodes reach their points anyway.
constexpr double stiffest = 1e8;
// Limits the force on a node, in the net's coordinates; steps are limited anyway.
constexpr double greatest_asked = 1e12;
// How far a surface may fall away over a step, as a share of the step.
constexpr double steepest = 0.5;

/// How far the surface falls away from the tangent plane over a step, by its curvature in the normals around node i.
double sagitta(const Net& net, std::size_t i, const Vector3& step) {
  const double length = step.norm();
  if (!(length > 0)) return 0;
  const Vector3& normal = net.normals[i];
  const Vector3 ahead = step / length;
  const Vector3 aside = normal.cross(ahead);
  // Least squares: how much the normal leans ahead per length.
  double spread_ahead = 0;
  double spread_aside = 0;
  double spread_both = 0;
  double lean_ahead = 0;
  double lean_aside = 0;
  for (const Link link : net.rings.links(i)) {
    if (!link.spoke()) continue;
    const Vector3 d = net.positions[link.node()] - net.positions[i];
    const Vector3& other = net.normals[link.node()];
    const double a = d.dot(ahead);
    const double b = d.dot(aside);
    const double lean = other.dot(normal) < 0 ? -other.dot(ahead) : other.dot(ahead);
    spread_ahead += a * a;
    spread_aside += b * b;
    spread_both += a * b;
    lean_ahead += lean * a;
    lean_aside += lean * b;
  }
  const double ridge = 1e-3 * (spread_ahead + spread_aside);
  spread_ahead += ridge;
  spread_aside += ridge;
  const double determinant = spread_ahead * spread_aside - spread_both * spread_both;
  if (!(determinant > 0)) return 0;
  const double curvature = (lean_ahead * spread_aside - lean_aside * spread_both) / determinant;
  return std::clamp(0.5 * curvature * length * length, -steepest * length, steepest * length);
}

}  // namespace

SurfacePreconditioner::SurfacePreconditioner(const SystemLevels& levels, LinearSolver& spreading,
                                             const TangentialRigidModes& rigid_modes, ThreadTeam& team)
    : net_(levels.net),
      team_(&team),
      factor_(bending_factor(*net_)),
      bending_(levels, team),
      spreading_(&spreading),
      rigid_modes_(&rigid_modes) {
  const auto has_two_ways = [](const auto& support) { return support != nullptr && !support->is_curve(); };
  if (std::any_of(net_->supports.begin(), net_->supports.end(), has_two_ways))
    spreading_with_sliding_ = spreading_solver(levels, team, !rigid_modes.needed(), SlidingNodes::move);
}

bool SurfacePreconditioner::refresh(const Model& model) {
  sum_edge_weights(*net_, *team_, weight_);
  std::atomic<bool> fits = !built_weight_.empty();
  if (fits) {
    parallel_ranges(*team_, net_->moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const float change = weight_[i] / built_weight_[i];
        if (!(change < greatest_change_of_shape && change * greatest_change_of_shape > 1)) fits = false;
      }
    });
  }
  const bool pulled_otherwise = stiffness_.renew(*net_, model, *team_);
  if (fits && !pulled_otherwise) return false;
  // A build that is interrupted is repeated next time.
  built_weight_.clear();
  std::vector<double> pull(stiffness_.values().begin(), stiffness_.values().end());
  for (std::size_t i = 0; i < pull.size(); ++i)
    pull[i] = static_cast<double>(weight_[i]) / factor_ * std::min(pull[i], stiffest);
  bending_.build(pull, pulled_otherwise);
  built_weight_ = weight_;
  return true;
}

void SurfacePreconditioner::correct(const Model& model, double enough, std::vector<Vector3>& correction) {
  const Net& net = *net_;
  along_.resize(net.moving);
  correction.resize(net.moving);
  parallel_ranges(*team_, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    std::vector<NodeForce> forces(end - begin);
    model.find_forces(net, {begin, end}, forces);
    for (std::size_t i = begin; i < end; ++i) {
      const NodeForce& force = forces[i - begin];
      const double asked = force.spring.dot(net.normals[i]) / std::max(force.stiffness / stiffest, 1.0);
      along_[i] = static_cast<double>(weight_[i]) / factor_ * std::clamp(asked, -greatest_asked, greatest_asked);
      correction[i] = force.regularisation;
    }
  });
  solve(enough, correction);
}

void SurfacePreconditioner::update(std::span<const Vector3> moves, double enough, std::vector<Vector3>& correction) {
  const Net& net = *net_;
  // First all nodes move along the surface, as evenly as the regularisation asks: a part that moves as a whole then
  // stays whole.
  correction.assign(net.moving, Vector3::Zero());
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    const auto shares = net.weights_of(i);
    double spokes = 0;
    for (std::size_t k = 0; k < links.size(); ++k) {
      if (!links[k].spoke()) continue;
      spokes += 1;
      const std::size_t j = links[k].node();
      if (j >= net.moving) correction[i] += (shares.empty() ? 1 : shares[k]) * moves[j - net.moving];
    }
    if (!shares.empty()) correction[i] *= spokes;
  }
  keep_sliding(correction);
  rigid_modes_->hold(correction);
  spreading_->solve(correction, {.enough = enough, .share = following_share});
  std::vector<Vector3> ways = correction;
  ways.insert(ways.end(), moves.begin(), moves.end());
  along_ = bending_residual(net, ways);
  bending_.solve(along_, {.enough = enough, .share = following_share});
  for (std::size_t i = 0; i < net.moving; ++i) correction[i] += way_across(i);
}

void SurfacePreconditioner::solve(double enough, std::vector<Vector3>& correction) {
  const Net& net = *net_;
  const auto in_parallel = [&](const auto& body) { parallel_each(*team_, net.moving, nodes_per_task, body); };
  bending_.solve(along_, {.enough = enough, .share = bending_share});
  in_parallel([&](std::size_t i) { correction[i] = asked_across(i, correction[i]); });
  rigid_modes_->hold(correction);
  const std::vector<Vector3> asked = spreading_with_sliding_ ? correction : std::vector<Vector3>();
  keep_sliding(correction);
  spreading_->solve(correction, {.enough = enough, .share = spreading_share});
  if (spreading_with_sliding_) add_ways_of_sliding(asked, correction);
  in_parallel([&](std::size_t i) {
    if (!net.slides(i)) correction[i] -= correction[i].dot(net.normals[i]) * net.normals[i];
  });
  rigid_modes_->hold(correction);
  in_parallel([&](std::size_t i) {
    if (net.slides(i))
      correction[i] += way_across(i);
    else
      correction[i] += (along_[i] - sagitta(net, i, correction[i])) * net.normals[i];
  });
}

void SurfacePreconditioner::keep_sliding(std::vector<Vector3>& asked) const {
  for (std::size_t i = 0; i < net_->supports.size(); ++i) {
    if (net_->slides(i)) asked[i].setZero();
  }
}

Vector3 SurfacePreconditioner::way_across(std::size_t i, double share) const {
  const Vector3 way = share * along_[i] * net_->normals[i];
  return net_->slides(i) ? along_support(*net_, i, way) : way;
}

void SurfacePreconditioner::add_ways_of_sliding(const std::vector<Vector3>& asked, std::vector<Vector3>& correction) {
  const Net& net = *net_;
  // Other nodes have moved as if these stayed; then all nodes share the steps that these are to take.
  std::vector<Vector3> ways(net.moving, Vector3::Zero());
  const auto along = [&](std::size_t i, const Vector3& way) {
    return Vector3(along_support(net, i, way - way.dot(net.normals[i]) * net.normals[i]));
  };
  for (std::size_t i = 0; i < net.supports.size(); ++i) {
    if (!net.slides(i)) continue;
    const auto links = net.rings.links(i);
    const auto shares = net.weights_of(i);
    double spokes = 0;
    Vector3 sum = Vector3::Zero();
    for (std::size_t k = 0; k < links.size(); ++k) {
      if (!links[k].spoke()) continue;
      spokes += 1;
      const std::size_t j = links[k].node();
      if (j < net.moving) sum += (shares.empty() ? 1 : shares[k]) * correction[j];
    }
    ways[i] = along(i, asked[i] + (shares.empty() ? 1 : spokes) * sum);
  }
  spreading_with_sliding_->solve(ways, {.share = spreading_share});
  for (std::size_t i = 0; i < net.moving; ++i) correction[i] += net.slides(i) ? along(i, ways[i]) : ways[i];
}

Vector3 SurfacePreconditioner::asked_across(std::size_t i, const Vector3& regularisation) const {
  const auto links = net_->rings.links(i);
  const auto shares = net_->weights_of(i);
  double spokes = 0;
  Vector3 mean = Vector3::Zero();
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (!links[k].spoke()) continue;
    spokes += 1;
    const std::size_t j = links[k].node();
    if (j < net_->moving) mean += way_across(j, shares.empty() ? 1 : shares[k]);
  }
  if (shares.empty() && spokes > 0) mean /= spokes;
  const Vector3& normal = net_->normals[i];
  const Vector3 asked = regularisation_divisor(*net_) * regularisation + mean - way_across(i);
  return spokes * (asked - asked.dot(normal) * normal);
}

}  // namespace vspring
