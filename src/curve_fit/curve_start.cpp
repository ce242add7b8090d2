#include "curve_fit/curve_start.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "base/cancellation.hpp"
#include "base/dense_algebra.hpp"
#include "curve_fit/way_corners.hpp"
#include "shape/segment.hpp"

namespace vspring {

namespace {

// Of the noise: rows that are nearer together tell nothing of the way.
constexpr double reach_of_rows = 2;
// Of that, across stations that stay.
constexpr double reach_across = 3;
// How far back rows may go and still be out of order, not on their way back: of that, or of rows and median edges about
// them.
constexpr double reach_of_folds = 5;
constexpr std::size_t most_rows_of_fold = 4;
constexpr double most_edges_of_fold = 10;
// Of how far back: so far aside rows may be of the way that they are put on.
constexpr double most_aside_of_fold = 0.4;
// From one edge to the next, 60°: in an order that has no more rows may lie anywhere.
constexpr double cosine_of_gentle_bend = 0.5;
constexpr std::size_t rows_beside_fold = 3;
constexpr std::size_t rows_about = 8;
constexpr int most_turns_of_folds = 10;
// Nodes on a straight piece of the polyline within the tolerance, and on the arc of a turn.
constexpr double edges_of_piece = 12;
// Of mean edges of the rows: nodes need not be denser, but at corners.
constexpr double least_share_of_rows = 0.5;
constexpr double least_share_of_tolerance = 0.5;
constexpr double steepest = 0.25;
constexpr double edges_between_held = 8;
// Of the length.
constexpr double least_spacing = 1e-5;
constexpr double greatest_half_turn = 1.3;
constexpr double greatest_turn_of_edge = 0.3;
constexpr double most_nodes = 4e6;

using Node = DenseCurve::Node;

/// Rows that are one place of the way.
struct Stop {
  Vector3 place;
  double rows = 0;
  bool fixed = false;
  std::size_t node = 0;  ///< of the chain: the first of its rows
  bool corner = false;   ///< that was found
};

/// The places that the rows of a chain go along, in order.
class Way {
 public:
  /// along: for its station().
  Way(const std::vector<ChainNode>& chain, bool closed, const StartScale& scale, const DenseCurve& along)
      : chain_(chain), closed_(closed), reach_(reach_of_rows * scale.noise), along_(along) {
    joined_with_.resize(chain.size());
    find_turns();
    for (std::size_t k = 0; k < chain.size(); ++k) add(k);
    join_seam();
    if (scale.sharp > 0) find_corners(scale);
    leave_out_next_to_fixed();
    for (int turn = 0; turn < most_turns_of_folds && undo_folds(); ++turn) {
    }
    leave_out_turns_at_ends();
  }

  std::vector<Stop> stops;

  /// The first row of the stop that a row belongs to.
  [[nodiscard]] std::size_t first_row(std::size_t row) const {
    while (joined_with_[row] != row) row = joined_with_[row];
    return row;
  }

  /// Of those that a stop begins with, one after the other.
  [[nodiscard]] std::size_t middle_row(const Stop& stop) const {
    std::size_t end = stop.node + 1;
    while (end < chain_.size() && first_row(end) == stop.node) ++end;
    return stop.node + (end - stop.node) / 2;
  }

 private:
  /// Rows where stations that stay go as far as they do before they come back: no other row could take their place.
  void find_turns() {
    turns_.assign(chain_.size(), 0);
    if (along_.moves_freely() || chain_.size() < 2) return;
    std::vector<double> edges;
    Vector3 axis = Vector3::Zero();
    for (std::size_t k = 1; k < chain_.size(); ++k) {
      const Vector3 away = station(chain_[k].place - chain_.front().place);
      if (away.norm() > axis.norm()) axis = away;
      edges.push_back(station(chain_[k].place - chain_[k - 1].place).norm());
    }
    axis.normalize();
    const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
    std::nth_element(edges.begin(), middle, edges.end());
    const double least = std::max(reach_of_folds * reach_, most_edges_of_fold * *middle);
    // How far it has come since the last turn, and back since then.
    std::size_t lowest = 0;
    std::size_t highest = 0;
    int way = 0;
    for (std::size_t k = 0; k < chain_.size() * (closed_ ? 2 : 1); ++k) {
      const std::size_t row = k % chain_.size();
      const auto at = [&](std::size_t other) { return axis.dot(chain_[other].place); };
      if (at(row) > at(highest)) highest = row;
      if (at(row) < at(lowest)) lowest = row;
      if (way >= 0 && at(row) < at(highest) - least) {
        if (way > 0 || closed_) turns_[highest] = 1;
        way = -1;
        lowest = row;
      } else if (way <= 0 && at(row) > at(lowest) + least) {
        if (way < 0 || closed_) turns_[lowest] = 1;
        way = 1;
        highest = row;
      }
    }
  }

