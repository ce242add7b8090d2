#include "curve_fit/smoothing_spline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "curve_fit/curve_lengths.hpp"

namespace vspring {

namespace {

// Greatest length, relative to the first one.
constexpr double longest = 1.25;
// Keeps parts without points straight.
constexpr double least_bending = 1e-7;
// Edges on either side of a point's place.
constexpr int edges_about = 1;

constexpr std::int32_t no_column = std::numeric_limits<std::int32_t>::max();

}  // namespace

SmoothingSpline::SmoothingSpline(DenseCurve& curve, const std::vector<CurvePoint>& points)
    : curve_(curve), points_(points) {
  number();
  const double length = length_of(curve);
  fixed_ = LeastSquares(columns_, width_);
  for (std::uint32_t i = 0; i < curve.size(); ++i) {
    if (!curve.is_edge(i)) continue;
    const std::uint32_t c = curve.next(i);
    const double edge = curve.edge_length(i);
    const auto first = bend(i, true);
    const auto second = bend(c, false);
    const double bending = least_bending * std::pow(length, 3) * edge;
    if (first) add(*first, bending);
    if (second) add(*second, bending);
    if (!first || !second || !(edge > 0)) continue;
    Affine change = *second;
    for (int k = 0; k < first->count; ++k)
      change.add(first->nodes[static_cast<std::size_t>(k)], -first->weights[static_cast<std::size_t>(k)]);
    change.rest -= first->rest;
    add(change, std::pow(length, 5) / edge);
  }
  take_rows();
  length_ = length;
  counts.assign(points.size(), 1);
  find_point_rows();
  weigh();
}

bool SmoothingSpline::solve(double smoothing) {
  LeastSquares sum(columns_, width_);
  for (std::size_t i = 0; i < columns_; ++i) {
    sum.add(i, fixed_.triangle.row(i), fixed_.right[i], std::sqrt(smoothing));
    sum.add(i, data_.triangle.row(i), data_.right[i], 1);
  }
  places_ = std::move(sum.right);
  sum.triangle.solve_upper(std::span(places_));
  const Vector3& moving = curve_.moving();
  for (std::uint32_t i = 0; i < curve_.size() && !curve_.moves_freely(); ++i) {
    if (column_[i] < 0) continue;
    Vector3& place = places_[static_cast<std::size_t>(column_[i])];
    place = curve_.place(i) + moving.cwiseProduct(place - curve_.place(i));
  }
  return std::all_of(places_.begin(), places_.end(), [](const Vector3& place) { return place.allFinite(); });
}

void SmoothingSpline::take() {
  if (places_.empty() || !std::all_of(places_.begin(), places_.end(), [](const Vector3& p) { return p.allFinite(); }))
    return;
  for (std::uint32_t i = 0; i < curve_.size(); ++i) {
    if (column_[i] >= 0) curve_.set_place(i, places_[static_cast<std::size_t>(column_[i])]);
  }
}

double SmoothingSpline::turning() const {
  return total_turn(curve_, [&](std::uint32_t node) -> const Vector3& { return found(node); });
}

bool SmoothingSpline::is_sane() const {
  double length = 0;
  for (std::uint32_t i = 0; i < curve_.size(); ++i)
    length += curve_.is_edge(i) ? (found(curve_.next(i)) - found(i)).norm() : 0;
  return length <= longest * length_;
}

Vector3 SmoothingSpline::residual(std::size_t point) const {
  const Affine& row = point_rows_[point];
  Vector3 away = row.rest;
  for (int k = 0; k < row.count; ++k) {
    const auto n = static_cast<std::size_t>(k);
    away += row.weights[n] * found(row.nodes[n]);
  }
  return curve_.moving().cwiseProduct(away);
}

double SmoothingSpline::squared_distance(std::size_t number) const {
  const CurvePoint& point = points_[number];
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t edge = point.at.edge;
  for (int k = 0; k < edges_about && curve_.before(edge) != DenseCurve::none; ++k) edge = curve_.before(edge);
  for (int k = 0; k <= 2 * edges_about && curve_.is_edge(edge); ++k, edge = curve_.next(edge)) {
    const Vector3& a = found(edge);
    const Vector3 chord = found(curve_.next(edge)) - a;
    const Vector3 away = point.place - a;
    const double length = chord.squaredNorm();
    const double share = length > 0 ? std::clamp(away.dot(chord) / length, 0.0, 1.0) : 0;
    least = std::min(least, (away - share * chord).squaredNorm());
  }
  return least;
}

void SmoothingSpline::weigh() {
  data_ = LeastSquares(columns_, width_);
  double weights = 0;
  for (const CurvePoint& point : points_) weights += point.weight;
  for (const std::size_t j : order_) {
    const double weight = counts[j] * points_[j].weight / weights;
    if (const auto row = row_from(point_rows_[j], weight)) data_.add(row->first, row->entries, row->value, row->factor);
  }
}

void SmoothingSpline::find_point_rows() {
  std::vector<std::int32_t> first(points_.size());
  order_.resize(points_.size());
  point_rows_.reserve(points_.size());
  for (std::size_t j = 0; j < points_.size(); ++j) {
    order_[j] = j;
    point_rows_.push_back(row_of(points_[j]));
    first[j] = first_column(point_rows_.back());
  }
  std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) { return first[a] < first[b]; });
}

