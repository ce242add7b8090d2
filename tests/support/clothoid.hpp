#pragma once

// Clothoids as an independent reference for the tests: uses nothing of the library.
//
// A clothoid (Euler spiral) has curvature linear in arc length. Notation follows E. Bertolazzi, M. Frego, "G1 fitting
// with clothoids", Math. Methods Appl. Sci. 38 (2015): over a chord of length r, with tau = s / L in [0, 1] and angles
// measured from the chord, the tangent angle is
//   P(tau) = A tau^2 + (delta - A) tau + phi0,   delta = phi1 - phi0,
// and the curve ends on the chord's far end exactly when g(A) = int sin P = 0 and L = r / h, h = int cos P > 0.

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace vspring::reference {

struct Clothoid {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  double angle = 0;           // of the tangent at the start
  double curvature = 0;       // at the start
  double curvature_rate = 0;  // derivative of the curvature by arc length
  double length = 0;

  [[nodiscard]] Eigen::Vector2d at(double s) const;
  // Not wrapped: angle_at(length) - angle is the total turn.
  [[nodiscard]] double angle_at(double s) const { return angle + s * (curvature + 0.5 * s * curvature_rate); }
  [[nodiscard]] double curvature_at(double s) const { return curvature + s * curvature_rate; }
};

namespace clothoid_detail {

constexpr double pi = std::numbers::pi;

struct GaussRule {
  std::array<double, 16> node{};  // on [0, 1]
  std::array<double, 16> weight{};
};

// Sixteen-point Gauss-Legendre rule: roots of the Legendre polynomial by Newton, in extended precision if available.
inline const GaussRule& gauss_rule() {
  static const GaussRule rule = [] {
    constexpr int n = 16;
    GaussRule made;
    for (int i = 0; i < n; ++i) {
      long double x = std::cos(std::numbers::pi_v<long double> * (i + 0.75L) / (n + 0.5L));
      long double derivative = 0;
      for (int iteration = 0; iteration < 10; ++iteration) {
        long double before = 1;
        long double value = x;
        for (int k = 2; k <= n; ++k) {
          const long double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
          before = value;
          value = next;
        }
        derivative = n * (x * value - before) / (x * x - 1);
        x -= value / derivative;
      }
      made.node[static_cast<std::size_t>(i)] = static_cast<double>((1 - x) / 2);
      made.weight[static_cast<std::size_t>(i)] = static_cast<double>(1 / ((1 - x * x) * derivative * derivative));
    }
    return made;
  }();
  return rule;
}

// Panels over which the angle turns by at most one radian: the rule's error is then far below rounding.
inline int panels_for(double turning) {
  if (!(turning <= 1e5)) throw std::runtime_error("clothoid: winds too often, or not finite");
  return 1 + static_cast<int>(turning);
}

// Calls visit(t, weight) for every node of the composite rule on [0, end].
template <typename Visit>
void quadrature(double end, int panels, const Visit& visit) {
  const GaussRule& rule = gauss_rule();
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      visit(end * ((panel + rule.node[i]) / panels), end * (rule.weight[i] / panels));
    }
  }
}

// To (-pi, pi].
inline double normalised(double angle) {
  const double rest = std::remainder(angle, 2 * pi);
  return rest <= -pi ? rest + 2 * pi : rest;
}

inline double direction(const Eigen::Vector2d& chord) { return std::atan2(chord.y(), chord.x()); }

// g and h with their derivatives by A, phi0 and phi1. Sums of plain numbers, as tests are not optimised.
struct Moments {
  double g = 0;
  double h = 0;
  std::array<double, 3> dg{};
  std::array<double, 3> dh{};
};

inline Moments moments(double a, double phi0, double phi1) {
  const double delta = phi1 - phi0;
  Moments sum;
  quadrature(1, panels_for(std::abs(delta) + std::abs(a)), [&](double t, double weight) {
    const double angle = phi0 + t * (delta + a * (t - 1));
    const double sine = weight * std::sin(angle);
    const double cosine = weight * std::cos(angle);
    sum.g += sine;
    sum.h += cosine;
    const double by[] = {t * (t - 1), 1 - t, t};
    for (std::size_t k = 0; k < 3; ++k) {
      sum.dg[k] += cosine * by[k];
      sum.dh[k] -= sine * by[k];
    }
  });
  return sum;
}

