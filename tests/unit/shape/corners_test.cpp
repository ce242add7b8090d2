#include "shape/corners.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "vspring/error.hpp"

namespace vspring::corners_test {
namespace {

const std::vector<Vector3> square = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};

TEST(Corners, AreWhereEdgesTurnByMore) {
  EXPECT_EQ(find_corners(PolygonCurve(square), 30), (std::vector<Index>{2, 3}));
  EXPECT_EQ(find_corners(PolygonCurve(square, true), 30), (std::vector<Index>{0, 2, 3, 4}));
  EXPECT_EQ(find_corners(PolygonCurve(square, true), 91), std::vector<Index>{});
  // The way back.
  EXPECT_EQ(find_corners(PolygonCurve({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}), 179), std::vector<Index>{1});
}

TEST(Corners, PassOverWhatHasNoLengthOrIsNotFinite) {
  const Vector3 none = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(find_corners(PolygonCurve({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}}), 30), std::vector<Index>{1});
  EXPECT_EQ(find_corners(PolygonCurve({{0, 0, 0}, none, {1, 1, 0}, {1, 2, 0}}), 30), std::vector<Index>{});
  EXPECT_EQ(find_corners(PolygonCurve({{0, 0, 0}, {1e200, 0, 0}, {1e200, 1e200, 0}}), 30), std::vector<Index>{1});
  EXPECT_EQ(find_corners(PolygonCurve({{0, 0, 0}, {1, 0, 0}}, true), 30), std::vector<Index>{});
}

TEST(Corners, AnglesAreBetween0And180) {
  for (const double wrong : {0.0, -1.0, 180.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW((void)find_corners(PolygonCurve(square), wrong), Error) << wrong;
}

TEST(Corners, EndChainsAndBeginThemAgain) {
  const auto chains_of = [](const PolygonCurve& curve, const std::vector<std::uint8_t>& corners) {
    std::vector<std::vector<Index>> nodes;
    const PolygonCurve sides = cut_at_corners(curve, corners);
    for (const auto& chain : sides.chains()) {
      EXPECT_FALSE(chain.closed);
      nodes.push_back(chain.nodes);
    }
    return nodes;
  };
  using Chains = std::vector<std::vector<Index>>;
  EXPECT_EQ(chains_of(PolygonCurve(square), {0, 0, 1, 1, 0}), (Chains{{0, 1, 2}, {2, 3}, {3, 4}}));
  EXPECT_EQ(chains_of(PolygonCurve(square), {1, 0, 0, 0, 1}), (Chains{{0, 1, 2, 3, 4}})) << "ends are ends already";
  EXPECT_EQ(chains_of(PolygonCurve(square, true), {0, 0, 1, 0, 1}), (Chains{{2, 3, 4}, {4, 0, 1, 2}}));
  EXPECT_EQ(chains_of(PolygonCurve(square, true), {0, 1, 0, 0, 0}), (Chains{{1, 2, 3, 4, 0, 1}}));
  EXPECT_TRUE(cut_at_corners(PolygonCurve(square, true), std::vector<std::uint8_t>(5, 0)).chains().front().closed);
}

}  // namespace
}  // namespace vspring::corners_test
