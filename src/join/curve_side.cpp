#include "join/curve_side.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/dense_algebra.hpp"
#include "join/curvature_arc.hpp"

namespace vspring {

namespace {

// A place, a direction and a constant curvature; one more for linear and quadratic curvature; and one more to judge.
constexpr Eigen::Index fewest_terms_of_arc = 3;
constexpr Eigen::Index most_terms_of_arc = 6;
// Places beyond these, where there are as many: what fewer are off tells little.
constexpr std::size_t enough_spare = 2;
constexpr std::size_t first_window = 11;
constexpr int most_passes = 20;
// What asks for more in one step leads nowhere.
constexpr double most_turn_of_step = 100;
// Of what places are off, squared: a step that takes less from it is small beside noise.
constexpr double last_gain = 1e-6;
// In lengths, squared: what rounding leaves.
constexpr double least_off = 1e-30;
// In lengths, root mean square: what is off by more is no smooth curve.
constexpr double most_off_arc = 0.1;
constexpr double most_off_without_noise = 1e-3;
// Of the curvature times the length of the arc, squared: more places need not tell it better.
constexpr double known = 1e-14;

struct FittedArc {
  CurvatureArc arc;
  double off = 0;     ///< the sum of the squares of what places are off, in lengths
  double spread = 0;  ///< the variance of its turn per length by noise of the places of variance 1, in lengths
};

/// The circle through the first place, the last and one half way.
std::optional<CurvatureArc> circle_through(std::span<const Vector3> places) {
  const Vector3 half = places[places.size() / 2] - places[0];
  const Vector3 whole = places.back() - places[0];
  CurvatureArc arc;
  for (std::size_t k = 0; k + 1 < places.size(); ++k) arc.length += (places[k + 1] - places[k]).norm();
  const Vector3 along = half / half.squaredNorm() - whole / whole.squaredNorm();
  if (!(arc.length > 0) || !along.allFinite() || !(along.norm() > 0)) return std::nullopt;
  const Vector3 tangent = along.normalized();
  const Vector3 across = whole - whole.dot(tangent) * tangent;
  const double sine = across.norm();
  arc.start.place = places[0];
  arc.start.axes.col(0) = tangent;
  arc.start.axes.col(1) = sine > 1e-12 * arc.length ? Vector3(across / sine) : Vector3(tangent.unitOrthogonal());
  arc.start.axes.col(2) = tangent.cross(Vector3(arc.start.axes.col(1)));
  arc.turns(0, 0) = 2 * sine / whole.squaredNorm() * arc.length;
  return arc;
}

/// Steps of Gauss and Newton to where the arc is least off the places, across it.
std::optional<FittedArc> fitted(std::span<const Vector3> places, CurvatureArc arc, Eigen::Index terms) {
  const auto count = static_cast<Eigen::Index>(places.size());
  std::vector<double> at = {0};
  for (std::size_t k = 0; k + 1 < places.size(); ++k)
    at.push_back(at.back() + (places[k + 1] - places[k]).norm() / arc.length);
  const Eigen::Index columns = 2 * terms;
  Eigen::MatrixXd rows(2 * count, columns);
  Eigen::VectorXd off(2 * count);
  for (int pass = 0; pass < most_passes; ++pass) {
    const std::vector<CurvatureArc::Place> walked = arc.walk(arc.steps());
    const Eigen::Matrix<double, 3, 2> across = arc.start.normals();
    for (Eigen::Index k = 0; k < count; ++k) {
      double& u = at[static_cast<std::size_t>(k)];
      const CurvatureArc::Place here = arc.at(u, walked);
      const Vector3 way = places[static_cast<std::size_t>(k)] - here.pose.place;
      const Vector3 from_start = here.pose.place - arc.start.place;
      const Eigen::Matrix<double, 2, 3> to_rows = here.pose.normals().transpose();
      off.segment<2>(2 * k) = to_rows * way / arc.length;
      rows.block<2, 2>(2 * k, 0) = to_rows * across;
      rows.block<2, 2>(2 * k, 2) = to_rows * across.colwise().cross(from_start) / arc.length;
      rows.block(2 * k, 4, 2, columns - 4) = (to_rows * here.moved(arc.start.place) / arc.length).leftCols(columns - 4);
      u += way.dot(here.pose.tangent()) / arc.length;
    }
    const Eigen::MatrixXd spread = inverse(rows.transpose() * rows);
    const Eigen::VectorXd step = spread * (rows.transpose() * off);
    if (!step.allFinite() || !(step.cwiseAbs().maxCoeff() < most_turn_of_step)) return std::nullopt;
    arc.start.place += arc.length * (across * step.head<2>());
    const Vector3 turn = across * step.segment<2>(2);
    if (turn.norm() > 0)
      arc.start.axes = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * arc.start.axes;
    // It starts beside the first place.
    arc.start.place += (places[0] - arc.start.place).dot(arc.start.tangent()) * arc.start.tangent();
    for (Eigen::Index k = 4; k < columns; ++k) arc.turns(k % 2, k / 2 - 2) += step[k];
    const double squares = (off - rows * step).squaredNorm();
    if (off.squaredNorm() - squares > last_gain * squares + least_off * static_cast<double>(count)) continue;
    if (!(squares < most_off_arc * most_off_arc * static_cast<double>(count))) return std::nullopt;
    const FittedArc found = {arc, squares, spread(4, 4) + spread(5, 5)};
    if (!std::isfinite(found.spread)) return std::nullopt;
    return found;
  }
  return std::nullopt;
}

Vector3 curvature_at_start(const CurvatureArc& arc) { return arc.start.normals() * arc.turns.col(0) / arc.length; }

struct JudgedSide {
  CurveSide side;
  bool is_known = false;  ///< so well that more places need not tell
};

/// By how much the second derivative is wrong at the end if places are off by a Legendre polynomial of this degree,
/// with a root mean square of 1.
double error_by_legendre(Eigen::Index degree) {
  const auto n = static_cast<double>(degree);
  return std::sqrt(2 * n + 1) * (n - 1) * n * (n + 1) * (n + 2) / 2;
}

/// By the arc of these places that tells the curvature best: what an arc of more terms is off is noise, and what others
/// are off more is their error.
std::optional<JudgedSide> judged(std::span<const Vector3> places, std::size_t spare) {
  std::optional<CurvatureArc> start = circle_through(places);
  std::vector<FittedArc> arcs;
  const auto count = static_cast<Eigen::Index>(places.size());
  for (Eigen::Index terms = fewest_terms_of_arc; start && terms <= most_terms_of_arc; ++terms) {
    if (terms + static_cast<Eigen::Index>(spare) > count) break;
    const std::optional<FittedArc> found = fitted(places, *start, terms);
    if (!found) break;
    arcs.push_back(*found);
    start = found->arc;
  }
  if (arcs.empty()) return std::nullopt;
  const auto most = fewest_terms_of_arc + static_cast<Eigen::Index>(arcs.size()) - 1;
  const double noise =
      std::max(arcs.back().off / static_cast<double>(std::max<Eigen::Index>(1, 2 * (count - most))), least_off);
  std::optional<JudgedSide> best;
  for (std::size_t k = 0; k < std::max<std::size_t>(1, arcs.size() - 1); ++k) {
    const auto terms = fewest_terms_of_arc + static_cast<Eigen::Index>(k);
    const double more = arcs[k].off - arcs.back().off - 2 * static_cast<double>(most - terms) * noise;
    const double error = error_by_legendre(terms);
    const CurvatureArc& arc = arcs[k].arc;
    const double of_turn = noise * arcs[k].spread + error * error * std::max(0.0, more) / static_cast<double>(count);
    const double variance = of_turn / (arc.length * arc.length);
    if (!best || variance < best->side.variance)
      best = {{arc.start.tangent(), curvature_at_start(arc), variance}, of_turn < known};
  }
  return best;
}

}  // namespace

std::optional<CurveSide> curve_side(std::span<const Vector3> places) {
  if (places.size() < static_cast<std::size_t>(fewest_terms_of_arc)) return std::nullopt;
  const std::size_t spare = std::min(enough_spare, places.size() - static_cast<std::size_t>(fewest_terms_of_arc));
  std::optional<JudgedSide> best;
  int worse = 0;
  // More places tell less once two windows in a row do.
  for (std::size_t window = first_window; worse < 2; window = 2 * window - 1) {
    const std::span<const Vector3> taken = places.first(std::min(window, places.size()));
    const std::optional<JudgedSide> found = judged(taken, spare);
    if (found && (!best || found->side.variance < best->side.variance)) {
      best = found;
      worse = 0;
    } else if (best) {
      ++worse;
    }
    if (taken.size() == places.size() || (best && best->is_known)) break;
  }
  if (!best) return std::nullopt;
  return best->side;
}

std::optional<Vector3> curvature_at_first(std::span<const Vector3> places) {
  const auto fewest = static_cast<std::size_t>(most_terms_of_arc);
  for (std::size_t count = places.size();; count = std::max(fewest, count / 2)) {
    const std::span<const Vector3> taken = places.first(count);
    const auto terms = static_cast<Eigen::Index>(std::min(fewest, count));
    const std::optional<FittedArc> found = fitted(taken, linear_arc_near(taken, std::nullopt), terms);
    if (found && found->off < most_off_without_noise * most_off_without_noise * static_cast<double>(count))
      return curvature_at_start(found->arc);
    if (count <= fewest) return std::nullopt;
  }
}

}  // namespace vspring