// Newton on g(A) = 0 down to rounding; nothing if it moves further than `reach` from the guess.
inline std::optional<double> newton(double guess, double phi0, double phi1, double reach) {
  double best = guess;
  double best_residual = std::numeric_limits<double>::infinity();
  double a = guess;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Moments m = moments(a, phi0, phi1);
    if (std::abs(m.g) >= best_residual) break;
    best = a;
    best_residual = std::abs(m.g);
    a -= m.g / m.dg[0];
    if (!(std::abs(a - guess) <= reach)) return std::nullopt;
  }
  if (best_residual > 1e-15) return std::nullopt;
  return best;
}

// A on the branch of the straight line: follows A(t) for the end angles (t phi0, t phi1), t from 0 to 1.
inline double continued(double phi0, double phi1) {
  const double largest = std::max(std::abs(phi0), std::abs(phi1));
  const double whole = 1 / std::ceil(1 + 8 * largest);
  double step = whole;
  double t = 0;
  double a = 0;
  while (t < 1) {
    const double next = std::min(1.0, t + step);
    const Moments m = moments(a, t * phi0, t * phi1);
    const double slope = -(m.dg[1] * phi0 + m.dg[2] * phi1) / m.dg[0];
    const double predicted = a + (next - t) * slope;
    // A small corrector step keeps the path from jumping to another branch.
    const std::optional<double> corrected = newton(predicted, next * phi0, next * phi1, 0.1);
    if (corrected && moments(*corrected, next * phi0, next * phi1).dg[0] * m.dg[0] > 0) {
      a = *corrected;
      t = next;
      step = std::min(whole, 2 * step);
    } else {
      step /= 2;
      if (step < 1e-7) throw std::runtime_error("clothoid: the branch of the straight line ends before these angles");
    }
  }
  return a;
}

// Start guess for end angles within [-pi, pi]: the fit in Bertolazzi and Frego's published implementation.
inline double fitted_guess(double phi0, double phi1) {
  const double x = phi0 / pi;
  const double y = phi1 / pi;
  const double product = x * y;
  const double squares = x * x + y * y;
  return (phi0 + phi1) * (2.989696028701907 + product * (0.716228953608281 - 0.458969738821509 * product) +
                          squares * (-0.502821153340377 + 0.261062141752652 * product - 0.045854475238709 * squares));
}

inline double solved(double phi0, double phi1) {
  if (std::max(std::abs(phi0), std::abs(phi1)) <= pi) {
    const std::optional<double> a = newton(fitted_guess(phi0, phi1), phi0, phi1, 2);
    if (a && moments(*a, phi0, phi1).h > 0) return *a;
  }
  return continued(phi0, phi1);
}

inline Clothoid over_chord(const Eigen::Vector2d& p0, double angle0, const Eigen::Vector2d& p1, double phi0,
                           double phi1, double a) {
  const double r = (p1 - p0).norm();
  const double h = moments(a, phi0, phi1).h;
  // h = 0 means infinite length, as for a whole circle that starts and ends at different points. The error of the end
  // point is rounding divided by h.
  if (!(h > 1e-8)) throw std::runtime_error("clothoid: no positive finite length");
  const double length = r / h;
  return {p0, angle0, (phi1 - phi0 - a) / length, 2 * a / (length * length), length};
}

inline void check_chord(const Eigen::Vector2d& p0, const Eigen::Vector2d& p1) {
  if (!((p1 - p0).norm() > 0)) throw std::invalid_argument("clothoid: ends coincide or are not finite");
}

}  // namespace clothoid_detail

inline Eigen::Vector2d Clothoid::at(double s) const {
  const double turning = std::abs(s) * std::max(std::abs(curvature), std::abs(curvature_at(s)));
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  clothoid_detail::quadrature(s, clothoid_detail::panels_for(turning), [&](double t, double weight) {
    const double theta = angle_at(t);
    sum += weight * Eigen::Vector2d(std::cos(theta), std::sin(theta));
  });
  return start + sum;
}