  void add(std::size_t k) {
    const ChainNode& node = chain_[k];
    const bool fixed = node.held || node.corner || !node.tangents[1].isZero(0) || turns_[k] != 0;
    joined_with_[k] = k;
    if (!fixed && !stops.empty() && !stops.back().fixed && are_one(node.place, stops.back().place)) {
      join(stops.back(), {node.place, 1, false, k});
      return;
    }
    stops.push_back({node.place, 1, fixed, k});
  }

  /// Where stations stay, rows may be noise apart across them.
  [[nodiscard]] bool are_one(const Vector3& a, const Vector3& b) const {
    const double most = along_.moves_freely() ? reach_ : reach_across * reach_;
    return station(b - a).norm() <= reach_ && (b - a).norm() <= most;
  }

  [[nodiscard]] Vector3 station(const Vector3& v) const { return along_.station(v); }

  void join(Stop& a, const Stop& b) {
    a.place = (a.rows * a.place + b.rows * b.place) / (a.rows + b.rows);
    a.rows += b.rows;
    joined_with_[b.node] = a.node;
  }

  void join_seam() {
    while (closed_ && stops.size() > 3) {
      const Stop last = stops.back();
      if (last.fixed || stops.front().fixed || !are_one(last.place, stops.front().place)) return;
      join(stops.front(), last);
      stops.pop_back();
    }
  }

  void find_corners(const StartScale& scale) {
    std::vector<Vector3> places;
    std::vector<std::uint8_t> given;
    places.reserve(stops.size());
    for (const Stop& stop : stops) {
      places.push_back(stop.place);
      given.push_back(chain_[stop.node].corner ? 1 : 0);
    }
    for (const std::size_t k : corners_of_way(places, closed_, scale.sharp, scale.tolerance, given)) {
      // A given tangent says how the curve goes there.
      if (!chain_[stops[k].node].tangents[1].isZero(0)) continue;
      stops[k].fixed = stops[k].corner = true;
    }
  }

  /// Its rows are those of a neighbour then.
  void erase(std::size_t k) {
    joined_with_[stops[k].node] = stops[k > 0 ? k - 1 : k + 1].node;
    stops.erase(stops.begin() + static_cast<std::ptrdiff_t>(k));
  }

  /// So that directions there are not those of noise.
  void leave_out_next_to_fixed() {
    const std::size_t least = closed_ ? 3 : 2;
    for (std::size_t k = 0; k < stops.size() && stops.size() > least;) {
      const auto near = [&](std::size_t other) {
        return stops[other].fixed && (stops[other].place - stops[k].place).norm() <= reach_;
      };
      const bool spare = !stops[k].fixed && ((k > 0 || closed_ ? near((k > 0 ? k : stops.size()) - 1) : false) ||
                                             (k + 1 < stops.size() || closed_ ? near((k + 1) % stops.size()) : false));
      if (spare)
        erase(k);
      else
        ++k;
    }
  }

  [[nodiscard]] bool turns_back(std::size_t k) const {
    return station(stops[k].place - stops[k - 1].place).dot(stops[k + 1].place - stops[k].place) < 0;
  }

  /// Where the way goes back and on again within a few rows, or within what is noise, its places there are put in the
  /// order of the way from before to after. False where there is no such place.
  bool undo_folds() {
    bool found = false;
    for (std::size_t k = 1; k + 2 < stops.size(); ++k) {
      if (!turns_back(k)) continue;
      std::size_t end = k + 1;
      while (end + 1 < stops.size() && end - k <= most_rows_of_fold && !turns_back(end)) ++end;
      if (end + 1 >= stops.size() || !turns_back(end)) continue;
      const double back = station(stops[end].place - stops[k].place).norm();
      const bool is_noise = back <= reach_of_folds * reach_;
      if (!is_noise && (end - k > most_rows_of_fold || back > most_edges_of_fold * median_edge(k))) continue;
      found = (is_noise ? join_all(k, end) : put_in_order(k, end, most_aside_of_fold * back)) || found;
    }
    return found;
  }

