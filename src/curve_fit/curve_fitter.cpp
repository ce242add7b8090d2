#include "curve_fit/curve_fitter.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>

#include "base/cancellation.hpp"
#include "base/threads.hpp"
#include "curve_fit/polyline_bounds.hpp"
#include "shape/box_tree.hpp"
#include "shape/segment.hpp"

namespace vspring {

namespace {

// Of a tolerance, at the start, so that there is room to become fairer.
constexpr double first_share = 0.95;
// Of a tolerance, so that what is not linear in a step does not go beyond.
constexpr double aimed_share = 0.995;
// Of how far the curve may go, so that it does not go beyond between nodes.
constexpr double aimed_share_of_way = 0.98;
// Of that, across the curve, where what is away along it is nearly all.
constexpr double least_share_across = 0.01;
constexpr int starts = 2;
constexpr int robust_starts = 2;
constexpr int risk_starts = 4;
// Of the noise: what is nearer than that tells nothing.
constexpr double least_deviation = 0.5;
constexpr double times_noise = 3;
constexpr double least_spacing_in_tolerances = 0.05;
constexpr int most_grids = 4;
constexpr int most_steps_on_grid = 30;
// Of what is beyond bounds, that is left after so many steps.
constexpr int steps_per_look = 10;
constexpr double hopeless_share = 0.9;
// While corners move.
constexpr int most_steps_of_corners = 8;
constexpr int grids_of_corners = 3;
// Of the energy, in a step: what changes less is there.
constexpr double settled_energy = 1e-4;
// Of a bound, in a step.
constexpr double settled_share = 0.01;
// Of the energy at first.
constexpr double next_to_no_energy = 1e-6;
// Of edges, in a step.
constexpr double greatest_turn_of_step = 0.5;
constexpr double greatest_turn_of_settled = 0.2;
constexpr int most_halvings = 6;
// Of a step, that is taken to keep edges from turning further; damped where it were less.
constexpr double least_share = 0.15;
constexpr int most_dampings = 5;
// Of how far edges turned with less damping: where they still turn by more, damping does not help.
constexpr double no_less_for_damping = 0.8;
constexpr double first_damping = 0.01;
constexpr double more_damping = 8;
constexpr double less_damping = 0.1;
constexpr double least_damping = 1e-4;
constexpr double shrinking = 0.9;
constexpr double tie_break = 1e-6;
constexpr double loosened = 1.02;
// Of the energy, for what is two bounds away.
constexpr double price_of_bounds = 1e3;
// Of what a step promises to take off.
constexpr double least_gain = 0.1;
// Of the greatest curvature, where that is more than may be: what a step leaves of it, from one try to the next.
constexpr double curvature_left[] = {0.5, 0.9, 0.98, 1};
// How far from the polyline places may be: of the root mean square, and of the furthest point at the start.
constexpr double reach_of_rms = 4;
constexpr double spare_of_reach = 1.5;
// Of that: places that are nearer have no bound in a step.
constexpr double far_share = 0.3;
// Of the noise beyond so much of an edge.
constexpr double least_smoothing_of_noise = 4;
constexpr double edges_of_noise = 0.4;
// Of the smoothing length, between nodes.
constexpr double spacing_of_springs = 0.25;
constexpr int most_trials_of_weight = 24;
constexpr double near_rms = 0.985;
// Of a root mean square, for points that can be moved: with less than that the curve follows their noise.
constexpr double least_share_of_rms = 0.95;
constexpr double no_nearer = 0.995;
constexpr int most_without_gain = 3;
constexpr double next_to_no_weight = 1e-3;
// Of the root mean square: the bound of a first curve.
constexpr double bound_of_rms = 3;
constexpr double stride_of_weight = 10;

template <int K>
class CurveFitter {
 public:
  CurveFitter(const CurveFitTask& task, const std::function<void(double)>& progress)
      : task_(task),
        progress_(progress),
        plane_(task.plane.value_or(Vector3::Zero())),
        springs_(task.smoothing > 0 || task.weight > 0) {}

