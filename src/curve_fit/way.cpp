#include "curve_fit/way.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "base/median.hpp"
#include "shape/segment.hpp"

namespace vspring {

namespace {

// In units of the noise: nearer rows do not show the way.
constexpr double reach_of_rows = 2;
// In that unit, across coordinates that stay.
constexpr double reach_across = 3;
// How far rows may go back and still count as out of order: in that unit, in rows, and in median edges around.
constexpr double reach_of_folds = 5;
constexpr std::size_t most_rows_of_fold = 4;
constexpr double most_edges_of_fold = 10;
// How far aside of their new way reordered rows may lie, as a share of how far they go back.
constexpr double most_aside_of_fold = 0.4;
// 60° from one edge to the next: rows in an order without sharper turns may lie anywhere.
constexpr double cosine_of_gentle_bend = 0.5;
constexpr std::size_t rows_beside_fold = 3;
constexpr std::size_t rows_about = 8;
constexpr int most_turns_of_folds = 10;

class WayFinder {
 public:
  /// along: for its station().
  WayFinder(const std::vector<ChainNode>& chain, bool closed, const StartScale& scale, const DenseCurve& along)
      : chain_(chain), closed_(closed), reach_(reach_of_rows * scale.noise), along_(along) {
    joined_with_.resize(chain.size());
    find_turns();
    for (std::size_t k = 0; k < chain.size(); ++k) add(k);
    join_seam();
    if (scale.sharp > 0) find_corners(scale);
    leave_out_next_to_fixed();
    for (int turn = 0; turn < most_turns_of_folds && undo_folds(); ++turn) {
    }
    if (closed || along.moves_freely() || stops_.size() < 2) return;
    reach_to_rows(stops_.front(), stops_[1]);
    reach_to_rows(stops_.back(), stops_[stops_.size() - 2]);
  }

  Way take() {
    std::vector<std::size_t> first_rows;
    first_rows.reserve(chain_.size());
    for (std::size_t row = 0; row < chain_.size(); ++row) first_rows.push_back(first_row(row));
    return {std::move(stops_), std::move(first_rows)};
  }

 private:
  [[nodiscard]] std::size_t first_row(std::size_t row) const {
    while (joined_with_[row] != row) row = joined_with_[row];
    return row;
  }

  /// Finds rows at which coordinates that stay reach an extremum: no other row can take their place.
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
    const double least = std::max(reach_of_folds * reach_, most_edges_of_fold * median(edges));
    // The lowest and highest rows since the last turn.
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
    if (!fixed && !stops_.empty() && !stops_.back().fixed && are_one(node.place, stops_.back().place)) {
      join(stops_.back(), {node.place, 1, false, k});
      return;
    }
    stops_.push_back({node.place, 1, fixed, k});
  }

  /// If coordinates stay, rows at one station may differ by noise.
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
    while (closed_ && stops_.size() > 3) {
      const Stop last = stops_.back();
      if (last.fixed || stops_.front().fixed || !are_one(last.place, stops_.front().place)) return;
      join(stops_.front(), last);
      stops_.pop_back();
    }
  }

  void find_corners(const StartScale& scale) {
    std::vector<Vector3> places;
    std::vector<std::uint8_t> given;
    places.reserve(stops_.size());
    for (const Stop& stop : stops_) {
      places.push_back(stop.place);
      given.push_back(chain_[stop.node].corner ? 1 : 0);
    }
    for (const std::size_t k : corners_of_way(places, closed_, scale.sharp, scale.tolerance, given)) {
      // A given tangent determines the curve there.
      if (!chain_[stops_[k].node].tangents[1].isZero(0)) continue;
      stops_[k].fixed = stops_[k].corner = true;
    }
  }

  /// Where coordinates stay, the curve cannot grow along them: it has to end at the outermost of the rows that are one
  /// stop, not at their mean.
  void reach_to_rows(Stop& end, const Stop& next) const {
    if (end.fixed) return;
    const Vector3 out = station(end.place - next.place).normalized();
    double furthest = 0;
    for (std::size_t k = 0; k < chain_.size(); ++k) {
      if (first_row(k) == end.node) furthest = std::max(furthest, out.dot(chain_[k].place - end.place));
    }
    end.place += furthest * out;
  }

  /// Removes a stop; its rows join a neighbour.
  void erase(std::size_t k) {
    joined_with_[stops_[k].node] = stops_[k > 0 ? k - 1 : k + 1].node;
    stops_.erase(stops_.begin() + static_cast<std::ptrdiff_t>(k));
  }

