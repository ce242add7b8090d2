// Meshes of which the moving part gets new triangles.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "support/refusal.hpp"
#include "vspring/vspring.hpp"

namespace vspring::remesh_test {
namespace {

using support::refusal;
using support::says;

constexpr double pi = 3.14159265358979323846;

/// A closed sphere of radius 1 with two poles: quads, and triangles at the poles, of very different sizes.
PolygonMesh globe(Index rings, Index meridians) {
  MeshBuilder builder;
  builder.add_node({0, 0, 1});
  for (Index i = 1; i < rings; ++i) {
    for (Index j = 0; j < meridians; ++j) {
      const double theta = pi * i / rings;
      const double phi = 2 * pi * j / meridians;
      builder.add_node({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  }
  const Index south = builder.add_node({0, 0, -1});
  const auto node = [&](Index i, Index j) { return 1 + (i - 1) * meridians + j % meridians; };
  for (Index j = 0; j < meridians; ++j) {
    builder.add_face({0, node(1, j), node(1, j + 1)});
    for (Index i = 1; i + 1 < rings; ++i)
      builder.add_face({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    builder.add_face({node(rings - 1, j), south, node(rings - 1, j + 1)});
  }
  return builder.take();
}

/// A flat square of side 10, of needles: strips of 0.5 that are cut into triangles.
PolygonMesh needles() {
  MeshBuilder builder;
  constexpr Index strips = 20;
  for (Index j = 0; j <= strips; ++j) {
    builder.add_node({0.5 * j, 0, 0});
    builder.add_node({0.5 * j, 10, 0});
  }
  for (Index j = 0; j < strips; ++j) {
    builder.add_face({2 * j, 2 * j + 2, 2 * j + 3});
    builder.add_face({2 * j, 2 * j + 3, 2 * j + 1});
  }
  return builder.take();
}

/// A cube of side 2 with six faces.
PolygonMesh cube() {
  MeshBuilder builder;
  for (const double z : {-1.0, 1.0}) {
    for (const auto& [x, y] : {std::pair(-1.0, -1.0), std::pair(1.0, -1.0), std::pair(1.0, 1.0), std::pair(-1.0, 1.0)})
      builder.add_node({x, y, z});
  }
  builder.add_face({3, 2, 1, 0});
  builder.add_face({4, 5, 6, 7});
  for (Index k = 0; k < 4; ++k) builder.add_face({k, (k + 1) % 4, (k + 1) % 4 + 4, k + 4});
  return builder.take();
}

using Edges = std::map<std::pair<Index, Index>, std::vector<Index>>;

/// The faces of each edge.
Edges edges_of(const PolygonMesh& mesh) {
  Edges edges;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index next = face[(k + 1) % face.size()];
      edges[std::pair(std::min(face[k], next), std::max(face[k], next))].push_back(f);
    }
  }
  return edges;
}

double length_of(const PolygonMesh& mesh, const std::pair<Index, Index>& edge) {
  return (mesh.position(edge.first) - mesh.position(edge.second)).norm();
}

Vector3 normal_of(const PolygonMesh& mesh, Index f) {
  const auto face = mesh.face(f);
  return (mesh.position(face[1]) - mesh.position(face[0]))
      .cross(mesh.position(face[2]) - mesh.position(face[0]))
      .normalized();
}

double least_angle(const PolygonMesh& mesh) {
  double least = 180;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (face.size() != 3) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 a = mesh.position(face[(k + 1) % 3]) - mesh.position(face[k]);
      const Vector3 b = mesh.position(face[(k + 2) % 3]) - mesh.position(face[k]);
      least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / pi);
    }
  }
  return least;
}

/// The shortest and the longest edge.
std::pair<double, double> lengths_of(const PolygonMesh& mesh) {
  std::pair<double, double> range = {std::numeric_limits<double>::infinity(), 0};
  for (const auto& [edge, faces] : edges_of(mesh)) {
    range.first = std::min(range.first, length_of(mesh, edge));
    range.second = std::max(range.second, length_of(mesh, edge));
  }
  return range;
}

/// What holds for every result: origins and numbers fit, each edge has two faces at most, which run along it in
/// opposite directions, and the shape is one of the same kind.
void expect_sound(const PolygonMesh& input, const Remeshed& remeshed) {
  const PolygonMesh& mesh = remeshed.mesh;
  ASSERT_EQ(remeshed.input_node_count(), input.node_count());
  ASSERT_EQ(remeshed.constraints.node_count(), mesh.node_count());
  ASSERT_EQ(static_cast<Index>(remeshed.face_from.size()), mesh.face_count());
  EXPECT_TRUE(std::is_sorted(remeshed.face_from.begin(), remeshed.face_from.end()));
  const std::vector<Index> numbers = remeshed.numbers_in_means();
  for (Index node = 0; node < remeshed.kept_node_count(); ++node)
    EXPECT_EQ(mesh.position(node), input.position(numbers[static_cast<std::size_t>(node)]));
  std::map<std::pair<Index, Index>, int> directed;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) ++directed[{face[k], face[(k + 1) % face.size()]}];
  }
  for (const auto& [edge, count] : directed) EXPECT_EQ(count, 1) << edge.first << " " << edge.second;
  const auto characteristic = [](const PolygonMesh& of) {
    return of.node_count() - static_cast<Index>(edges_of(of).size()) + of.face_count();
  };
  EXPECT_EQ(characteristic(mesh), characteristic(input));
}