void SmoothingSpline::number() {
  column_.assign(curve_.size(), -1);
  std::int32_t next = 0;
  for (const auto& chain : curve_.chains()) {
    for (std::uint32_t k = 0; k < chain.count; ++k) {
      const std::uint32_t i = chain.begin + (!chain.closed ? k : k % 2 == 0 ? k / 2 : chain.count - 1 - k / 2);
      if (!curve_.node(i).held) column_[i] = next++;
    }
    width_ = std::max<std::size_t>(width_, chain.closed ? 7 : 4);
  }
  columns_ = static_cast<std::size_t>(next);
}

/// The second derivative at a node; if it has a tangent, on one side of it.
std::optional<Affine> SmoothingSpline::bend(std::uint32_t node, bool after) const {
  Affine sum;
  if (curve_.is_smooth(node)) {
    const double ahead = curve_.edge_length(node);
    const double behind = curve_.edge_length(curve_.before(node));
    if (!(ahead > 0) || !(behind > 0)) return std::nullopt;
    sum.add(curve_.next(node), 2 / (ahead * (ahead + behind)));
    sum.add(curve_.before(node), 2 / (behind * (ahead + behind)));
    sum.add(node, -2 / (ahead * behind));
    return sum;
  }
  const Vector3& tangent = curve_.tangent(node, after);
  const std::uint32_t other = after ? curve_.next(node) : curve_.before(node);
  if (tangent.isZero(0) || other == DenseCurve::none) return std::nullopt;
  const double edge = curve_.edge_length(after ? node : other);
  if (!(edge > 0)) return std::nullopt;
  sum.add(other, 2 / (edge * edge));
  sum.add(node, -2 / (edge * edge));
  sum.rest = (after ? -2 : 2) / edge * tangent;
  return sum;
}

Affine SmoothingSpline::row_of(const CurvePoint& point) const {
  const auto place = curve_.place_row(point.at);
  Affine row;
  for (std::size_t k = 0; k < 4; ++k) {
    if (place.nodes[k] != DenseCurve::none) row.add(place.nodes[k], place.weights[k]);
  }
  row.rest = place.rest - point.place;
  return row;
}

std::int32_t SmoothingSpline::first_column(const Affine& row) const {
  std::int32_t first = no_column;
  for (int k = 0; k < row.count; ++k) {
    const std::int32_t column = column_[row.nodes[static_cast<std::size_t>(k)]];
    if (column >= 0) first = std::min(first, column);
  }
  return first;
}

/// None if it has no unknowns or no weight.
auto SmoothingSpline::row_from(const Affine& row, double weight) const -> std::optional<Row> {
  const std::int32_t first = first_column(row);
  if (first == no_column || !(weight > 0)) return std::nullopt;
  Row found{static_cast<std::size_t>(first), {}, -row.rest, std::sqrt(weight)};
  for (int k = 0; k < row.count; ++k) {
    const auto n = static_cast<std::size_t>(k);
    const std::int32_t column = column_[row.nodes[n]];
    if (column < 0)
      found.value -= row.weights[n] * curve_.place(row.nodes[n]);
    else
      found.entries[static_cast<std::size_t>(column - first)] += row.weights[n];
  }
  return found;
}

void SmoothingSpline::add(const Affine& row, double weight) {
  if (auto found = row_from(row, weight)) rows_.push_back(std::move(*found));
}

/// Adds rows in the order of their first unknown.
void SmoothingSpline::take_rows() {
  std::stable_sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.first < b.first; });
  for (const Row& row : rows_) fixed_.add(row.first, row.entries, row.value, row.factor);
  rows_ = {};
}

}  // namespace vspring
