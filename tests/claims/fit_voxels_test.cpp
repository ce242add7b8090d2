// Surfaces of voxels: their steps are taken off, within half a voxel.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "support/masks.hpp"
#include "vspring/error.hpp"
#include "vspring/figures.hpp"
#include "vspring/fit.hpp"
#include "vspring/noise.hpp"
#include "vspring/self_intersections.hpp"
#include "vspring/topology.hpp"

namespace vspring::fit_voxels_test {
namespace {

using support::sides_of_voxels;

/// Quads over whole numbers.
PolygonMesh grid(int cells, const std::function<double(int, int)>& height) {
  std::vector<Vector3> places;
  std::vector<Index> begin = {0};
  std::vector<Index> corners;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) places.emplace_back(i, j, height(i, j));
  }
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const Index first = i * (cells + 1) + j;
      for (const Index corner : {first, first + cells + 1, first + cells + 2, first + 1}) corners.push_back(corner);
      begin.push_back(static_cast<Index>(corners.size()));
    }
  }
  return {std::move(places), std::move(begin), std::move(corners)};
}

double volume(const PolygonMesh& mesh, const std::vector<Vector3>& at) {
  double sum = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 2; k < face.size(); ++k)
      sum += at[static_cast<std::size_t>(face[0])].dot(
                 at[static_cast<std::size_t>(face[k - 1])].cross(at[static_cast<std::size_t>(face[k])])) /
             6;
  }
  return sum;
}

std::vector<Vector3> normals_of(const PolygonMesh& mesh, const std::vector<Vector3>& at) {
  std::vector<Vector3> sums(at.size(), Vector3::Zero());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const auto place = [&](std::size_t k) -> const Vector3& { return at[static_cast<std::size_t>(face[k])]; };
    const Vector3 area = (place(2) - place(0)).cross(place(3) - place(1));
    for (const Index node : face) sums[static_cast<std::size_t>(node)] += area;
  }
  for (Vector3& sum : sums) sum.normalize();
  return sums;
}

double rms(const std::vector<Vector3>& places, const std::function<double(const Vector3&)>& away) {
  double squares = 0;
  for (const Vector3& place : places) squares += std::pow(away(place), 2);
  return std::sqrt(squares / static_cast<double>(places.size()));
}

FitResult steps_off(const PolygonMesh& mesh, const Vector3& size) {
  FitOptions options;
  options.criterion = Voxels{size};
  return fit(mesh, Constraints(mesh.node_count()), {.positions = mesh.positions()}, options);
}

TEST(VoxelSize, IsFoundFarAwayAndInSinglePrecision) {
  const auto ball = [](const Vector3& place) { return place.norm() < 8; };
  for (const Vector3& size : {Vector3(1, 1, 1), Vector3(0.5, 0.5, 1.5)}) {
    PolygonMesh mesh = sides_of_voxels(size, Vector3::Constant(10), ball);
    const auto found = voxel_size(mesh);
    ASSERT_TRUE(found);
    EXPECT_LT((*found - size).norm(), 1e-12);
    // Far away and in single precision.
    std::vector<Vector3> places = mesh.positions();
    for (Vector3& place : places) place = (place + Vector3(300, -700, 20)).cast<float>().cast<double>();
    mesh.set_positions(places);
    ASSERT_TRUE(voxel_size(mesh));
    EXPECT_LT((*voxel_size(mesh) - size).norm(), 1e-3);
    EXPECT_EQ(estimate_noise(mesh).voxel, voxel_size(mesh));
    // With noise they are no steps.
    for (std::size_t i = 0; i < places.size(); ++i) places[i].x() += 0.05 * size.x() * std::sin(static_cast<double>(i));
    mesh.set_positions(places);
    EXPECT_FALSE(voxel_size(mesh));
  }
}

TEST(VoxelSize, IsNoneOfHeightsInWholeNumbersAndOfWhatIsFlat) {
  EXPECT_FALSE(
      voxel_size(grid(20, [](int i, int j) { return std::round(3 * std::sin(0.3 * i) + 2 * std::cos(0.4 * j)); })));
  EXPECT_FALSE(voxel_size(grid(20, [](int, int) { return 0; })));
}

