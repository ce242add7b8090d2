// Holes of shapes that are known, and what is left open.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/holes.hpp"
#include "support/refusal.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fill_test {
namespace {

using namespace support;

/// A closed unit sphere whose nodes are off their regular places.
PolygonMesh jittered_sphere(Index cells, double jitter) {
  return projected(generate::add_noise(closed_sphere(cells), jitter / cells, 3));
}

FillOptions exact() {
  FillOptions options;
  options.fair.method = EquilibriumMethod{.tolerance = 1e-9};
  return options;
}

std::vector<Vector3> new_places(const FilledHoles& filled) {
  return {filled.positions.end() - static_cast<std::ptrdiff_t>(filled.node_like.size()), filled.positions.end()};
}

void expect_closed(const FilledHoles& filled) {
  EXPECT_TRUE(boundary_loops(filled.mesh).empty());
  for (const Defect& defect : check(filled.mesh)) ADD_FAILURE() << defect.message();
}

void expect_same_input(const PolygonMesh& input, const FilledHoles& filled) {
  ASSERT_GE(filled.mesh.node_count(), input.node_count());
  const std::size_t bytes = input.positions().size() * sizeof(Vector3);
  EXPECT_EQ(std::memcmp(filled.positions.data(), input.positions().data(), bytes), 0);
  EXPECT_EQ(std::memcmp(filled.mesh.positions().data(), input.positions().data(), bytes), 0);
  EXPECT_TRUE(std::equal(input.corners().begin(), input.corners().end(), filled.mesh.corners().begin()));
}

TEST(Fill, AHoleOfASphereIsTheSphereAgain) {
  for (const bool triangles : {false, true}) {
    for (const double jitter : {0.0, 0.15}) {
      PolygonMesh whole = jittered_sphere(4, jitter);
      if (triangles) whole = in_triangles(whole);
      const PolygonMesh input = without_ball(whole, Vector3(0.1, 0.2, 1).normalized(), 0.75);
      const FilledHoles filled = fill_holes(input, exact());
      ASSERT_EQ(filled.holes.size(), 1U);
      EXPECT_EQ(filled.holes[0].state, HoleState::filled);
      EXPECT_EQ(filled.report.outcome, Outcome::converged);
      expect_closed(filled);
      expect_same_input(input, filled);
      ASSERT_GT(filled.node_like.size(), 5U);
      // Spheres are exact equilibria, and their normals at the rim exact: what is left is the tolerance, of a part
      // whose diagonal is less than 4. The flat patch is off by a good part of the radius.
      EXPECT_LT(distance_from_unit_sphere(new_places(filled)), 4e-8);
      EXPECT_GT(distance_from_unit_sphere(filled.mesh.positions()), 0.1);
    }
  }
}

TEST(Fill, APlaneStaysAPlane) {
  for (const generate::Faces faces : every_kind) {
    const PolygonMesh flat = generate::plane({.columns = 16, .rows = 16, .faces = faces});
    const PolygonMesh input = without_ball(flat, Vector3(0.5, 0.5, 0), 0.22);
    const FilledHoles filled = fill_holes(input);
    // The rim of the sheet stays.
    ASSERT_EQ(filled.holes.size(), 2U);
    EXPECT_EQ(std::count_if(filled.holes.begin(), filled.holes.end(),
                            [](const Hole& hole) { return hole.state == HoleState::outer_rim; }),
              1);
    EXPECT_EQ(boundary_loops(filled.mesh).size(), 1U);
    ASSERT_GT(filled.node_like.size(), 5U);
    for (const Vector3& p : filled.positions) EXPECT_LT(std::abs(p.z()), 1e-12);
    expect_same_input(input, filled);
    // All of it is covered, once.
    double area = 0;
    const PolygonMesh after = with_positions(filled.mesh, filled.positions);
    EXPECT_NEAR(measure_surface(after).area, 1, 1e-9);
    for (Index f = input.face_count(); f < after.face_count(); ++f) {
      const auto face = after.face(f);
      const Vector3 vector =
          (after.position(face[1]) - after.position(face[0])).cross(after.position(face[2]) - after.position(face[0]));
      EXPECT_GT(vector.z(), 0);
      area += vector.norm() / 2;
    }
    EXPECT_GT(area, 0.15);
  }
}

TEST(Fill, AHoleInTheSideOfACylinderIsTheCylinderToSecondOrder) {
  double last = 0;
  for (const int around : {24, 48}) {
    const PolygonMesh tube = generate::tube({.columns = around, .rows = around / 2}, 1, 3);
    const PolygonMesh input = without_ball(tube, Vector3(1, 0, 1.5), 0.7);
    FillOptions options = exact();
    // The first node of the hole: the one that lies next to its middle.
    for (const Hole& hole : find_holes(input)) {
      if (!hole.is_outer_rim() && hole.length < 6) options.at = {hole.rim.front()};
    }
    ASSERT_EQ(options.at.size(), 1U);
    const FilledHoles filled = fill_holes(input, options);
    EXPECT_EQ(filled.report.outcome, Outcome::converged);
    double greatest = 0;
    for (const Vector3& p : new_places(filled)) greatest = std::max(greatest, std::abs(std::hypot(p.x(), p.y()) - 1));
    // What an arc rises over an edge.
    const double sagitta = 1 - std::cos(std::numbers::pi / around);
    EXPECT_LT(greatest, 2 * sagitta);
    if (last > 0) EXPECT_LT(greatest, last / 2.5);
    last = greatest;
    EXPECT_EQ(std::count_if(filled.holes.begin(), filled.holes.end(),
                            [](const Hole& hole) { return hole.state == HoleState::elsewhere; }),
              2);
  }
}

TEST(Fill, EndsOfATubeAreFilledAndTheRimOfASheetIsNot) {
  const PolygonMesh tube = generate::tube({.columns = 16, .rows = 8});
  for (const Hole& hole : find_holes(tube)) EXPECT_NEAR(hole.facing, 0, 1e-9);
  expect_closed(fill_holes(tube));
  const PolygonMesh disc = generate::flat_disc({.nodes = 60});
  ASSERT_EQ(find_holes(disc).size(), 1U);
  EXPECT_NEAR(find_holes(disc)[0].facing, 1, 1e-9);
  const std::vector<Hole> of_sheet = find_holes(without_ball(generate::plane(), Vector3(0.5, 0.5, 0), 0.2));
  ASSERT_EQ(of_sheet.size(), 2U);
  EXPECT_NEAR(of_sheet[0].facing * of_sheet[1].facing, -1, 1e-9);
  // Roughness changes nothing of that.
  const PolygonMesh rough = generate::add_noise(disc, 0.05, 1, true);
  EXPECT_TRUE(find_holes(rough)[0].is_outer_rim());
  EXPECT_EQ(fill_holes(disc).holes[0].state, HoleState::outer_rim);
  // Nothing but the disc itself, turned over, would close it.
  const FilledHoles asked = fill_holes(disc, {.outer_rims = true});
  EXPECT_EQ(asked.holes[0].state, HoleState::unfillable);
  EXPECT_EQ(asked.holes[0].fault, HoleFault::folded);
  ASSERT_EQ(asked.report.warnings.size(), 1U);
  EXPECT_EQ(asked.report.warnings[0].code, WarningCode::unfilled_hole);
  // A cap can be closed.
  const PolygonMesh cap = generate::cap({.nodes = 200, .half_angle = 45});
  EXPECT_EQ(fill_holes(cap).holes[0].state, HoleState::outer_rim);
  expect_closed(fill_holes(cap, {.outer_rims = true, .flat = true}));
  expect_closed(fill_holes(cap, {.at = {find_holes(cap)[0].rim.back()}, .flat = true}));
}

TEST(Fill, SmallHolesGetNoNewNode) {
  // Three edges, and a face of the sphere.
  const PolygonMesh whole = in_triangles(closed_sphere(3));
  MeshBuilder builder;
  for (const Vector3& p : whole.positions()) builder.add_node(p);
  for (Index f = 1; f < whole.face_count(); ++f) builder.add_face(whole.face(f));
  const PolygonMesh input = builder.take();
  const FilledHoles filled = fill_holes(input);
  expect_closed(filled);
  EXPECT_EQ(filled.holes[0].face_count, 1);
  EXPECT_EQ(filled.holes[0].node_count, 0);
  EXPECT_FALSE(filled.holes[0].outcome);
  EXPECT_EQ(filled.report.outcome, Outcome::converged);
  expect_same_input(input, filled);
}

TEST(Fill, SizesAndNodesSayWhichHoles) {
  PolygonMesh input = without_ball(closed_sphere(6), Vector3(0, 0, 1), 0.5);
  input = without_ball(input, Vector3(0, 0, -1), 0.25);
  const auto state_of = [&](const FillOptions& options) {
    std::vector<HoleState> states;
    for (const Hole& hole : fill_holes(input, options).holes) states.push_back(hole.state);
    std::sort(states.begin(), states.end());
    return states;
  };
  using enum HoleState;
  EXPECT_EQ(state_of({.flat = true}), (std::vector{filled, filled}));
  const std::vector<Hole> holes = find_holes(input);
  ASSERT_EQ(holes.size(), 2U);
  const double between = (holes[0].length + holes[1].length) / 2;
  EXPECT_EQ(state_of({.most_length = between, .flat = true}), (std::vector{filled, too_large}));
  EXPECT_EQ(state_of({.most_edges = 3, .flat = true}), (std::vector{too_large, too_large}));
  EXPECT_EQ(state_of({.at = {holes[1].rim[2]}, .flat = true}), (std::vector{filled, elsewhere}));
  const auto says_of = [&](Index node) {
    return refusal([&] { (void)fill_holes(input, {.at = {node}}); }, ErrorCode::unusable_constraint);
  };
  EXPECT_TRUE(says(says_of(-4), "-4 is not a node"));
  Index inner = 0;
  const auto boundary = boundary_nodes(input);
  while (boundary[static_cast<std::size_t>(inner)] != 0) ++inner;
  EXPECT_TRUE(says(says_of(inner), "at no hole"));
  EXPECT_TRUE(
      says(refusal([&] { (void)fill_holes(input, {.most_length = -1}); }, ErrorCode::invalid_argument), "most_length"));
  EXPECT_TRUE(
      says(refusal([&] { (void)fill_holes(input, {.most_edges = 2}); }, ErrorCode::invalid_argument), "most_edges"));
}

TEST(Fill, WhatCannotBeFilledIsNamedAndTheOthersAreFilled) {
  // A fin of one more face at the rim of one of two holes.
  PolygonMesh input = without_ball(closed_sphere(6), Vector3(0, 0, 1), 0.5);
  input = without_ball(input, Vector3(0, 0, -1), 0.4);
  const std::vector<Hole> before = find_holes(input);
  ASSERT_EQ(before.size(), 2U);
  const Hole& hole = before[0];
  const Index at = hole.rim[3];
  const auto inner_edge = [&] {
    for (Index f = 0;; ++f) {
      const auto face = input.face(f);
      const auto k = static_cast<std::size_t>(std::find(face.begin(), face.end(), at) - face.begin());
      if (k == face.size()) continue;
      for (const std::size_t step : {std::size_t{1}, face.size() - 1}) {
        const Index other = face[(k + step) % face.size()];
        if (std::find(hole.rim.begin(), hole.rim.end(), other) == hole.rim.end()) return other;
      }
    }
  }();
  MeshBuilder builder;
  for (const Vector3& p : input.positions()) builder.add_node(p);
  for (Index f = 0; f < input.face_count(); ++f) builder.add_face(input.face(f));
  const Index tip = builder.add_node(1.3 * input.position(at));
  builder.add_face({at, inner_edge, tip});
  const FilledHoles filled = fill_holes(builder.take(), {.flat = true});
  int refused = 0;
  int closed = 0;
  for (const Hole& now : filled.holes) {
    closed += now.state == HoleState::filled ? 1 : 0;
    if (now.state != HoleState::unfillable) continue;
    ++refused;
    EXPECT_EQ(now.fault, HoleFault::non_manifold);
    EXPECT_TRUE(now.fault_node == at || now.fault_node == inner_edge) << now.fault_node;
    EXPECT_TRUE(says(fault_message(now), "node " + std::to_string(now.fault_node)));
  }
  EXPECT_GE(refused, 1);
  EXPECT_EQ(closed, 1);
}

TEST(Fill, HolesThatTouchAreFilledTogether) {
  // Two faces of the sphere with one node in common are cut out.
  const PolygonMesh whole = closed_sphere(8);
  PolygonMesh input = without_ball(whole, Vector3(0, 0.02, 1).normalized(), 0.5);
  input = without_ball(input, Vector3(0.3, 0.9, 0.1).normalized(), 0.5);
  const FilledHoles filled = fill_holes(input, exact());
  expect_closed(filled);
  EXPECT_EQ(filled.report.outcome, Outcome::converged);
  EXPECT_LT(distance_from_unit_sphere(filled.positions), 4e-8);
  // A bow tie: opposite quads of the four around a node.
  const PolygonMesh plane = generate::plane({.columns = 6, .rows = 6, .faces = generate::Faces::quads});
  MeshBuilder builder;
  for (const Vector3& p : plane.positions()) builder.add_node(p);
  for (Index f = 0; f < plane.face_count(); ++f) {
    if (f != 14 && f != 21) builder.add_face(plane.face(f));
  }
  const FilledHoles tied = fill_holes(builder.take());
  EXPECT_EQ(std::count_if(tied.holes.begin(), tied.holes.end(),
                          [](const Hole& hole) { return hole.state == HoleState::filled; }),
            2);
  EXPECT_EQ(boundary_loops(tied.mesh).size(), 1U);
}

TEST(Fill, APatchThatWouldCrossAnotherPartIsToldOf) {
  PolygonMesh input = without_ball(closed_sphere(6), Vector3(0, 0, 1), 0.6);
  MeshBuilder builder;
  for (const Vector3& p : input.positions()) builder.add_node(p);
  for (Index f = 0; f < input.face_count(); ++f) builder.add_face(input.face(f));
  // A needle through the hole.
  const PolygonMesh needle = generate::tube({.columns = 4, .rows = 1}, 0.05, 3);
  const Index first = input.node_count();
  for (const Vector3& p : needle.positions()) builder.add_node(p);
  for (Index f = 0; f < needle.face_count(); ++f) {
    std::vector<Index> face;
    for (const Index i : needle.face(f)) face.push_back(first + i);
    builder.add_face(face);
  }
  FillOptions options;
  options.most_length = 10;
  for (const Hole& hole : find_holes(input)) options.at.push_back(hole.rim.front());
  const FilledHoles filled = fill_holes(builder.take(), options);
  const auto& warnings = filled.report.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(),
                          [](const Warning& w) { return w.code == WarningCode::patch_crosses; }));
}

