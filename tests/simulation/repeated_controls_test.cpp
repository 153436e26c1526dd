#include "simulation/repeated_controls.h"

#include <gtest/gtest.h>

namespace sprung::sim {
namespace {

TEST(RepeatedControls, TheSameStampActsOnce) {
  RepeatedControls repeated;
  EXPECT_TRUE(repeated.is_new({5000, 4}));
  EXPECT_FALSE(repeated.is_new({5000, 4}));
  EXPECT_FALSE(repeated.is_new({5000, 4}));
}

TEST(RepeatedControls, TimeOrCycleAloneMakesAnotherOne) {
  RepeatedControls repeated;
  EXPECT_TRUE(repeated.is_new({5000, 4}));
  EXPECT_TRUE(repeated.is_new({5001, 4}));
  EXPECT_TRUE(repeated.is_new({5000, 5}));
}

TEST(RepeatedControls, EvenTheEmptyStampIsNewAtFirst) {
  RepeatedControls repeated;
  EXPECT_TRUE(repeated.is_new(Stamp{}));
  EXPECT_FALSE(repeated.is_new(Stamp{}));
}

TEST(RepeatedControls, SendersMayInterleave) {
  RepeatedControls repeated;
  for (int round = 0; round < 3; ++round) {
    for (std::size_t sender = 0; sender < RepeatedControls::kRemembered; ++sender)
      EXPECT_EQ(repeated.is_new({static_cast<std::int64_t>(sender), 1}), round == 0);
  }
}

TEST(RepeatedControls, OnlyTheOldestIsForgotten) {
  RepeatedControls repeated;
  for (std::size_t i = 0; i <= RepeatedControls::kRemembered; ++i)
    EXPECT_TRUE(repeated.is_new({static_cast<std::int64_t>(i), 1}));
  EXPECT_FALSE(repeated.is_new({1, 1}));
  EXPECT_TRUE(repeated.is_new({0, 1}));
}

}  // namespace
}  // namespace sprung::sim