  std::vector<std::pair<Index, double>> deviations() {
    begin_on_way();
    std::vector<double> distances;
    for (int k = 0; k < robust_starts; ++k) {
      smooth_out_robustly(found_.curve, found_.points, task_.noise);
      find_places(found_.curve, found_.points);
    }
    for (const CurvePoint& point : found_.points)
      distances.push_back(found_.curve.offset(point.at, point.place).norm());
    std::vector<double> sorted = distances;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double deviation = std::max(*middle / median_of_noise, least_deviation * task_.noise);
    std::vector<std::pair<Index, double>> result;
    for (std::size_t j = 0; j < distances.size(); ++j)
      result.emplace_back(found_.points[j].number, distances[j] / deviation);
    return result;
  }

  double rms_of_noise() {
    begin_on_way();
    LeastRisk found;
    for (int k = 0; k < risk_starts && !found_.points.empty(); ++k) {
      found = smooth_out_by_risk(found_.curve, found_.points, task_.noise, K, found.smoothing);
      find_places(found_.curve, found_.points);
      take_new_nodes(with_new_nodes(found_.curve, least_spacing()));
    }
    return found.rms;
  }

  CurveFound start() {
    begin();
    return std::move(found_);
  }

  CurveFound run() {
    if (task_.nodes) return run_on_nodes();
    if (task_.start)
      begin_from(*task_.start);
    else
      begin();
    if (has_corners()) place_corners();
    for (int grid = 0; grid < most_grids; ++grid) {
      most_work_ = std::max(most_work_, static_cast<std::size_t>(task_.most_steps) * found_.curve.size() / (grid + 1));
      weights_ = weights_of_change(found_.curve, task_.evenly);
      find_places_between();
      if (task_.rms > 0)
        go_to_rms();
      else
        go();
      progress_(static_cast<double>(grid + 1) / most_grids);
      if (work_ >= most_work_ || grid + 1 == most_grids || (!refine() && found_.converged)) break;
    }
    measure();
    return std::move(found_);
  }

 private:
  /// On nodes that are given, whose chords are the curve.
  CurveFound run_on_nodes() {
    found_.curve = *task_.nodes;
    hold_corners();
    found_.points = task_.scattered;
    set_bounds();
    find_places(found_.curve, found_.points);
    most_work_ = static_cast<std::size_t>(task_.most_steps) * found_.curve.size();
    weights_ = weights_of_change(found_.curve, task_.evenly);
    find_places_between();
    if (task_.rms > 0)
      go_to_rms();
    else
      go();
    measure();
    return std::move(found_);
  }

  /// How far the curve may go from the polyline of the points, about.
  [[nodiscard]] double tolerance() const { return std::max(task_.within, times_noise * task_.noise); }

  /// Between nodes: in less than that a curve does not get from one bound to the other and back.
  [[nodiscard]] double least_spacing() const { return least_spacing_in_tolerances * tolerance(); }

  void begin_on_way() {
    const StartScale scale{task_.noise, tolerance(), task_.sharp};
    found_.curve = DenseCurve(false, task_.moving);
    for (const auto& chain : task_.chains) add_start(chain.nodes, chain.closed, scale, found_.curve, found_.points);
    find_scattered();
    set_bounds();
  }

  void set_bounds() {
    for (CurvePoint& point : found_.points) {
      const auto number = static_cast<std::size_t>(point.number);
      point.bound = task_.within - (point.number >= 0 && !task_.spare.empty() ? task_.spare[number] : 0);
    }
  }

  void begin_from(const CurveFound& start) {
    found_ = start;
    set_bounds();
  }

  void begin() {
    begin_on_way();
    if (found_.points.empty()) return;
    for (int k = 0; k < starts; ++k) {
      smooth_out_at_first();
      find_places(found_.curve, found_.points);
      take_new_nodes(with_new_nodes(found_.curve, least_spacing()));
    }
    smooth_out_at_first();
    find_places(found_.curve, found_.points);
  }

  void smooth_out_at_first() {
    if (springs_) {
      set_springs();
      smooth_out_by(found_.curve, found_.points, found_.smoothing);
      for (std::uint32_t i = 0; i < found_.curve.size(); ++i)
        found_.curve.set_spacing(i, std::min(found_.curve.node(i).spacing, spacing_of_springs * found_.smoothing));
    } else {
      smooth_out(found_.curve, found_.points, first_share * task_.within, first_share * task_.rms);
    }
  }