TEST(Fill, AFairPatchThatCrossesMoreThanTheFlatOneStaysFlat) {
  const PolygonMesh input = without_ball(closed_sphere(6), Vector3(0, 0, 1), 0.6);
  MeshBuilder builder;
  for (const Vector3& p : input.positions()) builder.add_node(p);
  for (Index f = 0; f < input.face_count(); ++f) builder.add_face(input.face(f));
  // Where the ball was, above the flat patch.
  const Index a = builder.add_node({-0.05, 0.01, 1.05});
  const Index b = builder.add_node({0.05, 0.01, 1.05});
  const Index c = builder.add_node({0, 0.01, 0.95});
  builder.add_face({a, b, c});
  const FilledHoles filled = fill_holes(builder.take());
  EXPECT_EQ(filled.report.outcome, Outcome::worse_than_input);
  EXPECT_EQ(filled.positions, filled.mesh.positions());
  ASSERT_FALSE(filled.report.warnings.empty());
  EXPECT_EQ(filled.report.warnings.back().code, WarningCode::worse_than_input);
}

TEST(Fill, APatchThatBulgesGetsMoreNodes) {
  // More than half of the ball.
  const PolygonMesh input = without_ball(in_triangles(closed_sphere(6)), Vector3(0, 0, 1), 1.5);
  FillOptions options = exact();
  options.outer_rims = true;
  const FilledHoles filled = fill_holes(input, options);
  options.flat = true;
  const FilledHoles flat = fill_holes(input, options);
  EXPECT_GT(static_cast<double>(filled.node_like.size()), 1.3 * static_cast<double>(flat.node_like.size()));
  EXPECT_LT(distance_from_unit_sphere(filled.positions), 4e-8);
  // No face is turned over.
  const PolygonMesh after = with_positions(filled.mesh, filled.positions);
  for (Index f = 0; f < after.face_count(); ++f) {
    const auto face = after.face(f);
    const Vector3& p = after.position(face[0]);
    EXPECT_GT((after.position(face[1]) - p).cross(after.position(face[2]) - p).dot(p), 0);
  }
}