TEST(FitVoxels, LeavesABallOfItsVolumeWithinHalfAVoxel) {
  const auto ball = [](const Vector3& place) { return (place - Vector3(0.1, 0.2, 0.3)).norm() < 12; };
  for (const Vector3& size : {Vector3(1, 1, 1), Vector3(1, 1, 3)}) {
    const PolygonMesh mesh = sides_of_voxels(size, Vector3::Constant(15), ball);
    const FitResult result = steps_off(mesh, size);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_NEAR(volume(mesh, result.positions) / volume(mesh, mesh.positions()), 1, 1e-3);
    const auto away = [](const Vector3& place) { return (place - Vector3(0.1, 0.2, 0.3)).norm() - 12; };
    EXPECT_LT(rms(result.positions, away), 0.2 * rms(mesh.positions(), away));
    const std::vector<Vector3> normals = normals_of(mesh, result.positions);
    for (std::size_t i = 0; i < result.positions.size(); ++i) {
      const double gone = std::abs((result.positions[i] - mesh.positions()[i]).dot(normals[i]));
      EXPECT_LT(gone, 0.52 * normals[i].cwiseAbs().dot(size)) << i;
    }
    EXPECT_LT(result.report.after.all.greatest, 0.9 * size.maxCoeff());
    EXPECT_EQ(result.distances.size(), result.positions.size());
  }
}

TEST(FitVoxels, LeavesFlatEndsFlat) {
  const auto box = [](const Vector3& place) {
    return std::abs(place.x()) < 10 && std::abs(place.y()) < 7 && std::abs(place.z()) < 5;
  };
  const PolygonMesh mesh = sides_of_voxels(Vector3(1, 1, 1), Vector3(12, 9, 7), box);
  const FitResult result = steps_off(mesh, Vector3(1, 1, 1));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_NEAR(volume(mesh, result.positions) / volume(mesh, mesh.positions()), 1, 1e-3);
  int inside = 0;
  for (std::size_t i = 0; i < result.positions.size(); ++i) {
    const Vector3& before = mesh.positions()[i];
    if (before.z() != 5 || std::abs(before.x()) > 7 || std::abs(before.y()) > 4) continue;
    ++inside;
    EXPECT_NEAR(result.positions[i].z(), 5, 0.06);
  }
  EXPECT_EQ(inside, 15 * 9);
}

TEST(FitVoxels, KeepsTheVolumeOfBoxesWhoseCornersStay) {
  for (const double height : {1.0, 1.83, 2.58}) {
    const Vector3 half(8.2, 5.7, 4.1);
    const auto box = [&](const Vector3& place) {
      const Vector3 share = (place - Vector3(0.3, 0.8, 0.2)).cwiseAbs().cwiseQuotient(half);
      return share.maxCoeff() < 1;
    };
    const Vector3 size(1, 1, height);
    const PolygonMesh mesh = sides_of_voxels(size, Vector3::Constant(12), box);
    const FitResult result = steps_off(mesh, size);
    EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    EXPECT_NEAR(volume(mesh, result.positions) / volume(mesh, mesh.positions()), 1, 2e-4) << height;
  }
}

TEST(FitVoxels, ComesNearerToABoxThatIsTilted) {
  const double cosine = std::cos(0.35);
  const double sine = std::sin(0.35);
  const auto away = [&](const Vector3& place) {
    const Vector3 turned(cosine * place.x() + sine * place.z(), place.y(), cosine * place.z() - sine * place.x());
    const Vector3 beyond = turned.cwiseAbs() - Vector3(10, 7, 5);
    return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0);
  };
  const PolygonMesh mesh =
      sides_of_voxels(Vector3(1, 1, 1), Vector3(13, 9, 10), [&](const Vector3& place) { return away(place) < 0; });
  const FitResult result = steps_off(mesh, Vector3(1, 1, 1));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_NEAR(volume(mesh, result.positions) / volume(mesh, mesh.positions()), 1, 1e-3);
  EXPECT_LT(rms(result.positions, away), 0.7 * rms(mesh.positions(), away));
}

