#include "vspring/local_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "vspring/error.hpp"

namespace vspring::local_plane_test {
namespace {

/// Where a place on the ellipsoid is in space: lengths of short chords are those on the ground.
Vector3 in_space(const LocalPlane::Place& place) {
  constexpr double a = 6378137;
  constexpr double f = 1 / 298.257223563;
  const double latitude = place.latitude * std::numbers::pi / 180;
  const double longitude = place.longitude * std::numbers::pi / 180;
  const double across = a / std::sqrt(1 - f * (2 - f) * std::pow(std::sin(latitude), 2));
  return {across * std::cos(latitude) * std::cos(longitude), across * std::cos(latitude) * std::sin(longitude),
          across * (1 - f) * (1 - f) * std::sin(latitude)};
}

class Places {
 public:
  LocalPlane::Place origin() { return {89 * draw(), 180 * draw()}; }
  Vector3 within(double distance) {
    return {distance * draw() / std::numbers::sqrt2, distance * draw() / std::numbers::sqrt2, 0};
  }
  double draw() { return number_(generator_); }

 private:
  std::mt19937_64 generator_{5};
  std::uniform_real_distribution<double> number_{-1, 1};
};

TEST(LocalPlane, KeepsLengthsToAMillionthWithin12Kilometres) {
  Places places;
  for (int k = 0; k < 2000; ++k) {
    const LocalPlane plane(places.origin());
    const Vector3 a = places.within(12'000);
    const Vector3 b = a + places.within(100);
    const double on_ground = (in_space(plane.place(a)) - in_space(plane.place(b))).norm();
    // Beside what rounding of numbers of the size of the earth makes of the chord.
    EXPECT_NEAR((a - b).norm(), on_ground, 1e-6 * on_ground + 5e-9);
  }
}

TEST(LocalPlane, StretchesAsItSays) {
  Places places;
  for (const double distance : {1e5, 1e6}) {
    for (int k = 0; k < 500; ++k) {
      const LocalPlane plane(places.origin());
      const Vector3 a = places.within(distance);
      // In every direction alike.
      for (const Vector3& step : {Vector3(100, 0, 0), Vector3(0, 100, 0), Vector3(70, -70, 0)}) {
        const double on_ground = (in_space(plane.place(a)) - in_space(plane.place(a + step))).norm();
        EXPECT_NEAR(step.norm() / on_ground - 1, plane.stretch(a), 1e-3 * plane.stretch({distance, 0, 0}));
      }
    }
  }
}

TEST(LocalPlane, LeadsBackToTheSamePlace) {
  Places places;
  for (const double distance : {1.0, 1e3, 1e5, 1e6}) {
    for (int k = 0; k < 500; ++k) {
      const LocalPlane plane(places.origin());
      const Vector3 a = places.within(distance);
      EXPECT_LT((plane.position(plane.place(a)) - a).norm(), 2e-8);
    }
  }
}

TEST(LocalPlane, HasItsOriginInTheMiddleAndNorthUp) {
  const LocalPlane plane({47.25, 8.5});
  EXPECT_LT(plane.position({47.25, 8.5}).norm(), 1e-8);
  EXPECT_NEAR(plane.position({47.25, 8.5}).x(), 0, 1e-9);
  // A minute of arc north is a nautical mile or so, and less than that east.
  const Vector3 north = plane.position({47.25 + 1 / 60.0, 8.5});
  const Vector3 east = plane.position({47.25, 8.5 + 1 / 60.0});
  EXPECT_NEAR(north.y(), 1853, 1);
  EXPECT_NEAR(north.x(), 0, 1e-9);
  EXPECT_NEAR(east.x(), 1853 * std::cos(47.25 * std::numbers::pi / 180), 5);
  EXPECT_DOUBLE_EQ(plane.origin().latitude, 47.25);
}

TEST(LocalPlane, CrossesTheDateLineAndReachesPoles) {
  const LocalPlane plane({0, 179.9});
  EXPECT_NEAR(plane.position({0, -179.9}).x(), 22264, 1);
  EXPECT_NEAR(plane.place({22264, 0, 0}).longitude, -179.9, 1e-5);
  for (const double latitude : {90.0, -90.0}) {
    const LocalPlane pole({latitude, 12});
    const LocalPlane::Place near = {latitude * 0.99, -77};
    const LocalPlane::Place again = pole.place(pole.position(near));
    EXPECT_NEAR(again.latitude, near.latitude, 1e-12);
    EXPECT_NEAR(again.longitude, near.longitude, 1e-10);
    EXPECT_TRUE(plane.position({latitude, 3}).allFinite());
    EXPECT_NEAR(plane.place(plane.position({latitude, 3})).latitude, latitude, 1e-9);
  }
  for (const LocalPlane::Place none : {LocalPlane::Place{91, 0}, {NAN, 0}, {0, NAN}, {0, INFINITY}})
    EXPECT_THROW(LocalPlane{none}, Error);
}

}  // namespace
}  // namespace vspring::local_plane_test