TEST(Fill, PatchesFollowWhatAFileHasAndEarlierPatches) {
  PolygonMesh input = without_ball(closed_sphere(6), Vector3(0, 0, 1), 0.5);
  input = without_ball(input, Vector3(0, 0, -1), 0.5);
  const std::vector<Hole> holes = find_holes(input);
  ASSERT_EQ(holes.size(), 2U);
  SurfaceFile file;
  file.mesh = input;
  file.groups = {{fmt::format("hole_{}", holes[1].rim[0]), {}}};
  const FilledHoles first = fill_holes(file.mesh, {.at = {holes[0].rim[0]}});
  add_patches(file, first);
  EXPECT_TRUE(file.mesh.has_same_faces(first.mesh));
  EXPECT_EQ(file.mesh.positions(), first.positions);
  EXPECT_TRUE(says(refusal([&] { add_patches(file, first); }, ErrorCode::invalid_argument),
                   fmt::format("the file has {} and {}", first.mesh.node_count(), first.mesh.face_count())));

  const FilledHoles second = fill_holes(file.mesh);
  add_patches(file, second);
  EXPECT_TRUE(boundary_loops(file.mesh).empty());
  EXPECT_EQ(file.mesh.positions(), second.positions);
  const AddedElements& added = file.added;
  EXPECT_EQ(added.node_like.size(), first.node_like.size() + second.node_like.size());
  EXPECT_TRUE(std::equal(second.face_like.rbegin(), second.face_like.rend(), added.face_like.rbegin()));
  // The file has a group of that name.
  const std::vector<std::pair<Index, std::string>> groups = {
      {input.face_count(), fmt::format("hole_{}", holes[0].rim[0])},
      {first.mesh.face_count(), fmt::format("hole_{}_", holes[1].rim[0])}};
  EXPECT_EQ(added.groups, groups);
  // Nodes and faces of patches are like those of the file, not like earlier patches.
  for (const Index node : added.node_like) EXPECT_LT(node, input.node_count());
  for (const Index face : added.face_like) EXPECT_LT(face, input.face_count());
}

