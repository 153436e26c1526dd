#include "simulation/node/power_stage.h"

#include <gtest/gtest.h>

namespace sprung::sim {
namespace {

constexpr double kPowerStageStep_s = 0.001;
constexpr PowerTimes kEpos2Like{0.001, 0.002, 0.005, 0.020};

/// @param words are given at `velocity_rad_s`, one tick each.
void give(PowerStage& stage, std::initializer_list<int> words, const PowerOptions& options = {},
          double velocity_rad_s = 0.0) {
  for (const int word : words) {
    stage.control(static_cast<std::uint16_t>(word), options, velocity_rad_s, true);
    stage.advance(velocity_rad_s);
  }
}

PowerStage enabled() {
  PowerStage stage({}, kPowerStageStep_s);
  stage.advance(0.0);
  give(stage, {0x06, 0x07, 0x0F});
  EXPECT_EQ(stage.state(), PowerState::kOperationEnabled);
  return stage;
}

TEST(PowerStage, FirstEnableTakesRefreshAndMeasurementOnce) {
  PowerStage stage(kEpos2Like, kPowerStageStep_s);
  EXPECT_EQ(stage.extra(), PowerExtra::kStart);
  stage.advance(0.0);
  EXPECT_EQ(stage.extra(), PowerExtra::kNone);
  EXPECT_EQ(stage.state(), PowerState::kNotReadyToSwitchOn);
  for (int i = 0; i < 2; ++i) stage.advance(0.0);
  EXPECT_EQ(stage.state(), PowerState::kSwitchOnDisabled);
  give(stage, {0x06, 0x07, 0x0F});
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(stage.extra(), PowerExtra::kRefresh) << i;
    give(stage, {0x0F});
  }
  EXPECT_EQ(stage.extra(), PowerExtra::kMeasure);
  EXPECT_EQ(stage.state(), PowerState::kSwitchedOn);
  EXPECT_FALSE(stage.powered());
  for (int i = 0; i < 20; ++i) give(stage, {0x0F});
  EXPECT_EQ(stage.state(), PowerState::kOperationEnabled);
  give(stage, {0x07, 0x0F});
  EXPECT_EQ(stage.state(), PowerState::kOperationEnabled);  // not again
}

TEST(PowerStage, EnableFromReadyGoesOnThroughSwitchedOn) {
  PowerStage stage({}, kPowerStageStep_s);
  stage.advance(0.0);
  give(stage, {0x06, 0x0F});
  EXPECT_EQ(stage.state(), PowerState::kOperationEnabled);
  PowerStage refreshed(kEpos2Like, kPowerStageStep_s);
  for (int i = 0; i < 4; ++i) refreshed.advance(0.0);
  give(refreshed, {0x06, 0x0F});
  EXPECT_EQ(refreshed.state(), PowerState::kSwitchedOn);
  EXPECT_EQ(refreshed.extra(), PowerExtra::kRefresh);
  give(refreshed, {0x06});
  EXPECT_EQ(refreshed.state(), PowerState::kReadyToSwitchOn) << "taken back before it was enabled";
  for (int i = 0; i < 30; ++i) give(refreshed, {0x0F});
  EXPECT_EQ(refreshed.state(), PowerState::kOperationEnabled);
}

TEST(PowerStage, EnableFromDisabledDoesNothing) {
  PowerStage stage({}, kPowerStageStep_s);
  stage.advance(0.0);
  give(stage, {0x0F, 0x0F, 0x07});
  EXPECT_EQ(stage.state(), PowerState::kSwitchOnDisabled);
}

TEST(PowerStage, RefreshIsLeftWhenEnableIsTakenBack) {
  PowerStage stage(kEpos2Like, kPowerStageStep_s);
  for (int i = 0; i < 4; ++i) stage.advance(0.0);
  give(stage, {0x06, 0x07, 0x0F, 0x07});
  EXPECT_EQ(stage.extra(), PowerExtra::kNone);
  EXPECT_EQ(stage.state(), PowerState::kSwitchedOn);
  give(stage, {0x0F});
  EXPECT_EQ(stage.extra(), PowerExtra::kRefresh);  // from its begin
}

TEST(PowerStage, ShutdownAndDisableBrakeWhenTheirOptionSaysSo) {
  for (const int word : {0x06, 0x07}) {
    const PowerState end = word == 0x06 ? PowerState::kReadyToSwitchOn : PowerState::kSwitchedOn;
    PowerStage coasting = enabled();
    give(coasting, {word}, {}, 3.0);
    EXPECT_EQ(coasting.state(), end);
    PowerStage braking = enabled();
    PowerOptions options;
    options.shutdown = word == 0x06 ? 1 : 0;
    options.disable = word == 0x07 ? 1 : 0;
    give(braking, {word}, options, 3.0);
    EXPECT_EQ(braking.state(), PowerState::kOperationEnabled) << word;
    EXPECT_TRUE(braking.braking());
    braking.advance(0.01);
    EXPECT_EQ(braking.state(), end) << word;
  }
}

TEST(PowerStage, EnableAgainEndsTheBraking) {
  PowerStage stage = enabled();
  PowerOptions options;
  options.disable = 1;
  give(stage, {0x07}, options, 3.0);
  give(stage, {0x0F}, options, 3.0);
  EXPECT_FALSE(stage.braking());
  stage.advance(0.0);
  EXPECT_EQ(stage.state(), PowerState::kOperationEnabled);
}

TEST(PowerStage, HaltBrakesForAsLongAsItsBitIsSet) {
  PowerStage stage = enabled();
  give(stage, {0x10F});
  EXPECT_TRUE(stage.braking());
  give(stage, {0x0F});
  EXPECT_FALSE(stage.braking());
}

TEST(PowerStage, QuickStopCoastsOrBrakesByItsOption) {
  PowerStage coasting = enabled();
  give(coasting, {0x02}, {}, 3.0);
  EXPECT_EQ(coasting.state(), PowerState::kSwitchOnDisabled);
  PowerStage braking = enabled();
  PowerOptions options;
  options.quick_stop = 2;
  give(braking, {0x02}, options, 3.0);
  EXPECT_EQ(braking.state(), PowerState::kQuickStopActive);
  for (int i = 0; i < 100; ++i) braking.advance(3.0);
  EXPECT_EQ(braking.state(), PowerState::kSwitchOnDisabled);  // never slow, but never forever
}

/// 0x605A = 5 to 8, also of a motor at rest.
TEST(PowerStage, QuickStopThatStaysKeepsItsPowerUntilItIsTakenAwayOrOperationGoesOn) {
  PowerOptions options;
  for (const double velocity_rad_s : {0.0, 3.0}) {
    for (options.quick_stop = 5; options.quick_stop <= 8; ++options.quick_stop) {
      PowerStage stage = enabled();
      give(stage, {0x02}, options, velocity_rad_s);
      for (int i = 0; i < 1000; ++i) stage.advance(0.0);
      EXPECT_EQ(stage.state(), PowerState::kQuickStopActive) << options.quick_stop;
      EXPECT_TRUE(stage.powered() && stage.braking());
      PowerStage off = stage;
      give(stage, {0x8F, 0x07}, options);
      EXPECT_EQ(stage.state(), PowerState::kQuickStopActive) << "neither of them enables";
      give(stage, {0x0F}, options);
      EXPECT_EQ(stage.state(), PowerState::kOperationEnabled);
      EXPECT_FALSE(stage.braking());
      give(off, {0x00}, options);
      EXPECT_EQ(off.state(), PowerState::kSwitchOnDisabled);
    }
  }
  PowerStage braking = enabled();
  options.quick_stop = 2;
  give(braking, {0x02, 0x0F}, options, 3.0);
  EXPECT_EQ(braking.state(), PowerState::kQuickStopActive) << "the others are left downwards";
}

TEST(PowerStage, FaultBrakesWithPowerOrLosesItAtOnce) {
  PowerStage off = enabled();
  off.fault(false, 3.0);
  EXPECT_FALSE(off.powered());
  off.advance(3.0);
  EXPECT_EQ(off.state(), PowerState::kFault);
  PowerStage braking = enabled();
  braking.fault(true, 3.0);
  EXPECT_TRUE(braking.powered() && braking.braking());
  braking.advance(3.0);
  EXPECT_EQ(braking.state(), PowerState::kFaultReactionActive);
  braking.advance(0.0);
  EXPECT_EQ(braking.state(), PowerState::kFault);
  EXPECT_FALSE(braking.powered());
}

TEST(PowerStage, FaultResetWaitsUntilItIsAllowedAndNeedsANewEdge) {
  PowerStage stage = enabled();
  stage.fault(false, 0.0);
  stage.advance(0.0);
  stage.control(0x80, {}, 0.0, false);
  EXPECT_EQ(stage.state(), PowerState::kFault);
  stage.control(0x80, {}, 0.0, true);
  EXPECT_EQ(stage.state(), PowerState::kFault);
  give(stage, {0x00, 0x80});
  EXPECT_EQ(stage.state(), PowerState::kSwitchOnDisabled);
}

TEST(PowerStage, LostConnectionFollowsItsOption) {
  PowerOptions options;
  options.quick_stop = 2;
  options.fault_reaction = 2;
  const PowerState expected[] = {PowerState::kOperationEnabled, PowerState::kFaultReactionActive,
                                 PowerState::kSwitchOnDisabled, PowerState::kQuickStopActive};
  for (int option = 0; option < 4; ++option) {
    PowerStage stage = enabled();
    stage.connection_lost(option, options, 3.0);
    EXPECT_EQ(stage.state(), expected[option]) << option;
  }
  PowerStage unpowered({}, kPowerStageStep_s);
  unpowered.advance(0.0);
  unpowered.connection_lost(1, options, 0.0);
  EXPECT_EQ(unpowered.state(), PowerState::kSwitchOnDisabled);
}

}  // namespace
}  // namespace sprung::sim
