#include "drivers/bridge/background_access.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "drivers/canopen/objects.h"
#include "drivers/canopen/sdo_frames.h"
#include "drivers/canopen/wire.h"
#include "robots/robot_loader.h"

namespace sprung {
namespace {

constexpr int kNode = 3;
constexpr std::int64_t kTimeout_us = 100'000;
constexpr std::int64_t kFirst_us = 60'000;  // 20 ms a node id

class BackgroundAccessTest : public ::testing::Test {
 protected:
  explicit BackgroundAccessTest(const char* robot_name) {
    const RobotConfig robot = load_robot(robot_name);
    const WatchdogConfig& w = robot.watchdogs;
    profile_ = make_profile(robot.actuators[0], {robot.cycle_s, w.heartbeat_s, w.heartbeat_consumer_s});
    reads_ = std::make_unique<BackgroundAccess>(*profile_, false);
    reads_->begin_operation(kNode, 0);
  }
  bool step(std::int64_t time_us, std::int64_t unconfirmed_us = 0) {
    return reads_->step(time_us, sdo_, unconfirmed_us, request_);
  }
  void answer(canopen::ObjectId object, std::uint32_t value, int size) {
    ASSERT_EQ(request_, canopen::sdo_read_request(kNode, object));
    sdo_.receive(canopen::sdo_read_reply(kNode, object, value, size));
  }
  std::int64_t failures() const {
    NodeHealth out;
    reads_->show(out);
    return out.sdo_failures;
  }

  const canopen::ObjectId mode_object_{canopen::kModeDisplay, 0};
  std::unique_ptr<DriveProfile> profile_;
  std::unique_ptr<BackgroundAccess> reads_;
  canopen::SdoClient sdo_{kNode, kTimeout_us};
  CanFrame request_;
};

/// Knows its supply voltage, in mV.
struct BackgroundAccessOfGold : BackgroundAccessTest {
  BackgroundAccessOfGold() : BackgroundAccessTest("single_leg") {}
};
/// Knows the count at its index.
struct BackgroundAccessOfEpos2 : BackgroundAccessTest {
  BackgroundAccessOfEpos2() : BackgroundAccessTest("pegasus") {}
};

TEST_F(BackgroundAccessOfGold, SupplyIsReadOnceASecondEachNodeAtItsOwnTime) {
  EXPECT_TRUE(std::isnan(reads_->supply_V()));
  EXPECT_FALSE(step(kFirst_us - 1));
  ASSERT_TRUE(step(kFirst_us));
  answer(profile_->supply_voltage_object(), 48'000, 4);
  EXPECT_FALSE(step(kFirst_us + 1'000));
  EXPECT_DOUBLE_EQ(reads_->supply_V(), 48.0);
  EXPECT_FALSE(step(kFirst_us + 999'999));
  EXPECT_TRUE(step(kFirst_us + 1'000'000));
}

TEST_F(BackgroundAccessOfGold, AModeThatIsNotConfirmedIsReadEveryFiftyMilliseconds) {
  EXPECT_FALSE(step(1'000, 50'000));
  ASSERT_TRUE(step(2'000, 50'001));
  answer(mode_object_, 0xFD, 1);
  EXPECT_FALSE(step(3'000, 51'001));
  EXPECT_EQ(reads_->take_mode(), std::int8_t{-3});
  EXPECT_EQ(reads_->take_mode(), std::nullopt) << "taken";
  EXPECT_FALSE(step(51'999, 100'000));
  EXPECT_TRUE(step(52'000, 100'001));
}

TEST_F(BackgroundAccessOfEpos2, AnIndexThatIsAskedForComesFirst) {
  reads_->ask_index();
  ASSERT_TRUE(step(kFirst_us, 60'000));
  EXPECT_EQ(reads_->index_answer(), IndexAnswer::kWaiting);
  answer(profile_->index_counter_object(), static_cast<std::uint32_t>(-1234), 4);
  EXPECT_TRUE(step(kFirst_us + 1'000, 61'000)) << "then the mode";
  EXPECT_EQ(reads_->index_answer(), IndexAnswer::kKnown);
  EXPECT_EQ(reads_->index_counts(), -1234);
}

TEST_F(BackgroundAccessOfEpos2, WithoutAnIndexPulseTheCountIsZeroAndNone) {
  reads_->ask_index();
  ASSERT_TRUE(step(1'000));
  answer(profile_->index_counter_object(), 0, 4);
  EXPECT_FALSE(step(2'000));
  EXPECT_EQ(reads_->index_answer(), IndexAnswer::kFailed);
  EXPECT_EQ(failures(), 0);
}

TEST_F(BackgroundAccessOfGold, SilenceIsCountedAndLeavesTheLastValue) {
  ASSERT_TRUE(step(kFirst_us));
  answer(profile_->supply_voltage_object(), 48'000, 4);
  step(kFirst_us + 1'000);
  std::int64_t time_us = kFirst_us + 1'000'000;
  ASSERT_TRUE(step(time_us));
  EXPECT_TRUE(step(time_us += kTimeout_us)) << "asked once more";
  step(time_us += kTimeout_us);
  step(time_us += 1'000);
  EXPECT_EQ(failures(), 1);
  EXPECT_DOUBLE_EQ(reads_->supply_V(), 48.0);
}

TEST_F(BackgroundAccessOfGold, WhatWasAskedBeforeARestartIsForgotten) {
  ASSERT_TRUE(step(kFirst_us));
  sdo_.finish();
  reads_->begin_operation(kNode, 500'000);
  EXPECT_FALSE(step(500'001));
  EXPECT_TRUE(std::isnan(reads_->supply_V()));
  EXPECT_EQ(failures(), 0);
}

}  // namespace
}  // namespace sprung
