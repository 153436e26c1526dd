#include "tools/lab/run/dice.h"

#include <gtest/gtest.h>

#include <array>

namespace sprung {
namespace {

TEST(DiceTest, SameSeedGivesTheSameAndAnotherDoesNot) {
  Dice one(3), same(3), other(4);
  const double first = one.between(0.0, 1.0);
  EXPECT_EQ(first, same.between(0.0, 1.0));
  EXPECT_NE(first, other.between(0.0, 1.0));
}

TEST(DiceTest, DrawsStayWithinTheirBoundsAndComeEverywhere) {
  Dice dice(1);
  std::array<int, 5> sides{};
  int small = 0, negative = 0;
  for (int i = 0; i < 10'000; ++i) {
    ++sides[dice.below(sides.size())];
    const double drawn = dice.scale(1.0, 100.0);
    ASSERT_GE(drawn, 1.0);
    ASSERT_LE(drawn, 100.0);
    small += drawn < 10.0 ? 1 : 0;
    negative += dice.either_sign(1.0) < 0.0 ? 1 : 0;
  }
  for (const int count : sides) EXPECT_NEAR(count, 2000, 200);
  EXPECT_NEAR(small, 5000, 300) << "half of the scale";
  EXPECT_NEAR(negative, 5000, 300);
}

}  // namespace
}  // namespace sprung
