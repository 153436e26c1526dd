#include "drivers/can/lockstep_burst.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace sprung {
namespace {

CanFrame frame_of(std::int64_t tick, int index) {
  CanFrame frame;
  frame.id = static_cast<std::uint32_t>(index + 1);
  frame.length = 1;
  frame.remote = index % 2 == 1;
  frame.data[0] = static_cast<std::uint8_t>(tick & 0xFF);
  return frame;
}

TEST(BurstStamp, SurvivesTheDoubleUpToTheLargestTick) {
  for (const std::int64_t tick : {std::int64_t{0}, std::int64_t{1}, (std::int64_t{1} << 33) - 1}) {
    for (const int count : {1, 2, kMaxBurst}) {
      for (const int index : {0, count - 1}) {
        BurstStamp found;
        ASSERT_TRUE(decode_stamp(encode_stamp({tick, count, index}), found));
        EXPECT_EQ(found.tick, tick);
        EXPECT_EQ(found.count, count);
        EXPECT_EQ(found.index, index);
      }
    }
  }
}

TEST(BurstStamp, NumbersOfOtherToolsAreRefused) {
  BurstStamp found;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double value : {0.0, -1.0, 0.5, nan, 1e300, 1700000000.123, encode_stamp({5, 2, 2})}) {
    EXPECT_FALSE(decode_stamp(value, found)) << value;
  }
}

TEST(BurstAssembler, CompletesInAnyOrderOnce) {
  BurstAssembler assembler;
  EXPECT_EQ(assembler.add({0, 3, 2}, frame_of(0, 2)), BurstEvent::kPartial);
  EXPECT_EQ(assembler.add({0, 3, 0}, frame_of(0, 0)), BurstEvent::kPartial);
  EXPECT_EQ(assembler.add({0, 3, 0}, frame_of(0, 0)), BurstEvent::kPartial) << "a duplicate counts once";
  EXPECT_EQ(assembler.add({0, 3, 1}, frame_of(0, 1)), BurstEvent::kComplete);
  ASSERT_EQ(assembler.frames().size(), 3U);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(assembler.frames()[i], frame_of(0, i));
  EXPECT_EQ(assembler.tick(), 0);
}

TEST(BurstAssembler, RepeatOfTheLastTickIsReportedOnceABurst) {
  BurstAssembler assembler;
  for (int i = 0; i < 3; ++i) assembler.add({4, 3, i}, frame_of(4, i));
  EXPECT_EQ(assembler.add({4, 3, 0}, frame_of(4, 0)), BurstEvent::kPartial);
  EXPECT_EQ(assembler.add({4, 3, 1}, frame_of(4, 1)), BurstEvent::kPartial);
  EXPECT_EQ(assembler.add({4, 3, 2}, frame_of(4, 2)), BurstEvent::kRepeat);
  EXPECT_EQ(assembler.add({3, 1, 0}, frame_of(3, 0)), BurstEvent::kPartial)
      << "older ticks are nobody's question";
}

TEST(BurstAssembler, NewerTickReplacesAnUnfinishedOne) {
  BurstAssembler assembler;
  assembler.add({0, 2, 0}, frame_of(0, 0));
  EXPECT_EQ(assembler.add({1, 1, 0}, frame_of(1, 0)), BurstEvent::kComplete);
  EXPECT_EQ(assembler.add({0, 2, 1}, frame_of(0, 1)), BurstEvent::kPartial);
  EXPECT_EQ(assembler.tick(), 1);
}

TEST(BurstAssembler, GivenUpTickCannotComplete) {
  BurstAssembler assembler;
  assembler.add({0, 2, 0}, frame_of(0, 0));
  assembler.expect(1);
  EXPECT_EQ(assembler.add({0, 2, 1}, frame_of(0, 1)), BurstEvent::kPartial);
  EXPECT_EQ(assembler.tick(), -1);
  EXPECT_EQ(assembler.add({1, 1, 0}, frame_of(1, 0)), BurstEvent::kComplete);
}

TEST(BurstAssembler, CountThatChangesWithinATickIsIgnored) {
  BurstAssembler assembler;
  assembler.add({0, 2, 0}, frame_of(0, 0));
  EXPECT_EQ(assembler.add({0, 5, 4}, frame_of(0, 4)), BurstEvent::kPartial);
  EXPECT_EQ(assembler.add({0, 2, 1}, frame_of(0, 1)), BurstEvent::kComplete);
}

TEST(Mark, IsToldFromFramesAndErrorsOfABus) {
  EXPECT_TRUE(is_end_of_tick_mark(end_of_tick_mark()));
  CanFrame nmt;
  EXPECT_FALSE(is_end_of_tick_mark(nmt));
  CanFrame bus_off = end_of_tick_mark();
  bus_off.id = 0x40;
  EXPECT_FALSE(is_end_of_tick_mark(bus_off));
}

/// A medium that loses a tenth of the frames, repeats a tenth and shuffles the rest.
std::vector<int> through_bad_medium(int count, std::mt19937& random) {
  std::vector<int> arrivals;
  for (int i = 0; i < count; ++i) {
    const auto fate = random() % 10;
    if (fate == 0) continue;
    arrivals.push_back(i);
    if (fate == 1) arrivals.push_back(i);
  }
  std::shuffle(arrivals.begin(), arrivals.end(), random);
  return arrivals;
}

TEST(BurstAssembler, StopAndWaitDeliversEveryBurstUnchangedOverABadMedium) {
  std::mt19937 random(11);
  BurstAssembler assembler;
  for (std::int64_t tick = 0; tick < 500; ++tick) {
    const int count = 1 + static_cast<int>(random() % 30);
    int sends = 0;
    while (assembler.tick() != tick) {
      ASSERT_LT(++sends, 100);
      for (const int index : through_bad_medium(count, random))
        assembler.add({tick, count, index}, frame_of(tick, index));
    }
    ASSERT_EQ(assembler.frames().size(), static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) ASSERT_EQ(assembler.frames()[i], frame_of(tick, i));
  }
}

}  // namespace
}  // namespace sprung
