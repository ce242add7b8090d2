#include "fill/rim_triangles.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "fill/refinement.hpp"

namespace vspring::rim_triangles_test {
namespace {

/// normals: of the faces beside every edge.
Rim rim_of(std::vector<Vector3> places, const Vector3& normals = Vector3::Zero()) {
  Rim rim;
  rim.normals.assign(places.size(), normals);
  rim.joined.resize(places.size());
  rim.places = std::move(places);
  return rim;
}

std::vector<Vector3> circle(int count, double height = 0) {
  std::vector<Vector3> places;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    places.emplace_back(std::cos(angle), std::sin(angle), height * std::cos(2 * angle));
  }
  return places;
}

Vector3 vector_area(const std::vector<Vector3>& places, const std::array<Index, 3>& t) {
  const auto at = [&](std::size_t c) { return places[static_cast<std::size_t>(t[c])]; };
  return (at(1) - at(0)).cross(at(2) - at(0)) / 2;
}

double area(const Rim& rim, const RimTriangles& made) {
  double sum = 0;
  for (const auto& t : made.triangles) sum += vector_area(rim.places, t).norm();
  return sum;
}

/// Edges of the rim are in one triangle each, along the rim; all others in two, in both directions.
void expect_disc(const std::vector<std::array<Index, 3>>& triangles, Index rim, std::size_t nodes) {
  EXPECT_EQ(triangles.size(), 2 * nodes - static_cast<std::size_t>(rim) - 2);
  std::set<std::pair<Index, Index>> sides;
  for (const auto& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(sides.emplace(t[c], t[(c + 1) % 3]).second);
  }
  for (const auto& [a, b] : sides) {
    const bool at_rim = a < rim && b == (a + 1) % rim;
    EXPECT_EQ(sides.count({b, a}), at_rim ? 0U : 1U) << a << " to " << b;
  }
}

TEST(RimTriangles, APlanarPolygonIsCoveredOnce) {
  // A letter L, and a comb of which no corner sees all.
  const std::vector<std::vector<Vector3>> polygons = {
      circle(9),
      {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
      {{0, 0, 0},
       {5, 0, 0},
       {5, 3, 0},
       {4, 3, 0},
       {4, 1, 0},
       {3, 1, 0},
       {3, 3, 0},
       {2, 3, 0},
       {2, 1, 0},
       {1, 1, 0},
       {1, 3, 0},
       {0, 3, 0}}};
  const double areas[] = {9 * std::sin(2 * std::numbers::pi / 9) / 2, 3, 11};
  for (std::size_t k = 0; k < std::size(areas); ++k) {
    for (const bool turned : {false, true}) {
      std::vector<Vector3> places = polygons[k];
      const Eigen::AngleAxisd turn(0.7, Vector3(1, 2, 3).normalized());
      for (Vector3& p : places) p = turned ? Vector3(turn * p + Vector3(100, 0, 0)) : p;
      const Rim rim = rim_of(places, turned ? turn * Vector3::UnitZ() : Vector3::UnitZ());
      const RimTriangles made = triangulate(rim);
      EXPECT_FALSE(made.is_folded);
      expect_disc(made.triangles, static_cast<Index>(places.size()), places.size());
      EXPECT_NEAR(area(rim, made), areas[k], 1e-9);
      // Ears first: the same plane region.
      const RimTriangles in_parts = triangulate(rim, 4);
      expect_disc(in_parts.triangles, static_cast<Index>(places.size()), places.size());
      EXPECT_NEAR(area(rim, in_parts), areas[k], 1e-9);
    }
  }
}

TEST(RimTriangles, TheGreatestDihedralAngleIsLeast) {
  // A square bent along one diagonal: the other one would make the sharper edge with faces around that lie level.
  const Rim roof = rim_of({{0, 0, 0}, {1, 0, 0.4}, {1, 1, 0}, {0, 1, 0.4}}, Vector3::UnitZ());
  const auto greatest = [&](const std::vector<std::array<Index, 3>>& triangles) {
    double least = 1;
    for (const auto& t : triangles) least = std::min(least, vector_area(roof.places, t).normalized().z());
    return std::min(
        least,
        vector_area(roof.places, triangles[0]).normalized().dot(vector_area(roof.places, triangles[1]).normalized()));
  };
  const RimTriangles made = triangulate(roof);
  ASSERT_EQ(made.triangles.size(), 2U);
  const double best = std::max(greatest({{0, 1, 2}, {0, 2, 3}}), greatest({{1, 2, 3}, {1, 3, 0}}));
  EXPECT_NEAR(greatest(made.triangles), best, 1e-12);
  // The face beside the last edge alone decides: it goes on from one triangle there, away from the other.
  for (const bool other : {false, true}) {
    Rim beside = rim_of(roof.places);
    Vector3 near = vector_area(roof.places, {2, 3, 0}).normalized();
    Vector3 far = vector_area(roof.places, {3, 0, 1}).normalized();
    if (other) std::swap(near, far);
    beside.normals[3] = 2 * near.dot(far) * near - far;
    const auto triangles = triangulate(beside).triangles;
    const bool has_diagonal_of_1 = std::all_of(triangles.begin(), triangles.end(), [](const auto& t) {
      return std::count(t.begin(), t.end(), 1) + std::count(t.begin(), t.end(), 3) == 2;
    });
    EXPECT_EQ(has_diagonal_of_1, other);
  }
  // With the faces around of the other kind, the other diagonal.
  Rim saddle = rim_of(circle(4, 0.5));
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector3& a = saddle.places[k];
    const Vector3& b = saddle.places[(k + 1) % 4];
    const Vector3& low = saddle.places[k % 2 == 0 ? 3 - k : (k + 2) % 4];
    saddle.normals[k] = (b - a).cross(low - a).normalized();
  }
  const RimTriangles along = triangulate(saddle);
  for (const auto& t : along.triangles) EXPECT_GT(vector_area(saddle.places, t).z(), 0);
}

TEST(RimTriangles, ThreeEdgesAreOneTriangle) {
  const Rim rim = rim_of(circle(3), Vector3::UnitZ());
  const RimTriangles made = triangulate(rim);
  ASSERT_EQ(made.triangles.size(), 1U);
  EXPECT_FALSE(made.is_folded);
  EXPECT_TRUE(triangulate(rim_of({{0, 0, 0}, {1, 0, 0}})).triangles.empty());
}

TEST(RimTriangles, EdgesThatAreThereAlreadyAreNotMadeAgain) {
  Rim rim = rim_of(circle(4), Vector3::UnitZ());
  rim.joined[0] = {2};
  rim.joined[2] = {0};
  for (const std::size_t at_once : {std::size_t{500}, std::size_t{3}}) {
    for (const auto& t : triangulate(rim, at_once).triangles)
      EXPECT_TRUE(std::set<Index>(t.begin(), t.end()).count(0) + std::set<Index>(t.begin(), t.end()).count(2) < 2);
  }
  rim.joined[1] = {3};
  rim.joined[3] = {1};
  EXPECT_TRUE(triangulate(rim).triangles.empty());
  EXPECT_TRUE(triangulate(rim, 3).triangles.empty());
}

TEST(RimTriangles, WhatLiesOnTheFacesAroundIsFolded) {
  EXPECT_FALSE(triangulate(rim_of(circle(12), Vector3::UnitZ())).is_folded);
  EXPECT_TRUE(triangulate(rim_of(circle(12), -Vector3::UnitZ())).is_folded);
  // All in one line, as around a slit.
  EXPECT_TRUE(triangulate(rim_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}}, Vector3::UnitZ())).is_folded);
}

