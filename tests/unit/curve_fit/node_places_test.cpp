#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "curve_fit/node_spacing.hpp"

namespace vspring::node_places_test {
namespace {

TEST(SetInOrder, LeavesWhatIsInOrderAlone) {
  std::vector<double> values = {1, 2, 3.5, 4};
  const std::vector<double> before = values;
  set_in_order(values, 1e-3, 0, 5);
  for (std::size_t k = 0; k < values.size(); ++k) EXPECT_NEAR(values[k], before[k], 1e-12);
}

TEST(SetInOrder, SpreadsEqualOnesAndSortsThoseTheOtherWayRound) {
  std::vector<double> values = {0.5, 3, 2, 2, 2, 4, 9, 1};
  set_in_order(values, 1e-3, 0, 5);
  EXPECT_GE(values.front(), 1e-3);
  EXPECT_LE(values.back(), 5 - 1e-3);
  for (std::size_t k = 1; k < values.size(); ++k) EXPECT_GE(values[k] - values[k - 1], 0.99e-3) << k;
  EXPECT_NEAR(values[0], 0.5, 1e-12) << "what was in order stays";
  EXPECT_NEAR(values[1], 1, 1e-12) << "and the others have the places of all of them";
}

}  // namespace
}  // namespace vspring::node_places_test