  /// Removes stops next to fixed ones, so that directions there do not come from noise.
  void leave_out_next_to_fixed() {
    const std::size_t least = closed_ ? 3 : 2;
    for (std::size_t k = 0; k < stops_.size() && stops_.size() > least;) {
      const auto near = [&](std::size_t other) {
        return stops_[other].fixed && (stops_[other].place - stops_[k].place).norm() <= reach_;
      };
      const bool spare =
          !stops_[k].fixed && ((k > 0 || closed_ ? near((k > 0 ? k : stops_.size()) - 1) : false) ||
                               (k + 1 < stops_.size() || closed_ ? near((k + 1) % stops_.size()) : false));
      if (spare)
        erase(k);
      else
        ++k;
    }
  }

  [[nodiscard]] bool turns_back(std::size_t k) const {
    return station(stops_[k].place - stops_[k - 1].place).dot(stops_[k + 1].place - stops_[k].place) < 0;
  }

  /// Where the way goes back and on again within a few rows, or within noise, puts its stops in order along the way
  /// from before to after. False if there is no such place.
  bool undo_folds() {
    bool found = false;
    for (std::size_t k = 1; k + 2 < stops_.size(); ++k) {
      if (!turns_back(k)) continue;
      std::size_t end = k + 1;
      while (end + 1 < stops_.size() && end - k <= most_rows_of_fold && !turns_back(end)) ++end;
      if (end + 1 >= stops_.size() || !turns_back(end)) continue;
      const double back = station(stops_[end].place - stops_[k].place).norm();
      const bool is_noise = back <= reach_of_folds * reach_;
      if (!is_noise && (end - k > most_rows_of_fold || back > most_edges_of_fold * median_edge(k))) continue;
      found = (is_noise ? join_all(k, end) : put_in_order(k, end, most_aside_of_fold * back)) || found;
    }
    return found;
  }

  bool join_all(std::size_t first, std::size_t last) {
    for (std::size_t j = first; j <= last; ++j) {
      if (stops_[j].fixed) return false;
    }
    for (std::size_t j = first + 1; j <= last; ++j) join(stops_[first], stops_[j]);
    const auto begin = stops_.begin() + static_cast<std::ptrdiff_t>(first);
    stops_.erase(begin + 1, begin + static_cast<std::ptrdiff_t>(last - first) + 1);
    return true;
  }

  /// Reorders the stops of a fold and its disordered neighbours. False if they lie aside of their new way.
  bool put_in_order(std::size_t first, std::size_t last, double most_aside) {
    const std::size_t begin = first - std::min(first, rows_beside_fold);
    const std::size_t end = std::min(stops_.size() - 1, last + rows_beside_fold);
    const Vector3 on = station(stops_[end].place - stops_[begin].place);
    std::vector<std::size_t> order(end - begin - 1);
    std::iota(order.begin(), order.end(), begin + 1);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return stops_[a].place.dot(on) < stops_[b].place.dot(on); });
    std::size_t left = begin + 1;
    std::size_t right = end - 1;
    while (left < end && order[left - begin - 1] == left) ++left;
    while (right > left && order[right - begin - 1] == right) --right;
    if (left >= right) return false;
    std::vector<Vector3> places = {stops_[left - 1].place};
    for (std::size_t j = left; j <= right; ++j) places.push_back(stops_[order[j - begin - 1]].place);
    places.push_back(stops_[right + 1].place);
    const bool goes_on = bends_gently(places);
    const Vector3& from = places.front();
    const Vector3& to = places.back();
    for (std::size_t j = left; j <= right; ++j) {
      const Vector3& place = stops_[j].place;
      const double away = station(from + nearest_share(place, from, to) * (to - from) - place).norm();
      const bool is_aside = !goes_on && away > std::max(reach_of_folds * reach_, most_aside);
      if (stops_[j].fixed || is_aside) return false;
    }
    const std::vector<Stop> before(stops_.begin() + static_cast<std::ptrdiff_t>(left),
                                   stops_.begin() + static_cast<std::ptrdiff_t>(right) + 1);
    for (std::size_t j = left; j <= right; ++j) stops_[j] = before[order[j - begin - 1] - left];
    return true;
  }

  /// Whether places bend gently, as a way in the right order does.
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
    for (std::size_t k = begin; k + 1 < std::min(stops_.size(), about + rows_about); ++k)
      edges.push_back(station(stops_[k + 1].place - stops_[k].place).norm());
    return median(edges);
  }

  const std::vector<ChainNode>& chain_;
  bool closed_;
  double reach_;
  const DenseCurve& along_;
  std::vector<Stop> stops_;
  std::vector<std::uint8_t> turns_;
  std::vector<std::size_t> joined_with_;  // per row that begins a stop or belongs to one
};

}  // namespace

std::size_t Way::middle_row(const Stop& stop) const {
  std::size_t end = stop.node + 1;
  while (end < first_rows.size() && first_rows[end] == stop.node) ++end;
  return stop.node + (end - stop.node) / 2;
}

Way find_way(const std::vector<ChainNode>& chain, bool closed, const StartScale& scale, const DenseCurve& along) {
  return WayFinder(chain, closed, scale, along).take();
}

}  // namespace vspring