TEST(Refinement, TrianglesBecomeAsDenseAndAsRoundAsWhatIsAround) {
  const int count = 40;
  Patch patch;
  patch.places = patch.flat = circle(count);
  const double spacing = 2 * std::sin(std::numbers::pi / count);
  const Rim rim = rim_of(patch.places, Vector3::UnitZ());
  patch.triangles = triangulate(rim).triangles;
  patch.spacing.assign(patch.places.size(), spacing);
  for (Index k = 0; k < count; ++k) patch.like.push_back(k);
  EXPECT_TRUE(refine(patch, rim.joined));
  expect_disc(patch.triangles, count, patch.places.size());
  double sum = 0;
  double mean_edge = 0;
  double least_angle = 180;
  for (const auto& t : patch.triangles) {
    const Vector3 vector = vector_area(patch.places, t);
    EXPECT_GT(vector.z(), 0);
    sum += vector.norm();
    for (std::size_t c = 0; c < 3; ++c) {
      const auto at = [&](std::size_t k) { return patch.places[static_cast<std::size_t>(t[(c + k) % 3])]; };
      mean_edge += (at(1) - at(0)).norm() / 3 / static_cast<double>(patch.triangles.size());
      const Vector3 a = at(1) - at(0);
      const Vector3 b = at(2) - at(0);
      least_angle = std::min(least_angle, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
    }
  }
  EXPECT_NEAR(sum, count * std::sin(2 * std::numbers::pi / count) / 2, 1e-9);
  EXPECT_GT(mean_edge, 0.7 * spacing);
  EXPECT_LT(mean_edge, 1.3 * spacing);
  EXPECT_GT(least_angle, 15);
  for (const auto& t : patch.triangles)
    EXPECT_TRUE(std::any_of(t.begin(), t.end(), [&](Index i) { return i >= count; }));
  EXPECT_FALSE(refine(patch, rim.joined));
  for (std::size_t k = 0; k < patch.places.size(); ++k) EXPECT_LT(patch.like[k], count);
}

TEST(Refinement, ASharpTriangleAtTheRimGetsANodeThatCanMove) {
  const int count = 40;
  Patch patch;
  patch.places = circle(count);
  patch.places[0] = {1.05, 0, 0.13};
  patch.flat = patch.places;
  const Rim rim = rim_of(patch.places, Vector3::UnitZ());
  patch.triangles = {{count - 1, 0, 1}, {count - 1, 1, 20}};
  for (Index k = 1; k + 1 < count; ++k) {
    if (k != 19 && k != 20) patch.triangles.push_back({20, k, k + 1});
  }
  // The edge between the neighbours of node 0 is shorter, so that it is not cut.
  patch.spacing.assign(patch.places.size(), 0.4);
  for (Index k = 0; k < count; ++k) patch.like.push_back(k);
  EXPECT_TRUE(refine(patch, rim.joined));
  expect_disc(patch.triangles, count, patch.places.size());
  for (const auto& t : patch.triangles) {
    if (std::find(t.begin(), t.end(), 0) == t.end()) continue;
    EXPECT_TRUE(std::any_of(t.begin(), t.end(), [&](Index i) { return i >= count; }));
  }
}

}  // namespace
}  // namespace vspring::rim_triangles_test
