#include "equilibrium/surface_hierarchy.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "equilibrium/surface_spreading.hpp"
#include "linear/interpolation.hpp"
#include "precondition/surface_preconditioner.hpp"
#include "spring/sliding.hpp"

namespace vspring {

namespace {

// Number of passes of means over the few nodes of the coarsest level, until they lie as on a soap film.
constexpr int film_passes = 500;
// Moves of held nodes, as shares of the tolerance: smaller ones need not be followed, larger ones show where moving
// nodes go.
constexpr double negligible_move = 0.25;
constexpr double telling_move = 2;
// Moving nodes up to which Cholesky factors are faster than multigrid.
constexpr std::size_t few_enough_to_factor = 3000;

double greatest_length(std::span<const Vector3> vectors) {
  double square = 0;
  for (const Vector3& vector : vectors) square = std::max(square, vector.squaredNorm());
  return std::sqrt(square);
}

/// The springs of another net. Sphere springs give the same shape on every mesh: the shape of a coarser level is then
/// nearly in place.
void take_springs_of(const Net& other, Net& net) {
  if (!other.spheres.on() || net.spheres.on()) return;
  use_sphere_springs(net);
  if (!other.spheres.differences.empty()) use_least_bending(net);
}

}  // namespace

Preconditioner& SurfaceHierarchy::preconditioner(std::size_t level) {
  make_systems(level);
  return preconditioner_.emplace(system_levels_, *spreading_, *rigid_modes_, *team_);
}

Preconditioner& SurfaceHierarchy::kept_preconditioner() {
  const std::size_t last = levels_.size() - 1;
  return preconditioner_ && systems_of_ == last ? *preconditioner_ : preconditioner(last);
}

void SurfaceHierarchy::make_systems(std::size_t level) {
  // Nodes that slide move their neighbours along; shares are kept while the level is iterated.
  if (systems_of_ == level) return;
  systems_of_.reset();
  preconditioner_.reset();
  spreading_.reset();
  system_levels_ = {.net = &levels_[level].net};
  for (std::size_t k = level; k > 0 && levels_[k].net.moving > few_enough_to_factor; --k) {
    Level& coarse = levels_[k - 1];
    restrict_shape(levels_[k], coarse);
    system_levels_.interpolations.push_back(interpolation(levels_[k].net, coarse.net, coarse.finer, *team_));
  }
  rigid_modes_.emplace(levels_[level].net);
  spreading_ = spreading_solver(system_levels_, *team_, !rigid_modes_->needed());
  systems_of_ = level;
}

void SurfaceHierarchy::start() {
  for (std::size_t k = levels_.size(); k-- > 1;) {
    const Net& fine = levels_[k].net;
    Level& coarse = levels_[k - 1];
    for (std::size_t i = 0; i < coarse.net.moving; ++i) {
      const std::size_t at = coarse.finer[i];
      coarse.net.positions[i] =
          coarse.places.empty() ? Vector3(0.5 * (fine.positions[at] + mean_of_neighbours(fine, at))) : coarse.places[i];
    }
    put_on_supports(coarse.net, coarse.net.positions);
  }
}

void SurfaceHierarchy::start_from_membrane(std::size_t level) {
  Net& net = levels_[level].net;
  for (int pass = 0; pass < film_passes; ++pass) {
    for (std::size_t i = 0; i < net.moving; ++i) {
      // It would draw in what can slide.
      if (!net.slides(i)) net.positions[i] = mean_of_neighbours(net, i);
    }
  }
}

void SurfaceHierarchy::prolong_from(std::size_t level) {
  Level& coarse = levels_[level];
  Level& fine = levels_[level + 1];
  prolong_surface(coarse, fine, *team_);
  systems_of_.reset();
  const NetState found = coarse.net;
  make_systems(level + 1);
  if (!system_levels_.interpolations.empty() && !rigid_modes_->needed()) {
    // Systems have had the fine shape handed down.
    static_cast<NetState&>(coarse.net) = found;
    if (spread_coarser(coarse.net, fine.net, system_levels_.interpolations.front(), *spreading_, *team_))
      prolong_surface(coarse, fine, *team_);
  }
  spread_along(fine.net, *spreading_, *rigid_modes_, *team_);
  coarse.net.spheres = {};
  take_springs_of(finest(), fine.net);
}

void SurfaceHierarchy::prolong_roughly_from(std::size_t level) {
  systems_of_.reset();
  prolong_surface(levels_[level], levels_[level + 1], *team_);
}

void SurfaceHierarchy::forget(std::size_t level) {
  Level& coarse = levels_[level];
  // An assignment of {} would keep the vector's memory.
  coarse.removals = std::vector<Removals>();
  coarse.places = std::vector<Vector3>();
  coarse.net.laplacian_weights = std::vector<double>();
}

std::vector<Vector3> SurfaceHierarchy::step_of_held(const Constraints& constraints) const {
  const Net& net = finest();
  std::vector<Vector3> step(net.positions.size() - net.moving, Vector3::Zero());
  for (std::size_t k = 0; k < step.size(); ++k) {
    const Index node = net.node[net.moving + k];
    if (constraints.position_fixed(node))
      step[k] = net.frame.to_local(constraints.position(node)) - net.positions[net.moving + k];
  }
  for (std::size_t i = 0; i < net.positions.size(); ++i) {
    if (!net.normal_given(i)) continue;
    const Vector3& normal = constraints.normal(net.node[i]);
    const Vector3& before = net.normals[i];
    step.emplace_back((normal.dot(before) < 0 ? Vector3(-normal) : normal) - before);
  }
  return step;
}

std::vector<Vector3> SurfaceHierarchy::ways_with(const std::vector<Vector3>& held_step, const Model& model,
                                                 double tolerance) {
  const Net& net = finest();
  std::vector<Vector3> rest = held_step;
  std::vector<Vector3> ways(net.moving, Vector3::Zero());
  predictor_.predict(rest, ways);
  rest.resize(net.positions.size() - net.moving);
  if (greatest_length(rest) > negligible_move * tolerance) {
    (void)kept_preconditioner().refresh(model);
    std::vector<Vector3> correction;
    preconditioner_->update(rest, negligible_move * tolerance, correction);
    for (std::size_t i = 0; i < net.moving; ++i) ways[i] += correction[i];
  }
  return ways;
}

std::vector<Vector3> SurfaceHierarchy::predict(const Constraints& constraints, const Model& model, double tolerance) {
  std::vector<Vector3> places = ways_with(step_of_held(constraints), model, tolerance);
  for (std::size_t i = 0; i < places.size(); ++i) places[i] += finest().positions[i];
  return places;
}

void SurfaceHierarchy::update(const Constraints& constraints, const Model& model, double tolerance) {
  Net& net = finest();
  began_ = net.positions;
  normals_began_ = net.normals;
  held_step_ = step_of_held(constraints);
  const std::vector<Vector3> ways = ways_with(held_step_, model, tolerance);
  for (std::size_t i = 0; i < net.moving; ++i) displace(net, i, ways[i]);
  auto step = held_step_.begin();
  for (std::size_t i = net.moving; i < net.positions.size(); ++i) net.positions[i] += *step++;
  for (std::size_t i = 0; i < net.positions.size(); ++i) {
    if (net.normal_given(i)) net.normals[i] += *step++;
  }
  if (greatest_length(held_step_) < telling_move * tolerance) held_step_.clear();
  if (!memory_) memory_.emplace(surface_acceleration_depth(net.moving), net.moving, *team_);
  memory_->begin_anew();
}

void SurfaceHierarchy::arrived() {
  if (held_step_.empty()) return;
  const Net& net = finest();
  std::vector<Eigen::Vector3f> way(net.moving);
  for (std::size_t i = 0; i < net.moving; ++i) way[i] = (net.positions[i] - began_[i]).cast<float>();
  predictor_.remember(std::move(held_step_), std::move(way));
}

void SurfaceHierarchy::go_back() {
  finest().positions = began_;
  finest().normals = normals_began_;
}

}  // namespace vspring
