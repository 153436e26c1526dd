#include "drivers/profiles/gold/gold_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "drivers/canopen/objects.h"
#include "drivers/profiles/gold/gold_units.h"

namespace sprung::sim {
namespace {

using gold::kExtrapolationCycles;

constexpr std::int64_t kTick_us = 250;
constexpr double kPerMille_Nm = 1e-3 * 0.308 * 100.0;

SimDriveSetup drive_config() {
  SimDriveSetup config;
  config.actuator.node = 4;
  config.actuator.gear_ratio = 100.0;
  config.actuator.torque_constant_Nm_A = 0.044;
  config.actuator.rated_current_A = 7.0;
  config.actuator.encoder_counts_per_turn = 131072;
  config.actuator.speed_limit_rad_s = 12.0;
  config.actuator.position_stiffness_Nm_rad = 503.0;
  config.actuator.position_damping_Nm_s_rad = 29.7;
  config.truth.torque_constant_Nm_A = 0.044;
  config.truth.torque_loop_Hz = 94.0;
  config.truth.peak_torque_Nm = 171.6;
  config.truth.torque_noise_Nm = 0.5;
  config.truth.supply_V = 48.0;
  config.truth.quick_stop_damping_Nm_s_rad = 40.0;
  config.step_s = 1e-6 * kTick_us;
  config.seed = 1;
  return config;
}

/// A drive whose shaft the test moves.
class GoldDriveTest : public testing::Test {
 protected:
  explicit GoldDriveTest(const SimDriveSetup& setup = drive_config()) : drive_(setup) {
    drive_.outbox().open(&out_);
  }
  void run(int ticks, double speed_rad_s = 0.0) {
    while (ticks-- > 0) {
      out_.clear();
      shaft_rad_ += speed_rad_s * 1e-6 * kTick_us;
      drive_.step(shaft_rad_, time_us_ += kTick_us);
    }
  }
  void write(std::uint16_t index, std::int64_t value, int size, int sub = 0) {
    out_.clear();
    const canopen::ObjectId id{index, static_cast<std::uint8_t>(sub)};
    drive_.receive(canopen::sdo_write_request(4, id, static_cast<std::uint32_t>(value), size), time_us_);
    ASSERT_EQ(out_.size(), 1);
    ASSERT_EQ(canopen::decode_sdo_reply(out_[0].frame).kind, canopen::SdoKind::kDownload)
        << std::hex << index;
  }
  /// Signed by `size` bytes.
  std::int64_t read(std::uint16_t index, ObjectType type) {
    out_.clear();
    drive_.receive(canopen::sdo_read_request(4, {index, 0}), time_us_);
    return from_wire(type, canopen::decode_sdo_reply(out_[0].frame).value);
  }
  std::int64_t status() { return read(canopen::kStatusWord, ObjectType::kU16); }
  void start(int mode) {
    run(1);
    drive_.receive(canopen::nmt_frame(canopen::NmtCommand::kStart, 0), time_us_);
    write(canopen::kMode, mode, 1);
    for (const int word : {0x06, 0x07, 0x0F}) write(canopen::kControlWord, word, 2);
    run(1);
  }