/// New nodes are where their shares say.
void expect_means(const PolygonMesh& input, const Remeshed& remeshed) {
  std::vector<double> coordinates;
  for (const Vector3& position : input.positions())
    coordinates.insert(coordinates.end(), position.data(), position.data() + 3);
  const std::vector<double> means = remeshed.at_nodes(coordinates);
  for (Index node = 0; node < remeshed.mesh.node_count(); ++node) {
    const Vector3 mean(means.data() + 3 * static_cast<std::size_t>(node));
    EXPECT_LT((mean - remeshed.mesh.position(node)).norm(), 1e-12) << node;
  }
}

TEST(Remesh, AGlobeGetsEvenTriangles) {
  const PolygonMesh input = globe(24, 60);
  const Remeshed remeshed = remesh(input, Constraints(input.node_count()), {.length = 0.15});
  expect_sound(input, remeshed);
  expect_means(input, remeshed);
  const auto [shortest, longest] = lengths_of(remeshed.mesh);
  EXPECT_GT(shortest, 0.6 * 0.15);
  EXPECT_LT(longest, 1.45 * 0.15);
  EXPECT_GT(least_angle(remeshed.mesh), 32);
  EXPECT_LT(distance(remeshed.mesh, input).greatest, 1e-12);
  // Two triangles to a node, and 4π over the area of an even one of them.
  EXPECT_NEAR(remeshed.mesh.face_count(), 4 * pi / (std::sqrt(3.0) / 4 * 0.15 * 0.15), 150);
  for (const auto& [edge, faces] : edges_of(remeshed.mesh)) {
    ASSERT_EQ(faces.size(), 2U);
    EXPECT_GT(normal_of(remeshed.mesh, faces[0]).dot(normal_of(remeshed.mesh, faces[1])), std::cos(pi / 6));
  }
  for (Index f = 0; f < remeshed.mesh.face_count(); ++f)
    EXPECT_GT(normal_of(remeshed.mesh, f).dot(remeshed.mesh.position(remeshed.mesh.face(f)[0])), 0.8);
}

TEST(Remesh, LengthsMayBeMuchLongerOrShorterThanThoseOfTheInput) {
  const PolygonMesh input = globe(24, 60);
  for (const double length : {0.05, 0.5}) {
    const Remeshed remeshed = remesh(input, Constraints(input.node_count()), {.length = length});
    expect_sound(input, remeshed);
    const auto [shortest, longest] = lengths_of(remeshed.mesh);
    EXPECT_GT(shortest, 0.5 * length);
    EXPECT_LT(longest, 1.6 * length);
    EXPECT_GT(least_angle(remeshed.mesh), 25);
  }
}

TEST(Remesh, TheLengthIsTheMedianEdgeUnlessGiven) {
  const PolygonMesh input = globe(8, 12);
  const Remeshed remeshed = remesh(input, Constraints(input.node_count()), {});
  EXPECT_GT(remeshed.length, 0.35);
  EXPECT_LT(remeshed.length, 0.55);
  EXPECT_EQ(remesh(input, Constraints(input.node_count()), {.length = remeshed.length}).mesh.positions(),
            remeshed.mesh.positions());
}

