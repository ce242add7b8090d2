#include "equilibrium/bending_descent.hpp"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "checks/bending_energy.hpp"
#include "checks/result_check.hpp"
#include "equilibrium/edge_turns.hpp"
#include "linear/cholesky_solver.hpp"
#include "points/face_ties.hpp"
#include "spring/bending_factor.hpp"
#include "spring/point_force.hpp"
#include "spring/sliding.hpp"
#include "spring/spacing.hpp"

namespace vspring {

namespace {

// The root of ∫ κ₁² + κ₂² dA, about the turn of the whole shape in radians: below it the shape is as good as flat.
constexpr double next_to_flat = 1e-7;
// Turn of an edge in one step, in radians.
constexpr double most_turn = 0.3;
// Damping that is added to the diagonal, as a share of it: at first, at most, and at least; it decreases with each step
// that was taken, until there is none.
constexpr double first_damping = 1;
// The same where points pull by their distances from faces: the energy is then that of the shape, not of a plane.
constexpr double first_damping_by_faces = 0.01;
constexpr double most_damping = 1e4;
constexpr double least_damping = 1e-5;
constexpr double change_of_damping = 10;
// As a share of the greatest entry: nodes stay where nothing is bent.
constexpr double least_on_diagonal = 1e-12;
// The same where a node is to stay.
constexpr double most_times_greatest = 1e6;
// And the energies of a step, in iterations of the equilibrium solver.
constexpr double work_of_slopes = 6;
// As a share of the fall that the slopes predict.
constexpr double least_fall = 1e-4;
// Lengths that a line search tries: each is the best by a parabola through the energies so far.
constexpr int most_lengths = 3;
constexpr double most_change_of_length = 10;
constexpr double near_enough_to_best = 0.2;
// Number of steps from which the rate of their shrinking is taken; its least and greatest value.
constexpr std::size_t steps_of_rate = 5;
constexpr double least_rate = 0.5;
constexpr double most_rate = 0.95;
constexpr int steps_per_tie = 5;
// Where bending falls in so many steps by a smaller share than that, it falls no further: a shape may go on changing,
// at hardly any change of bending, by more than the tolerance.
constexpr int steps_of_fall = 10;
constexpr double least_fall_of_all = 1e-4;
constexpr std::size_t nodes_of_a_task = 64;

/// The energy of a height, its slope and its second derivative.
struct HeightEnergy {
  double value;
  double slope;
  double curvature;
};

/// −log z, as far as z is more than `relaxed`; below a quadratic with the same value, slope and curvature there.
HeightEnergy relaxed_logarithm(double z, double relaxed) {
  if (z > relaxed) return {-std::log(z), -1 / z, 1 / (z * z)};
  const double x = (z - 2 * relaxed) / relaxed;
  return {(x * x - 1) / 2 - std::log(relaxed), x / relaxed, 1 / (relaxed * relaxed)};
}

HeightEnergy barrier_energy(double height, const PointBounds& bounds) {
  const double share = height / bounds.distance;
  const HeightEnergy above = relaxed_logarithm(1 - share, bounds.relaxed);
  const HeightEnergy below = relaxed_logarithm(1 + share, bounds.relaxed);
  const double slope = bounds.barrier / bounds.distance;
  return {bounds.barrier * (above.value + below.value), slope * (below.slope - above.slope),
          slope / bounds.distance * (above.curvature + below.curvature)};
}

class BendingDescent {
 public:
  BendingDescent(Net& net, const Model& model, ThreadTeam& team)
      : net_(net), model_(model), team_(team), bending_(net), solver_(team) {
    model.prepare(net_);
  }

