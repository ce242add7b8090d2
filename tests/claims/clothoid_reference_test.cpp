// The reference clothoids that other tests compare with, against closed forms, series and brute force.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <vector>

#include "support/clothoid.hpp"

namespace vspring::reference::clothoid_reference_test {
namespace {

using Eigen::Vector2d;

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;

double end_error(const Clothoid& clothoid, const Vector2d& end) { return (clothoid.at(clothoid.length) - end).norm(); }

double turn_of(const Clothoid& clothoid) { return clothoid.angle_at(clothoid.length) - clothoid.angle; }

bool has_inflection(const Clothoid& clothoid) {
  return clothoid.curvature * clothoid.curvature_at(clothoid.length) < 0;
}

// Largest difference in shape, for clothoids over a chord of length about one.
double difference(const Clothoid& a, const Clothoid& b) {
  double largest = std::abs(a.length - b.length);
  largest = std::max(largest, std::abs(a.curvature - b.curvature));
  largest = std::max(largest, std::abs(a.curvature_rate - b.curvature_rate));
  for (int i = 0; i <= 8; ++i) {
    largest = std::max(largest, (a.at(a.length * i / 8) - b.at(b.length * i / 8)).norm());
  }
  return largest;
}

Vector2d mirrored(const Vector2d& p) { return {p.x(), -p.y()}; }

// C(x) and S(x), power series (Abramowitz and Stegun 7.3.11, 7.3.13).
Vector2d fresnel_series(double x) {
  const long double phase = std::numbers::pi_v<long double> / 2 * x * x;
  long double term = x;
  long double cosine = 0;
  long double sine = 0;
  for (int k = 0; k < 120; ++k) {
    (k % 2 == 0 ? cosine : sine) += (k / 2 % 2 == 0 ? term : -term) / (2 * k + 1);
    term *= phase / (k + 1);
  }
  return {static_cast<double>(cosine), static_cast<double>(sine)};
}

// Composite Simpson rule with 1e5 panels.
Vector2d simpson_end(const Clothoid& clothoid) {
  constexpr int panels = 100'000;
  const long double h = static_cast<long double>(clothoid.length) / (2 * panels);
  long double x = 0;
  long double y = 0;
  for (int i = 0; i <= 2 * panels; ++i) {
    const long double s = h * i;
    const long double theta = clothoid.angle + s * (clothoid.curvature + s * clothoid.curvature_rate / 2);
    const int weight = i == 0 || i == 2 * panels ? 1 : i % 2 == 1 ? 4 : 2;
    x += weight * std::cos(theta);
    y += weight * std::sin(theta);
  }
  return clothoid.start + Vector2d(static_cast<double>(x * h / 3), static_cast<double>(y * h / 3));
}

TEST(ClothoidReference, FresnelIntegrals) {
  // Abramowitz and Stegun, table 7.7.
  EXPECT_LT((fresnel_series(1) - Vector2d(0.7798934003768228, 0.4382591473903548)).norm(), 1e-15);
  const Clothoid spiral{.start = {0, 0}, .angle = 0, .curvature = 0, .curvature_rate = pi, .length = 3};
  double worst = 0;
  for (int i = -60; i <= 60; ++i) worst = std::max(worst, (spiral.at(i / 20.0) - fresnel_series(i / 20.0)).norm());
  EXPECT_LT(worst, 1e-14);  // up to a turn of 4.5 pi
}

TEST(ClothoidReference, PositionsAgreeWithSimpsonsRule) {
  const Vector2d start(0.25, -0.5);
  for (const Clothoid& clothoid : {Clothoid{start, 0.3, 1.5, -2.5, 2.0}, Clothoid{start, -2.0, -4.0, 3.0, 3.0},
                                   Clothoid{start, 1.0, 3 * pi, 0, 1.0}, Clothoid{start, 3.0, 9.0, -18.0, 1.0}}) {
    EXPECT_LT((clothoid.at(clothoid.length) - simpson_end(clothoid)).norm(), 1e-14);
  }
}

TEST(ClothoidReference, EndsWhereItShould) {
  const Vector2d p0(0.3, -0.2);
  int inflected = 0;
  int plain = 0;
  for (int turn = -270; turn <= 270; turn += 30) {
    for (int mean = -75; mean <= 75; mean += 25) {
      const double chord_direction = 0.1 * turn + 0.37 * mean;
      const Vector2d p1 = p0 + Vector2d(std::cos(chord_direction), std::sin(chord_direction));
      const double angle0 = chord_direction + (mean - turn / 2.0) * degree;
      const Clothoid clothoid = hermite_clothoid_with_turn(p0, angle0, p1, turn * degree);
      SCOPED_TRACE(testing::Message() << "turn " << turn << ", mean " << mean);
      EXPECT_EQ(clothoid.start, p0);
      EXPECT_EQ(clothoid.angle, angle0);
      EXPECT_GE(clothoid.length, 1 - 1e-15);
      EXPECT_LT(end_error(clothoid, p1), 1e-12);
      EXPECT_LT(std::abs(turn_of(clothoid) - turn * degree), 1e-12);
      ++(has_inflection(clothoid) ? inflected : plain);
    }
  }
  EXPECT_GE(inflected, 60);
  EXPECT_GE(plain, 30);
}

TEST(ClothoidReference, PrincipalSolutionIsOnTheBranchOfTheStraightLine) {
  const Vector2d p0(-0.4, 0.1);
  const Vector2d p1(0.3, 0.9);
  const double chord_direction = std::atan2(0.8, 0.7);
  for (int start = -175; start <= 175; start += 25) {
    for (int end = -175; end <= 175; end += 25) {
      // Nearly a whole circle: so long that curvature and rounding cannot be compared at a fixed accuracy.
      if (std::abs(start - end) > 300) continue;
      SCOPED_TRACE(testing::Message() << start << " to " << end);
      const double phi0 = start * degree;
      const double phi1 = end * degree;
      const Clothoid principal = hermite_clothoid(p0, chord_direction + phi0, p1, chord_direction + phi1);
      EXPECT_LT(end_error(principal, p1), 1e-12);
      EXPECT_LT(difference(principal, hermite_clothoid_on_chord(p0, p1, phi0, phi1)), 2e-12);
      // Angles count modulo 2 pi, and the turn says the same.
      EXPECT_LT(difference(principal,
                           hermite_clothoid(p0, chord_direction + phi0 + 2 * pi, p1, chord_direction + phi1 - 4 * pi)),
                2e-12);
      EXPECT_LT(difference(principal, hermite_clothoid_with_turn(p0, chord_direction + phi0 - 2 * pi, p1, phi1 - phi0)),
                2e-12);
    }
  }
}

TEST(ClothoidReference, GivesClothoidsBackFromTheirEnds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> curvature_of(-4.5, 4.5);  // over length one: turns by less than 270 degrees
  for (int i = 0; i < 200; ++i) {
    const double first = curvature_of(random);
    const double last = curvature_of(random);
    const Clothoid drawn{{1, 2}, curvature_of(random), first, last - first, 1};
    const Clothoid found = hermite_clothoid_with_turn(drawn.start, drawn.angle, drawn.at(1), turn_of(drawn));
    EXPECT_LT(difference(found, drawn), 1e-11) << first << " " << last;
  }
}

TEST(ClothoidReference, CircularArcs) {
  for (int turn = -270; turn <= 270; turn += 15) {
    const Vector2d p0(2, 1);
    const double angle0 = 0.7;
    const double radius = 1.5;
    Vector2d p1 = p0 + radius * Vector2d(std::cos(angle0), std::sin(angle0));
    if (turn != 0) {
      const double signed_radius = std::copysign(radius, turn);
      const double angle1 = angle0 + turn * degree;
      p1 = p0 + signed_radius * Vector2d(std::sin(angle1) - std::sin(angle0), std::cos(angle0) - std::cos(angle1));
    }
    SCOPED_TRACE(turn);
    const Clothoid arc = hermite_clothoid_with_turn(p0, angle0, p1, turn * degree);
    EXPECT_LT(std::abs(arc.curvature_rate), 1e-12);
    EXPECT_NEAR(arc.curvature, turn == 0 ? 0.0 : std::copysign(1 / radius, turn), 1e-12);
    EXPECT_NEAR(arc.length, turn == 0 ? radius : radius * std::abs(turn) * degree, 1e-12);
  }
}

TEST(ClothoidReference, StraightLine) {
  const Clothoid line = hermite_clothoid({1, 1}, std::atan2(4, 3), {4, 5}, std::atan2(4, 3));
  EXPECT_LT(std::abs(line.curvature), 1e-15);
  EXPECT_LT(std::abs(line.curvature_rate), 1e-15);
  EXPECT_NEAR(line.length, 5, 1e-14);
  EXPECT_LT((line.at(2.5) - Vector2d(2.5, 3)).norm(), 1e-14);
}

TEST(ClothoidReference, MirrorSymmetry) {
  const Vector2d p0(0, 0.5);
  const Vector2d p1(1, 0.25);
  for (const double angle0 : {-2.5, -1.0, 0.2, 1.3, 2.9}) {
    for (const double turn : {-4.7, -3.0, -0.5, 0.0, 1.0, 2.2, 4.7}) {
      SCOPED_TRACE(testing::Message() << angle0 << ", turn " << turn);
      const Clothoid clothoid = hermite_clothoid_with_turn(p0, angle0, p1, turn);
      const double unit = 1 + std::abs(clothoid.curvature_rate);
      const Clothoid mirror = hermite_clothoid_with_turn(mirrored(p0), -angle0, mirrored(p1), -turn);
      EXPECT_NEAR(mirror.length, clothoid.length, 1e-12);
      EXPECT_NEAR(mirror.curvature, -clothoid.curvature, 1e-12 * unit);
      EXPECT_NEAR(mirror.curvature_rate, -clothoid.curvature_rate, 1e-12 * unit);
      EXPECT_LT((mirror.at(0.4 * mirror.length) - mirrored(clothoid.at(0.4 * clothoid.length))).norm(), 1e-12);
      // The same curve run through backwards.
      const Clothoid back = hermite_clothoid_with_turn(p1, angle0 + turn + pi, p0, -turn);
      EXPECT_NEAR(back.length, clothoid.length, 1e-12);
      EXPECT_NEAR(back.curvature, -clothoid.curvature_at(clothoid.length), 1e-12 * unit);
      EXPECT_LT((back.at(0.4 * back.length) - clothoid.at(0.6 * clothoid.length)).norm(), 1e-12);
    }
  }
}

TEST(ClothoidReference, RefusesWhatHasNoSolution) {
  EXPECT_THROW((void)hermite_clothoid({1, 1}, 0, {1, 1}, 1), std::invalid_argument);
  EXPECT_THROW((void)hermite_clothoid({1, 1}, 0, {NAN, 1}, 1), std::invalid_argument);
  // A whole circle between two points.
  EXPECT_THROW((void)hermite_clothoid_on_chord({0, 0}, {1, 0}, -pi, pi), std::runtime_error);
  EXPECT_THROW((void)hermite_clothoid_spline({{0, 0}}), std::invalid_argument);
}

void expect_spline(const std::vector<Clothoid>& spline, const std::vector<Vector2d>& points) {
  ASSERT_EQ(spline.size() + 1, points.size());
  for (std::size_t i = 0; i < spline.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(spline[i].start, points[i]);
    EXPECT_LT(end_error(spline[i], points[i + 1]), 1e-12);
    if (i == 0) continue;
    const Clothoid& before = spline[i - 1];
    EXPECT_LT(std::abs(std::remainder(before.angle_at(before.length) - spline[i].angle, 2 * pi)), 1e-12);
    EXPECT_LT(std::abs(before.curvature_at(before.length) - spline[i].curvature), 1e-11);
  }
}

TEST(ClothoidReferenceSpline, CurvatureIsContinuous) {
  const std::vector<Vector2d> points{{0, 0}, {1, 0.4}, {1.5, 1.5}, {3, 1}, {3.2, -0.8}, {5, -1}, {5.5, 0.5}};
  const auto natural = hermite_clothoid_spline(points);
  expect_spline(natural, points);
  EXPECT_LT(std::abs(natural.front().curvature), 1e-12);
  EXPECT_LT(std::abs(natural.back().curvature_at(natural.back().length)), 1e-12);

  const auto held = hermite_clothoid_spline(points, -1.2, 2.5);
  expect_spline(held, points);
  EXPECT_EQ(held.front().angle, -1.2);
  EXPECT_LT(std::abs(std::remainder(held.back().angle_at(held.back().length) - 2.5, 2 * pi)), 1e-12);

  const auto mixed = hermite_clothoid_spline(points, std::nullopt, -0.3);
  expect_spline(mixed, points);
  EXPECT_LT(std::abs(mixed.front().curvature), 1e-12);
}

TEST(ClothoidReferenceSpline, PointsOfACircleGiveTheCircle) {
  // Unevenly spaced, more than once around.
  const double radius = 2;
  std::vector<Vector2d> points;
  std::vector<double> at;
  double angle = 0.4;
  double step = 0.3;
  while (angle < 8) {
    at.push_back(angle);
    points.push_back(radius * Vector2d(std::cos(angle), std::sin(angle)));
    angle += step;
    step = 1.2 - step / 2;
  }
  const auto spline = hermite_clothoid_spline(points, at.front() + pi / 2, at.back() + pi / 2);
  expect_spline(spline, points);
  for (std::size_t i = 0; i < spline.size(); ++i) {
    EXPECT_NEAR(spline[i].curvature, 1 / radius, 1e-11);
    EXPECT_LT(std::abs(spline[i].curvature_rate), 1e-11);
    EXPECT_NEAR(spline[i].length, radius * (at[i + 1] - at[i]), 1e-11);
    EXPECT_NEAR(spline[i].at(spline[i].length / 3).norm(), radius, 1e-11);
  }
}

TEST(ClothoidReferenceSpline, PointsOfAClothoidGiveTheClothoid) {
  const Clothoid whole{{0, 0}, 0.5, -1.5, 1.0, 5};
  std::vector<Vector2d> points;
  const std::vector<double> at{0, 0.7, 1.2, 2.3, 3.1, 3.6, 4.4, 5};
  points.reserve(at.size());
  for (const double s : at) points.push_back(whole.at(s));
  const auto spline = hermite_clothoid_spline(points, whole.angle, whole.angle_at(whole.length));
  expect_spline(spline, points);
  for (std::size_t i = 0; i < spline.size(); ++i) {
    EXPECT_NEAR(spline[i].curvature, whole.curvature_at(at[i]), 1e-11);
    EXPECT_NEAR(spline[i].curvature_rate, whole.curvature_rate, 1e-10);
  }
}

TEST(ClothoidReferenceSpline, TwoPointsAreOneHermiteClothoid) {
  const auto spline = hermite_clothoid_spline({{0, 0}, {1, 0}}, 1.1, 0.3);
  ASSERT_EQ(spline.size(), 1);
  EXPECT_LT(difference(spline[0], hermite_clothoid({0, 0}, 1.1, {1, 0}, 0.3)), 1e-12);
  const auto line = hermite_clothoid_spline({{0, 0}, {1, 0}});
  EXPECT_LT(std::abs(line[0].curvature), 1e-14);
}

}  // namespace
}  // namespace vspring::reference::clothoid_reference_test
