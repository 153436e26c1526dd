#include "drivers/bridge/sample_watch.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

constexpr int kSilentCycles = 2;

CanFrame answer(std::uint8_t value) {
  CanFrame frame;
  frame.id = 0x181;
  frame.length = 1;
  frame.data[0] = value;
  return frame;
}

class SampleWatchTest : public ::testing::Test {
 protected:
  void begin() { watch_.begin(++cycle_ * 1000, true); }
  Answer receive(std::uint8_t value, std::int64_t after_us = 300) {
    return watch_.receive(answer(value), cycle_ * 1000 + after_us);
  }
  void end() { watch_.end(watch_.to_be_judged(), true); }
  void cycle_without_answer() {
    begin();
    end();
  }
  void good_cycle(std::uint8_t value) {
    begin();
    ASSERT_EQ(receive(value), Answer::kSample);
    end();
  }
  NodeHealth shown() const {
    NodeHealth out;
    watch_.show(out);
    return out;
  }

  SampleWatch watch_{kSilentCycles};
  std::int64_t cycle_ = 0;
};

TEST_F(SampleWatchTest, AnAnswerInItsCycleIsTheSampleOfThatSync) {
  good_cycle(1);
  begin();
  EXPECT_FALSE(watch_.answered());
  EXPECT_EQ(receive(2), Answer::kSample);
  EXPECT_TRUE(watch_.answered());
  EXPECT_TRUE(watch_.caught_up());
  EXPECT_EQ(watch_.sample_sync_us(), 2000);
  EXPECT_EQ(watch_.earliest_sync_us(), 2000);
  end();
  EXPECT_EQ(watch_.age_cycles(), 0);
  EXPECT_EQ(shown().missing_samples, 0);
}

TEST_F(SampleWatchTest, SilenceIsMoreCyclesThanAllowed) {
  good_cycle(1);
  for (int k = 1; k <= kSilentCycles; ++k) {
    cycle_without_answer();
    EXPECT_EQ(watch_.age_cycles(), k);
    EXPECT_FALSE(watch_.silent());
  }
  cycle_without_answer();
  EXPECT_TRUE(watch_.silent());
  EXPECT_EQ(shown().missing_samples, kSilentCycles + 1);
  watch_.begin_operation();
  EXPECT_FALSE(watch_.silent());
}

TEST_F(SampleWatchTest, AnAnswerThatIsNoNewMeasurementIsNone) {
  good_cycle(1);
  begin();
  receive(2);
  watch_.end(false, true);
  EXPECT_EQ(watch_.age_cycles(), 1);
  EXPECT_EQ(watch_.untimely_cycles(), 1);
  EXPECT_EQ(shown().missing_samples, 1);
}

TEST_F(SampleWatchTest, TheSameFrameTwiceIsHarmlessAndAnotherIsAConflict) {
  begin();
  ASSERT_EQ(receive(7), Answer::kSample);
  EXPECT_EQ(receive(7), Answer::kRepeated);
  EXPECT_EQ(receive(8), Answer::kConflict);
  EXPECT_EQ(shown().duplicate_samples, 2);
}

TEST_F(SampleWatchTest, AStalledDevicePaysInOrderAndTheLastIsTheSample) {
  good_cycle(1);
  cycle_without_answer();
  cycle_without_answer();
  begin();
  EXPECT_EQ(watch_.owed(), 3);
  EXPECT_EQ(receive(2), Answer::kSample);
  EXPECT_FALSE(watch_.caught_up()) << "two more may come";
  EXPECT_EQ(watch_.earliest_sync_us(), 2000) << "owed for two cycles";
  EXPECT_EQ(receive(3), Answer::kSample);
  EXPECT_EQ(receive(4), Answer::kSample);
  EXPECT_TRUE(watch_.caught_up());
  EXPECT_EQ(receive(5), Answer::kConflict) << "nobody owes a fourth";
  EXPECT_EQ(shown().late_samples, 2);
}

TEST_F(SampleWatchTest, AnAnswerAfterItsCycleCountsForThatCycle) {
  good_cycle(1);
  cycle_without_answer();
  EXPECT_EQ(receive(2, 900), Answer::kSample);
  begin();
  EXPECT_FALSE(watch_.answered());
  EXPECT_TRUE(watch_.to_be_judged());
  EXPECT_EQ(watch_.sample_sync_us(), 2000);
  end();
  EXPECT_EQ(watch_.age_cycles(), 1) << "its own SYNC's answer is still owed";
  EXPECT_EQ(watch_.untimely_cycles(), 2);
  EXPECT_EQ(shown().late_samples, 1);
}

TEST_F(SampleWatchTest, AnAnswerStampedBeforeItsSyncIsNotThisCycles) {
  good_cycle(1);
  cycle_without_answer();
  begin();
  EXPECT_EQ(receive(2, -500), Answer::kSample);
  EXPECT_FALSE(watch_.answered());
  EXPECT_EQ(receive(3, -100), Answer::kSample) << "within the error of stamps";
  EXPECT_TRUE(watch_.answered());
}

TEST_F(SampleWatchTest, ALateAnswerThatNobodyOwesIsNotRead) {
  good_cycle(1);
  begin();
  EXPECT_EQ(receive(2, -500), Answer::kUnasked) << "the one owed is this cycle's";
  EXPECT_FALSE(watch_.to_be_judged());
  EXPECT_EQ(receive(3), Answer::kSample);
  EXPECT_EQ(shown().late_samples, 1);
}

TEST_F(SampleWatchTest, AlwaysLateIsSilentAfterTwiceTheTime) {
  good_cycle(1);
  for (int k = 0; k < 2 * kSilentCycles; ++k) {
    cycle_without_answer();
    receive(static_cast<std::uint8_t>(k), 900);
  }
  EXPECT_FALSE(watch_.silent());
  cycle_without_answer();
  EXPECT_FALSE(watch_.too_old());
  EXPECT_TRUE(watch_.silent());
}

TEST_F(SampleWatchTest, DebtsExpireAfterTenCyclesInTime) {
  good_cycle(0);
  cycle_without_answer();
  for (std::uint8_t k = 1; k <= 9; ++k) good_cycle(k);
  EXPECT_EQ(watch_.owed(), 1);
  good_cycle(10);
  EXPECT_EQ(watch_.owed(), 0);
}

TEST_F(SampleWatchTest, ARestartedNodeOwesNothingAndIsNotSilent) {
  good_cycle(1);
  for (int k = 0; k < 10; ++k) cycle_without_answer();
  watch_.restart();
  EXPECT_EQ(watch_.owed(), 0);
  EXPECT_FALSE(watch_.silent());
  watch_.begin(50'000, false);
  watch_.end(false, false);
  EXPECT_EQ(watch_.owed(), 0) << "not in operation, it owes none";
  EXPECT_EQ(shown().missing_samples, 10) << "and misses none";
}

}  // namespace
}  // namespace sprung