TEST(FitVoxels, HoldsPartsWhereTheyTouchAndTurnsNoEdgeFurther) {
  // Two boxes with one edge in common, along z.
  const auto boxes = [](const Vector3& place) {
    const bool first = place.x() < 0 && place.y() < 0 && place.minCoeff() > -8;
    const bool second = place.x() > 0 && place.y() > 0 && place.maxCoeff() < 8;
    return std::abs(place.z()) < 5 && (first || second);
  };
  const PolygonMesh mesh = sides_of_voxels(Vector3(1, 1, 1), Vector3(9, 9, 9), boxes);
  const FitResult result = steps_off(mesh, Vector3(1, 1, 1));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  ASSERT_FALSE(result.report.fair.warnings.empty());
  EXPECT_EQ(result.report.fair.warnings[0].code, WarningCode::immovable_nodes);
  double moved = 0;
  for (std::size_t i = 0; i < result.positions.size(); ++i) {
    const Vector3& before = mesh.positions()[i];
    if (before.head<2>().cwiseAbs().maxCoeff() <= 1 && std::abs(before.z()) < 5)
      EXPECT_EQ(result.positions[i], before) << i;
    moved = std::max(moved, (result.positions[i] - before).norm());
  }
  EXPECT_GT(moved, 0.01);
  const auto turn = [&](const std::vector<Vector3>& at) {
    PolygonMesh shape = mesh;
    shape.set_positions(at);
    return measure_surface(shape).greatest_turn;
  };
  EXPECT_LE(turn(result.positions), turn(mesh.positions()) + 1e-6);
}

TEST(FitVoxels, LinesWhereThreeMaterialsMeetAreCurvesOfTheirOwn) {
  // A ball of two materials.
  const Vector3 across = Vector3(std::sin(0.35), 0, std::cos(0.35));
  const auto from_ball = [](const Vector3& place) { return place.norm() - 10; };
  const auto from_plane = [&](const Vector3& place) { return across.dot(place) - 1.3; };
  const PolygonMesh mesh =
      support::sides_of_materials(Vector3(1, 1, 1), Vector3::Constant(12), [&](const Vector3& place) {
        return from_ball(place) > 0 ? 0 : from_plane(place) > 0 ? 1 : 2;
      });
  std::vector<std::uint8_t> on_line(mesh.positions().size(), 0);
  for (const Defect& defect : check(mesh)) {
    if (defect.kind != Defect::Kind::non_manifold_edge) continue;
    on_line[static_cast<std::size_t>(defect.node)] = on_line[static_cast<std::size_t>(defect.other)] = 1;
  }
  const FitResult result = steps_off(mesh, Vector3(1, 1, 1));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_EQ(result.report.fair.moving_nodes, mesh.node_count()) << "lines move, too";
  EXPECT_EQ(result.positions.size(), mesh.positions().size());
  EXPECT_EQ(result.distances.size(), mesh.positions().size());
  const auto off = [&](const std::vector<Vector3>& places) {
    std::array<double, 3> squares{};
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double ball = std::pow(from_ball(places[i]), 2);
      const double plane = std::pow(from_plane(places[i]), 2);
      if (on_line[i] != 0)
        squares[0] += ball + plane;
      else if (std::abs(from_ball(mesh.positions()[i])) < 1.2)
        squares[1] += ball;
      else
        squares[2] += plane;
    }
    return squares;
  };
  const auto before = off(mesh.positions());
  const auto after = off(result.positions);
  EXPECT_LT(std::sqrt(after[0] / before[0]), 0.5) << "the line";
  EXPECT_LT(std::sqrt(after[1] / before[1]), 0.3) << "the ball";
  EXPECT_LT(std::sqrt(after[2] / before[2]), 0.4) << "the plane between";
}