  EquilibriumResult run(const EquilibriumTask& task, Context& context) {
    EquilibriumResult result;
    try {
      sound_ = net_.positions;
      draw_home(task);
      face_ties_ = task.face_ties;
      bounds_ = task.bounds;
      const CancellationScope cancellation(context);
      start(task.may_smooth_start);
      // Nodes of a crumpled start would keep its folds.
      keeps_faces_ = most_turned_ == 0;
      if (keeps_faces_) stays_.assign(net_.moving, 0);
      follow(task, result);
      result.kept = static_cast<std::size_t>(std::count(stays_.begin(), stays_.end(), 1));
    } catch (const Cancelled&) {
      result.outcome = Outcome::cancelled;
    }
    // Where folds were fewer at first at the cost of bending, and the way ended too soon.
    if (net_.points.empty() && !input_.empty() && bending_.of(sound_, team_) > energy_of_input_) {
      sound_ = input_;
      if (result.outcome == Outcome::converged) result.outcome = Outcome::stalled;
    }
    net_.positions = sound_;
    return result;
  }

 private:
  /// Weighted by areas, so that waves are damped alike on any mesh.
  void draw_home(const EquilibriumTask& task) {
    home_ = task.home;
    if (home_.empty()) return;
    const double squared = task.smoothing_length * task.smoothing_length;
    draw_.resize(net_.moving);
    for (std::size_t i = 0; i < net_.moving; ++i) draw_[i] = bending_.area(net_.positions, i) / (squared * squared);
  }

  /// Σ M d²/L⁴.
  [[nodiscard]] double energy_of_way_home() const {
    double energy = 0;
    for (std::size_t i = 0; i < draw_.size(); ++i) energy += draw_[i] * (net_.positions[i] - home_[i]).squaredNorm();
    return energy;
  }

  /// Without its noise, where that leaves fewer folds, or as many and less bending.
  void start(bool may_smooth) {
    best_ = net_.positions;
    const auto energy_here = [&] {
      if (face_ties_ == nullptr) return bending_.of(net_.positions, team_);
      update_directions(net_, model_, team_);
      look_at_points();
      return energy_now();
    };
    energy_of_input_ = energy_ = energy_here();
    input_ = best_;
    most_turned_ = turned_edges(net_, team_);
    sound_ = best_;
    if (!may_smooth) return;
    net_.positions = rest_positions(net_, team_);
    const double energy = energy_here();
    if (std::pair(turned_edges(net_, team_), energy) < std::pair(most_turned_, energy_)) {
      energy_ = energy;
      best_ = net_.positions;
    }
    sound_ = net_.positions = best_;
  }

  void follow(const EquilibriumTask& task, EquilibriumResult& result) {
    double damping = task.face_ties != nullptr ? first_damping_by_faces : first_damping;
    // Nothing is known of it.
    result.expected_error = 1;
    std::deque<double> sizes;
    std::vector<Vector3> places = best_;
    double fallen = 0;
    int steps = 0;
    for (; result.iterations < task.max_iterations; ++result.iterations) {
      if (result.work + 1 > task.most_work) {
        result.outcome = Outcome::work_limit;
        return;
      }
      end_if_cancelled();
      if (steps == steps_of_fall) {
        if (fallen < least_fall_of_all * energy_) {
          for (std::size_t i = 0; i < net_.moving; ++i) places[i] -= best_[i];
          result.expected_error = length_of(places);
          result.outcome = sound_ == best_ ? Outcome::converged : Outcome::stalled;
          return;
        }
        places = best_;
        fallen = 0;
        steps = 0;
      }
      if (task.renew_ties && result.iterations % steps_per_tie == 0) (void)task.renew_ties(0);
      if (!find_way(damping, result)) {
        result.outcome = Outcome::stalled;
        return;
      }
      if (is_flat()) {
        result.expected_error = std::sqrt(energy_);
        result.outcome = Outcome::converged;
        return;
      }
      const double size = length_of(across_);
      if (damping == 0) {
        sizes.push_back(size);
        if (sizes.size() > steps_of_rate + 1) sizes.pop_front();
        const bool is_known = sizes.size() > steps_of_rate;
        const double rate =
            is_known ? std::pow(size / sizes.front(), 1 / static_cast<double>(steps_of_rate)) : most_rate;
        result.expected_error = size / (1 - std::clamp(rate, least_rate, most_rate));
        if (result.expected_error < task.tolerance && !(task.renew_ties && task.renew_ties(0))) {
          ++result.iterations;
          result.outcome = sound_ == best_ ? Outcome::converged : Outcome::stalled;
          return;
        }
      }
      if (task.on_iteration) task.on_iteration(result.expected_error);
      const std::ptrdiff_t staying = count_staying();
      const double before = energy_;
      const bool went = go();
      fallen += before - energy_;
      ++steps;
      if (count_staying() > staying) {
        // What falls is another shape's bending now.
        conjugate_.clear();
        places = best_;
        fallen = 0;
        steps = 0;
        continue;
      }
      if (!went) {
        conjugate_.clear();
        damping = std::max(change_of_damping * damping, least_damping);
        if (damping > most_damping) {
          result.outcome = Outcome::stalled;
          return;
        }
        continue;
      }
      if (turned_edges(net_, team_) <= most_turned_) sound_ = best_;
      damping = damping / change_of_damping < least_damping ? 0 : damping / change_of_damping;
    }
  }