  GoldDrive drive_;
  FrameBatch out_;
  double shaft_rad_ = 1.0;
  std::int64_t time_us_ = 0;
};

TEST_F(GoldDriveTest, WalksThroughThePowerStates) {
  run(1);
  drive_.receive(canopen::nmt_frame(canopen::NmtCommand::kStart, 0), time_us_);
  run(1);
  EXPECT_EQ(status() & 0x26F, 0x240);
  const std::vector<std::pair<int, int>> steps = {{0x06, 0x221}, {0x07, 0x223}, {0x0F, 0x227},
                                                  {0x07, 0x223}, {0x06, 0x221}, {0x00, 0x240}};
  for (const auto& [word, expected] : steps) {
    write(canopen::kControlWord, word, 2);
    run(1);
    EXPECT_EQ(status() & 0x26F, expected) << word;
  }
}

TEST_F(GoldDriveTest, GivesNoTorqueUnlessEnabled) {
  run(1);
  write(canopen::kMode, 10, 1);
  write(canopen::kTargetTorque, 1000, 2);
  run(40);
  EXPECT_EQ(drive_.motor_torque_Nm(), 0.0);
  for (const int word : {0x06, 0x07, 0x0F}) write(canopen::kControlWord, word, 2);
  run(80);
  EXPECT_NEAR(drive_.motor_torque_Nm(), 1000 * kPerMille_Nm, 1e-3);
  write(canopen::kControlWord, 0x00, 2);
  run(1);
  EXPECT_EQ(drive_.motor_torque_Nm(), 0.0);
}

TEST_F(GoldDriveTest, ClampsByMaxTorqueAndByWhatThePowerStageCan) {
  start(10);
  write(canopen::kTargetTorque, 8000, 2);
  run(100);
  EXPECT_NEAR(drive_.motor_torque_Nm(), 171.6, 1e-3);
  EXPECT_NE(status() & 0x800, 0);  // internal limit
  write(canopen::kMaxTorque, 2000, 2);
  run(100);
  EXPECT_NEAR(drive_.motor_torque_Nm(), 2000 * kPerMille_Nm, 1e-3);
  write(canopen::kTargetTorque, 100, 2);
  run(100);
  EXPECT_EQ(status() & 0x800, 0);
}

TEST_F(GoldDriveTest, TorqueOffsetIsAddedToTheSetpoint) {
  start(10);
  EXPECT_EQ(read(canopen::kTorqueOffset, ObjectType::kI16), 0);
  write(canopen::kTargetTorque, 600, 2);
  write(canopen::kTorqueOffset, -200, 2);
  run(100);
  EXPECT_NEAR(drive_.motor_torque_Nm(), 400 * kPerMille_Nm, 1e-3);
}

TEST_F(GoldDriveTest, SpeedCapTakesTheTorque) {
  start(10);
  write(canopen::kTargetTorque, 1000, 2);
  run(200, 12.5);
  EXPECT_LT(drive_.motor_torque_Nm(), 0.0);
  run(200, 5.0);
  EXPECT_NEAR(drive_.motor_torque_Nm(), 1000 * kPerMille_Nm, 1e-3);
}

TEST_F(GoldDriveTest, PositionLoopActsAsSpringAndDamper) {
  run(1);
  write(kExtrapolationCycles, 1000, 2);
  start(8);
  run(80);
  EXPECT_NEAR(drive_.motor_torque_Nm(), 0.0, 1e-6);  // enters where it is
  shaft_rad_ -= 0.1;
  run(200);
  EXPECT_NEAR(drive_.motor_torque_Nm(), 50.3, 0.01);
  const double before_rad = shaft_rad_;
  run(400, 0.5);
  EXPECT_NEAR(drive_.motor_torque_Nm(), 50.3 - 503 * (shaft_rad_ - before_rad) - 29.7 * 0.5, 0.6);
}

class LooseGold : public GoldDriveTest {
 protected:
  static SimDriveSetup loose_config() {
    SimDriveSetup config = drive_config();
    config.truth.position_loop = {1.2, 0.5, 0.0};
    return config;
  }
  LooseGold() : GoldDriveTest(loose_config()) {}
};

TEST_F(LooseGold, PositionLoopMayHaveAnotherStiffnessAndDampingThanRobotYamlSays) {
  run(1);
  write(kExtrapolationCycles, 1000, 2);
  start(8);
  shaft_rad_ -= 0.1;
  run(200);
  EXPECT_NEAR(drive_.motor_torque_Nm(), 1.2 * 50.3, 0.01);
  const double before_rad = shaft_rad_;
  run(400, 0.5);
  const double spring_Nm = 1.2 * (50.3 - 503 * (shaft_rad_ - before_rad));
  EXPECT_NEAR(drive_.motor_torque_Nm(), spring_Nm - 0.5 * 29.7 * 0.5, 0.6);
}

TEST_F(GoldDriveTest, GoesOnAsFastAsBeforeWithoutSetPointsAndThenFaults) {
  run(1);
  write(kExtrapolationCycles, 5, 2);
  start(8);
  const auto counts = read(canopen::kPositionActual, ObjectType::kI32);
  for (int cycle = 0; cycle < 20; ++cycle) {
    write(canopen::kTargetPosition, counts + 100 * cycle, 4);
    run(4);
    ASSERT_EQ(status() & 0x6F, 0x27) << cycle;
  }
  run(20);  // five cycles
  EXPECT_EQ(status() & 0x6F, 0x27);
  EXPECT_NEAR(static_cast<double>(read(kFollowingError, ObjectType::kI32)), 100 * 24, 1);
  run(2);
  EXPECT_EQ(status() & 0x4F, 0x08);
}

TEST_F(GoldDriveTest, UnknownModeIsRefusedAndNotShown) {
  start(10);
  out_.clear();
  drive_.receive(canopen::sdo_write_request(4, {canopen::kMode, 0}, 3, 1), time_us_);
  ASSERT_EQ(out_.size(), 1);
  EXPECT_EQ(canopen::decode_sdo_reply(out_[0].frame).value, canopen::kAbortRange);
  run(2);
  EXPECT_EQ(read(canopen::kModeDisplay, ObjectType::kI8), 10);
  write(canopen::kMode, 8, 1);
  run(1);
  EXPECT_EQ(read(canopen::kModeDisplay, ObjectType::kI8), 8);
}

TEST_F(GoldDriveTest, QuickStopBrakesUntilSlowThenPowersOff) {
  start(10);
  run(4, 3.0);
  write(canopen::kControlWord, 0x02, 2);
  run(40, 3.0);
  EXPECT_EQ(status() & 0x6F, 0x07);
  EXPECT_NEAR(drive_.motor_torque_Nm(), -120.0, 3.0);
  run(3, 0.0);
  EXPECT_EQ(status() & 0x6F, 0x40);
  EXPECT_EQ(drive_.motor_torque_Nm(), 0.0);
}

TEST_F(GoldDriveTest, QuickStopEndsAfterItsTimeAtTheLatest) {
  start(10);
  run(4, 3.0);
  write(canopen::kControlWord, 0x02, 2);
  run(398, 3.0);
  EXPECT_EQ(status() & 0x6F, 0x07);
  run(6, 3.0);
  EXPECT_EQ(status() & 0x6F, 0x40);
}

TEST_F(GoldDriveTest, LostConnectionFollowsItsOption) {
  const std::vector<std::pair<int, int>> options = {{0, 0x27}, {1, 0x08}, {2, 0x40}, {3, 0x40}};
  for (const auto& [option, expected] : options) {
    drive_.receive(canopen::nmt_frame(canopen::NmtCommand::kResetNode, 0), time_us_);
    start(10);
    write(canopen::kAbortConnectionOption, option, 2);
    drive_.receive(canopen::nmt_frame(canopen::NmtCommand::kStop, 0), time_us_);
    run(2);
    drive_.receive(canopen::nmt_frame(canopen::NmtCommand::kEnterPreOperational, 0), time_us_);  // serves SDO
    EXPECT_EQ(status() & (expected == 0x08 ? 0x4F : 0x6F), expected) << option;
  }
}

TEST_F(GoldDriveTest, DriveThatIsMadePreOperationalKeepsItsPower) {
  start(10);
  write(canopen::kAbortConnectionOption, 2, 2);
  drive_.receive(canopen::nmt_frame(canopen::NmtCommand::kEnterPreOperational, 0), time_us_);
  run(20);
  EXPECT_EQ(status() & 0x6F, 0x27);
}

TEST_F(GoldDriveTest, FaultPowersOffUntilReset) {
  start(10);
  write(canopen::kTargetTorque, 500, 2);
  run(40);
  drive_.raise_fault(0x4210);
  run(2);
  EXPECT_EQ(status() & 0x4F, 0x08);
  EXPECT_EQ(drive_.motor_torque_Nm(), 0.0);
  write(canopen::kControlWord, 0x0F, 2);
  EXPECT_EQ(drive_.power_state(), PowerState::kFault);
  drive_.receive({0x604, 8, {0x2B, 0x40, 0x60, 0, 0x80, 0}, false}, time_us_);
  run(1);
  EXPECT_EQ(status() & 0x6F, 0x40);
  EXPECT_EQ(read(canopen::kErrorCode, ObjectType::kU16), 0);
}

TEST_F(GoldDriveTest, EncoderCountsRoundDown) {
  run(1);
  drive_.sample(1.0, 0);
  EXPECT_EQ(read(canopen::kPositionActual, ObjectType::kI32),
            static_cast<std::int64_t>(std::floor(131072.0 * 100.0 / (2 * M_PI))));
  drive_.sample(-1e-9, 0);
  EXPECT_EQ(read(canopen::kPositionActual, ObjectType::kI32), -1);
}

TEST_F(GoldDriveTest, TorqueNoiseHasItsRmsAndNoMean) {
  start(10);
  double sum = 0.0;
  double square = 0.0;
  constexpr int kSamples = 4000;
  for (int cycle = 0; cycle < kSamples; ++cycle) {
    drive_.sample(1.0, cycle);
    const double torque_Nm = kPerMille_Nm *
                             static_cast<double>(read(canopen::kTorqueActual, ObjectType::kI16));
    sum += torque_Nm;
    square += torque_Nm * torque_Nm;
  }
  EXPECT_NEAR(sum / kSamples, 0.0, 0.03);
  EXPECT_NEAR(std::sqrt(square / kSamples), 0.5, 0.02);
}

TEST_F(GoldDriveTest, RatingsScaleTheSetPoint) {
  start(10);
  write(canopen::kRatedTorque, 616, 4);  // believes twice the torque for a current
  write(canopen::kTargetTorque, 1000, 2);
  run(100);
  EXPECT_NEAR(drive_.motor_torque_Nm(), 1000 * kPerMille_Nm,
              1e-3);  // per mille of rated current all the same
}

TEST_F(GoldDriveTest, JumpedShaftIsNoSpeedOnceForgotten) {
  start(10);
  run(4);
  shaft_rad_ += 1.0;
  drive_.forget_motion();
  run(1);
  EXPECT_EQ(read(kVelocityActual, ObjectType::kI32), 0);
  EXPECT_EQ(read(canopen::kSupplyVoltage, ObjectType::kU32), 48000);
}

}  // namespace
}  // namespace sprung::sim
