#include "tools/logs/recorder/gap_tracker.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>
#include <random>
#include <set>

namespace sprung {
namespace {

GapCounts after(std::initializer_list<std::int64_t> cycles) {
  GapTracker tracker;
  for (const std::int64_t seq : cycles) tracker.add(seq);
  return tracker.counts();
}

TEST(GapTracker, CyclesInOrderMissNothing) {
  const GapCounts counts = after({0, 1, 2, 3});
  EXPECT_EQ(counts.messages, 4);
  EXPECT_EQ(counts.missing, 0);
  EXPECT_EQ(counts.gaps, 0);
  EXPECT_EQ(counts.first_missing, -1);
}

TEST(GapTracker, EachGapIsCountedWithItsCycles) {
  const GapCounts counts = after({5, 6, 9, 10, 12});
  EXPECT_EQ(counts.missing, 3);
  EXPECT_EQ(counts.gaps, 2);
  EXPECT_EQ(counts.first_missing, 7);
}

TEST(GapTracker, SaysHowManyAMessageLeftOut) {
  GapTracker tracker;
  EXPECT_EQ(tracker.add(100), 0);
  EXPECT_EQ(tracker.add(105), 4);
  EXPECT_EQ(tracker.add(106), 0);
}

TEST(GapTracker, WhatComesLateIsNotMissing) {
  const GapCounts counts = after({0, 2, 1, 3});
  EXPECT_EQ(counts.missing, 0);
  EXPECT_EQ(counts.repeats, 0);
}

/// Lock-step asks again for k - 1 and k.
TEST(GapTracker, RepeatsAreNoGaps) {
  const GapCounts counts = after({0, 1, 2, 1, 2, 3});
  EXPECT_EQ(counts.missing, 0);
  EXPECT_EQ(counts.repeats, 2);
}

TEST(GapTracker, RepeatOfWhatCameLateIsARepeat) { EXPECT_EQ(after({0, 2, 1, 1}).repeats, 1); }

TEST(GapTracker, MessagesBeforeTheFirstCycleAreCountedOnly) {
  const GapCounts counts = after({-1, -1, -1, 0, 1});
  EXPECT_EQ(counts.messages, 5);
  EXPECT_EQ(counts.missing, 0);
  EXPECT_EQ(counts.repeats, 0);
}

TEST(GapTracker, RecordingThatBeginsInTheMiddleMissesNothingBefore) {
  EXPECT_EQ(after({1000, 1001}).missing, 0);
  EXPECT_EQ(after({1000, 999, 1001}).missing, 0);
}

TEST(GapTracker, BridgeThatCountsFromZeroAgainIsARestart) {
  const GapCounts counts = after({100, 101, 0, 1, 2});
  EXPECT_EQ(counts.restarts, 1);
  EXPECT_EQ(counts.missing, 0);
}

TEST(GapTracker, LongGapIsCountedWhole) {
  const GapCounts counts = after({0, 5000, 5001});
  EXPECT_EQ(counts.missing, 4999);
  EXPECT_EQ(counts.gaps, 1);
}

/// Against a set of all cycles.
TEST(GapTracker, RandomLossesAndSmallDisorderAreCountedExactly) {
  std::mt19937 random(7);
  GapTracker tracker;
  std::set<std::int64_t> came{0};
  tracker.add(0);
  for (std::int64_t k = 1; k < 20'000; k += 2) {
    const bool swapped = random() % 5 == 0;
    for (const std::int64_t seq : {swapped ? k + 1 : k, swapped ? k : k + 1}) {
      if (random() % 10 == 0 && seq != 20'000) continue;
      tracker.add(seq);
      came.insert(seq);
    }
  }
  const std::int64_t last = *came.rbegin();
  EXPECT_EQ(tracker.counts().missing, last + 1 - static_cast<std::int64_t>(came.size()));
  EXPECT_EQ(tracker.counts().repeats, 0);
}

TEST(HasEveryCycle, TellsCyclicChannelsFromOthers) {
  for (const char* channel : {"DRIVE_STATE", "JOINT_STATE", "LEG_COMMAND", "DRIVE_COMMAND", "MOTION_STATE",
                              "CAN_TRACE", "SIM_TRUTH", "IMU"})
    EXPECT_TRUE(has_every_cycle(channel)) << channel;
  for (const char* channel :
       {"SAFETY_STATE", "PROCESS_STATUS", "TORQUE_SENSOR", "OPERATOR_COMMAND", "FOREIGN"})
    EXPECT_FALSE(has_every_cycle(channel)) << channel;
}

TEST(GapTracker, CycleThatCannotBeIsDamageNotAGap) {
  const GapCounts counts = after({0, 1, std::numeric_limits<std::int64_t>::max(), 2});
  EXPECT_EQ(counts.missing, 0);
  EXPECT_EQ(counts.messages, 4);
}

TEST(SessionGapTracker, EachSessionHasCyclesOfItsOwn) {
  SessionGapTracker tracker;
  for (const std::int64_t k : {0, 1, 3}) EXPECT_EQ(tracker.add(1, k), k == 3 ? 1 : 0);
  for (const std::int64_t k : {5000, 5001}) EXPECT_EQ(tracker.add(2, k), 0);  // a log put behind another
  EXPECT_EQ(tracker.add(1, 4), 0);
  const GapCounts counts = tracker.counts();
  EXPECT_EQ(counts.messages, 6);
  EXPECT_EQ(counts.missing, 1);
  EXPECT_EQ(counts.gaps, 1);
  EXPECT_EQ(counts.first_missing, 2);
  EXPECT_EQ(counts.repeats, 0);
}

}  // namespace
}  // namespace sprung