  /// Whether nothing is bent, and no point pulls.
  [[nodiscard]] bool is_flat() const {
    constexpr double next_to_nothing = next_to_flat * next_to_flat;
    return energy_ < next_to_nothing && std::all_of(pulls_.begin(), pulls_.end(), [](const Pull& pull) {
             return std::abs(pull.stiffness * pull.height) < next_to_nothing;
           });
  }

  /// Where to from here.
  bool find_way(double damping, EquilibriumResult& result) {
    update_directions(net_, model_, team_);
    slopes_.swap(slopes_before_);
    along_.swap(along_before_);
    slopes_ = bending_.slopes(net_.positions, team_);
    Eigen::SparseMatrix<double> matrix = bending_.second_derivative(net_.positions);
    look_at_points();
    energy_ = energy_now();
    for (std::size_t i = 0; i < draw_.size(); ++i) {
      const Vector3 way = way_of(i, 1);
      slopes_[i] += 2 * draw_[i] * (net_.positions[i] - home_[i]).dot(way);
      const auto at = static_cast<Eigen::Index>(i);
      matrix.coeffRef(at, at) += 2 * draw_[i] * way.squaredNorm();
    }
    for (const Pull& pull : pulls_) {
      const HeightEnergy energy = energy_of(pull, pull.height);
      for (std::size_t a = 0; a < pull.nodes.size(); ++a) {
        if (pull.rise[a] == 0) continue;
        slopes_[pull.nodes[a]] += energy.slope * pull.rise[a];
        for (std::size_t b = 0; b < pull.nodes.size(); ++b) {
          if (pull.rise[b] == 0 || pull.nodes[b] > pull.nodes[a]) continue;
          matrix.coeffRef(static_cast<Eigen::Index>(pull.nodes[a]), static_cast<Eigen::Index>(pull.nodes[b])) +=
              energy.curvature * pull.rise[a] * pull.rise[b];
        }
      }
    }
    const double least = least_on_diagonal * matrix.diagonal().maxCoeff();
    const double most = most_times_greatest * matrix.diagonal().maxCoeff();
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      double& diagonal = matrix.coeffRef(i, i);
      diagonal += stays(static_cast<std::size_t>(i)) ? most : damping * diagonal + least;
    }
    solver_.build(matrix);
    result.work += work_of_slopes + solver_.work_of_building();
    for (std::size_t i = 0; i < net_.moving; ++i) slopes_[i] = stays(i) ? 0 : slopes_[i];
    along_ = slopes_;
    solver_.solve(along_, {});
    for (std::size_t i = 0; i < net_.moving; ++i) along_[i] = stays(i) ? 0 : along_[i];
    for (double& way : along_) way = -way;
    across_.resize(net_.moving);
    for (std::size_t i = 0; i < net_.moving; ++i) across_[i] = way_of(i, along_[i]);
    return std::isfinite(length_of(across_));
  }

  /// The pulls of points, in the units of the energy.
  void look_at_points() {
    if (net_.points.empty()) return;
    if (face_ties_ != nullptr) {
      look_at_faces();
      return;
    }
    const double kappa = bending_factor(net_);
    pulls_.clear();
    from_ = best_;
    for (std::size_t i = 0; i < net_.moving; ++i) {
      const Vector3& normal = net_.normals[i];
      const PointForce points =
          point_force(net_, i, mean_edge(net_, i), [&](const Vector3& d) { return Vector3(d.dot(normal) * normal); });
      if (!(points.stiffness > 0)) continue;
      const auto node = static_cast<std::uint32_t>(i);
      pulls_.push_back({{.nodes = {node, node, node},
                         .rise = {1, 0, 0},
                         .height = -points.displacement.dot(normal) / points.stiffness},
                        2 / kappa * bending_.weight(best_, i) * points.stiffness,
                        0});
    }
  }