  [[nodiscard]] double length() const {
    double length = 0;
    for (std::uint32_t i = 0; i < found_.curve.size(); ++i)
      length += found_.curve.is_edge(i) ? found_.curve.edge_length(i) : 0;
    return length;
  }

  /// Each point stands for an equal share of the length.
  void set_springs() {
    const double length = this->length();
    found_.smoothing = task_.smoothing;
    if (task_.weight > 0) found_.smoothing = length / task_.edges * std::pow(8 * task_.weight, -0.25);
    // Where noise is longer than edges there is no way through all points.
    const double noise = task_.noise - edges_of_noise * length / task_.edges;
    found_.smoothing = std::max(found_.smoothing, least_smoothing_of_noise * noise);
    data_weight_ = length / static_cast<double>(found_.points.size()) * std::pow(found_.smoothing, -4);
  }

  void find_scattered() {
    if (task_.scattered.empty()) return;
    const DenseCurve& curve = found_.curve;
    std::vector<std::uint32_t> edges;
    std::vector<Box> boxes;
    for (std::uint32_t i = 0; i < curve.size(); ++i) {
      if (!curve.is_edge(i)) continue;
      edges.push_back(i);
      boxes.emplace_back();
      boxes.back().extend(curve.place(i));
      boxes.back().extend(curve.place(curve.next(i)));
    }
    ThreadTeam team(1);
    const BoxTree tree(std::move(boxes), team);
    for (CurvePoint point : task_.scattered) {
      const auto share = [&](Index k) {
        const std::uint32_t edge = edges[static_cast<std::size_t>(k)];
        return nearest_share(point.place, curve.place(edge), curve.place(curve.next(edge)));
      };
      const auto nearest = tree.nearest(point.place, [&](Index k) {
        const std::uint32_t edge = edges[static_cast<std::size_t>(k)];
        const Vector3& start = curve.place(edge);
        return (point.place - start - share(k) * (curve.place(curve.next(edge)) - start)).squaredNorm();
      });
      point.at = {edges[static_cast<std::size_t>(nearest.item)], share(nearest.item)};
      found_.points.push_back(point);
    }
  }

  void find_places_between() {
    gives_way_ = false;
    between_.clear();
    if (task_.in_order && task_.keeps_way)
      between_ = polyline_bounds(found_.curve, found_.points, reach(), {.everywhere = task_.way_share < 1});
    for (PolylineBound& one : between_) one.bound *= task_.way_share;
  }

  /// How far from the polyline places may be: where only points pull, a sharp turn would go out to a wide loop.
  [[nodiscard]] double reach() const {
    if (task_.within > 0) return task_.within;
    if (task_.rms > 0) return reach_of_rms * task_.rms;
    double reach = reach_of_rms * task_.noise;
    for (const CurvePoint& point : found_.points)
      reach = std::max(reach, spare_of_reach * found_.curve.offset(point.at, point.place).norm());
    return reach;
  }

