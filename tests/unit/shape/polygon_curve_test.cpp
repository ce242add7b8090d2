#include "vspring/polygon_curve.hpp"

#include <gtest/gtest.h>

#include "vspring/error.hpp"

namespace vspring::polygon_curve_test {
namespace {

using Segments = std::vector<std::pair<Index, Index>>;

std::vector<Index> nodes(const PolygonCurve::Chain& chain) { return chain.nodes; }

TEST(PolygonCurve, ChainsAreJoinedFromSegmentsInAnyOrder) {
  const auto chains = chains_of_segments({{2, 3}, {1, 0}, {3, 4}, {1, 2}}, 6);
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_EQ(nodes(chains[0]), (std::vector<Index>{0, 1, 2, 3, 4}));
  EXPECT_FALSE(chains[0].closed);
}

TEST(PolygonCurve, ClosedChainsDoNotRepeatTheirFirstNode) {
  const auto chains = chains_of_segments({{5, 4}, {7, 8}, {4, 6}, {6, 5}}, 9);
  ASSERT_EQ(chains.size(), 2U);
  EXPECT_EQ(nodes(chains[0]), (std::vector<Index>{5, 4, 6}));
  EXPECT_TRUE(chains[0].closed);
  EXPECT_EQ(nodes(chains[1]), (std::vector<Index>{7, 8}));
}

TEST(PolygonCurve, ChainsEndWhereMoreThanTwoSegmentsMeet) {
  const auto chains = chains_of_segments({{0, 1}, {1, 2}, {2, 3}, {2, 4}, {4, 4}}, 5);
  ASSERT_EQ(chains.size(), 3U);
  EXPECT_EQ(nodes(chains[0]), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(nodes(chains[1]), (std::vector<Index>{2, 3}));
  EXPECT_EQ(nodes(chains[2]), (std::vector<Index>{2, 4}));
}

TEST(PolygonCurve, ADoubledSegmentIsAClosedChainOfTwo) {
  const auto chains = chains_of_segments({{0, 1}, {1, 0}}, 2);
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_TRUE(chains[0].closed);
  EXPECT_EQ(nodes(chains[0]), (std::vector<Index>{0, 1}));
}

TEST(PolygonCurve, EndsAreBoundary) {
  const PolygonCurve curve(std::vector<Vector3>(6, Vector3::Zero()), {{{3, 1, 0}, false}, {{2, 4, 5}, true}});
  EXPECT_EQ(boundary_nodes(curve), (std::vector<std::uint8_t>{1, 0, 0, 1, 0, 0}));
}

TEST(PolygonCurve, AnUnknownNodeIsRefused) {
  EXPECT_THROW(PolygonCurve(std::vector<Vector3>(2, Vector3::Zero()), {{{0, 2}, false}}), Error);
}

TEST(PolygonCurve, PositionsForOtherNodesAreRefused) {
  PolygonCurve curve(std::vector<Vector3>(3, Vector3::Zero()));
  EXPECT_THROW(curve.set_positions(std::vector<Vector3>(4, Vector3::Ones())), Error);
  EXPECT_EQ(curve.positions(), std::vector<Vector3>(3, Vector3::Zero()));
}

}  // namespace
}  // namespace vspring::polygon_curve_test
