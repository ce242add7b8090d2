#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "base/cancellation.hpp"
#include "curve_fit/curve_start.hpp"
#include "linear/band_triangle.hpp"

namespace vspring {

namespace {

// Of what the spline is smoothed by: from where it is hardly bent, by factors, to where it goes through all points.
constexpr double first_smoothing = 1e2;
constexpr double least_smoothing = 1e-24;
constexpr double coarse_stride = 1e-2;
constexpr double fine_stride = 0.3;
// To either side of the smoothing of a curve that is much the same.
constexpr int strides_about = 6;
// Of the points: parameters.
constexpr double most_freedom = 0.9;
// How often parameters count for the risk: more than once, as noise may be more than it was estimated to be, and who
// follows it by a little has many bends.
constexpr double caution = 3;
constexpr int halvings = 5;
// So that what no point has a part in is straight.
constexpr double least_bending = 1e-7;
// Of the length at first.
constexpr double longest = 1.25;
// Of the points, and of the tolerance: some lie by what is held, and would have the whole curve follow the noise.
constexpr double share_outside = 0.1;
constexpr double most_outside = 2;
// Of the root mean square.
constexpr double reach_of_rms_at_first = 2.5;
constexpr double more_turning = 0.5;
// To either side of a point's place.
constexpr int edges_about = 1;
constexpr double robust_stride = 0.1;
constexpr int robust_turns = 6;
constexpr int most_turns_drawing_in = 8;

/// A sum of places with weights, and a vector.
struct Affine {
  std::array<std::uint32_t, 6> nodes{};
  std::array<double, 6> weights{};
  int count = 0;
  Vector3 rest = Vector3::Zero();

  void add(std::uint32_t node, double weight) {
    for (int k = 0; k < count; ++k) {
      if (nodes[static_cast<std::size_t>(k)] != node) continue;
      weights[static_cast<std::size_t>(k)] += weight;
      return;
    }
    nodes[static_cast<std::size_t>(count)] = node;
    weights[static_cast<std::size_t>(count++)] = weight;
  }
};

/// Rows and what they should be, as a triangle.
struct LeastSquares {
  LeastSquares(std::size_t size, std::size_t width) : triangle(size, width), right(size, Vector3::Zero()) {}

  /// entries · x = value.
  void add(std::size_t first, std::span<const double> entries, Vector3 value, double factor) {
    value *= factor;
    triangle.add(first, entries, factor, [&](std::size_t column, double cosine, double sine) {
      const Vector3 above = right[column];
      right[column] = cosine * above + sine * value;
      value = cosine * value - sine * above;
    });
  }

  BandTriangle triangle;
  std::vector<Vector3> right;
};

class SmoothingSpline {
  struct Row {
    std::size_t first;
    BandTriangle::Row entries;
    Vector3 value;
    double factor;
  };

 public:
  SmoothingSpline(DenseCurve& curve, const std::vector<CurvePoint>& points) : curve_(curve), points_(points) {
    number();
    double length = 0;
    for (std::uint32_t i = 0; i < curve.size(); ++i) length += curve.is_edge(i) ? curve.edge_length(i) : 0;
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
    counts_.assign(points.size(), 1);
    find_point_rows();
    find_data();
  }

  void run_by(double smoothing_length) {
    double smoothing = std::min(std::pow(smoothing_length / length_, 6), first_smoothing);
    while (!(solve(smoothing) && is_sane()) && smoothing < first_smoothing) smoothing /= coarse_stride;
    take();
  }

