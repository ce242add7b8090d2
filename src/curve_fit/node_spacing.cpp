#include "curve_fit/node_spacing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "base/cancellation.hpp"
#include "base/dense_algebra.hpp"
#include "shape/segment.hpp"

namespace vspring {

namespace {

// Least distance, as a share of the mean distance of values around; and how many of these on either side.
constexpr double least_share_of_mean = 0.1;
constexpr std::size_t values_about = 8;

// Edges on a piece of the polyline that is straight within the tolerance, and on the arc of a turn.
constexpr double edges_of_piece = 12;
// In mean edges of the rows: nodes need not be denser, except at corners.
constexpr double least_share_of_rows = 0.5;
constexpr double least_share_of_tolerance = 0.5;
constexpr double steepest = 0.25;
// As a share of the length.
constexpr double least_share_of_length = 1e-5;
constexpr double greatest_half_turn = 1.3;

/// Whether the places of a piece of a way follow a straight line, in their order, within a tolerance.
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

/// Marks vertices whose polyline stays within a tolerance (Ramer 1972; Douglas and Peucker 1973). Pieces near a
/// straight line that misses the vertices count as straight, too, as vertices have noise.
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

/// A way with its vertices, and the spacing of nodes at these so far.
class Spacing {
 public:
  Spacing(const WayVertices& way, bool closed, double tolerance)
      : way_(way.places), fixed_(way.fixed), sharp_(way.sharp), closed_(closed), tolerance_(tolerance) {
    length_.assign(way_.size(), 0);
    for (std::size_t k = 1; k < way_.size(); ++k) length_[k] = length_[k - 1] + (way_[k] - way_[k - 1]).norm();
    spacing_.assign(way_.size(), length_.back());
  }

  std::vector<double> find() {
    find_vertices();
    divide_pieces();
    keep_to_rows();
    bend_at_corners();
    std::vector<double> edges;
    for (std::size_t k = 1; k < way_.size(); ++k) edges.push_back(length_[k] - length_[k - 1]);
    even_out_spacing(spacing_, edges, closed_);
    return std::move(spacing_);
  }

 private:
  /// Finds the ends of pieces that are straight within the tolerance.
  void find_vertices() {
    const std::size_t count = way_.size();
    std::vector<std::uint8_t> kept = fixed_;
    // Halves of a closed way separately, as its ends coincide.
    const std::size_t half = closed_ && count > 3 ? count / 2 : count - 1;
    keep_vertices(way_, 0, half, tolerance_, kept);
    if (half + 1 < count) keep_vertices(way_, half, count - 1, tolerance_, kept);
    for (std::size_t k = 0; k < count; ++k) {
      if (kept[k] != 0) vertices_.push_back(k);
    }
  }

  void divide_pieces() {
    for (std::size_t v = 0; v + 1 < vertices_.size(); ++v) {
      const double piece = (length_[vertices_[v + 1]] - length_[vertices_[v]]) / edges_of_piece;
      for (std::size_t k = vertices_[v]; k <= vertices_[v + 1]; ++k) spacing_[k] = std::min(spacing_[k], piece);
    }
  }

  void keep_to_rows() {
    // Corners move by up to the tolerance, which must not reverse edges next to them.
    const bool has_corners = std::find(sharp_.begin(), sharp_.end(), 1) != sharp_.end();
    const double least = has_corners ? least_share_of_tolerance * tolerance_ : 0;
    const std::size_t last = way_.size() - 1;
    for (std::size_t k = 0; k <= last; ++k) {
      const std::size_t before = k > 0 ? k - 1 : 0;
      const std::size_t after = std::min(k + 1, last);
      const double rows = (length_[after] - length_[before]) / static_cast<double>(after - before);
      spacing_[k] = std::max(spacing_[k], std::max(least_share_of_rows * rows, least));
    }
  }

  /// A vertex that turns more than its neighbours is a corner: there the curve turns within the tolerance.
  void bend_at_corners() {
    std::vector<Vector3> turns(vertices_.size(), Vector3::Zero());
    std::vector<double> angles(vertices_.size(), 0);
    for (std::size_t v = 1; v + 1 < vertices_.size(); ++v) {
      const Vector3 a = way_[vertices_[v]] - way_[vertices_[v - 1]];
      const Vector3 b = way_[vertices_[v + 1]] - way_[vertices_[v]];
      angles[v] = turn_between(a, b);
      turns[v] = a.cross(b);
    }
    for (std::size_t v = 1; v + 1 < vertices_.size(); ++v) {
      double beside = 0;
      for (const std::size_t w : {v - 1, v + 1}) {
        if (turns[w].dot(turns[v]) > 0) beside = std::max(beside, angles[w]);
      }
      const double excess = angles[v] - beside;
      const std::size_t k = vertices_[v];
      if (!(excess > greatest_turn_of_edge) || sharp_[k] != 0) continue;
      const double half_turn = std::min(excess / 2, greatest_half_turn);
      const double radius = tolerance_ / (1 / std::cos(half_turn) - 1);
      spacing_[k] = std::min(spacing_[k], radius * 2 * half_turn / edges_of_piece);
    }
  }

