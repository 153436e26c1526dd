#include "drivers/bridge/second_device_watch.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

using canopen::NmtState;

constexpr double kHeartbeat_s = 0.005;

class SecondDeviceWatchTest : public ::testing::Test {
 protected:
  void cycle(bool conflict = false, bool answered = true, bool rebooted = false) {
    watch_.begin_cycle();
    if (conflict) watch_.conflict();
    sync_us_ += 1000;
    watch_.judge(answered, sync_us_, rebooted);
  }
  SecondDeviceWatch watch_{kHeartbeat_s};
  std::int64_t sync_us_ = 0;
};

TEST_F(SecondDeviceWatchTest, ThreeConflictsOfTenCyclesAreTwoDevices) {
  for (int k = 0; k < 2; ++k) cycle(true);
  for (int k = 0; k < 9; ++k) cycle();
  cycle(true);
  cycle();
  EXPECT_FALSE(watch_.found()) << "the first two are more than ten cycles ago";
  cycle(true);
  cycle(true);
  EXPECT_FALSE(watch_.found()) << "judged when the cycle is over";
  cycle();
  EXPECT_TRUE(watch_.found());
  watch_.restart();
  EXPECT_FALSE(watch_.found());
  cycle(true);
  cycle();
  EXPECT_FALSE(watch_.found()) << "the conflicts of before are forgotten";
}

TEST_F(SecondDeviceWatchTest, OneThatLeavesAndFallsSilentIsOne) {
  watch_.said(NmtState::kPreOperational, 0);
  for (int k = 0; k < 50; ++k) cycle(false, false);
  EXPECT_FALSE(watch_.found());
}

TEST_F(SecondDeviceWatchTest, OneContradictionMayHaveBeenOnItsWayAndTwoAreTwoDevices) {
  for (int k = 0; k < 2; ++k) {
    EXPECT_FALSE(watch_.found());
    watch_.said(NmtState::kPreOperational, 0);
    cycle();
    EXPECT_FALSE(watch_.found()) << "this answer may be to the SYNC before";
    cycle();
  }
  EXPECT_TRUE(watch_.found());
}

TEST_F(SecondDeviceWatchTest, AnswersThatAreOwedAreNoContradiction) {
  watch_.said(NmtState::kBootUp, 3);
  for (int k = 0; k < 4; ++k) cycle(false, true, true);
  EXPECT_FALSE(watch_.found());
  cycle(false, true, true);
  EXPECT_TRUE(watch_.found()) << "one that has booted and answers is enough";
}

TEST_F(SecondDeviceWatchTest, ContradictionsFade) {
  watch_.said(NmtState::kPreOperational, 0);
  cycle();
  cycle();
  sync_us_ += 101'000;  // twenty heartbeats
  watch_.said(NmtState::kPreOperational, 0);
  cycle();
  cycle();
  EXPECT_FALSE(watch_.found());
}

TEST_F(SecondDeviceWatchTest, StoppedIsBelievedOnlyBesideAConflict) {
  for (int k = 0; k < 5; ++k) {
    watch_.said(NmtState::kStopped, 0);
    cycle();
    cycle();
  }
  EXPECT_FALSE(watch_.found()) << "a flipped bit, or one that disturbs nobody";
  cycle(true);
  for (int k = 0; k < 2; ++k) {
    watch_.said(NmtState::kStopped, 0);
    cycle();
    cycle();
  }
  EXPECT_TRUE(watch_.found());
}

}  // namespace
}  // namespace sprung