  bool join_all(std::size_t first, std::size_t last) {
    for (std::size_t j = first; j <= last; ++j) {
      if (stops[j].fixed) return false;
    }
    for (std::size_t j = first + 1; j <= last; ++j) join(stops[first], stops[j]);
    const auto begin = stops.begin() + static_cast<std::ptrdiff_t>(first);
    stops.erase(begin + 1, begin + static_cast<std::ptrdiff_t>(last - first) + 1);
    return true;
  }

  /// Those of a fold, and what is out of order beside it. False where they lie aside of the way that they would be on.
  bool put_in_order(std::size_t first, std::size_t last, double most_aside) {
    const std::size_t begin = first - std::min(first, rows_beside_fold);
    const std::size_t end = std::min(stops.size() - 1, last + rows_beside_fold);
    const Vector3 on = station(stops[end].place - stops[begin].place);
    std::vector<std::size_t> order(end - begin - 1);
    std::iota(order.begin(), order.end(), begin + 1);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return stops[a].place.dot(on) < stops[b].place.dot(on); });
    std::size_t left = begin + 1;
    std::size_t right = end - 1;
    while (left < end && order[left - begin - 1] == left) ++left;
    while (right > left && order[right - begin - 1] == right) --right;
    if (left >= right) return false;
    std::vector<Vector3> places = {stops[left - 1].place};
    for (std::size_t j = left; j <= right; ++j) places.push_back(stops[order[j - begin - 1]].place);
    places.push_back(stops[right + 1].place);
    const bool goes_on = bends_gently(places);
    const Vector3& from = places.front();
    const Vector3& to = places.back();
    for (std::size_t j = left; j <= right; ++j) {
      const Vector3& place = stops[j].place;
      const double away = station(from + nearest_share(place, from, to) * (to - from) - place).norm();
      const bool is_aside = !goes_on && away > std::max(reach_of_folds * reach_, most_aside);
      if (stops[j].fixed || is_aside) return false;
    }
    const std::vector<Stop> before(stops.begin() + static_cast<std::ptrdiff_t>(left),
                                   stops.begin() + static_cast<std::ptrdiff_t>(right) + 1);
    for (std::size_t j = left; j <= right; ++j) stops[j] = before[order[j - begin - 1] - left];
    return true;
  }

  /// As a way in its right order does.
  [[nodiscard]] bool bends_gently(const std::vector<Vector3>& places) const {
    for (std::size_t k = 1; k + 1 < places.size(); ++k) {
      const Vector3 a = station(places[k] - places[k - 1]);
      const Vector3 b = station(places[k + 1] - places[k]);
      if (!(a.dot(b) > cosine_of_gentle_bend * a.norm() * b.norm())) return false;
    }
    return true;
  }

  [[nodiscard]] double median_edge(std::size_t about) const {
    std::vector<double> edges;
    const std::size_t begin = about > rows_about ? about - rows_about : 0;
    for (std::size_t k = begin; k + 1 < std::min(stops.size(), about + rows_about); ++k)
      edges.push_back(station(stops[k + 1].place - stops[k].place).norm());
    const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
    std::nth_element(edges.begin(), middle, edges.end());
    return *middle;
  }

  /// At an end there is no way before.
  void leave_out_turns_at_ends() {
    const double most = reach_of_folds * reach_;
    const auto turns = [&](const Stop& end, const Stop& next, const Stop& beyond) {
      const Vector3 step = station(next.place - end.place);
      return !next.fixed && step.norm() <= most && step.dot(beyond.place - next.place) < 0 &&
             station(beyond.place - end.place).norm() < station(beyond.place - next.place).norm();
    };
    while (!closed_ && stops.size() > 3 && turns(stops[0], stops[1], stops[2])) erase(1);
    while (!closed_ && stops.size() > 3) {
      const std::size_t n = stops.size();
      if (!turns(stops[n - 1], stops[n - 2], stops[n - 3])) break;
      erase(n - 2);
    }
  }

  const std::vector<ChainNode>& chain_;
  bool closed_;
  double reach_;
  const DenseCurve& along_;
  std::vector<std::uint8_t> turns_;
  std::vector<std::size_t> joined_with_;  // of every row that begins a stop, or is in one
};