  /// The same from faces. All points of a node count alike.
  void look_at_faces() {
    const double kappa = bending_factor(net_);
    first_pull_.assign(1, 0);
    for (std::size_t i = 0; i < net_.moving; ++i) first_pull_.push_back(first_pull_.back() + net_.points.of(i).size());
    pulls_.resize(first_pull_.back());
    parallel_ranges(team_, net_.moving, nodes_of_a_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto points = net_.points.of(i);
        if (points.empty()) continue;
        const double stiffness =
            2 / kappa * bending_.weight(best_, i) * net_.points.factor(i) / static_cast<double>(points.size());
        for (std::size_t k = 0; k < points.size(); ++k)
          pulls_[first_pull_[i] + k] = {face_ties_->of(i, points[k]), stiffness * net_.points.weights[points[k]],
                                        points[k]};
      }
    });
  }

  /// Of the shape of the net.
  double energy_now() {
    double energy = bending_.of(net_.positions, team_) + energy_of_way_home();
    if (face_ties_ != nullptr) return energy + energy_of_heights();
    for (const Pull& pull : pulls_) {
      double rise = 0;
      for (std::size_t k = 0; k < pull.nodes.size(); ++k) {
        const std::uint32_t node = pull.nodes[k];
        if (pull.rise[k] != 0) rise += pull.rise[k] * (net_.positions[node] - from_[node]).dot(net_.normals[node]);
      }
      energy += pull.stiffness * rise * (rise / 2 + pull.height);
    }
    return energy;
  }

  [[nodiscard]] double energy_of_heights() {
    std::vector<double> energy(net_.moving, 0);
    parallel_ranges(team_, net_.moving, nodes_of_a_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t k = first_pull_[i]; k < first_pull_[i + 1]; ++k) {
          energy[i] += energy_of(pulls_[k], face_ties_->of(i, pulls_[k].point).height).value;
        }
      }
    });
    return std::accumulate(energy.begin(), energy.end(), 0.0);
  }

  /// A step across the surface: conjugate to the one before (Polak and Ribière), as long as the energy falls most.
  bool go() {
    double share_of_last = 0;
    if (!conjugate_.empty()) {
      double change = 0;
      double last = 0;
      for (std::size_t i = 0; i < net_.moving; ++i) {
        change += slopes_[i] * (along_[i] - along_before_[i]);
        last += slopes_before_[i] * along_before_[i];
      }
      share_of_last = std::max(0.0, change / last);
    }
    const auto slope_of = [&] {
      double slope = 0;
      for (std::size_t i = 0; i < net_.moving; ++i) slope += slopes_[i] * conjugate_[i];
      return slope;
    };
    conjugate_.resize(net_.moving, 0);
    for (std::size_t i = 0; i < net_.moving; ++i) conjugate_[i] = along_[i] + share_of_last * conjugate_[i];
    double slope = slope_of();
    if (!(slope < 0)) {
      conjugate_ = along_;
      slope = slope_of();
    }
    if (!(slope < 0)) return false;
    std::vector<Vector3> step(net_.moving);
    for (std::size_t i = 0; i < net_.moving; ++i) step[i] = way_of(i, conjugate_[i]);
    const double longest = most_turn / turn_of(step);
    double length = std::min(1.0, longest);
    const double before = energy_;
    const std::vector<Vector3> start = best_;
    bool taken = false;
    for (int k = 0; k < most_lengths; ++k) {
      const double least = energy_;
      const std::vector<Vector3> places = std::exchange(best_, start);
      const bool is_better = take(step, length, std::min(least, before + least_fall * length * slope));
      if (!is_better) net_.positions = best_ = places;
      if (is_blocked_) return taken;
      const double curved = (looked_at_ - before - slope * length) / (length * length);
      const double best = curved > 0 ? -slope / (2 * curved) : longest;
      taken = taken || is_better;
      if (taken && (!is_better || std::abs(best - length) < near_enough_to_best * length)) break;
      length =
          std::min(std::clamp(best, length / most_change_of_length, (is_better ? most_change_of_length : 0.5) * length),
                   longest);
    }
    return taken;
  }

  /// Moves so far from the best shape, and keeps the new one if its energy is at most that. If no more edges turn than
  /// at first, it is then the best shape that is no worse than the start.
  bool take(const std::vector<Vector3>& step, double share, double most) {
    for (std::size_t i = 0; i < net_.moving; ++i) net_.positions[i] = best_[i] + share * step[i];
    put_on_supports(net_, net_.positions);
    is_blocked_ = keeps_faces_ && folds();
    looked_at_ = energy_now();
    if (is_blocked_ || !(looked_at_ <= most)) {
      net_.positions = best_;
      return false;
    }
    energy_ = looked_at_;
    best_ = net_.positions;
    return true;
  }

  /// Whether faces turned over. Their nodes stay from now on.
  bool folds() {
    const std::vector<std::size_t> nodes = nodes_at_turned_edges(net_);
    for (const std::size_t node : nodes) {
      if (node < net_.moving) stays_[node] = 1;
    }
    return !nodes.empty();
  }

  /// As far along the normal; a node that slides moves along its support.
  [[nodiscard]] Vector3 way_of(std::size_t i, double along) const {
    const Vector3 way = along * net_.normals[i];
    return net_.slides(i) ? along_support(net_, i, way) : way;
  }

  [[nodiscard]] bool stays(std::size_t i) const { return keeps_faces_ && stays_[i] != 0; }
  [[nodiscard]] std::ptrdiff_t count_staying() const { return std::count(stays_.begin(), stays_.end(), 1); }

  double turn_of(const std::vector<Vector3>& step) { return edge_turns(net_, step, team_).largest; }

  double length_of(const std::vector<Vector3>& step) {
    return std::sqrt(greatest_over_nodes(net_, team_, [&](std::size_t i) { return step[i].squaredNorm(); }));
  }

  Net& net_;
  const Model& model_;
  ThreadTeam& team_;
  BendingEnergy bending_;
  CholeskySolver solver_;
  std::vector<Vector3> best_;
  std::vector<Vector3> sound_;       ///< the best where no more edges turn than at first
  std::vector<std::uint8_t> stays_;  ///< by moving node: faces would turn over there
  bool keeps_faces_ = false;
  bool is_blocked_ = false;  ///< the last step, by faces that would
  std::vector<Vector3> input_;
  double energy_of_input_ = 0;
  double energy_ = 0;            ///< of the best shape
  double looked_at_ = 0;         ///< of the last one
  std::size_t most_turned_ = 0;  ///< edges
  struct Pull : HeightOverFace {
    double stiffness;
    std::uint32_t point;
  };
  [[nodiscard]] HeightEnergy energy_of(const Pull& pull, double height) const {
    if (bounds_.distance > 0) return barrier_energy(height, bounds_);
    return {pull.stiffness * height * height / 2, pull.stiffness * height, pull.stiffness};
  }
  PointBounds bounds_;
  const FaceTies* face_ties_ = nullptr;
  std::vector<Pull> pulls_;
  std::vector<std::size_t> first_pull_;  ///< of each moving node
  std::vector<Vector3> from_;            ///< where nodes were pulled so
  std::span<const Vector3> home_;        ///< where nodes are drawn to
  std::vector<double> draw_;             ///< by moving node, for a way of 1
  std::vector<double> slopes_;
  std::vector<double> slopes_before_;
  std::vector<double> along_;  ///< the normals
  std::vector<double> along_before_;
  std::vector<double> conjugate_;
  std::vector<Vector3> across_;
};

}  // namespace

EquilibriumResult descend_bending(Net& net, const Model& model, const EquilibriumTask& task, ThreadTeam& team,
                                  Context& context) {
  return BendingDescent(net, model, team).run(task, context);
}

}  // namespace vspring