  LeastRisk run_by_risk(double noise, int directions, double about) {
    double least = std::numeric_limits<double>::infinity();
    LeastRisk found;
    std::vector<Vector3> best;
    const auto pulls = [](const CurvePoint& point) { return point.weight > 0; };
    const auto count = static_cast<double>(std::count_if(points_.begin(), points_.end(), pulls));
    const std::vector<double> shares = shares_of_freedom();
    const std::vector<Vector3> along = directions_at_points();
    const double far = std::pow(fine_stride, strides_about);
    const double first = about > 0 ? std::min(about / far, first_smoothing) : first_smoothing;
    double smoothing = first / fine_stride;
    while (smoothing > std::max(least_smoothing, about > 0 ? far * found.smoothing : 0)) {
      smoothing *= fine_stride;
      end_if_cancelled();
      const double freedom = this->freedom(shares, smoothing);
      const double spread = 2 * caution * noise * noise * freedom / count;
      // What follows every point tells nothing.
      if (freedom > most_freedom * count || spread > least) break;
      if (!solve(smoothing)) continue;
      const double square = mean_square_across(along);
      const double risk = square / directions + spread;
      if (!(risk < least) || !is_sane()) continue;
      least = risk;
      found = {std::sqrt(square), smoothing};
      best = places_;
    }
    // Less of it may be better.
    if (found.smoothing == first && first < first_smoothing) return run_by_risk(noise, directions, 0);
    places_ = std::move(best);
    take();
    return found;
  }

  void run_robustly(double noise) {
    double smoothing = first_smoothing;
    while (smoothing > least_smoothing) {
      counts_.assign(points_.size(), 1);
      find_data();
      const std::vector<Vector3> before = places_;
      if (!solve(smoothing) || !is_sane()) {
        places_ = before;
        break;
      }
      for (int turn = 0; turn < robust_turns; ++turn) {
        for (std::size_t j = 0; j < points_.size(); ++j)
          counts_[j] = 1 / std::max(std::sqrt(squared_residual(j)) / noise, 1.0);
        find_data();
        (void)solve(smoothing);
      }
      std::vector<double> distances;
      for (std::size_t j = 0; j < points_.size(); ++j)
        distances.push_back(curve_.moves_freely() ? squared_distance(points_[j]) : squared_residual(j));
      const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
      std::nth_element(distances.begin(), middle, distances.end());
      if (std::sqrt(*middle) <= median_of_noise * noise) break;
      smoothing *= robust_stride;
    }
    take();
  }

  void run(double within, double rms) {
    double smoothing = first_smoothing;
    double beyond = 0;
    std::vector<Vector3> sane;
    for (;; smoothing *= coarse_stride) {
      end_if_cancelled();
      if (!solve(smoothing) || !is_sane()) {
        // What is left of points that are far apart may go anywhere; the last one did not.
        if (!sane.empty()) {
          places_ = std::move(sane);
          break;
        }
      } else {
        if (is_near(within, rms)) break;
        sane = places_;
      }
      if (smoothing < least_smoothing) break;
      beyond = smoothing;
    }
    for (int k = 0; k < halvings && beyond > 0 && smoothing >= least_smoothing; ++k) {
      const double middle = std::sqrt(smoothing * beyond);
      const std::vector<Vector3> found = places_;
      if (solve(middle) && is_sane() && is_near(within, rms)) {
        smoothing = middle;
      } else {
        beyond = middle;
        places_ = found;
      }
    }
    if (smoothing >= least_smoothing) draw_in(within, rms, smoothing);
    take();
  }

 private:
  void take() {
    if (places_.empty() || !std::all_of(places_.begin(), places_.end(), [](const Vector3& p) { return p.allFinite(); }))
      return;
    for (std::uint32_t i = 0; i < curve_.size(); ++i) {
      if (column_[i] >= 0) curve_.set_place(i, places_[static_cast<std::size_t>(column_[i])]);
    }
  }

  /// Points that are further away count more until they are not, or the curve turns more for it: a tip goes out then,
  /// and no loop is made for rows that have no order.
  void draw_in(double within, double rms, double smoothing) {
    const double most = within > 0 ? within : reach_of_rms_at_first * rms;
    const double most_turning = turning() + more_turning;
    for (int turn = 0; turn < most_turns_drawing_in; ++turn) {
      bool outside = false;
      for (std::size_t j = 0; j < points_.size(); ++j) {
        const double away = curve_.moves_freely() ? squared_distance(points_[j]) : squared_residual(j);
        const double beyond = std::sqrt(away) / most;
        if (!(points_[j].weight > 0) || beyond <= 1) continue;
        outside = true;
        counts_[j] *= std::pow(1 + beyond, 2);
      }
      if (!outside) return;
      find_data();
      const std::vector<Vector3> before = places_;
      if (solve(smoothing) && is_sane() && turning() <= most_turning) continue;
      places_ = before;
      return;
    }
  }

