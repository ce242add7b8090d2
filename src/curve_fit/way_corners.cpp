#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/cancellation.hpp"
#include "curve_fit/way.hpp"

namespace vspring {

namespace {

// In tolerances: the length of a stretch, the rise of a corner of the least angle, and the least stretch next to
// another corner.
constexpr double stretch_in_tolerances = 8;
constexpr double rise_in_tolerances = 2;
constexpr double least_stretch_in_tolerances = 4;
// Lengths of stretches, relative to the least one.
constexpr double lengths_of_stretches[] = {4, 2, 1};
// As a share of a closed way.
constexpr double longest_stretch = 1.0 / 3;
// Greatest root mean square distance from two straight stretches, in tolerances.
constexpr double miss_of_stretches = 0.75;
// How much more an even bend must leave than two straight stretches, in variances about these.
constexpr double clear_gain_of_corner = 8;
constexpr double least_noise_of_stretches = 1.0 / 6;
// Shares of the length that count as zero.
constexpr double nothing_of_way = 1e-9;

class CornerSearch {
 public:
  CornerSearch(std::span<const Vector3> way, bool closed, double angle, double tolerance,
               std::span<const std::uint8_t> given, int least_edges)
      : way_(way),
        closed_(closed),
        angle_(angle),
        tolerance_(tolerance),
        least_edges_(least_edges),
        is_given_(given.begin(), given.end()) {
    is_given_.resize(way.size(), 0);
    is_corner_ = is_given_;
    at_.resize(way.size() + 1, 0);
    for (std::size_t k = 0; k < way.size(); ++k)
      at_[k + 1] = at_[k] + (closed || k + 1 < way.size() ? (way[(k + 1) % way.size()] - way[k]).norm() : 0);
    stretch_ = std::max(stretch_in_tolerances, rise_in_tolerances / std::sin(std::min(angle, std::numbers::pi) / 2)) *
               tolerance;
    if (closed) stretch_ = std::min(stretch_, longest_stretch * at_.back());
  }

  std::vector<std::size_t> find() {
    // The clearest corner first. Stretches of others end there, so more may become clear.
    for (bool is_new = true; is_new;) {
      std::vector<Corner> found;
      for (std::size_t k = 0; k < way_.size(); ++k) {
        end_if_cancelled_at(k);
        const Corner corner = look_at(k);
        if (is_corner_[k] == 0 && corner.gain >= 0) found.push_back(corner);
      }
      std::stable_sort(found.begin(), found.end(), [](const Corner& a, const Corner& b) {
        return a.gain > b.gain || (a.gain == b.gain && a.turn > b.turn);
      });
      is_new = false;
      for (const Corner& corner : found) {
        const Corner now = look_at(corner.place);
        if (is_corner_[corner.place] != 0 || now.gain < 0) continue;
        is_corner_[corner.place] = 1;
        is_new = true;
      }
    }
    // Moves each corner, between the others, to where the residual is least.
    for (const std::size_t k : places()) {
      is_corner_[k] = 0;
      is_corner_[best_about(look_at(k))] = 1;
    }
    return places();
  }

 private:
  struct Corner {
    std::size_t place = 0;
    double gain = -1;  ///< squares that an even bend leaves beyond those of the corner; negative: no corner
    double turn = 0;
    double left = 0;  ///< mean squares that the corner leaves
  };

  [[nodiscard]] std::vector<std::size_t> places() const {
    std::vector<std::size_t> corners;
    for (std::size_t k = 0; k < way_.size(); ++k) {
      if (is_corner_[k] != 0 && is_given_[k] == 0) corners.push_back(k);
    }
    return corners;
  }

  /// The place near a corner at which it leaves least.
  [[nodiscard]] std::size_t best_about(Corner corner) const {
    const std::size_t count = way_.size();
    for (std::size_t steps = 0; steps < count; ++steps) {
      const Corner before = corner;
      for (const std::size_t next : {(before.place + count - 1) % count, (before.place + 1) % count}) {
        const Corner other = look_at(next);
        if (is_corner_[next] == 0 && other.gain >= 0 && other.left < corner.left) corner = other;
      }
      if (corner.place == before.place) break;
    }
    return corner.place;
  }

  /// Places around one, itself included, with their lengths from it along the way.
  struct Window {
    std::vector<Vector3> places;
    std::vector<double> at;
    double before = 0;  ///< lengths on both sides
    double after = 0;
  };