  /// Steps to the fairest curve for the weight of points as it is.
  void go(int most_steps = most_steps_on_grid) {
    find_places(found_.curve, found_.points);
    double energy = merit();
    double excess = this->excess();
    double bent = greatest_bend();
    const double* left = std::begin(curvature_left);
    const int sides = has_corners() ? 2 : 1;
    int sides_done = 0;
    double last_step = std::numeric_limits<double>::infinity();
    double excess_at_look = std::numeric_limits<double>::infinity();
    for (int step = 0; step < most_steps && work_ < most_work_; ++step) {
      end_if_cancelled();
      if (step % steps_per_look == 0) {
        // What is far beyond its bounds and comes no nearer stays so.
        if (excess_at_look > 1 && excess - 1 > hopeless_share * (excess_at_look - 1)) break;
        excess_at_look = excess;
      }
      ++found_.steps;
      work_ += found_.curve.size();
      const DenseCurve before = found_.curve;
      std::vector<CurvePoint> places = found_.points;
      double greatest = 0;
      double turn = 0;
      double last_turn = std::numeric_limits<double>::infinity();
      bool found = false;
      std::vector<Vector3> moves(before.size(), Vector3::Zero());
      for (int trial = 0; trial < most_dampings; ++trial) {
        std::optional<CurveProgram<K>> program;
        BallSolution solution;
        const auto solve = [&](double share, double price) {
          program.emplace(this->program(share, price));
          solution = program->solve();
          found = solution.found;
        };
        // What was too much for one step is so for the next.
        for (solve(*left, 0); !found && task_.least_radius > 0 && left + 1 != std::end(curvature_left);)
          solve(*++left, 0);
        if (program->blocks() == 0) {
          found_.converged = true;
          return;
        }
        if (!found) {
          // What can't be kept, along with all else or at a price.
          solve(1, price_of_bounds * energy);
          if (found)
            loosen_bounds(solution);
          else
            loosen_bounds();
          places = found_.points;
          excess = this->excess();
        }
        program->for_moves(solution, [&](std::uint32_t i, const Vector3& move) { moves[i] = move; });
        greatest = turn = 0;
        double squares = 0;
        for (std::uint32_t i = 0; i < before.size(); ++i) {
          if (!moves[i].allFinite()) greatest = std::numeric_limits<double>::infinity();
          greatest = std::max(greatest, moves[i].norm());
          if (!before.is_edge(i)) continue;
          const double length = before.edge_length(i);
          const double turned = (moves[before.next(i)] - moves[i]).norm() / length;
          turn = std::max(turn, turned);
          squares += length * turned * turned;
        }
        if (!std::isfinite(greatest)) {
          found_.converged = false;
          return;
        }
        if (turn * least_share <= greatest_turn_of_step) break;
        // Bounds have to be met, however much a step is damped.
        if (turn > no_less_for_damping * last_turn) break;
        last_turn = turn;
        damping_ = damping_ > 0 ? more_damping * damping_ : first_damping * energy / squares;
      }
      double share = turn > greatest_turn_of_step ? greatest_turn_of_step / turn : 1;
      bool better = false;
      double now = energy;
      for (int half = 0; half < most_halvings; ++half, share /= 2) {
        for (std::uint32_t i = 0; i < before.size(); ++i) found_.curve.set_place(i, before.place(i) + share * moves[i]);
        found_.points = places;
        find_places(found_.curve, found_.points);
        now = merit();
        const double beyond = std::max(1.0, this->excess());
        const double bend = std::max(1.0, greatest_bend());
        // Bounds come first: a curve that is beyond them may well be fairer.
        if (excess > 1)
          better = beyond - 1 <= (1 - least_gain * share) * (excess - 1) || (beyond <= excess && now < energy);
        else
          // Springs have no energy of their own; near their balance steps become smaller from one to the next.
          better = beyond <= 1 &&
                   (now < energy || bend < bent || (springs_ && share == 1 && greatest <= shrinking * last_step));
        better = better && bend <= std::max(1.0, bent);
        if (!better) continue;
        excess = beyond;
        bent = bend;
        break;
      }
      const bool damped = damping_ > 0;
      if (!better) {
        found_.curve = before;
        found_.points = places;
        if (damped) {
          damping_ = 0;
          continue;
        }
        found_.converged = found && bent <= 1;
        ahead_ = !ahead_;
        if (++sides_done < sides) continue;
        return;
      }
      if (!gives_way_) {
        // Other pieces of the polyline may be nearer now.
        find_places_between();
        excess = std::max(1.0, this->excess());
      }
      last_step = greatest * share;
      found_.error = last_step;
      const bool still = !damped && excess <= 1 && last_step < settled_step();
      const bool settled = !springs_ && !damped &&
                           ((share == 1 && energy - now <= settled_energy * energy) || now <= nothing_left_) &&
                           excess <= 1 && bent <= 1;
      energy = now;
      damping_ = damping_ > least_damping * energy ? damping_ * less_damping : 0;
      ahead_ = !ahead_;
      if (turn > greatest_turn_of_settled || !(still || settled)) {
        sides_done = 0;
        continue;
      }
      found_.converged = bent <= 1;
      if (++sides_done == sides) return;
    }
    found_.converged = false;
  }

  /// What moves no further is there. Of a tolerance that is close to what the whole is to be as near to, less.
  [[nodiscard]] double settled_step() const {
    return task_.within > 0 ? std::min(task_.tolerance, settled_share * task_.within) : task_.tolerance;
  }