/// Whether the places of a piece of a way go along a straight line, in their order, within a tolerance.
bool is_straight(std::span<const Vector3> piece, double tolerance) {
  Vector3 middle = Vector3::Zero();
  for (const Vector3& place : piece) middle += place / static_cast<double>(piece.size());
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Vector3& place : piece) squares += (place - middle) * (place - middle).transpose();
  Vector3 along = principal_axes(squares).col(2);
  if (along.dot(piece.back() - piece.front()) < 0) along = -along;
  double furthest = -std::numeric_limits<double>::infinity();
  for (const Vector3& place : piece) {
    const Vector3 away = place - middle;
    const double at = away.dot(along);
    furthest = std::max(furthest, at);
    if (at < furthest - tolerance || (away - at * along).norm() > tolerance) return false;
  }
  return true;
}

/// Marks the vertices of a polyline that stays within a tolerance (Ramer 1972; Douglas and Peucker 1973), or where a
/// straight line does that need not go through the vertices: these have noise, too.
void keep_vertices(const std::vector<Vector3>& way, std::size_t begin, std::size_t end, double tolerance,
                   std::vector<std::uint8_t>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> open = {{begin, end}};
  std::size_t steps = 0;
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    kept[a] = kept[b] = 1;
    double furthest = tolerance;
    std::size_t at = a;
    for (std::size_t k = a + 1; k < b; ++k) {
      end_if_cancelled_at(++steps);
      const double share = nearest_share(way[k], way[a], way[b]);
      const double distance = (way[a] + share * (way[b] - way[a]) - way[k]).norm();
      if (distance > furthest) {
        furthest = distance;
        at = k;
      }
    }
    if (at == a || is_straight(std::span(way).subspan(a, b - a + 1), tolerance)) continue;
    open.emplace_back(a, at);
    open.emplace_back(at, b);
  }
}

double turn_between(const Vector3& a, const Vector3& b) {
  const double lengths = std::sqrt(a.squaredNorm() * b.squaredNorm());
  return lengths > 0 ? std::acos(std::clamp(a.dot(b) / lengths, -1.0, 1.0)) : 0;
}

/// How far apart nodes should be at each vertex of a way. It ends with its first vertex again where closed.
/// sharp: where it need not turn within the tolerance.
std::vector<double> spacing_along(const std::vector<Vector3>& way, const std::vector<std::uint8_t>& fixed,
                                  const std::vector<std::uint8_t>& sharp, bool closed, double tolerance) {
  const std::size_t count = way.size();
  std::vector<std::uint8_t> kept(count, 0);
  for (std::size_t k = 0; k < count; ++k) kept[k] = fixed[k];
  std::size_t first = 0;
  // Of a closed way each half on its own: its ends are one place.
  const std::size_t half = closed && count > 3 ? count / 2 : count - 1;
  keep_vertices(way, 0, half, tolerance, kept);
  if (half + 1 < count) keep_vertices(way, half, count - 1, tolerance, kept);
  std::vector<double> length(count, 0);
  for (std::size_t k = 1; k < count; ++k) length[k] = length[k - 1] + (way[k] - way[k - 1]).norm();
  // Corners move by up to the tolerance, and edges beside them should not turn round then.
  const bool has_corners = std::find(sharp.begin(), sharp.end(), 1) != sharp.end();
  const double least = has_corners ? least_share_of_tolerance * tolerance : 0;
  std::vector<double> spacing(count, length.back());
  std::vector<std::size_t> vertices;
  for (std::size_t k = 0; k < count; ++k) {
    if (kept[k] != 0) vertices.push_back(k);
  }
  for (std::size_t v = 0; v + 1 < vertices.size(); ++v) {
    const double piece = (length[vertices[v + 1]] - length[vertices[v]]) / edges_of_piece;
    for (std::size_t k = vertices[v]; k <= vertices[v + 1]; ++k) spacing[k] = std::min(spacing[k], piece);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const double rows = (length[std::min(k + 1, count - 1)] - length[k > 0 ? k - 1 : 0]) /
                        static_cast<double>(std::min(k + 1, count - 1) - (k > 0 ? k - 1 : 0));
    spacing[k] = std::max(spacing[k], std::max(least_share_of_rows * rows, least));
  }
  // A corner is what turns by more than the vertices beside it: there the curve turns within the tolerance.
  std::vector<Vector3> turns(vertices.size(), Vector3::Zero());
  std::vector<double> angles(vertices.size(), 0);
  for (std::size_t v = 1; v + 1 < vertices.size(); ++v) {
    const Vector3 a = way[vertices[v]] - way[vertices[v - 1]];
    const Vector3 b = way[vertices[v + 1]] - way[vertices[v]];
    angles[v] = turn_between(a, b);
    turns[v] = a.cross(b);
  }
  for (std::size_t v = 1; v + 1 < vertices.size(); ++v) {
    double beside = 0;
    for (const std::size_t w : {v - 1, v + 1}) {
      if (turns[w].dot(turns[v]) > 0) beside = std::max(beside, angles[w]);
    }
    const double excess = angles[v] - beside;
    if (!(excess > greatest_turn_of_edge) || sharp[vertices[v]] != 0) continue;
    const double half_turn = std::min(excess / 2, greatest_half_turn);
    const double radius = tolerance / (1 / std::cos(half_turn) - 1);
    const std::size_t k = vertices[v];
    spacing[k] = std::min(spacing[k], std::max(radius * 2 * half_turn / edges_of_piece, least_spacing * length.back()));
  }
  // No piece between fixed vertices has too few.
  for (std::size_t k = 1; k < count; ++k) {
    if (k + 1 < count && fixed[k] == 0) continue;
    const double most =
        (length[k] - length[first]) / (edges_between_held * (closed && first == 0 && k + 1 == count ? 3 : 1));
    for (std::size_t j = first; j <= k; ++j) spacing[j] = std::min(spacing[j], most);
    first = k;
  }
  for (double& one : spacing) one = std::max(one, std::max(least_spacing, 1 / most_nodes) * length.back());
  for (int around = 0; around < (closed ? 2 : 1); ++around) {
    if (closed) spacing.front() = spacing.back() = std::min(spacing.front(), spacing.back());
    for (std::size_t k = 1; k < count; ++k)
      spacing[k] = std::min(spacing[k], spacing[k - 1] + steepest * (length[k] - length[k - 1]));
    for (std::size_t k = count - 1; k-- > 0;)
      spacing[k] = std::min(spacing[k], spacing[k + 1] + steepest * (length[k + 1] - length[k]));
  }
  return spacing;
}

}  // namespace

