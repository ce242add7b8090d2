#include "vspring/joined_ends.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "support/refusal.hpp"

namespace vspring::joined_ends_test {
namespace {

using Pairs = std::vector<std::pair<Index, Index>>;
using Nodes = std::vector<Index>;

/// A ring whose last row repeats the first, and an open chain.
PolygonCurve two_chains() {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {5, 0, 0}, {6, 0, 0}, {7, 1, 0}},
          {{.nodes = {0, 1, 2, 3, 4}}, {.nodes = {5, 6, 7}}}};
}

TEST(JoinedEnds, CloseChainsAndLeaveARepeatedNodeOut) {
  PolygonCurve curve = two_chains();
  const JoinedEnds ends(curve);
  EXPECT_EQ(ends.followers(), (Pairs{{4, 0}}));
  EXPECT_TRUE(curve.chains()[0].closed && curve.chains()[1].closed);
  EXPECT_EQ(curve.chains()[0].nodes, (Nodes{0, 1, 2, 3}));
  EXPECT_EQ(curve.chains()[1].nodes, (Nodes{5, 6, 7}));
  std::vector<Vector3> positions = curve.positions();
  positions[0] = {9, 9, 9};
  ends.follow(positions);
  EXPECT_EQ(positions[4], Vector3(9, 9, 9));
}

TEST(JoinedEnds, CloseTheChainsThatAreMarked) {
  PolygonCurve curve = two_chains();
  EXPECT_TRUE(JoinedEnds(curve, std::array<std::uint8_t, 2>{0, 1}).followers().empty());
  EXPECT_FALSE(curve.chains()[0].closed);
  EXPECT_TRUE(curve.chains()[1].closed);
  EXPECT_TRUE(support::says(
      support::refusal([&] { JoinedEnds(curve, std::array<std::uint8_t, 1>{1}); }, ErrorCode::invalid_argument),
      "1 marks of chains"));
}

TEST(JoinedEnds, GiveTheFirstNodeWhatHoldsTheLast) {
  PolygonCurve curve = two_chains();
  const JoinedEnds ends(curve);
  Constraints constraints(curve.node_count());
  constraints.fix_position(4, {0, 0, 1});
  constraints.fix_tangent(4, {1, 0, 0});
  ends.hold(constraints);
  EXPECT_EQ(constraints.position(0), Vector3(0, 0, 1));
  EXPECT_TRUE(constraints.tangent_fixed(0));
  EXPECT_FALSE(constraints.position_fixed(4) || constraints.tangent_fixed(4));
  constraints.fix_position(4, {0, 0, 2});
  EXPECT_EQ(support::refusal([&] { ends.hold(constraints); }, ErrorCode::unusable_constraint),
            "nodes 0 and 4 are one in the closed curve, but are held at different places; hold one of them");
}

}  // namespace
}  // namespace vspring::joined_ends_test
