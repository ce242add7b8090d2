// Meshes from flat arrays, and their coordinates as one.

#include "vspring/polygon_mesh.hpp"

#include <gtest/gtest.h>

#include <span>
#include <utility>
#include <vector>

#include "support/refusal.hpp"
#include "vspring/polygon_curve.hpp"

namespace vspring {
namespace {

using support::refusal;
using support::says;

const std::vector<double> square = {0, 0, 0, 1, 0, 0, 1, 1, 0.5, 0, 1, 0};

TEST(PolygonMesh, ComesFromFlatArraysOfQuadsAndOfTriangles) {
  const PolygonMesh quad = PolygonMesh::from_arrays(square, std::vector<Index>{0, 4}, std::vector<Index>{0, 1, 2, 3});
  EXPECT_EQ(quad.node_count(), 4);
  EXPECT_EQ(quad.position(2), Vector3(1, 1, 0.5));
  EXPECT_EQ(quad.face(0).size(), 4U);
  const PolygonMesh triangles = PolygonMesh::from_arrays(square, std::vector<Index>{0, 1, 2, 0, 2, 3});
  EXPECT_EQ(triangles.face_count(), 2);
  EXPECT_EQ(triangles.face(1)[2], 3);
  EXPECT_EQ(PolygonMesh::from_arrays({}, {}).face_count(), 0);
}

TEST(PolygonMesh, GivesItsCoordinatesWhereTheyLie) {
  const PolygonMesh quad = PolygonMesh::from_arrays(square, std::vector<Index>{0, 1, 2, 3}, 4);
  const std::span<const double> flat = coordinates(quad.positions());
  EXPECT_EQ(std::vector<double>(flat.begin(), flat.end()), square);
  EXPECT_EQ(flat.data(), quad.positions().front().data());
  EXPECT_TRUE(coordinates({}).empty());
}

TEST(PolygonMesh, TakesOtherPositionsFromAFlatArray) {
  PolygonMesh quad = PolygonMesh::from_arrays(square, std::vector<Index>{0, 1, 2, 3}, 4);
  std::vector<double> raised = square;
  raised[11] = 7;
  quad.set_positions(raised);
  EXPECT_EQ(quad.position(3), Vector3(0, 1, 7));
  EXPECT_TRUE(says(refusal([&] { quad.set_positions(std::span(raised).first(11)); }, ErrorCode::invalid_argument),
                   "11 coordinates"));
  EXPECT_TRUE(says(refusal([&] { quad.set_positions(std::span(raised).first(9)); }, ErrorCode::invalid_argument),
                   "3 positions given for 4 nodes"));
  EXPECT_EQ(quad.position(3), Vector3(0, 1, 7));

  PolygonCurve curve(positions_of(square), true);
  curve.set_positions(raised);
  EXPECT_EQ(curve.position(3), Vector3(0, 1, 7));
  EXPECT_TRUE(says(refusal([&] { curve.set_positions(std::span(raised).first(9)); }, ErrorCode::invalid_argument),
                   "3 positions given for 4 nodes"));
}

TEST(PolygonMesh, SharesWhatItHasWithCopiesUntilTheyAreMoved) {
  const PolygonMesh quad = PolygonMesh::from_arrays(square, std::vector<Index>{0, 1, 2, 3}, 4);
  PolygonMesh copy = quad;
  EXPECT_EQ(copy.positions().data(), quad.positions().data());
  std::vector<Vector3> positions = quad.positions();
  positions[2].z() = 7;
  copy.set_positions(positions);
  EXPECT_EQ(copy.position(2).z(), 7);
  EXPECT_EQ(quad.position(2).z(), 0.5);
  EXPECT_EQ(copy.corners().data(), quad.corners().data());
  PolygonMesh taken = std::move(copy);
  EXPECT_EQ(taken.node_count(), 4);
  taken = PolygonMesh();
  EXPECT_EQ(taken.node_count(), 0);
  EXPECT_EQ(taken.face_count(), 0);
}

TEST(PolygonMesh, SaysWhereFacesBeginWhetherTheyHaveAsManyNodesOrNot) {
  const std::vector<std::vector<Index>> offsets = {{0},       {0, 3},    {0, 3, 6, 9}, {0, 4, 8},
                                                   {0, 3, 7}, {0, 0, 0}, {0, 3, 3}};
  for (const std::vector<Index>& begin : offsets) {
    std::vector<Index> corners(static_cast<std::size_t>(begin.back()));
    for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = static_cast<Index>(k % 4);
    const PolygonMesh mesh = PolygonMesh::from_arrays(square, begin, corners);
    EXPECT_EQ(mesh.face_begin(), begin);
    ASSERT_EQ(mesh.face_count(), static_cast<Index>(begin.size()) - 1);
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const Index first = begin[static_cast<std::size_t>(f)];
      EXPECT_EQ(mesh.face_begin(f), first);
      EXPECT_EQ(mesh.face(f).data(), mesh.corners().data() + first);
      EXPECT_EQ(static_cast<Index>(mesh.face(f).size()), begin[static_cast<std::size_t>(f) + 1] - first);
    }
    EXPECT_EQ(mesh.face_begin(mesh.face_count()), begin.back());
    EXPECT_TRUE(mesh.has_same_faces(PolygonMesh::from_arrays(square, begin, corners)));
  }
}

TEST(PolygonMesh, TellsOtherFacesFromTheSame) {
  const PolygonMesh quad = PolygonMesh::from_arrays(square, std::vector<Index>{0, 1, 2, 3}, 4);
  PolygonMesh moved = quad;
  moved.set_positions(std::vector<Vector3>(4, Vector3::Zero()));
  EXPECT_TRUE(quad.has_same_faces(moved));
  EXPECT_FALSE(quad.has_same_faces(PolygonMesh::from_arrays(square, std::vector<Index>{0, 1, 3, 2}, 4)));
  EXPECT_FALSE(quad.has_same_faces(PolygonMesh::from_arrays(square, std::vector<Index>{0, 1, 2, 3}, 2)));
  std::vector<double> one_more = square;
  one_more.insert(one_more.end(), {2, 2, 2});
  EXPECT_FALSE(quad.has_same_faces(PolygonMesh::from_arrays(one_more, std::vector<Index>{0, 1, 2, 3}, 4)));
}

TEST(PolygonMesh, RefusesArraysThatDoNotFit) {
  const auto from = [](const std::vector<double>& numbers, const std::vector<Index>& corners, Index sides,
                       ErrorCode code) {
    return refusal([&] { (void)PolygonMesh::from_arrays(numbers, corners, sides); }, code);
  };
  EXPECT_TRUE(says(from({0, 0, 0, 1}, {}, 3, ErrorCode::invalid_argument), "4 coordinates"));
  EXPECT_TRUE(says(from(square, {0, 1, 2, 0}, 3, ErrorCode::invalid_argument), "4 corners"));
  EXPECT_TRUE(says(from(square, {}, 0, ErrorCode::invalid_argument), "1 node or more"));
  EXPECT_TRUE(says(from(square, {0, 1, 4}, 3, ErrorCode::unusable_shape), "face 0: node 4"));
  const std::vector<Index> corners = {0, 1, 2, 3};
  // Of more numbers than an Index can count; only their number is looked at.
  const std::span<const Index> too_many(corners.data(), std::size_t{3} << 30U);
  EXPECT_TRUE(says(refusal([&] { (void)PolygonMesh::from_arrays(square, too_many, 3); }, ErrorCode::invalid_argument),
                   "3221225472 corners"));
  const auto with_offsets = [&](const std::vector<Index>& begin) {
    return refusal([&] { (void)PolygonMesh::from_arrays(square, begin, corners); }, ErrorCode::unusable_shape);
  };
  EXPECT_TRUE(says(with_offsets({}), "begin with 0 and end with the number of corners, 4"));
  EXPECT_TRUE(says(with_offsets({0, 3}), "the number of corners, 4"));
  EXPECT_TRUE(says(with_offsets({0, 5, 4}), "face 1: its offset"));
}

}  // namespace
}  // namespace vspring