  const std::vector<Vector3>& way_;
  const std::vector<std::uint8_t>& fixed_;
  const std::vector<std::uint8_t>& sharp_;
  bool closed_;
  double tolerance_;
  std::vector<double> length_;         // up to each vertex
  std::vector<std::size_t> vertices_;  // the ends of straight pieces
  std::vector<double> spacing_;
};

}  // namespace

void set_in_order(std::vector<double>& values, double apart, double least, double most) {
  const std::size_t count = values.size();
  if (count == 0) return;
  std::vector<double> sorted = values;
  for (double& value : sorted) value = std::clamp(value, least, most);
  std::sort(sorted.begin(), sorted.end());
  // The least distance of value k from `least`.
  std::vector<double> from(count + 1);
  double sum = 0;
  for (std::size_t k = 0; k <= count; ++k) {
    const std::size_t first = k > values_about ? k - values_about : 0;
    const std::size_t last = std::min(count + 1, k + values_about);
    const auto at = [&](std::size_t n) { return n == 0 ? least : n > count ? most : sorted[n - 1]; };
    sum += std::max(apart, least_share_of_mean * (at(last) - at(first)) / static_cast<double>(last - first));
    from[k] = sum;
  }
  const double scale = std::min(1.0, (most - least) / sum);
  for (double& one : from) one *= scale;
  struct Pool {
    double sum;
    std::size_t count;
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Pool> pools;
  for (std::size_t k = 0; k < count; ++k) {
    pools.push_back({sorted[k] - least - from[k], 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() >= pools.back().mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().sum += last.sum;
      pools.back().count += last.count;
    }
  }
  std::size_t k = 0;
  const double spare = std::max(0.0, most - least - from[count]);
  for (const Pool& pool : pools) {
    for (std::size_t n = 0; n < pool.count; ++n, ++k) values[k] = least + from[k] + std::clamp(pool.mean(), 0.0, spare);
  }
}

double turn_between(const Vector3& a, const Vector3& b) {
  const double lengths = std::sqrt(a.squaredNorm() * b.squaredNorm());
  return lengths > 0 ? std::acos(std::clamp(a.dot(b) / lengths, -1.0, 1.0)) : 0;
}

std::vector<double> spacing_along(const WayVertices& way, bool closed, double tolerance) {
  return Spacing(way, closed, tolerance).find();
}

void even_out_spacing(std::vector<double>& spacing, std::span<const double> edges, bool closed) {
  const double whole = std::accumulate(edges.begin(), edges.end(), 0.0);
  for (double& one : spacing) one = std::max(one, least_share_of_length * whole);
  for (int around = 0; around < (closed ? 2 : 1); ++around) {
    if (closed) spacing.front() = spacing.back() = std::min(spacing.front(), spacing.back());
    for (std::size_t k = 0; k < edges.size(); ++k)
      spacing[k + 1] = std::min(spacing[k + 1], spacing[k] + steepest * edges[k]);
    for (std::size_t k = edges.size(); k-- > 0;)
      spacing[k] = std::min(spacing[k], spacing[k + 1] + steepest * edges[k]);
  }
}

std::vector<PlaceOnWay> places_between(std::span<const double> edges, std::span<const double> spacing,
                                       std::size_t first, std::size_t last, double least) {
  std::vector<double> sum = {0};
  for (std::size_t j = first; j < last; ++j) sum.push_back(sum.back() + edges[j] * 2 / (spacing[j] + spacing[j + 1]));
  const auto count = static_cast<std::size_t>(std::max(least, std::ceil(sum.back())));
  std::vector<PlaceOnWay> places;
  places.reserve(count);
  std::size_t j = first;
  for (std::size_t made = 1; made < count; ++made) {
    const double want = sum.back() * static_cast<double>(made) / static_cast<double>(count);
    while (j + 1 < last && sum[j - first + 1] < want) ++j;
    places.push_back({j, (want - sum[j - first]) / (sum[j - first + 1] - sum[j - first])});
  }
  return places;
}

}  // namespace vspring
