#include "drivers/bridge/heartbeat_watch.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

using canopen::NmtState;

constexpr std::int64_t kStart_us = 1'000'000;
constexpr std::int64_t kPeriod_us = 5'000;
constexpr std::int64_t kLongest_us = 20'000;

WatchdogConfig watchdogs() {
  WatchdogConfig out;
  out.heartbeat_s = 0.005;
  out.drive_heartbeat_s = 0.020;
  return out;
}

class HeartbeatWatchTest : public ::testing::Test {
 protected:
  HeartbeatWatchTest() { watch_.begin_operation(kStart_us); }
  NodeHealth shown() const {
    NodeHealth out;
    watch_.show(out);
    return out;
  }
  HeartbeatWatch watch_{watchdogs()};
};

TEST_F(HeartbeatWatchTest, IsMissingAfterTheLongestPause) {
  EXPECT_TRUE(watch_.receive(NmtState::kOperational, kStart_us + kPeriod_us, true));
  EXPECT_TRUE(watch_.operational());
  EXPECT_FALSE(watch_.missing(kStart_us + kPeriod_us + kLongest_us));
  EXPECT_TRUE(watch_.missing(kStart_us + kPeriod_us + kLongest_us + 1));
}

TEST_F(HeartbeatWatchTest, ALossIsCountedOnceAndOnlyInOperation) {
  const std::int64_t later_us = kStart_us + 2 * kLongest_us;
  watch_.watch(later_us, false);
  EXPECT_EQ(shown().heartbeat_losses, 0);
  watch_.watch(later_us, true);
  watch_.watch(later_us + 1000, true);
  EXPECT_EQ(shown().heartbeat_losses, 1);
  watch_.receive(NmtState::kOperational, later_us + 2000, true);
  watch_.watch(later_us + 3000, true);
  watch_.watch(later_us + 4 * kLongest_us, true);
  EXPECT_EQ(shown().heartbeat_losses, 2);
}

TEST_F(HeartbeatWatchTest, AHeartbeatFromBeforeTheStartIsAliveAndNoWord) {
  EXPECT_FALSE(watch_.receive(NmtState::kPreOperational, kStart_us + 2 * kPeriod_us - 1, true));
  EXPECT_TRUE(watch_.operational());
  EXPECT_FALSE(watch_.missing(kStart_us + kPeriod_us + kLongest_us)) << "but it was heard";
  EXPECT_TRUE(watch_.receive(NmtState::kPreOperational, kStart_us + 2 * kPeriod_us, true));
  EXPECT_FALSE(watch_.operational());
  EXPECT_EQ(watch_.word(), NmtState::kPreOperational);
}

TEST_F(HeartbeatWatchTest, AnotherToolsGuardRequestIsNotHeardAtAll) {
  EXPECT_FALSE(watch_.receive(NmtState::kUnknown, kStart_us + kLongest_us, true));
  EXPECT_TRUE(watch_.missing(kStart_us + kLongest_us + 1));
  EXPECT_TRUE(watch_.operational());
}

TEST_F(HeartbeatWatchTest, ABootUpStaysTheWordUntilTheRestart) {
  watch_.receive(NmtState::kBootUp, kStart_us + 1, true);
  watch_.receive(NmtState::kOperational, kStart_us + 2, true);
  EXPECT_TRUE(watch_.rebooted());
  EXPECT_FALSE(watch_.operational());
  EXPECT_EQ(watch_.word(), NmtState::kBootUp);
  watch_.restart();
  EXPECT_FALSE(watch_.rebooted());
  watch_.receive(NmtState::kBootUp, kStart_us + 3, false);
  EXPECT_FALSE(watch_.rebooted()) << "the bridge has asked for this one";
}

TEST(HeartbeatWatchBefore, NothingHeardIsNotKnown) {
  NodeHealth out;
  const HeartbeatWatch watch(watchdogs());
  watch.show(out);
  EXPECT_EQ(out.nmt_state, -1);
  EXPECT_FALSE(watch.operational());
}

}  // namespace
}  // namespace sprung