  /// Nodes do not go along the curve, so that corners can't go far on one grid. Afterwards they stay where they are.
  void place_corners() {
    has_sides_ = task_.within > 0;
    if (has_sides_) data_weight_ = weight_of_sides();
    for (int grid = 0; grid < grids_of_corners; ++grid) {
      most_work_ = std::max(most_work_, static_cast<std::size_t>(task_.most_steps) * found_.curve.size());
      weights_ = weights_of_change(found_.curve, task_.evenly);
      find_places_between();
      if (has_sides_ && grid == 0) nothing_left_ = next_to_no_energy * merit();
      if (task_.rms > 0)
        go_to_rms();
      else
        go(most_steps_of_corners);
      take_new_nodes(with_new_nodes(found_.curve, least_spacing()));
    }
    hold_corners();
  }

  void hold_corners() {
    for (std::uint32_t i = 0; i < found_.curve.size(); ++i) {
      if (found_.curve.node(i).corner) found_.curve.hold(i);
    }
  }

  void take_new_nodes(DenseCurve now) {
    carry_places(found_.curve, now, found_.points);
    found_.curve = std::move(now);
  }

  /// That move, across the edge after and that before in turns.
  [[nodiscard]] bool has_corners() const {
    for (std::uint32_t i = 0; i < found_.curve.size(); ++i) {
      if (found_.curve.node(i).corner && !found_.curve.node(i).held) return true;
    }
    return false;
  }

  /// left: of what nodes are bent by more than they may be, so much may stay. price: of what is a whole bound beyond
  /// it, half of that; 0: nothing may be.
  CurveProgram<K> program(double left, double price) {
    CurveProgram<K> program(found_.curve, plane_, ahead_);
    bounded_.clear();
    const auto set_bound = [&](CurvePoint& point, double bound, double share) {
      point.bound = share * bound;
      if (bound > 0) point.price = price / bound;
    };
    if (springs_) {
      program.add_springs(1);
    } else {
      program.add_variation(weights_);
      program.add_bending(tie_break);
    }
    for (CurvePoint& point : found_.points) {
      if (!(point.weight > 0) || found_.curve.is_at_held(point.at)) continue;
      CurvePoint aimed = point;
      set_bound(aimed, point.bound, aimed_share);
      const std::size_t row = program.add_point(aimed, data_weight_);
      if (point.bound > 0) bounded_.push_back({&point.bound, row, 0});
    }
    for (PolylineBound& one : between_) {
      const Vector3 place = found_.curve.at(one.at);
      if (!(task_.within > 0) && one.distance(place) < far_share * one.bound) continue;
      CurvePoint point;
      point.place = one.nearest(place);
      point.at = one.at;
      set_bound(point, one.bound, aimed_share_of_way);
      // Nodes go across the curve, which may go across the polyline, as at tips.
      const double along = (place - point.place).dot(found_.curve.direction(one.at));
      const double across = std::sqrt(std::max(0.0, point.bound * point.bound - along * along));
      point.bound = std::max(across, least_share_across * point.bound);
      bounded_.push_back({&one.bound, program.add_bound(point), along});
    }
    if (damping_ > 0) program.add_damping(damping_);
    if (task_.least_radius > 0)
      program.add_greatest_curvature(std::max(aimed_share, left * greatest_bend()) / task_.least_radius);
    return program;
  }

  [[nodiscard]] double merit() const {
    const DenseCurve& curve = found_.curve;
    double sum = springs_ ? bending() : 0;
    for (std::uint32_t b = 0; b < curve.size() && !springs_; ++b) {
      if (!curve.is_edge(b)) continue;
      const auto first = curve.curvature_row(b, true);
      const auto second = curve.curvature_row(curve.next(b), false);
      if (first.count == 0 || second.count == 0) continue;
      const Vector3 along = (curve.place(curve.next(b)) - curve.place(b)).normalized();
      const Vector3 change = second.curvature - first.curvature;
      sum += weights_[b] * (change.squaredNorm() - std::pow(change.dot(along), 2));
    }
    if (data_weight_ > 0) {
      for (const CurvePoint& point : found_.points)
        sum += data_weight_ * point.weight * curve.offset(point.at, point.place).squaredNorm();
    }
    if (has_sides_) sum += tie_break * bending();
    return sum;
  }