TEST(FitVoxels, LinesStayWhereEdgesBesideThemWouldTurnOver) {
  // A ball of one material in a ball of another, which comes out at one side.
  const Vector3 inner(-2.62 * 0.8, 0.442 * 0.8, -1.3 * 0.8);
  const PolygonMesh mesh =
      support::sides_of_materials(Vector3(1, 1, 1), Vector3::Constant(12), [&](const Vector3& place) {
        if (place.norm() > 6.937) return 0;
        return (place - inner).squaredNorm() < 6.937 * 6.937 / 3 ? 1 : 2;
      });
  const FitResult result = steps_off(mesh, Vector3(1, 1, 1));
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  ASSERT_FALSE(result.report.fair.warnings.empty());
  EXPECT_EQ(result.report.fair.warnings[0].code, WarningCode::immovable_nodes);
  for (const Warning& warning : result.report.fair.warnings) EXPECT_NE(warning.code, WarningCode::worse_than_input);
  PolygonMesh shape = mesh;
  shape.set_positions(result.positions);
  EXPECT_LE(measure_surface(shape).greatest_turn, 90 + 1e-6);
  EXPECT_TRUE(self_intersections(shape).empty());
  const auto outside = [](const Vector3& place) { return place.norm() > 6 ? place.norm() - 6.937 : 0; };
  EXPECT_LT(rms(result.positions, outside), 0.7 * rms(mesh.positions(), outside));
}

TEST(FitVoxels, StepsAlsoGoWhereTheFirstShapeOnTheWayIsWorse) {
  // Nodes that no weight holds back yet fold an edge at a corner of this ring.
  const auto from_ring = [](const Vector3& place) {
    const Vector3 p = place - Vector3(0.11, 0.93, 0.79);
    return std::hypot(std::hypot(p.x(), p.y()) - 8.6, p.z()) - 4.3;
  };
  const PolygonMesh mesh =
      sides_of_voxels(Vector3(1, 1, 1), Vector3(15, 15, 7), [&](const Vector3& place) { return from_ring(place) < 0; });
  const FitResult result = steps_off(mesh, Vector3(1, 1, 1));
  EXPECT_EQ(result.report.smoothing_length, 2);
  EXPECT_LT(rms(result.positions, from_ring), 0.4 * rms(mesh.positions(), from_ring));
}

TEST(FitVoxels, ThinWallsHaveNoFlatEnds) {
  // A tube four voxels thick: what is three voxels below its upmost terrace is its other side.
  const auto from_ring = [](const Vector3& place) {
    return std::hypot(std::hypot(place.x(), place.y()) - 14, place.z()) - 6;
  };
  const Vector3 size(1, 1, 3);
  const PolygonMesh mesh =
      support::sides_of_voxels(size, Vector3(22, 22, 9), [&](const Vector3& place) { return from_ring(place) < 0; });
  EXPECT_LT(rms(steps_off(mesh, size).positions, from_ring), 0.3 * rms(mesh.positions(), from_ring));
}

TEST(FitVoxels, IsRefusedForOtherPointsAndForCurves) {
  const PolygonMesh mesh =
      sides_of_voxels(Vector3(1, 1, 1), Vector3::Constant(6), [](const Vector3& p) { return p.norm() < 4; });
  FitOptions options;
  options.criterion = Voxels{Vector3(1, 1, 1)};
  EXPECT_THROW((void)fit(mesh, Constraints(mesh.node_count()), {.positions = {Vector3(0, 0, 0)}}, options), Error);
  options.criterion = Voxels{Vector3(1, 0, 1)};
  EXPECT_THROW((void)fit(mesh, Constraints(mesh.node_count()), {.positions = mesh.positions()}, options), Error);
  options.criterion = Voxels{Vector3(1, 1, 1)};
  const PolygonCurve curve({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  EXPECT_THROW((void)fit(curve, Constraints(3), {.positions = curve.positions()}, options), Error);
}

}  // namespace
}  // namespace vspring::fit_voxels_test
