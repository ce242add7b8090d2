#include "vspring/warning.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace vspring::warning_test {
namespace {

TEST(WarningCode, EachHasANameOfItsOwnInPlainWords) {
  std::set<std::string> names;
  for (auto code = WarningCode::immovable_nodes; code <= WarningCode::time_limit;
       code = static_cast<WarningCode>(static_cast<int>(code) + 1)) {
    const std::string word = name(code);
    EXPECT_FALSE(word.empty()) << static_cast<int>(code);
    EXPECT_EQ(word.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos) << word;
    EXPECT_TRUE(names.insert(word).second) << word;
  }
  EXPECT_STREQ(name(WarningCode::immovable_nodes), "immovable-nodes");
  EXPECT_STREQ(name(WarningCode::outside_tolerance), "outside-tolerance");
  EXPECT_STREQ(name(WarningCode::time_limit), "time-limit");
}

}  // namespace
}  // namespace vspring::warning_test