  [[nodiscard]] double bending() const {
    const DenseCurve& curve = found_.curve;
    double sum = 0;
    for (std::uint32_t i = 0; i < curve.size(); ++i) {
      const std::uint32_t before = curve.before(i);
      if (curve.is_edge(i)) sum += curve.edge_length(i) / 2 * curve.curvature_row(i, true).curvature.squaredNorm();
      if (before != DenseCurve::none)
        sum += curve.edge_length(before) / 2 * curve.curvature_row(i, false).curvature.squaredNorm();
    }
    return sum;
  }

  /// Those that were paid for, to where the step goes.
  void loosen_bounds(const BallSolution& solution) {
    gives_way_ = true;
    for (const auto& [bound, row, along] : bounded_) {
      const double away = std::hypot(solution.distances[row], along);
      if (away > *bound) *bound = loosened * away;
    }
  }

  /// All to where they are.
  void loosen_bounds() {
    gives_way_ = true;
    for (CurvePoint& point : found_.points) {
      const double away = found_.curve.offset(point.at, point.place).norm();
      if (point.bound > 0) point.bound = std::max(point.bound, loosened * away);
    }
    for (PolylineBound& one : between_)
      one.bound = std::max(one.bound, loosened * one.distance(found_.curve.at(one.at)));
  }

  /// The greatest share of its bound that anything is away that can be moved.
  [[nodiscard]] double excess() const {
    double greatest = 0;
    for (const CurvePoint& point : found_.points) {
      if (point.bound > 0 && point.weight > 0 && !found_.curve.is_at_held(point.at))
        greatest = std::max(greatest, found_.curve.offset(point.at, point.place).norm() / point.bound);
    }
    for (const PolylineBound& one : between_)
      greatest = std::max(greatest, one.distance(found_.curve.at(one.at)) / one.bound);
    return greatest;
  }

  /// The greatest share of what is allowed that curvature has; 0 where all is.
  [[nodiscard]] double greatest_bend() const {
    double greatest = 0;
    for (std::uint32_t i = 0; i < found_.curve.size() && task_.least_radius > 0; ++i)
      greatest = std::max(greatest, task_.least_radius * found_.curve.greatest_curvature(i));
    return greatest;
  }

  [[nodiscard]] double rms() const {
    const auto all = squares([](const CurvePoint&) { return true; });
    return all.weights > 0 ? std::sqrt(all.sum / all.weights) : 0;
  }

  struct Squares {
    double sum = 0;
    double weights = 0;
  };

  /// Of the distances of points that count.
  template <typename Counts>
  [[nodiscard]] Squares squares(Counts counts) const {
    Squares result;
    for (const CurvePoint& point : found_.points) {
      if (!counts(point)) continue;
      result.sum += point.weight * found_.curve.offset(point.at, point.place).squaredNorm();
      result.weights += point.weight;
    }
    return result;
  }

  /// The root mean square that all points have where those that can be moved have what is asked for, if that is so much
  /// more that they would have to follow their noise to make up for the others.
  [[nodiscard]] double rms_to_reach() const {
    const Squares at_held = squares([&](const CurvePoint& point) { return found_.curve.is_at_held(point.at); });
    const double weights = weight();
    const double wanted = task_.rms * task_.rms;
    const double left = wanted * weights - at_held.sum;
    const double movable = weights - at_held.weights;
    if (left >= std::pow(least_share_of_rms, 2) * wanted * movable) return task_.rms;
    return std::sqrt((wanted * movable + at_held.sum) / weights);
  }

  [[nodiscard]] double weight() const {
    double weights = 0;
    for (const CurvePoint& point : found_.points) weights += point.weight;
    return weights;
  }

  /// What holds a wave of the whole length half.
  [[nodiscard]] double weight_of_wave() const {
    const double length = this->length();
    return std::pow(2 * std::numbers::pi / length, 6) * length / weight();
  }

  /// Next to nothing beside least bending, as that is beside least change of curvature: so that sides which are
  /// straight go through the middle of their points.
  [[nodiscard]] double weight_of_sides() const {
    const double length = this->length();
    return next_to_no_weight * tie_break * std::pow(2 * std::numbers::pi / length, 4) * length / weight();
  }

