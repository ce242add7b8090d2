// Which loops are lids, by how they turn from those beside them.

#include "span/lids.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace vspring::lids_test {
namespace {

std::vector<std::size_t> lids(const LoopTurns& turns, std::size_t count) {
  return turns.lids(std::vector<std::uint8_t>(count, 1), std::vector<std::uint8_t>(count, 0));
}

TEST(Lids, AreTheEndsOfATube) {
  // Four panels around in two rows, and two ends of four sides.
  LoopTurns turns(10);
  for (std::size_t row : {std::size_t{0}, std::size_t{4}}) {
    for (std::size_t k = 0; k < 4; ++k) {
      turns.add(row + k, row + (k + 1) % 4, 2, 8);
      turns.add(row + k, row == 0 ? 8 : 9, 1, 88);
    }
  }
  for (std::size_t k = 0; k < 4; ++k) turns.add(k, 4 + k, 1, 3);
  EXPECT_EQ(lids(turns, 10), (std::vector<std::size_t>{8, 9}));
}

TEST(Lids, AreTheEndsOfAWingButNoneOfItsPanels) {
  // Upper and lower panels turn sharply at both edges, and go on along the span.
  LoopTurns turns(6);
  for (const std::size_t span : {std::size_t{0}, std::size_t{2}}) {
    turns.add(span, span + 1, 2, 165);
    turns.add(span, span + 1, 2, 120);
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) turns.add(span + side, span == 0 ? 4 : 5, 1, 90);
  }
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) turns.add(side, 2 + side, 1, 4);
  EXPECT_EQ(lids(turns, 6), (std::vector<std::size_t>{4, 5}));
}

TEST(Lids, AreNoPanelsThatGoOnAtOneSide) {
  // Both sides of a bow, which meet at the stem.
  LoopTurns turns(4);
  turns.add(0, 1, 1, 5);
  turns.add(2, 3, 1, 5);
  turns.add(1, 3, 2, 130);
  turns.add(0, 2, 1, 20);
  EXPECT_EQ(lids(turns, 4), std::vector<std::size_t>());
}

}  // namespace
}  // namespace vspring::lids_test