TEST(Remesh, AllSizesGiveTheSame) {
  const PolygonMesh input = globe(10, 14);
  const Remeshed remeshed = remesh(input, Constraints(input.node_count()), {.length = 0.25});
  for (const double scale : {0x1p-600, 0x1p600}) {
    std::vector<Vector3> positions = input.positions();
    for (Vector3& position : positions) position *= scale;
    PolygonMesh scaled = input;
    scaled.set_positions(std::move(positions));
    const Remeshed other = remesh(scaled, Constraints(input.node_count()), {.length = 0.25 * scale});
    ASSERT_TRUE(other.mesh.has_same_faces(remeshed.mesh));
    for (Index node = 0; node < other.mesh.node_count(); ++node)
      EXPECT_EQ(other.mesh.position(node), remeshed.mesh.position(node) * scale);
  }
}

TEST(Remesh, AHeldBoundaryStaysAndGetsHeldNodes) {
  const PolygonMesh input = needles();
  Constraints held(input.node_count());
  fix_boundary_positions(held, input);
  // The whole is faces all of whose nodes are held; one has to move for the part to begin there.
  held.free_position(20);
  const Remeshed remeshed = remesh(input, held, {.length = 1});
  expect_sound(input, remeshed);
  EXPECT_LT(least_angle(input), 3);
  EXPECT_GT(least_angle(remeshed.mesh), 25);
  Index new_and_held = 0;
  for (Index node = 0; node < remeshed.mesh.node_count(); ++node) {
    const Vector3& place = remeshed.mesh.position(node);
    const bool at_end = place.x() == 0 || place.x() == 10;
    EXPECT_EQ(place.z(), 0);
    if (!at_end) continue;
    EXPECT_TRUE(remeshed.constraints.position_fixed(node));
    EXPECT_EQ(remeshed.constraints.position(node), place);
    new_and_held += node >= remeshed.kept_node_count() ? 1 : 0;
  }
  // Sides of 10 are halved until no edge is longer than 4/3, and near the ends of others, which are 0.5 long, more.
  EXPECT_GE(new_and_held, 14);
  const std::vector<Index> numbers = remeshed.numbers_in_means();
  for (Index node = 0; node < input.node_count(); ++node) {
    const bool is_kept = std::binary_search(numbers.begin(), numbers.begin() + remeshed.kept_node_count(), node);
    EXPECT_TRUE(is_kept || node == 20) << node;
  }
}

TEST(Remesh, AFreeBoundaryStaysALine) {
  const PolygonMesh input = needles();
  const Remeshed remeshed = remesh(input, Constraints(input.node_count()), {.length = 1});
  expect_sound(input, remeshed);
  EXPECT_GT(least_angle(remeshed.mesh), 30);
  double around = 0;
  for (const auto& [edge, faces] : edges_of(remeshed.mesh)) {
    if (faces.size() != 1) continue;
    around += length_of(remeshed.mesh, edge);
    EXPECT_GT(length_of(remeshed.mesh, edge), 0.6);
    EXPECT_LT(length_of(remeshed.mesh, edge), 1.5);
  }
  // With all four corners it is as long as before.
  EXPECT_NEAR(around, 40, 1e-9);
}