  /// The least weight of points with which they are near enough. From the fairest curve that has none of them much
  /// further away: with small weights alone a curve may go anywhere.
  void go_to_rms() {
    if (data_weight_ == 0) {
      for (CurvePoint& point : found_.points) {
        const double away = found_.curve.offset(point.at, point.place).norm();
        point.bound = std::max(bound_of_rms * task_.rms, loosened * away);
      }
      go();
      for (CurvePoint& point : found_.points) point.bound = 0;
      if (rms() <= rms_to_reach()) return;
      // As much as the energy is.
      const double of_wave = weight_of_wave();
      data_weight_ = std::max(merit() / (weight() * std::pow(task_.rms, 2)), of_wave);
      least_weight_ = next_to_no_weight * of_wave;
    }
    const double wanted = rms_to_reach();
    double near = 0;
    double far = 0;
    double nearest = std::numeric_limits<double>::infinity();
    int without_gain = 0;
    CurveFound best = found_;
    for (int trial = 0; trial < most_trials_of_weight; ++trial) {
      go();
      const double figure = rms();
      if (figure <= wanted) {
        near = data_weight_;
        best = found_;
        if (figure >= near_rms * wanted || (far > 0 && near < 1.02 * far)) break;
        // A curve of no energy at all is nearer than it need be.
        if (data_weight_ < least_weight_) {
          best.converged = true;
          break;
        }
      } else {
        far = data_weight_;
        if (near == 0) {
          // Where larger weights lead no nearer, they only make it follow the noise.
          without_gain = figure > no_nearer * nearest ? without_gain + 1 : 0;
          if (without_gain == most_without_gain) break;
          nearest = figure;
          best = found_;
        } else {
          const int steps = found_.steps;
          found_ = best;
          found_.steps = steps;
        }
      }
      if (near > 0 && far > 0)
        data_weight_ = std::sqrt(near * far);
      else
        data_weight_ *= near > 0 ? 1 / stride_of_weight : stride_of_weight;
    }
    if (near > 0) data_weight_ = near;
    const int steps = found_.steps;
    found_ = std::move(best);
    found_.steps = steps;
  }

  /// More nodes where edges turn much; false where none do.
  bool refine() {
    DenseCurve now = with_new_nodes(found_.curve, least_spacing());
    if (now.size() <= found_.curve.size() + found_.curve.size() / 20) return false;
    take_new_nodes(std::move(now));
    return true;
  }

  void measure() {
    found_.rms = rms();
    for (const CurvePoint& point : found_.points)
      found_.greatest = std::max(found_.greatest, found_.curve.offset(point.at, point.place).norm());
    if (task_.in_order) between_ = polyline_bounds(found_.curve, found_.points, reach());
    found_.beyond = excess();
  }

  const CurveFitTask& task_;
  const std::function<void(double)>& progress_;
  Vector3 plane_;
  bool springs_;  ///< and no least change of curvature
  CurveFound found_;
  std::vector<double> weights_;
  std::vector<PolylineBound> between_;
  struct Bounded {
    double* bound;
    std::size_t row;  ///< of the program
    double along;     ///< how far away along the curve, which no step changes
  };
  std::vector<Bounded> bounded_;
  bool gives_way_ = false;  ///< whether a bound does
  double data_weight_ = 0;
  double least_weight_ = 0;
  double damping_ = 0;
  bool has_sides_ = false;   ///< between corners, within a tolerance
  double nothing_left_ = 0;  ///< energy of sides that are as good as straight
  bool ahead_ = true;        ///< corners go across the edges after them
  std::size_t work_ = 0;     ///< nodes, each for every step
  std::size_t most_work_ = 0;
};

}  // namespace

std::vector<std::pair<Index, double>> robust_deviations(const CurveFitTask& task) {
  const std::function<void(double)> none = [](double) {};
  return task.plane ? CurveFitter<1>(task, none).deviations() : CurveFitter<2>(task, none).deviations();
}

double rms_of_noise(const CurveFitTask& task) {
  const std::function<void(double)> none = [](double) {};
  return task.plane ? CurveFitter<1>(task, none).rms_of_noise() : CurveFitter<2>(task, none).rms_of_noise();
}

CurveFound start_of(const CurveFitTask& task) {
  const std::function<void(double)> none = [](double) {};
  return task.plane ? CurveFitter<1>(task, none).start() : CurveFitter<2>(task, none).start();
}

CurveFound fit_curve(const CurveFitTask& task, const std::function<void(double share)>& progress) {
  return task.plane ? CurveFitter<1>(task, progress).run() : CurveFitter<2>(task, progress).run();
}

}  // namespace vspring