  /// At most this long on either side, unless that has fewer than the least edges.
  [[nodiscard]] Window window(std::size_t about, double most) const {
    Window found{{way_[about]}, {0}};
    const std::size_t count = way_.size();
    for (const bool ahead : {false, true}) {
      double& length = ahead ? found.after : found.before;
      int edges = 0;
      for (std::size_t k = about; closed_ || (ahead ? k + 1 < count : k > 0);) {
        const std::size_t next = ahead ? (k + 1) % count : (k + count - 1) % count;
        const std::size_t edge = ahead ? k : next;
        const double longer = length + at_[edge + 1] - at_[edge];
        if (next == about || ((length > 0 && longer > most) && edges >= least_edges_)) break;
        length = longer;
        ++edges;
        found.places.push_back(way_[next]);
        found.at.push_back(ahead ? length : -length);
        k = next;
        if (is_corner_[k] != 0) break;
      }
    }
    return found;
  }

  /// Fits places by three functions of their lengths, and gives the residual sum of squares.
  struct LeastSquares3 {
    Eigen::Matrix3d rows;
    double left = 0;
  };

  template <typename Functions>
  static LeastSquares3 nearest(const Window& window, Functions functions) {
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d right = Eigen::Matrix3d::Zero();
    for (std::size_t n = 0; n < window.at.size(); ++n) {
      const Vector3 values = functions(window.at[n]);
      squares += values * values.transpose();
      right += values * (window.places[n] - window.places.front()).transpose();
    }
    LeastSquares3 found;
    found.rows = squares.ldlt().solve(right);
    for (std::size_t n = 0; n < window.at.size(); ++n)
      found.left +=
          (window.places[n] - window.places.front() - found.rows.transpose() * functions(window.at[n])).squaredNorm();
    return found;
  }

  static Vector3 sharp(double at) { return {1, std::min(at, 0.0), std::max(at, 0.0)}; }
  static double turn_of(const LeastSquares3& corner) {
    const Vector3 in = corner.rows.row(1);
    const Vector3 out = corner.rows.row(2);
    return std::atan2(in.cross(out).norm(), in.dot(out));
  }

  /// Compares corner and bend on the longest stretches on which either is near enough.
  [[nodiscard]] Corner look_at(std::size_t k) const {
    Corner corner{k};
    for (const double times : lengths_of_stretches) {
      const Window window = this->window(k, times * stretch_);
      if (std::min(window.before, window.after) < least_stretch_in_tolerances * tolerance_) return corner;
      const LeastSquares3 of_corner = nearest(window, sharp);
      const double unit = std::max(window.before, window.after);
      const LeastSquares3 of_bend =
          nearest(window, [unit](double at) { return Vector3(1, at / unit, at * at / (unit * unit)); });
      const auto count = static_cast<double>(window.at.size());
      corner.left = of_corner.left / count;
      const double nothing = nothing_of_way * at_.back();
      if (std::min(of_corner.left, of_bend.left) > count * std::pow(miss_of_stretches * tolerance_ + nothing, 2))
        continue;
      corner.turn = turn_of(of_corner);
      if (!(corner.turn > angle_)) return corner;
      // Three places lie on both.
      const double gain = of_bend.left - of_corner.left;
      const double variance = count > 3 ? of_corner.left / (count - 3) : 0;
      const double least_variance = std::pow(least_noise_of_stretches * tolerance_ + nothing, 2);
      if (count == 3 || gain > clear_gain_of_corner * std::max(variance, least_variance))
        corner.gain = std::max(0.0, gain);
      return corner;
    }
    return corner;
  }

  std::span<const Vector3> way_;
  bool closed_;
  double angle_;
  double tolerance_;
  int least_edges_;
  double stretch_ = 0;
  std::vector<double> at_;  ///< lengths along the way; the last is the whole length
  std::vector<std::uint8_t> is_given_;
  std::vector<std::uint8_t> is_corner_;
};

}  // namespace

std::vector<std::size_t> corners_of_way(std::span<const Vector3> way, bool closed, double angle, double tolerance,
                                        std::span<const std::uint8_t> given, int least_edges) {
  if (way.size() < 3) return {};
  return CornerSearch(way, closed, angle, tolerance, given, least_edges).find();
}

}  // namespace vspring
