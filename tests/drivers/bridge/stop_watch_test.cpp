#include "drivers/bridge/stop_watch.h"

#include <gtest/gtest.h>

#include "drivers/canopen/nmt.h"
#include "drivers/canopen/objects.h"
#include "tests/support/bridge_fixture.h"

namespace sprung {
namespace {

class StopWatchTest : public ::testing::Test {
 protected:
  StopWatchTest() { in_.wanted = true; }
  /// @return the step that many milliseconds later, told every one of them.
  StopStep after_ms(int ms) {
    for (int i = 0; i < ms; ++i) {
      in_.time_us += 1000;
      watch_.update(in_);
      resets_ += watch_.take_reset(in_.time_us) ? 1 : 0;
    }
    return watch_.step();
  }

  StopWatch watch_;
  StopInputs in_;
  int resets_ = 0;
};

TEST_F(StopWatchTest, NothingIsDoneWhereNoStopIsWanted) {
  in_.wanted = false;
  EXPECT_EQ(after_ms(2000), StopStep::kNone);
  EXPECT_EQ(watch_.worst(), StopStep::kNone);
}

TEST_F(StopWatchTest, PowerThatIsSeenOffInTimeNeedsNoOtherWay) {
  EXPECT_EQ(after_ms(150), StopStep::kPdo);
  in_.seen_off = true;
  EXPECT_EQ(after_ms(1), StopStep::kNone);
  EXPECT_EQ(after_ms(2000), StopStep::kNone);
  EXPECT_EQ(watch_.worst(), StopStep::kPdo);
  EXPECT_EQ(resets_, 0);
}

TEST_F(StopWatchTest, EachStepFollowsWhereTheOneBeforeDidNotHelp) {
  EXPECT_EQ(after_ms(200), StopStep::kPdo);
  EXPECT_EQ(after_ms(1), StopStep::kSdo);
  EXPECT_EQ(after_ms(99), StopStep::kSdo);
  EXPECT_EQ(after_ms(1), StopStep::kReset);
  EXPECT_EQ(after_ms(100), StopStep::kWithhold);
  EXPECT_EQ(after_ms(499), StopStep::kWithhold);
  EXPECT_EQ(resets_, 6) << "every 100 ms";
  EXPECT_EQ(after_ms(1), StopStep::kGivenUp);
  EXPECT_EQ(after_ms(1000), StopStep::kGivenUp);
  EXPECT_STREQ(text(watch_.worst()), "not at all: cut its supply");
}

TEST_F(StopWatchTest, DriveThatMayBrakeGetsTheTime) {
  in_.brakes = true;
  EXPECT_EQ(after_ms(800), StopStep::kPdo);
  EXPECT_EQ(after_ms(1), StopStep::kSdo);
}

TEST_F(StopWatchTest, DriveThatTakesNoSetPointsIsAskedBySdoAtOnce) {
  in_.takes_pdos = false;
  EXPECT_EQ(after_ms(1), StopStep::kSdo);
  EXPECT_TRUE(watch_.by_sdo());
}

TEST_F(StopWatchTest, DriveThatLeavesOperationalMeanwhileIsAskedBySdoAtOnce) {
  EXPECT_EQ(after_ms(50), StopStep::kPdo);
  in_.takes_pdos = false;
  EXPECT_EQ(after_ms(1), StopStep::kSdo);
}

TEST_F(StopWatchTest, HeartbeatStaysForADriveThatIsNotHeard) {
  in_.alive = false;
  after_ms(301);
  EXPECT_EQ(after_ms(100), StopStep::kGivenUp);
}

TEST_F(StopWatchTest, NextStopBeginsAtTheFirstStep) {
  after_ms(350);
  in_.wanted = false;
  after_ms(1);
  EXPECT_EQ(watch_.worst(), StopStep::kReset) << "news until the next stop";
  in_.wanted = true;
  EXPECT_EQ(after_ms(1), StopStep::kPdo);
  EXPECT_EQ(watch_.worst(), StopStep::kPdo);
}

TEST(StopStepText, EachStepHasItsWords) {
  EXPECT_STREQ(text(StopStep::kNone), "");
  EXPECT_STREQ(text(StopStep::kPdo), "by control word");
  EXPECT_STREQ(text(StopStep::kSdo), "by SDO");
  EXPECT_STREQ(text(StopStep::kReset), "by NMT reset");
  EXPECT_STREQ(text(StopStep::kWithhold), "by withholding the heartbeat");
  EXPECT_STREQ(text(StopStep::kGivenUp), "not at all: cut its supply");
}

/// The bridge with drives that do not obey.
class WatchedStop : public test::PoweredBridge {
 protected:
  void expect_detail(const char* text) const {
    EXPECT_NE(bench_.detail().find(text), std::string::npos) << bench_.detail();
  }
};

TEST_F(WatchedStop, DriveThatLeftOperationalUnderPowerIsSwitchedOffBySdo) {
  bench_.drives[0].nmt = canopen::NmtState::kPreOperational;  // as a foreign NMT command makes it
  bench_.run(20);
  EXPECT_EQ(level(), SafetyLevel::kDamping);
  EXPECT_EQ(bench_.drives[0].power, PowerState::kSwitchOnDisabled);
  EXPECT_EQ(bench_.drives[1].power, PowerState::kOperationEnabled) << "the other one damps";
  EXPECT_EQ(bench_.drives[0].resets, 1) << "that of the boot";
  expect_detail("hip_motor: was stopped by SDO");
  expect_stays_off();
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  bench_.enable();
  EXPECT_EQ(enabled(), 2);
}

TEST_F(WatchedStop, DriveThatServesNoSdoIsReset) {
  bench_.drives[0].nmt = canopen::NmtState::kStopped;
  bench_.drives[0].aborts[{canopen::kControlWord, 0}] = 0x08000022;
  bench_.drives[0].aborts[{canopen::kStatusWord, 0}] = 0x08000022;
  bench_.run(150);
  EXPECT_EQ(bench_.drives[0].resets, 2);
  EXPECT_EQ(bench_.drives[0].power, PowerState::kSwitchOnDisabled);
  expect_detail("hip_motor: was stopped by NMT reset");
}

TEST_F(WatchedStop, DriveThatObeysNothingLosesTheMastersHeartbeat) {
  bench_.drives[0].stuck_on = true;
  bench_.drives[0].boots_silently = true;
  bench_.ask(OperatorKind::kEstop);
  int heartbeats = 0;
  for (int i = 0; i < 500; ++i) {
    bench_.tick();
    if (i >= 405)
      heartbeats += static_cast<int>(bench_.sent(canopen::heartbeat_id(canopen::kBridgeNode)).size());
  }
  EXPECT_EQ(heartbeats, 0);
  EXPECT_EQ(bench_.drives[1].power, PowerState::kSwitchOnDisabled);
  bench_.run(800);
  expect_detail("hip_motor: is being stopped not at all: cut its supply");
}

}  // namespace
}  // namespace sprung
