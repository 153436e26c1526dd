#include "tools/logs/log/cycle_stretches.h"

#include <gtest/gtest.h>

namespace sprung::log {
namespace {

TEST(CycleStretches, CyclesInARowAreOneStretch) {
  CycleStretches stretches;
  EXPECT_TRUE(stretches.empty());
  for (const std::int64_t seq : {5, 6, 7, 9}) stretches.add(seq);
  stretches.add(10, 20);
  EXPECT_EQ(stretches.cycles(), 15);
  EXPECT_EQ(stretches.stretches(), 2);
  EXPECT_EQ(stretches.text(), "5 to 7, 9 to 20");
}

TEST(CycleStretches, WhatComesAgainIsNoNews) {
  CycleStretches stretches;
  for (const std::int64_t seq : {5, 5, 6, 5, 6}) stretches.add(seq);
  EXPECT_EQ(stretches.cycles(), 2);
  EXPECT_EQ(stretches.text(), "5 to 6");
}

TEST(CycleStretches, TheFirstFiveAreNamedAndTheOthersCounted) {
  CycleStretches stretches;
  for (std::int64_t seq = 0; seq < 10; seq += 2) stretches.add(seq);
  EXPECT_EQ(stretches.text(), "0, 2, 4, 6, 8");
  stretches.add(10);
  EXPECT_EQ(stretches.text(), "0, 2, 4, 6, 8 and 1 stretch more");
  stretches.add(11);  // the same one goes on
  stretches.add(20);
  EXPECT_EQ(stretches.text(), "0, 2, 4, 6, 8 and 2 stretches more");
  EXPECT_EQ(stretches.first().size(), 5u);
  EXPECT_EQ(stretches.cycles(), 8);
}

TEST(CycleStretches, NewestStretchIsAskedForWhole) {
  CycleStretches stretches;
  EXPECT_FALSE(stretches.newest_has(0, 0));
  stretches.add(0, 3);
  stretches.add(10, 20);
  EXPECT_TRUE(stretches.newest_has(10, 20));
  EXPECT_FALSE(stretches.newest_has(9, 12));
  EXPECT_FALSE(stretches.newest_has(20, 21));
  EXPECT_FALSE(stretches.newest_has(0, 3));
}

TEST(CycleStretches, LowNumbersCountAgainAfterABeginAnew) {
  CycleStretches stretches;
  stretches.add(100);
  stretches.begin_anew();
  EXPECT_FALSE(stretches.newest_has(100, 100));
  stretches.add(0);
  EXPECT_EQ(stretches.text(), "100, 0");
}

}  // namespace
}  // namespace sprung::log
