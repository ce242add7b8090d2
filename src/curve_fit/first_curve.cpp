#include "curve_fit/first_curve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/median.hpp"
#include "base/threads.hpp"
#include "curve_fit/curve_lengths.hpp"
#include "curve_fit/scattered_way.hpp"
#include "noise/noisy_places.hpp"
#include "shape/box_tree.hpp"
#include "shape/segment.hpp"

namespace vspring {

namespace {

using Node = DenseCurve::Node;

// Share of a tolerance that the start uses; the rest is left for making it fairer.
constexpr double first_share = 0.95;
constexpr int starts = 2;
constexpr int robust_starts = 2;
constexpr int risk_starts = 4;
// In units of the noise: smaller deviations mean nothing.
constexpr double least_deviation = 0.5;
constexpr double times_noise = 3;
// In tolerances, or smoothing lengths: closer nodes tell nothing.
constexpr double closest_spacing = 0.05;
// In units of the noise beyond a share of an edge.
constexpr double least_smoothing_of_noise = 4;
constexpr double edges_of_noise = 0.4;
// Spacing of nodes, in smoothing lengths.
constexpr double spacing_of_springs = 0.25;

/// About how far the curve may go from the polyline of the points.
double reach_of_way(const CurveFitTask& task) { return std::max(task.within, times_noise * task.noise); }

/// A task's curve before any program is solved.
class FirstCurve {
 public:
  explicit FirstCurve(const CurveFitTask& task) : task_(task) {}

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
    const double deviation = std::max(median(sorted) / median_of_noise, least_deviation * task_.noise);
    std::vector<std::pair<Index, double>> result;
    for (std::size_t j = 0; j < distances.size(); ++j)
      result.emplace_back(found_.points[j].number, distances[j] / deviation);
    return result;
  }

  CurveFound least_risk() {
    begin_on_way();
    LeastRisk found;
    for (int k = 0; k < risk_starts && !found_.points.empty(); ++k) {
      found = smooth_out_by_risk(found_.curve, found_.points, task_.noise, task_.plane ? 1 : 2, found.smoothing);
      find_places(found_.curve, found_.points);
      take_new_nodes(found_, with_new_nodes(found_.curve, least_spacing(task_)));
    }
    find_all_places();
    found_.rms = found.rms;
    return std::move(found_);
  }

  CurveFound smoothed() {
    begin_on_way();
    if (found_.points.empty()) return std::move(found_);
    for (int k = 0; k < starts; ++k) {
      smooth_out_at_first();
      find_all_places();
      take_new_nodes(found_, with_new_nodes(found_.curve, least_spacing(task_)));
    }
    smooth_out_at_first();
    find_all_places();
    return std::move(found_);
  }

 private:
  void begin_on_way() {
    const StartScale scale{task_.noise, reach_of_way(task_), task_.sharp};
    found_.curve = DenseCurve(false, task_.moving);
    for (const auto& chain : task_.chains) add_start(chain.nodes, chain.closed, scale, found_.curve, found_.points);
    find_scattered();
    if (!task_.in_order) {
      found_.way = way_of_scattered(found_.curve, found_.points, gap_of_way());
      fit_ends(found_);
    }
    set_bounds(task_, found_);
  }

  /// With weights, points may be anywhere.
  [[nodiscard]] double gap_of_way() const {
    double gap = reach_of_way(task_);
    if (task_.within > 0 || task_.rms > 0) return gap;
    for (const CurvePoint& point : found_.points)
      gap = std::max(gap, found_.curve.offset(point.at, point.place).norm());
    return gap;
  }

  void find_all_places() {
    find_places(found_.curve, found_.points);
    find_places(found_.curve, found_.way);
    fit_ends(found_);
  }

  void smooth_out_at_first() {
    if (task_.smoothing > 0 || task_.weight > 0) {
      set_smoothing();
      smooth_out_by(found_.curve, found_.points, found_.smoothing);
      for (std::uint32_t i = 0; i < found_.curve.size(); ++i)
        found_.curve.set_spacing(i, std::min(found_.curve.node(i).spacing, spacing_of_springs * found_.smoothing));
    } else {
      smooth_out(found_.curve, points_and_way(), first_share * task_.within, first_share * task_.rms);
    }
  }

  /// Where there are no points, the way shows where the curve goes.
  [[nodiscard]] std::vector<CurvePoint> points_and_way() const {
    std::vector<CurvePoint> all = found_.points;
    for (const CurvePoint& row : found_.way) {
      if (row.weight > 0) continue;
      all.push_back(row);
      all.back().weight = 1;
    }
    return all;
  }