TEST(Remesh, ARegionChangesAndTheRestStaysToTheBit) {
  const PolygonMesh input = globe(30, 40);
  std::vector<Index> region;
  for (Index node = 0; node < input.node_count(); ++node) {
    if (input.position(node).x() > 0.3) region.push_back(node);
  }
  Constraints held(input.node_count());
  restrict_to_region(held, input, region);
  const Remeshed remeshed = remesh(input, held, {.length = 0.1});
  expect_sound(input, remeshed);
  const std::vector<Index> numbers = remeshed.numbers_in_means();
  // Per face that stays, the same nodes.
  std::vector<std::vector<Index>> parts(static_cast<std::size_t>(input.face_count()));
  for (Index f = 0; f < remeshed.mesh.face_count(); ++f)
    parts[static_cast<std::size_t>(remeshed.face_from[static_cast<std::size_t>(f)])].push_back(f);
  Index staying = 0;
  for (Index f = 0; f < input.face_count(); ++f) {
    const auto face = input.face(f);
    if (std::any_of(face.begin(), face.end(), [&](Index i) { return !held.position_fixed(i); })) continue;
    ++staying;
    ASSERT_EQ(parts[static_cast<std::size_t>(f)].size(), 1U);
    std::vector<Index> now;
    for (const Index node : remeshed.mesh.face(parts[static_cast<std::size_t>(f)][0]))
      now.push_back(numbers[static_cast<std::size_t>(node)]);
    EXPECT_TRUE(std::equal(face.begin(), face.end(), now.begin(), now.end())) << f;
  }
  EXPECT_GT(staying, 500);
  for (Index node = 0; node < remeshed.kept_node_count(); ++node) {
    const Index before = numbers[static_cast<std::size_t>(node)];
    EXPECT_EQ(remeshed.constraints.position_fixed(node), held.position_fixed(before));
  }
  for (Index node = 0; node < input.node_count(); ++node) {
    if (held.position_fixed(node)) {
      EXPECT_FALSE(std::binary_search(remeshed.removed.begin(), remeshed.removed.end(), node)) << node;
    }
  }
  for (Index node = remeshed.kept_node_count(); node < remeshed.mesh.node_count(); ++node)
    EXPECT_FALSE(remeshed.constraints.position_fixed(node));
}

TEST(Remesh, NearALongRimEdgesAreLong) {
  // One half of the globe stays with its long edges.
  const PolygonMesh input = globe(6, 8);
  std::vector<Index> region;
  for (Index node = 0; node < input.node_count(); ++node) {
    if (input.position(node).z() > 0.1) region.push_back(node);
  }
  Constraints held(input.node_count());
  restrict_to_region(held, input, region);
  const Remeshed remeshed = remesh(input, held, {.length = 0.1});
  expect_sound(input, remeshed);
  EXPECT_GT(least_angle(remeshed.mesh), 15);
  EXPECT_LT(remeshed.mesh.node_count(), 600);
}

TEST(Remesh, ACubeKeepsItsEdgesAndCorners) {
  const PolygonMesh input = cube();
  const MeshEdges sharp = find_sharp_edges(input, 40).edges;
  ASSERT_EQ(sharp.size(), 12U);
  const Remeshed remeshed = remesh(input, Constraints(input.node_count()), {.length = 0.3, .lines = sharp});
  expect_sound(input, remeshed);
  EXPECT_EQ(remeshed.kept_node_count(), 8);
  EXPECT_GT(least_angle(remeshed.mesh), 28);
  EXPECT_LT(distance(remeshed.mesh, input).greatest, 1e-12);
  EXPECT_LT(distance(input, remeshed.mesh).greatest, 1e-12);
  double length = 0;
  for (std::size_t k = 0; k < remeshed.lines.size(); ++k) {
    length += length_of(remeshed.mesh, remeshed.lines[k]);
    // Its ends are on the given one.
    const auto& given = sharp[static_cast<std::size_t>(remeshed.line_from[k])];
    const Vector3 way = input.position(given.second) - input.position(given.first);
    for (const Index node : {remeshed.lines[k].first, remeshed.lines[k].second})
      EXPECT_LT((remeshed.mesh.position(node) - input.position(given.first)).cross(way).norm(), 1e-12);
  }
  EXPECT_NEAR(length, 24, 1e-12);
  const SharpEdges found = find_sharp_edges(remeshed.mesh, 40);
  EXPECT_EQ(found.edges, remeshed.lines);
  EXPECT_EQ(found.corners.size(), 8U);
  for (Index f = 0; f < remeshed.mesh.face_count(); ++f)
    EXPECT_NEAR(normal_of(remeshed.mesh, f).cwiseAbs().maxCoeff(), 1, 1e-9);
}

TEST(Remesh, EachTriangleComesFromTheFaceBelow) {
  const PolygonMesh input = cube();
  const Remeshed remeshed =
      remesh(input, Constraints(input.node_count()), {.length = 0.5, .lines = find_sharp_edges(input, 40).edges});
  for (Index f = 0; f < remeshed.mesh.face_count(); ++f) {
    const Index from = remeshed.face_from[static_cast<std::size_t>(f)];
    EXPECT_GT(normal_of(remeshed.mesh, f).dot(normal_of(input, from)), 0.99);
  }
}