void add_start(const std::vector<ChainNode>& chain, bool closed, const StartScale& scale, DenseCurve& curve,
               std::vector<CurvePoint>& points) {
  Way found(chain, closed, scale, curve);
  std::vector<Stop>& stops = found.stops;
  if (stops.size() < (closed ? 3U : 2U)) {
    // Nothing that could be bent.
    std::vector<Node> nodes;
    for (const ChainNode& one : chain) {
      Node& node = nodes.emplace_back();
      node.place = one.place;
      node.held = true;
      node.dense = false;
      node.from = one.from;
    }
    curve.add_chain(nodes, closed);
    return;
  }
  // A closed way begins at a fixed place, if there is one.
  if (closed) {
    const auto fixed = std::find_if(stops.begin(), stops.end(), [](const Stop& stop) { return stop.fixed; });
    if (fixed != stops.end()) std::rotate(stops.begin(), fixed, stops.end());
    stops.push_back(stops.front());
  }
  std::vector<Vector3> way;
  std::vector<std::uint8_t> fixed;
  std::vector<std::uint8_t> sharp;
  for (const Stop& stop : stops) {
    way.push_back(stop.place);
    fixed.push_back(stop.fixed ? 1 : 0);
    sharp.push_back(stop.corner || (stop.fixed && chain[stop.node].corner) ? 1 : 0);
  }
  if (!closed && !fixed.empty()) fixed.front() = fixed.back() = 1;
  const std::vector<double> spacing = spacing_along(way, fixed, sharp, closed, scale.tolerance);
  const std::uint32_t begin = curve.size();
  std::vector<Node> nodes;
  // The node of the curve at each stop, and where the stop lies along the way.
  std::vector<double> length(way.size(), 0);
  for (std::size_t k = 1; k < way.size(); ++k) length[k] = length[k - 1] + (way[k] - way[k - 1]).norm();
  std::vector<double> at_node;
  const auto add = [&](const Vector3& place, double at, double apart) -> Node& {
    Node& node = nodes.emplace_back();
    node.place = place;
    node.spacing = apart;
    at_node.push_back(at);
    return node;
  };
  const auto add_stop = [&](std::size_t k) {
    Node& node = add(way[k], length[k], spacing[k]);
    if (!stops[k].fixed) return;
    const ChainNode& from = chain[stops[k].corner ? found.middle_row(stops[k]) : stops[k].node];
    node.tangents = from.tangents;
    node.held = from.held;
    node.corner = sharp[k] != 0;
    node.from = from.from;
    node.dense = false;
  };
  std::size_t first = 0;
  add_stop(0);
  for (std::size_t k = 1; k < way.size(); ++k) {
    if (fixed[k] == 0 && k + 1 < way.size()) continue;
    double edges = 0;
    std::vector<double> sum = {0};
    for (std::size_t j = first; j < k; ++j) {
      edges += (length[j + 1] - length[j]) * 2 / (spacing[j] + spacing[j + 1]);
      sum.push_back(edges);
    }
    const bool straight =
        k == first + 1 && stops[first].fixed && stops[k].fixed && stops[first].node + 1 == stops[k].node;
    const auto count = static_cast<std::size_t>(straight ? 1 : std::max(1.0, std::ceil(edges)));
    std::size_t j = first;
    for (std::size_t made = 1; made < count; ++made) {
      const double want = edges * static_cast<double>(made) / static_cast<double>(count);
      while (j + 1 < k && sum[j - first + 1] < want) ++j;
      const double share = (want - sum[j - first]) / (sum[j - first + 1] - sum[j - first]);
      add(way[j] + share * (way[j + 1] - way[j]), length[j] + share * (length[j + 1] - length[j]),
          spacing[j] + share * (spacing[j + 1] - spacing[j]));
    }
    if (k + 1 < way.size() || !closed) add_stop(k);
    first = k;
  }
  curve.add_chain(nodes, closed);
  const auto edges = static_cast<std::uint32_t>(nodes.size() - (closed ? 0 : 1));
  std::vector<std::size_t> stop_of(chain.size(), 0);
  for (std::size_t k = 0; k + (closed ? 1 : 0) < stops.size(); ++k) stop_of[stops[k].node] = k;
  // In the order of the way.
  std::vector<std::pair<std::size_t, std::size_t>> rows;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    if (chain[k].point >= 0) rows.emplace_back(stop_of[found.first_row(k)], k);
  }
  std::sort(rows.begin(), rows.end());
  for (const auto& [stop, k] : rows) {
    const ChainNode& row = chain[k];
    // Not further than the stops beside: the way may come back here.
    double at = length[stop];
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t from = stop > 0 ? stop - 1 : 0; from <= stop && from + 1 < way.size(); ++from) {
      const double share = nearest_share(row.place, way[from], way[from + 1]);
      const double distance = (way[from] + share * (way[from + 1] - way[from]) - row.place).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      at = length[from] + share * (length[from + 1] - length[from]);
    }
    const auto above = std::upper_bound(at_node.begin(), at_node.end(), at);
    const auto node = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - at_node.begin() - 1, 0, edges - 1));
    const double end = node + 1 < at_node.size() ? at_node[node + 1] : length.back();
    const double edge = end - at_node[node];
    const double share = edge > 0 ? std::clamp((at - at_node[node]) / edge, 0.0, 1.0) : 0;
    CurvePoint point{row.place, row.weight, {begin + static_cast<std::uint32_t>(node), share}, row.point, 0};
    points.push_back(point);
  }
}