// The G1 Hermite problem with end angles relative to the chord that are not normalised. They select one of the many
// solutions: the one reached from the straight line as the angles grow in proportion from (0, 0) to (chord_angle0,
// chord_angle1). Throws std::runtime_error if that branch ends earlier. The clothoid turns by chord_angle1 -
// chord_angle0 exactly.
inline Clothoid hermite_clothoid_on_chord(const Eigen::Vector2d& p0, const Eigen::Vector2d& p1, double chord_angle0,
                                          double chord_angle1) {
  using namespace clothoid_detail;
  check_chord(p0, p1);
  const double a = continued(chord_angle0, chord_angle1);
  return over_chord(p0, direction(p1 - p0) + chord_angle0, p1, chord_angle0, chord_angle1, a);
}

// The G1 Hermite problem as Bertolazzi and Frego pose it: both end angles relative to the chord are taken in
// (-pi, pi], so the clothoid turns by less than 2 pi and has the fewest windings.
inline Clothoid hermite_clothoid(const Eigen::Vector2d& p0, double angle0, const Eigen::Vector2d& p1, double angle1) {
  using namespace clothoid_detail;
  check_chord(p0, p1);
  const double chord_direction = direction(p1 - p0);
  const double phi0 = normalised(angle0 - chord_direction);
  const double phi1 = normalised(angle1 - chord_direction);
  return over_chord(p0, angle0, p1, phi0, phi1, solved(phi0, phi1));
}

// hermite_clothoid() with the total turn given, not normalised: the end angle is angle0 + turn, and turn determines the
// windings. The start angle relative to the chord is taken with the multiple of 2 pi that makes the larger of the two
// end angles smallest (on a tie the start angle in (-pi, pi]); the branch is that of hermite_clothoid_on_chord.
inline Clothoid hermite_clothoid_with_turn(const Eigen::Vector2d& p0, double angle0, const Eigen::Vector2d& p1,
                                           double turn) {
  using namespace clothoid_detail;
  check_chord(p0, p1);
  const double principal = normalised(angle0 - direction(p1 - p0));
  // The larger of |phi0| and |phi0 + turn| is |phi0 + turn / 2| + |turn| / 2.
  double phi0 = principal;
  for (const double windings : {-2.0, -1.0, 1.0, 2.0}) {
    const double other = principal + 2 * pi * windings;
    if (std::abs(other + turn / 2) < std::abs(phi0 + turn / 2) - 1e-12) phi0 = other;
  }
  return over_chord(p0, angle0, p1, phi0, phi0 + turn, continued(phi0, phi0 + turn));
}