TEST(Remesh, ThinWallsStayApart) {
  // Two sides of a plate, 0.02 apart, of edges of 0.5.
  const PolygonMesh block = cube();
  std::vector<Vector3> positions = block.positions();
  for (Vector3& position : positions) position.z() *= 0.01;
  PolygonMesh plate = block;
  plate.set_positions(std::move(positions));
  const Remeshed remeshed =
      remesh(plate, Constraints(plate.node_count()), {.length = 0.3, .lines = find_sharp_edges(plate, 40).edges});
  expect_sound(plate, remeshed);
  EXPECT_TRUE(self_intersections(remeshed.mesh).empty());
  EXPECT_LT(distance(remeshed.mesh, plate).greatest, 1e-12);
  EXPECT_LT(distance(plate, remeshed.mesh).greatest, 1e-12);
}

TEST(Remesh, EdgesOfMoreThanTwoFacesStay) {
  // Three sheets of two cells meet in one edge.
  MeshBuilder builder;
  for (const double y : {0.0, 1.0, 2.0}) builder.add_node({0, y, 0});
  for (Index k = 0; k < 3; ++k) {
    const double angle = 2 * pi * k / 3;
    for (const double y : {0.0, 1.0, 2.0}) builder.add_node({std::cos(angle), y, std::sin(angle)});
    for (Index row = 0; row < 2; ++row) builder.add_face({row, row + 1, 3 * k + row + 4, 3 * k + row + 3});
  }
  const PolygonMesh input = builder.take();
  const Remeshed remeshed = remesh(input, Constraints(input.node_count()), {.length = 0.2});
  const Edges edges = edges_of(remeshed.mesh);
  EXPECT_EQ(std::count_if(edges.begin(), edges.end(), [](const auto& edge) { return edge.second.size() == 3; }), 2);
  for (const auto& [edge, faces] : edges) EXPECT_LE(faces.size(), 3U);
  for (Index node = 0; node < 3; ++node) EXPECT_EQ(remeshed.mesh.position(node), input.position(node));
}

TEST(Remesh, WhatDoesNotMoveIsNotRemeshed) {
  const PolygonMesh input = globe(6, 8);
  Constraints held(input.node_count());
  for (Index node = 0; node < input.node_count(); ++node) held.fix_position(node, input.position(node));
  for (const std::optional<double> length : {std::optional<double>(0.1), std::optional<double>()}) {
    const Remeshed remeshed = remesh(input, held, {.length = length});
    EXPECT_EQ(remeshed.new_node_count(), 0);
    EXPECT_TRUE(remeshed.removed.empty());
    EXPECT_TRUE(remeshed.mesh.has_same_faces(input));
    EXPECT_EQ(remeshed.mesh.positions(), input.positions());
  }
}

TEST(Remesh, WhatCannotBeRemeshedIsRefused) {
  const PolygonMesh input = globe(6, 8);
  const Constraints free(input.node_count());
  for (const double length : {0.0, -1.0, std::numeric_limits<double>::infinity()})
    EXPECT_TRUE(says(refusal([&] { (void)remesh(input, free, {.length = length}); }, ErrorCode::invalid_argument),
                     "length is"));
  EXPECT_TRUE(says(refusal([&] { (void)remesh(input, free, {.length = 1e-4}); }, ErrorCode::invalid_argument),
                   "more than 10000000"));
  EXPECT_TRUE(says(refusal([&] { (void)remesh(input, Constraints(3), {.length = 1}); }, ErrorCode::unusable_constraint),
                   "constraints of 3 nodes"));
  EXPECT_TRUE(says(refusal(
                       [&] {
                         (void)remesh(input, free, {.length = 1, .lines = {{0, 999}}});
                       },
                       ErrorCode::invalid_argument),
                   "there is no node 999"));
  std::vector<Vector3> positions = input.positions();
  positions[5].x() = std::numeric_limits<double>::quiet_NaN();
  PolygonMesh broken = input;
  broken.set_positions(std::move(positions));
  EXPECT_TRUE(says(refusal([&] { (void)remesh(broken, free, {.length = 1}); }, ErrorCode::unusable_shape),
                   "its node 5 has a coordinate that is not finite"));
}

}  // namespace
}  // namespace vspring::remesh_test