  /// Of all edges, in radians.
  [[nodiscard]] double turning() const {
    double sum = 0;
    for (std::uint32_t i = 0; i < curve_.size(); ++i) {
      if (!curve_.is_edge(i) || curve_.before(i) == DenseCurve::none) continue;
      const Vector3 first = found(i) - found(curve_.before(i));
      const Vector3 second = found(curve_.next(i)) - found(i);
      sum += std::atan2(first.cross(second).norm(), first.dot(second));
    }
    return sum;
  }

  void find_data() {
    data_ = LeastSquares(columns_, width_);
    double weights = 0;
    for (const CurvePoint& point : points_) weights += point.weight;
    for (const std::size_t j : order_) {
      const double weight = counts_[j] * points_[j].weight / weights;
      if (const auto row = row_from(point_rows_[j], weight))
        data_.add(row->first, row->entries, row->value, row->factor);
    }
  }

  void find_point_rows() {
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

  void number() {
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

  /// The second derivative along a node and its neighbours; of a node with a tangent, on one side of it.
  [[nodiscard]] std::optional<Affine> bend(std::uint32_t node, bool after) const {
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

  [[nodiscard]] Affine row_of(const CurvePoint& point) const {
    const auto place = curve_.place_row(point.at);
    Affine row;
    for (std::size_t k = 0; k < 4; ++k) {
      if (place.nodes[k] != DenseCurve::none) row.add(place.nodes[k], place.weights[k]);
    }
    row.rest = place.rest - point.place;
    return row;
  }

  static constexpr std::int32_t no_column = std::numeric_limits<std::int32_t>::max();

  [[nodiscard]] std::int32_t first_column(const Affine& row) const {
    std::int32_t first = no_column;
    for (int k = 0; k < row.count; ++k) {
      const std::int32_t column = column_[row.nodes[static_cast<std::size_t>(k)]];
      if (column >= 0) first = std::min(first, column);
    }
    return first;
  }

  /// None where it has no unknowns or no weight.
  [[nodiscard]] std::optional<Row> row_from(const Affine& row, double weight) const {
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

  void add(const Affine& row, double weight) {
    if (auto found = row_from(row, weight)) rows_.push_back(std::move(*found));
  }

  /// In the order of their first unknown.
  void take_rows() {
    std::stable_sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.first < b.first; });
    for (const Row& row : rows_) fixed_.add(row.first, row.entries, row.value, row.factor);
    rows_ = {};
  }

  bool solve(double smoothing) {
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

  [[nodiscard]] const Vector3& found(std::uint32_t node) const {
    return column_[node] < 0 ? curve_.place(node) : places_[static_cast<std::size_t>(column_[node])];
  }

  [[nodiscard]] bool is_sane() const {
    double length = 0;
    for (std::uint32_t i = 0; i < curve_.size(); ++i)
      length += curve_.is_edge(i) ? (found(curve_.next(i)) - found(i)).norm() : 0;
    return length <= longest * length_;
  }

  [[nodiscard]] bool is_near(double within, double rms) const {
    double squares = 0;
    double outside = 0;
    double weights = 0;
    for (std::size_t j = 0; j < points_.size(); ++j) {
      const CurvePoint& point = points_[j];
      if (!(point.weight > 0)) continue;
      const double square = this->square(j, within);
      if (within > 0 && square > std::pow(most_outside * within, 2)) return false;
      outside += square > within * within ? point.weight : 0;
      // The others would have to follow their noise to make up for it.
      if (!(within > 0) && curve_.is_at_held(point.at)) continue;
      squares += point.weight * square;
      weights += point.weight;
    }
    return within > 0 ? outside <= share_outside * weights : squares <= weights * rms * rms;
  }

  /// Of its distance. Where the way comes back, the nearest place may be one of its other half.
  [[nodiscard]] double square(std::size_t point, double within) const {
    return within > 0 || !curve_.moves_freely() ? squared_residual(point) : squared_distance(points_[point]);
  }

  /// What a point has of the parameters of the spline with a smoothing of 1, one after the other: they are as dense as
  /// (its weight over the length it stands for)^(1/6) / 3 (Silverman 1984).
  [[nodiscard]] std::vector<double> shares_of_freedom() const {
    std::vector<double> begins(curve_.size() + 1, 0);
    for (std::uint32_t i = 0; i < curve_.size(); ++i)
      begins[i + 1] = begins[i] + (curve_.is_edge(i) ? curve_.edge_length(i) : 0);
    std::vector<std::pair<double, double>> places;
    double weights = 0;
    for (const CurvePoint& point : points_) {
      if (!(point.weight > 0)) continue;
      const std::uint32_t edge = point.at.edge;
      places.emplace_back(begins[edge] + point.at.share * (begins[edge + 1] - begins[edge]), point.weight);
      weights += point.weight;
    }
    std::sort(places.begin(), places.end());
    std::vector<double> shares;
    for (std::size_t j = 0; j < places.size(); ++j) {
      const double from = j > 0 ? places[j - 1].first : 0;
      const double to = j + 1 < places.size() ? places[j + 1].first : length_;
      const double length = (to - from) / 2 / length_;
      shares.push_back(std::pow(places[j].second / weights, 1.0 / 6) * std::pow(length, 5.0 / 6) / 3);
    }
    return shares;
  }

  /// How many parameters the spline has in effect, in each coordinate; a point can tell no more than one.
  [[nodiscard]] static double freedom(const std::vector<double>& shares, double smoothing) {
    const double density = std::pow(smoothing, -1.0 / 6);
    double sum = 0;
    for (const double share : shares) sum += std::min(1.0, share * density);
    return sum;
  }

  /// Of the curve as it was, at the places of points.
  [[nodiscard]] std::vector<Vector3> directions_at_points() const {
    std::vector<Vector3> directions(points_.size(), Vector3::Zero());
    for (std::size_t j = 0; j < points_.size() && curve_.moves_freely(); ++j)
      directions[j] = curve_.direction(points_[j].at);
    return directions;
  }

  /// Of points from their places, across the curve.
  [[nodiscard]] double mean_square_across(const std::vector<Vector3>& along) const {
    double squares = 0;
    double weights = 0;
    for (std::size_t j = 0; j < points_.size(); ++j) {
      const CurvePoint& point = points_[j];
      Vector3 away = residual(j);
      away -= away.dot(along[j]) * along[j];
      squares += point.weight * away.squaredNorm();
      weights += point.weight;
    }
    return squares / weights;
  }

  [[nodiscard]] double squared_residual(std::size_t point) const { return residual(point).squaredNorm(); }

  [[nodiscard]] Vector3 residual(std::size_t point) const {
    const Affine& row = point_rows_[point];
    Vector3 away = row.rest;
    for (int k = 0; k < row.count; ++k) {
      const auto n = static_cast<std::size_t>(k);
      away += row.weights[n] * found(row.nodes[n]);
    }
    return curve_.moving().cwiseProduct(away);
  }

  /// From the chords about its place.
  [[nodiscard]] double squared_distance(const CurvePoint& point) const {
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

  DenseCurve& curve_;
  const std::vector<CurvePoint>& points_;
  std::vector<std::int32_t> column_;
  std::size_t columns_ = 0;
  std::size_t width_ = 0;
  std::vector<Row> rows_;  ///< until they are taken
  std::vector<Affine> point_rows_;
  std::vector<std::size_t> order_;  ///< of points, by their first unknowns
  LeastSquares fixed_{0, 1};
  LeastSquares data_{0, 1};
  double length_ = 0;
  std::vector<double> counts_;  ///< what each point counts for, besides its weight
  std::vector<Vector3> places_;
};

}  // namespace

void smooth_out(DenseCurve& curve, const std::vector<CurvePoint>& points, double within, double rms) {
  SmoothingSpline(curve, points).run(within, rms);
}

void smooth_out_by(DenseCurve& curve, const std::vector<CurvePoint>& points, double length) {
  SmoothingSpline(curve, points).run_by(length);
}

LeastRisk smooth_out_by_risk(DenseCurve& curve, const std::vector<CurvePoint>& points, double noise, int directions,
                             double about) {
  return SmoothingSpline(curve, points).run_by_risk(noise, directions, about);
}

void smooth_out_robustly(DenseCurve& curve, const std::vector<CurvePoint>& points, double noise) {
  SmoothingSpline(curve, points).run_robustly(noise);
}

}  // namespace vspring