// The Euler-spiral spline through points (R. Levien, "From Spiral to Spline", 2009): one clothoid per segment, tangent
// direction and curvature continuous at the inner points (angles modulo 2 pi). An end without a given angle has
// curvature zero. Every segment is hermite_clothoid's solution, so neither end of it turns from its chord by more than
// pi.
inline std::vector<Clothoid> hermite_clothoid_spline(const std::vector<Eigen::Vector2d>& points,
                                                     std::optional<double> start_angle = std::nullopt,
                                                     std::optional<double> end_angle = std::nullopt) {
  using namespace clothoid_detail;
  if (points.size() < 2) throw std::invalid_argument("clothoid spline: fewer than two points");
  const Eigen::Index segments = static_cast<Eigen::Index>(points.size()) - 1;
  const auto point = [&](Eigen::Index i) -> const Eigen::Vector2d& { return points[static_cast<std::size_t>(i)]; };

  Eigen::VectorXd chord_length(segments);
  Eigen::VectorXd chord_direction(segments);
  for (Eigen::Index i = 0; i < segments; ++i) {
    check_chord(point(i), point(i + 1));
    chord_length[i] = (point(i + 1) - point(i)).norm();
    chord_direction[i] = direction(point(i + 1) - point(i));
  }

  // Start from about the tangents of circles through three points each.
  Eigen::VectorXd angles(segments + 1);
  for (Eigen::Index i = 1; i < segments; ++i) {
    const double turn = normalised(chord_direction[i] - chord_direction[i - 1]);
    angles[i] = chord_direction[i - 1] + turn * chord_length[i - 1] / (chord_length[i - 1] + chord_length[i]);
  }
  const Eigen::Index last = segments - 1;
  const auto mirrored = [&](Eigen::Index chord, Eigen::Index from) {
    return segments == 1 ? chord_direction[chord]
                         : chord_direction[chord] - normalised(angles[from] - chord_direction[chord]);
  };
  angles[0] = start_angle ? *start_angle : mirrored(0, 1);
  angles[segments] = end_angle ? *end_angle : mirrored(last, last);

  struct System {
    Eigen::VectorXd residual;
    Eigen::MatrixXd jacobian;
    std::vector<Clothoid> clothoids;
  };
  const double scale = chord_length.mean();  // makes curvature differences dimensionless
  const auto system_at = [&](const Eigen::VectorXd& at) {
    System system{Eigen::VectorXd::Zero(segments + 1), Eigen::MatrixXd::Zero(segments + 1, segments + 1), {}};
    for (Eigen::Index i = 0; i < segments; ++i) {
      const double phi0 = normalised(at[i] - chord_direction[i]);
      const double phi1 = normalised(at[i + 1] - chord_direction[i]);
      const double a = solved(phi0, phi1);
      system.clothoids.push_back(over_chord(point(i), at[i], point(i + 1), phi0, phi1, a));
      // Curvatures h (delta -+ A) / r at start and end; A depends on the angles through g = 0.
      const Moments m = moments(a, phi0, phi1);
      const Eigen::Vector2d da = -Eigen::Vector2d(m.dg[1], m.dg[2]) / m.dg[0];
      const Eigen::Vector2d dh = Eigen::Vector2d(m.dh[1], m.dh[2]) + m.dh[0] * da;
      const Eigen::Vector2d ddelta(-1, 1);
      const double unit = scale / chord_length[i];
      const double delta = phi1 - phi0;
      system.residual[i] += unit * m.h * (delta - a);
      system.residual[i + 1] -= unit * m.h * (delta + a);
      system.jacobian.block<1, 2>(i, i) += unit * (dh * (delta - a) + m.h * (ddelta - da)).transpose();
      system.jacobian.block<1, 2>(i + 1, i) -= unit * (dh * (delta + a) + m.h * (ddelta + da)).transpose();
    }
    for (const Eigen::Index end : {Eigen::Index{0}, segments}) {
      if (!(end == 0 ? start_angle : end_angle)) continue;
      system.residual[end] = 0;
      system.jacobian.row(end).setZero();
      system.jacobian(end, end) = 1;
    }
    return system;
  };

  System system = system_at(angles);
  for (int iteration = 0; iteration < 100; ++iteration) {
    Eigen::VectorXd step = system.jacobian.partialPivLu().solve(system.residual);
    if (start_angle) step[0] = 0;  // given angles stay to the last bit
    if (end_angle) step[segments] = 0;
    // Far from the solution, short steps: at most half a radian, halved until the residual falls.
    double factor = std::min(1.0, 0.5 / std::max(step.lpNorm<Eigen::Infinity>(), 1e-300));
    bool improved = false;
    for (int halving = 0; halving < 40 && !improved; ++halving, factor /= 2) {
      const Eigen::VectorXd trial = angles - factor * step;
      System next = system_at(trial);
      if (next.residual.norm() < system.residual.norm()) {
        angles = trial;
        system = std::move(next);
        improved = true;
      }
      if (system.residual.lpNorm<Eigen::Infinity>() < 1e-13 && halving > 0) break;
    }
    if (!improved) break;
  }
  // Newton goes on to rounding; rounding of the angles grows with the ratio of the chord lengths.
  const double roughest = scale / chord_length.minCoeff();
  if (!(system.residual.lpNorm<Eigen::Infinity>() <= 1e-12 * roughest)) {
    throw std::runtime_error("clothoid spline: no convergence");
  }
  return system.clothoids;
}

}  // namespace vspring::reference
