#include "curve_fit/curve_descent.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/cancellation.hpp"
#include "curve_fit/curve_lengths.hpp"

namespace vspring {

namespace {

// Share of a tolerance to aim at, so that nonlinearity of a step does not exceed it.
constexpr double aimed_share = 0.995;
// Share of the curve's allowed distance from the polyline, so that it is not exceeded between nodes.
constexpr double aimed_share_of_way = 0.98;
// Least share of that left across the curve, if most of the distance is along it.
constexpr double least_share_across = 0.01;
// Steps that change less of the energy have converged.
constexpr double settled_energy = 1e-4;
// Energies, times the third power of the length, of circles and straight lines: curvature changes by less than a
// 3,000th of one over the length. Many of them are within a tolerance, and steps would go on from one to the next.
constexpr double round_energy = 1e-7;
// Turn of an edge, in radians.
constexpr double greatest_turn_of_step = 0.5;
constexpr int most_halvings = 6;
// Price, in energies, for a distance of two bounds.
constexpr double price_of_bounds = 1e3;
// Shares of an excessive greatest curvature that a step leaves, from one try to the next.
constexpr double curvature_left[] = {0.5, 0.9, 0.98, 1};

}  // namespace

template <int K>
CurveDescent<K>::CurveDescent(const CurveFitTask& task)
    : task_(task), plane_(task.plane.value_or(Vector3::Zero())), springs_(task.smoothing > 0 || task.weight > 0) {}

template <int K>
void CurveDescent<K>::begin_grid() {
  weights_ = weights_of_change(found.curve, task_.evenly);
  spare_.assign(found.curve.size(), 0);
  find_places_between();
  for (const PolylineBound& one : between_) {
    double& spare = spare_[one.at.edge];
    if (!(task_.within > 0)) spare = std::max(spare, loosened * one.distance(found.curve.at(one.at)));
  }
  find_places_between();
}

template <int K>
void CurveDescent<K>::go(int most_steps) {
  find_places(found.curve, found.points);
  energy_ = merit();
  excess_ = excess();
  bent_ = greatest_bend();
  left_ = std::begin(curvature_left);
  last_step_ = std::numeric_limits<double>::infinity();
  const int sides = has_corners() ? 2 : 1;
  int sides_done = 0;
  for (int step = 0; step < most_steps && !is_out_of_work(); ++step) {
    end_if_cancelled();
    ++found.steps;
    const std::optional<Step> next = find_step();
    if (!next) return;
    const double last_energy = energy_;
    const double share = take(*next);
    if (share == 0) {
      found.converged = found_ && bent_ <= 1;
      ahead_ = !ahead_;
      if (++sides_done < sides) continue;
      return;
    }
    if (!gives_way_) {
      // Other pieces of the polyline may be nearer now.
      find_places_between();
      excess_ = std::max(1.0, excess());
    }
    last_step_ = next->greatest * share;
    found.error = last_step_;
    ahead_ = !ahead_;
    if (!is_settled(share, last_energy)) {
      sides_done = 0;
      continue;
    }
    found.converged = bent_ <= 1;
    if (++sides_done == sides) return;
  }
  found.converged = false;
}

/// None if nothing moves, or the step is unbounded.
template <int K>
auto CurveDescent<K>::find_step() -> std::optional<Step> {
  std::optional<CurveProgram<K>> program;
  BallSolution solution;
  const auto solve = [&](double left, double price) {
    program.emplace(this->program(left, price));
    solution = program->solve();
    spent_ += found.curve.size() * static_cast<std::size_t>(std::max(1, solution.steps));
    found_ = solution.found;
    return found_;
  };
  // A reduction that was too much for one step is too much for the next.
  bool met = solve(*left_, 0);
  while (!met && task_.least_radius > 0 && left_ + 1 != std::end(curvature_left) && !is_out_of_work())
    met = solve(*++left_, 0);
  if (program->blocks() == 0) {
    found.converged = true;
    return std::nullopt;
  }
  if (!met) {
    // Bounds that cannot be kept, together with all others or at a price.
    if (solve(1, price_of_bounds * energy_))
      loosen_bounds(solution);
    else
      loosen_bounds();
    excess_ = excess();
  }
  Step step = measured(*program, solution);
  if (std::isfinite(step.greatest)) return step;
  found.converged = false;
  return std::nullopt;
}

template <int K>
auto CurveDescent<K>::measured(const CurveProgram<K>& program, const BallSolution& solution) const -> Step {
  const DenseCurve& curve = found.curve;
  Step step;
  step.moves.assign(curve.size(), Vector3::Zero());
  program.for_moves(solution, [&](std::uint32_t i, const Vector3& move) { step.moves[i] = move; });
  for (std::uint32_t i = 0; i < curve.size(); ++i) {
    if (!step.moves[i].allFinite()) step.greatest = std::numeric_limits<double>::infinity();
    step.greatest = std::max(step.greatest, step.moves[i].norm());
    if (!curve.is_edge(i)) continue;
    step.turn = std::max(step.turn, (step.moves[curve.next(i)] - step.moves[i]).norm() / curve.edge_length(i));
  }
  return step;
}

/// Returns the share of the step that was taken: 0 if none is better.
template <int K>
double CurveDescent<K>::take(const Step& step) {
  const DenseCurve before = found.curve;
  const std::vector<CurvePoint> places = found.points;
  double share = step.turn > greatest_turn_of_step ? greatest_turn_of_step / step.turn : 1;
  for (int half = 0; half < most_halvings; ++half, share /= 2) {
    for (std::uint32_t i = 0; i < before.size(); ++i) found.curve.set_place(i, before.place(i) + share * step.moves[i]);
    found.points = places;
    find_places(found.curve, found.points);
    const double now = merit();
    const double beyond = std::max(1.0, excess());
    const double bend = std::max(1.0, greatest_bend());
    // Bounds come first: a curve beyond them may well be fairer. Springs have no energy of their own; near their
    // balance steps become smaller from one to the next.
    const bool better = excess_ > 1 ? beyond < excess_
                                    : beyond <= 1 && (now < energy_ || bend < bent_ ||
                                                      (springs_ && share == 1 && step.greatest < last_step_));
    if (!better || bend > std::max(1.0, bent_)) continue;
    energy_ = now;
    excess_ = beyond;
    bent_ = bend;
    return share;
  }
  found.curve = before;
  found.points = places;
  return 0;
}

/// Whether the curve is the fairest after a share of a step.
template <int K>
bool CurveDescent<K>::is_settled(double share, double last_energy) const {
  if (excess_ > 1) return false;
  if (last_step_ < task_.tolerance) return true;
  if (springs_ || bent_ > 1) return false;
  if (share == 1 && last_energy - energy_ <= settled_energy * last_energy) return true;
  const bool is_round = data_weight == 0 && energy_ * std::pow(length_of(found.curve), 3) <= round_energy;
  return is_round || energy_ <= nothing_left;
}

template <int K>
void CurveDescent<K>::find_places_between() {
  gives_way_ = false;
  between_.clear();
  if (!task_.in_order) find_places(found.curve, found.way);
  between_ = polyline_bounds(found.curve, way(), reach(), {.everywhere = task_.way_share < 1});
  for (PolylineBound& one : between_) one.bound = std::max(task_.way_share * one.bound, spare_[one.at.edge]);
}

/// How far from the polyline places may be: with points only, a sharp turn would become a wide loop.
template <int K>
double CurveDescent<K>::reach() const {
  if (task_.within > 0) return task_.within;
  if (task_.rms > 0) return reach_of_rms * task_.rms;
  double reach = reach_of_rms * task_.noise;
  for (const CurvePoint& point : found.points)
    reach = std::max(reach, found.curve.offset(point.at, point.place).norm());
  return reach;
}

template <int K>
bool CurveDescent<K>::has_corners() const {
  for (std::uint32_t i = 0; i < found.curve.size(); ++i) {
    if (found.curve.node(i).corner && !found.curve.node(i).held) return true;
  }
  return false;
}

template <int K>
CurveProgram<K> CurveDescent<K>::program(double left, double price) {
  CurveProgram<K> program(found.curve, plane_, ahead_);
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
  for (CurvePoint& point : found.points) {
    if (!(point.weight > 0) || found.curve.is_at_held(point.at)) continue;
    CurvePoint aimed = point;
    set_bound(aimed, point.bound, aimed_share);
    const std::size_t row = program.add_point(aimed, data_weight);
    if (point.bound > 0) bounded_.push_back({&point.bound, row, 0});
  }
  for (PolylineBound& one : between_) {
    const Vector3 place = found.curve.at(one.at);
    CurvePoint point;
    point.place = one.nearest(place);
    point.at = one.at;
    set_bound(point, one.bound, aimed_share_of_way);
    // Nodes move across the curve, which may cross the polyline, as at tips.
    const double along = (place - point.place).dot(found.curve.direction(one.at));
    const double across = std::sqrt(std::max(0.0, point.bound * point.bound - along * along));
    point.bound = std::max(across, least_share_across * point.bound);
    bounded_.push_back({&one.bound, program.add_bound(point), along});
  }
  if (task_.least_radius > 0)
    program.add_greatest_curvature(std::max(aimed_share, left * greatest_bend()) / task_.least_radius);
  return program;
}

template <int K>
double CurveDescent<K>::merit() const {
  const DenseCurve& curve = found.curve;
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
  if (data_weight > 0) {
    for (const CurvePoint& point : found.points)
      sum += data_weight * point.weight * curve.offset(point.at, point.place).squaredNorm();
  }
  if (has_sides) sum += tie_break * bending();
  return sum;
}

template <int K>
double CurveDescent<K>::bending() const {
  const DenseCurve& curve = found.curve;
  double sum = 0;
  for (std::uint32_t i = 0; i < curve.size(); ++i) {
    const std::uint32_t before = curve.before(i);
    if (curve.is_edge(i)) sum += curve.edge_length(i) / 2 * curve.curvature_row(i, true).curvature.squaredNorm();
    if (before != DenseCurve::none)
      sum += curve.edge_length(before) / 2 * curve.curvature_row(i, false).curvature.squaredNorm();
  }
  return sum;
}

/// Moves exceeded bounds with a price to where the step goes.
template <int K>
void CurveDescent<K>::loosen_bounds(const BallSolution& solution) {
  gives_way_ = true;
  for (const auto& [bound, row, along] : bounded_) {
    const double away = std::hypot(solution.distances[row], along);
    if (away > *bound) *bound = loosened * away;
  }
}

/// Moves all bounds to the present distances.
template <int K>
void CurveDescent<K>::loosen_bounds() {
  gives_way_ = true;
  for (CurvePoint& point : found.points) {
    const double away = found.curve.offset(point.at, point.place).norm();
    if (point.bound > 0) point.bound = std::max(point.bound, loosened * away);
  }
  for (PolylineBound& one : between_) one.bound = std::max(one.bound, loosened * one.distance(found.curve.at(one.at)));
}

/// The greatest distance, as a share of its bound, of anything that can be moved.
template <int K>
double CurveDescent<K>::excess() const {
  double greatest = 0;
  for (const CurvePoint& point : found.points) {
    if (point.bound > 0 && point.weight > 0 && !found.curve.is_at_held(point.at))
      greatest = std::max(greatest, found.curve.offset(point.at, point.place).norm() / point.bound);
  }
  for (const PolylineBound& one : between_)
    greatest = std::max(greatest, one.distance(found.curve.at(one.at)) / one.bound);
  return greatest;
}

/// The greatest curvature as a share of the allowed one; 0 if any is allowed.
template <int K>
double CurveDescent<K>::greatest_bend() const {
  double greatest = 0;
  for (std::uint32_t i = 0; i < found.curve.size() && task_.least_radius > 0; ++i)
    greatest = std::max(greatest, task_.least_radius * found.curve.greatest_curvature(i));
  return greatest;
}

template <int K>
double CurveDescent<K>::measured_excess() {
  between_ = polyline_bounds(found.curve, way(), reach());
  return excess();
}

template class CurveDescent<1>;
template class CurveDescent<2>;

}  // namespace vspring
