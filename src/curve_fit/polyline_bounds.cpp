#include "curve_fit/polyline_bounds.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "curve_fit/curve_lengths.hpp"

namespace vspring {

namespace {

// On either side: places next to corners may be nearer to another piece of the polyline.
constexpr std::size_t rows_around = 3;
// In units of the reach: between nearer points no bound is needed.
constexpr double least_gap = 0.5;
// In units of the reach: a way along the curve, between the places of two near points, that needs bounds all the same.
constexpr double long_way = 2;
// Rows among which one at a different place is sought.
constexpr std::size_t most_rows_at_a_place = 64;
constexpr double greatest_turn_of_arc = 2;
// Chords of edges have the same bounds as their ends.
constexpr int least_parts = 2;

class PolylineBounds {
 public:
  PolylineBounds(const DenseCurve& curve, double reach, BoundedPlaces places)
      : curve_(curve),
        reach_(reach),
        parts_(std::max(places.parts, least_parts)),
        nearest_(static_cast<std::size_t>(parts_) * curve.size()),
        least_(nearest_.size(), std::numeric_limits<double>::infinity()),
        in_gap_(curve.size(), places.everywhere ? 1 : 0) {}

  /// length: along the chain, up to each node, and in all.
  void look_at(const DenseCurve::Chain& chain, std::span<const double> length, std::span<const CurvePoint> rows) {
    const std::size_t count = rows.size();
    if (count < 2) return;
    const std::size_t gaps = count - (chain.closed ? 0 : 1);
    const auto row = [&](std::size_t k) -> const Vector3& { return rows[k % count].place; };
    const auto way = [&](std::uint32_t from, std::uint32_t to) {
      const double ahead = length[to - chain.begin] - length[from - chain.begin];
      return ahead < 0 ? ahead + length.back() : ahead;
    };
    // Of a closed chain: by the shorter way.
    const auto goes_back = [&](std::size_t from, std::size_t to) {
      return 2 * way(rows[from % count].at.edge, rows[to % count].at.edge) > length.back();
    };
    // Calls use() with the edges from the place of row `from` to that of row `to`, in succession; with none if they go
    // back.
    const auto for_edges = [&](std::size_t from, std::size_t to, auto use) {
      std::uint32_t begin = rows[from % count].at.edge;
      std::uint32_t end = rows[to % count].at.edge;
      if (chain.closed) {
        if (goes_back(from, to)) return;
      } else {
        for (std::size_t k = from; k < to && to > from + 1; ++k) {
          begin = std::min(begin, rows[k].at.edge);
          end = std::max(end, rows[k].at.edge);
        }
        if (end < begin) return;
      }
      for (std::uint32_t i = begin;; i = curve_.next(i)) {
        if (!curve_.node(i).held && curve_.is_edge(i)) use(i);
        if (i == end) return;
      }
    };
    for (std::size_t k = 0; k < gaps; ++k) {
      const bool goes_far = way(rows[k].at.edge, rows[(k + 1) % count].at.edge) > long_way * reach_;
      if (goes_far || is_gap(row(k), row(k + 1))) for_edges(k, k + 1, [&](std::uint32_t i) { in_gap_[i] = 1; });
    }
    for (std::size_t k = 0; k < gaps; ++k) {
      std::optional<Vector3> before;
      std::optional<Vector3> after;
      const std::size_t most = std::min(count - 1, most_rows_at_a_place);
      for (std::size_t n = 1; n <= most && !before && (chain.closed || n <= k); ++n) {
        if (is_gap(row(k + count - n), row(k))) before = row(k + count - n);
      }
      for (std::size_t n = k + 2; n <= k + 1 + most && !after && (chain.closed || n < count); ++n) {
        if (is_gap(row(n), row(k + 1))) after = row(n);
      }
      const PolylineBound gap{{}, row(k), row(k + 1), reach_ + rise_over(before, row(k), row(k + 1), after)};
      // Few rows are more than half of a loop.
      std::size_t around = chain.closed ? std::min(rows_around, (count - 2) / 2) : rows_around;
      while (around > 0 && chain.closed && goes_back(k + count - around, k + 1 + around)) --around;
      const std::size_t begin = chain.closed ? k + count - around : k - std::min(k, around);
      const std::size_t end = chain.closed ? k + 1 + around : std::min(count - 1, k + 1 + around);
      for_edges(begin, end, [&](std::uint32_t i) {
        if (in_gap_[i] == 0) return;
        for (int part = 0; part < parts_; ++part)
          look_at({i, static_cast<double>(part) / parts_}, static_cast<std::size_t>(parts_) * i + part, gap);
      });
    }
  }

  [[nodiscard]] std::vector<PolylineBound> found() const {
    std::vector<PolylineBound> bounds;
    for (std::size_t i = 0; i < nearest_.size(); ++i) {
      if (std::isfinite(least_[i])) bounds.push_back(nearest_[i]);
    }
    return bounds;
  }

 private:
  void look_at(const CurvePlace& at, std::size_t n, const PolylineBound& gap) {
    const double away = gap.distance(curve_.at(at)) / gap.bound;
    if (away >= least_[n]) return;
    least_[n] = away;
    nearest_[n] = gap;
    nearest_[n].at = at;
  }

  [[nodiscard]] bool is_gap(const Vector3& a, const Vector3& b) const { return (b - a).norm() > least_gap * reach_; }

  /// How far an arc rises over the middle two of four points, with the turn at the end where they turn less. Turns that
  /// noise explains do not count.
  [[nodiscard]] double rise_over(const std::optional<Vector3>& a, const Vector3& b, const Vector3& c,
                                 const std::optional<Vector3>& d) const {
    const Vector3 edge = c - b;
    const Vector3 first = a ? (b - *a).cross(edge) : Vector3::Zero();
    const Vector3 second = d ? edge.cross(*d - c) : Vector3::Zero();
    if (a && d && !(first.dot(second) > 0)) return 0;
    // The angle between the edge and the circle through its ends and the point before or after; a short neighbouring
    // edge may account for at most half a turn.
    const auto angle = [&](const Vector3& beside) {
      const double turn = std::atan2(beside.cross(edge).norm(), beside.dot(edge));
      return turn * std::min(0.5, edge.norm() / (edge.norm() + beside.norm()));
    };
    double turn = a || d ? greatest_turn_of_arc / 2 : 0;
    if (a) turn = std::min(turn, angle(b - *a));
    if (d) turn = std::min(turn, angle(*d - c));
    return std::max(0.0, edge.norm() / 2 * std::tan(turn / 2) - reach_ / 2);
  }

  const DenseCurve& curve_;
  double reach_;
  int parts_;  ///< of an edge
  std::vector<PolylineBound> nearest_;
  std::vector<double> least_;
  std::vector<std::uint8_t> in_gap_;
};

}  // namespace

std::vector<PolylineBound> polyline_bounds(const DenseCurve& curve, std::span<const CurvePoint> points, double reach,
                                           BoundedPlaces places) {
  PolylineBounds bounds(curve, reach, places);
  const CurveLengths lengths(curve);
  std::size_t first = 0;
  for (std::size_t c = 0; c < curve.chains().size(); ++c) {
    const auto& chain = curve.chains()[c];
    std::size_t end = first;
    while (end < points.size() && points[end].at.edge >= chain.begin && points[end].at.edge < chain.begin + chain.count)
      ++end;
    bounds.look_at(chain, lengths.of(c), points.subspan(first, end - first));
    first = end;
  }
  return bounds.found();
}

}  // namespace vspring