DenseCurve with_new_nodes(const DenseCurve& curve, double least) {
  DenseCurve result(false, curve.moving());
  for (const auto& chain : curve.chains()) {
    std::vector<std::uint32_t> way;
    way.reserve(chain.count + 1);
    for (std::uint32_t k = 0; k < chain.count; ++k) way.push_back(chain.begin + k);
    if (chain.closed) way.push_back(chain.begin);
    std::vector<double> spacing;
    spacing.reserve(way.size());
    for (const std::uint32_t i : way) spacing.push_back(curve.node(i).spacing);
    std::vector<double> lengths;
    for (std::size_t k = 0; k + 1 < way.size(); ++k) {
      const double length = curve.edge_length(way[k]);
      lengths.push_back(length);
      const double turn = turn_between(curve.bend(way[k], true).tangent, curve.bend(way[k + 1], false).tangent);
      if (turn > greatest_turn_of_edge) {
        const double most = std::max(least, length * greatest_turn_of_edge / turn);
        spacing[k] = std::min(spacing[k], most);
        spacing[k + 1] = std::min(spacing[k + 1], most);
      }
    }
    const double whole = std::accumulate(lengths.begin(), lengths.end(), 0.0);
    for (double& one : spacing) one = std::max(one, least_spacing * whole);
    for (int around = 0; around < (chain.closed ? 2 : 1); ++around) {
      if (chain.closed) spacing.front() = spacing.back() = std::min(spacing.front(), spacing.back());
      for (std::size_t k = 0; k + 1 < way.size(); ++k)
        spacing[k + 1] = std::min(spacing[k + 1], spacing[k] + steepest * lengths[k]);
      for (std::size_t k = way.size() - 1; k-- > 0;)
        spacing[k] = std::min(spacing[k], spacing[k + 1] + steepest * lengths[k]);
    }
    std::vector<Node> nodes;
    const auto add_old = [&](std::size_t k) {
      nodes.push_back(curve.node(way[k]));
      nodes.back().spacing = spacing[k];
    };
    std::size_t first = 0;
    add_old(0);
    for (std::size_t k = 1; k < way.size(); ++k) {
      if (curve.node(way[k]).dense && k + 1 < way.size()) continue;
      double edges = 0;
      std::vector<double> sum = {0};
      for (std::size_t j = first; j < k; ++j) {
        edges += lengths[j] * 2 / (spacing[j] + spacing[j + 1]);
        sum.push_back(edges);
      }
      const auto count = static_cast<std::size_t>(k == first + 1 ? 1 : std::max(2.0, std::ceil(edges)));
      std::size_t j = first;
      for (std::size_t made = 1; made < count; ++made) {
        const double want = edges * static_cast<double>(made) / static_cast<double>(count);
        while (j + 1 < k && sum[j - first + 1] < want) ++j;
        const double share = (want - sum[j - first]) / (sum[j - first + 1] - sum[j - first]);
        Node node;
        node.place = curve.at({way[j], share});
        node.spacing = spacing[j] + share * (spacing[j + 1] - spacing[j]);
        nodes.push_back(node);
      }
      if (k + 1 < way.size() || !chain.closed) add_old(k);
      first = k;
    }
    result.add_chain(nodes, chain.closed);
  }
  return result;
}