  void set_smoothing() {
    const double length = length_of(found_.curve);
    found_.smoothing = task_.smoothing;
    if (task_.weight > 0) found_.smoothing = length / task_.edges * std::pow(8 * task_.weight, -0.25);
    // If noise is longer than edges there is no way through all points.
    const double noise = task_.noise - edges_of_noise * length / task_.edges;
    found_.smoothing = std::max(found_.smoothing, least_smoothing_of_noise * noise);
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

  const CurveFitTask& task_;
  CurveFound found_;
};

bool is_free_end(const DenseCurve& curve, std::uint32_t node) {
  const bool is_end = curve.before(node) == DenseCurve::none || curve.next(node) == DenseCurve::none;
  return is_end && !curve.node(node).held && curve.tangent(node, true).isZero(0);
}

/// The places of points and of the way that are nearest to the ends of a chain.
struct Outermost {
  std::optional<CurvePlace> first, last;
};

std::vector<Outermost> outermost_places(const CurveFound& found) {
  std::vector<Outermost> of_chains(found.curve.chains().size());
  const auto order = [](const CurvePlace& at) { return std::pair(at.edge, at.share); };
  for (const auto* points : {&found.points, &found.way}) {
    for (const CurvePoint& point : *points) {
      auto& [first, last] = of_chains[found.curve.chain_of(point.at.edge)];
      if (!first || order(point.at) < order(*first)) first = point.at;
      if (!last || order(point.at) > order(*last)) last = point.at;
    }
  }
  return of_chains;
}

/// The mean vector from an end to the points whose nearest place it is, as far as they lie ahead.
Vector3 ahead_of_end(const CurveFound& found, const CurvePlace& end, bool at_last) {
  const Vector3 out = (at_last ? 1 : -1) * found.curve.direction(end);
  double furthest = 0;
  for (const CurvePoint& point : found.points) {
    if (point.at.edge == end.edge && point.at.share == end.share)
      furthest = std::max(furthest, out.dot(point.place - found.curve.at(end)));
  }
  return furthest * out;
}

/// nodes: of the chain; those beyond the new place of its last end may be missing.
void fit_end(const CurveFound& found, const DenseCurve::Chain& chain, const std::optional<CurvePlace>& outermost,
             bool at_last, std::vector<Node>& nodes) {
  const std::uint32_t end = at_last ? chain.count - 1 : 0;
  if (!is_free_end(found.curve, chain.begin + end) || !outermost) return;
  // The first or last node that stays.
  const std::uint32_t first = outermost->edge - chain.begin + (at_last ? 1 : 0);
  if (first == end && outermost->share == (at_last ? 1 : 0)) {
    nodes[end].place += ahead_of_end(found, *outermost, at_last);
    return;
  }
  const auto begin = nodes.begin() + static_cast<std::ptrdiff_t>(at_last ? first : 0);
  const auto last = at_last ? nodes.end() : nodes.begin() + static_cast<std::ptrdiff_t>(first) + 1;
  if (std::any_of(begin, last, [](const Node& node) { return !node.dense; })) return;
  nodes[first].place = found.curve.at(*outermost);
  at_last ? nodes.erase(begin + 1, last) : nodes.erase(begin, last - 1);
}

}  // namespace

double least_spacing(const CurveFitTask& task) {
  return closest_spacing * std::max(reach_of_way(task), task.smoothing);
}

void fit_ends(CurveFound& found) {
  // Coordinates that do not move determine the end.
  if (!found.curve.moves_freely()) return;
  bool any = false;
  for (std::uint32_t i = 0; i < found.curve.size(); ++i) any = any || is_free_end(found.curve, i);
  if (!any) return;
  const std::vector<Outermost> outermost = outermost_places(found);
  DenseCurve fitted(false, found.curve.moving());
  for (std::size_t c = 0; c < found.curve.chains().size(); ++c) {
    const auto& chain = found.curve.chains()[c];
    std::vector<Node> nodes;
    for (std::uint32_t k = 0; k < chain.count; ++k) nodes.push_back(found.curve.node(chain.begin + k));
    if (!chain.closed && nodes.size() > 2) {
      // The last end first: cutting off nodes at the first end changes the numbers of nodes.
      fit_end(found, chain, outermost[c].last, true, nodes);
      fit_end(found, chain, outermost[c].first, false, nodes);
    }
    fitted.add_chain(nodes, chain.closed);
  }
  take_new_nodes(found, std::move(fitted));
}

void set_bounds(const CurveFitTask& task, CurveFound& found) {
  for (CurvePoint& point : found.points) {
    const auto number = static_cast<std::size_t>(point.number);
    point.bound = task.within - (point.number >= 0 && !task.spare.empty() ? task.spare[number] : 0);
  }
}

void take_new_nodes(CurveFound& found, DenseCurve now) {
  carry_places(found.curve, now, found.points);
  carry_places(found.curve, now, found.way);
  found.curve = std::move(now);
}

std::vector<std::pair<Index, double>> robust_deviations(const CurveFitTask& task) {
  return FirstCurve(task).deviations();
}

CurveFound curve_of_least_risk(const CurveFitTask& task) { return FirstCurve(task).least_risk(); }

CurveFound start_of(const CurveFitTask& task) { return FirstCurve(task).smoothed(); }

}  // namespace vspring
