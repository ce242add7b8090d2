#include "vspring/advice.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "vspring/error.hpp"
#include "vspring/warning.hpp"

namespace vspring::advice_test {
namespace {

const std::vector<Advice> advice = {
    {Remedy::input, "mend it"}, {Remedy::region, "move a part"}, {Remedy::weld, "weld within less"}};

TEST(Advice, EndsATextAsAList) {
  const auto first = [](std::size_t count) {
    return std::vector<Advice>(advice.begin(), advice.begin() + static_cast<std::ptrdiff_t>(count));
  };
  EXPECT_EQ(with_advice("it is wrong", first(0)), "it is wrong");
  EXPECT_EQ(with_advice("it is wrong", first(1)), "it is wrong; mend it");
  EXPECT_EQ(with_advice("it is wrong", first(2)), "it is wrong; mend it, or move a part");
  EXPECT_EQ(with_advice("it is wrong", first(3)), "it is wrong; mend it, move a part, or weld within less");
}

TEST(Advice, IsCarriedByErrors) {
  const Error error(ErrorCode::unusable_shape, "it is wrong", advice);
  const Error copy = error;  // NOLINT(performance-unnecessary-copy-initialization)
  EXPECT_STREQ(copy.what(), "it is wrong; mend it, move a part, or weld within less");
  EXPECT_EQ(copy.fault(), "it is wrong");
  EXPECT_EQ(std::vector<Advice>(copy.advice().begin(), copy.advice().end()), advice);
  const Error without(ErrorCode::unusable_shape, "it is wrong; mend it");
  EXPECT_EQ(without.fault(), "it is wrong; mend it");
  EXPECT_TRUE(without.advice().empty());
}

TEST(Advice, IsCarriedByWarnings) {
  const Warning warning(WarningCode::no_equilibrium, "it is wrong", advice);
  EXPECT_EQ(warning.text, "it is wrong; mend it, move a part, or weld within less");
  EXPECT_EQ(warning.fault(), "it is wrong");
  EXPECT_EQ(warning.advice, advice);
  EXPECT_NE(warning, Warning(WarningCode::no_equilibrium, warning.text));
}

}  // namespace
}  // namespace vspring::advice_test