void find_places(const DenseCurve& curve, std::vector<CurvePoint>& points) {
  for (std::size_t j = 0; j < points.size(); ++j) {
    end_if_cancelled_at(j);
    CurvePoint& point = points[j];
    const double away = curve.offset(point.at, point.place).norm();
    point.at = curve.nearest(point.place, point.at, 2 * away + 2 * curve.edge_length(point.at.edge));
  }
}

void carry_places(const DenseCurve& before, const DenseCurve& curve, std::vector<CurvePoint>& points) {
  // Ends and held nodes are on both; what is between is found by the length.
  const auto lengths_of = [](const DenseCurve& of) {
    std::vector<std::vector<double>> sums;
    for (const auto& chain : of.chains()) {
      std::vector<double> sum(chain.count + 1, 0);
      for (std::uint32_t k = 0; k < chain.count; ++k)
        sum[k + 1] = sum[k] + (of.is_edge(chain.begin + k) ? of.edge_length(chain.begin + k) : 0);
      sums.push_back(std::move(sum));
    }
    return sums;
  };
  const auto from = lengths_of(before);
  const auto to = lengths_of(curve);
  for (CurvePoint& point : points) {
    const auto above = std::upper_bound(before.chains().begin(), before.chains().end(), point.at.edge,
                                        [](std::uint32_t edge, const auto& chain) { return edge < chain.begin; });
    const auto c = static_cast<std::size_t>(above - before.chains().begin() - 1);
    const auto& now = curve.chains()[c];
    const std::uint32_t k = point.at.edge - before.chains()[c].begin;
    const double scale = from[c].back() > 0 ? to[c].back() / from[c].back() : 1;
    const double way = scale * (from[c][k] + point.at.share * (from[c][k + 1] - from[c][k]));
    const std::uint32_t edges = now.count - (now.closed ? 0 : 1);
    const auto found = std::upper_bound(to[c].begin(), to[c].end(), way);
    const auto at = static_cast<std::uint32_t>(std::clamp<std::ptrdiff_t>(found - to[c].begin() - 1, 0, edges - 1));
    const double length = to[c][at + 1] - to[c][at];
    point.at = {now.begin + at, length > 0 ? std::clamp((way - to[c][at]) / length, 0.0, 1.0) : 0};
  }
  find_places(curve, points);
}

}  // namespace vspring