TEST(Fill, ThreadsAndCancellation) {
  PolygonMesh input = without_ball(closed_sphere(8), Vector3(0, 0, 1), 0.6);
  input = without_ball(input, Vector3(0, 0, -1), 0.6);
  std::vector<Vector3> first;
  for (const int threads : {1, 4}) {
    Context context;
    context.threads = threads;
    const FilledHoles filled = fill_holes(input, {}, context);
    if (first.empty()) first = filled.positions;
    ASSERT_EQ(filled.positions.size(), first.size());
    EXPECT_EQ(std::memcmp(filled.positions.data(), first.data(), first.size() * sizeof(Vector3)), 0);
  }
  Context context;
  double last = 0;
  context.on_progress = [&](const Progress& progress) {
    EXPECT_GE(progress.fraction, last);
    EXPECT_LE(progress.fraction, 1);
    last = progress.fraction;
    if (progress.fraction > 0) context.cancel();
  };
  const FilledHoles cancelled = fill_holes(input, {}, context);
  EXPECT_EQ(cancelled.report.outcome, Outcome::cancelled);
  EXPECT_TRUE(context.on_progress != nullptr);
  for (const Vector3& p : cancelled.positions) EXPECT_TRUE(p.allFinite());
  context.on_progress = nullptr;
  for (const Hole& hole : fill_holes(input, {}, context).holes) EXPECT_EQ(hole.state, HoleState::cancelled);
}

}  // namespace
}  // namespace vspring::fill_test
