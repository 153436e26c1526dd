#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "drivers/canopen/objects.h"
#include "drivers/profiles/gold/gold_profile.h"
#include "drivers/profiles/gold/gold_units.h"
#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

constexpr DriveTiming kGoldTiming{0.001, 0.005, 0.020};

ActuatorConfig gold_actuator() { return test::two_drive_robot().actuators[0]; }

std::uint32_t value_of(const DriveProfile& profile, canopen::ObjectId object) {
  for (const DriveSetting& setting : profile.settings()) {
    if (setting.object == object) return setting.value;
  }
  ADD_FAILURE() << "no setting " << std::hex << object.index;
  return 0;
}

std::int16_t torque_of(const CanFrame& frame) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(canopen::get_le(&frame.data[0], 2)));
}
std::int32_t gold_position_of(const CanFrame& frame) {
  return static_cast<std::int32_t>(canopen::get_le(&frame.data[2], 4));
}

TEST(MakeProfile, UnknownNameListsTheKnownOnes) {
  ActuatorConfig config = gold_actuator();
  config.profile = "epos9";
  EXPECT_THAT(
      [&] { make_profile(config, kGoldTiming); },
      ::testing::ThrowsMessage<std::invalid_argument>(::testing::HasSubstr("there are: epos2, gold")));
}

TEST(GoldSettings, FollowFromTheRobotsFile) {
  const gold::GoldProfile profile(gold_actuator(), kGoldTiming);
  EXPECT_EQ(value_of(profile, {canopen::kHeartbeatProducer, 0}), 5U);
  EXPECT_EQ(value_of(profile, {canopen::kHeartbeatConsumer, 1}), (127U << 16) | 20U);
  EXPECT_EQ(value_of(profile, {canopen::kAbortConnectionOption, 0}), 2U);
  EXPECT_EQ(value_of(profile, {canopen::kQuickStopOption, 0}), 2U);
  EXPECT_EQ(value_of(profile, {canopen::kRatedCurrent, 0}), 7000U);
  EXPECT_EQ(value_of(profile, {canopen::kRatedTorque, 0}), 308U);
  EXPECT_EQ(value_of(profile, {canopen::kMaxTorque, 0}), 5571U);  // 171.6 / 100 / 0.308, per mille
  EXPECT_EQ(value_of(profile, {canopen::kTorqueOffset, 0}), 0U);
  EXPECT_EQ(value_of(profile, {canopen::kMaxMotorSpeed, 0}), 11459U);  // 12 rad/s * 100, rpm
  EXPECT_EQ(value_of(profile, {canopen::kSyncPeriod, 0}), 1000U);
  EXPECT_EQ(value_of(profile, {gold::kExtrapolationCycles, 0}), 5U);
}

TEST(GoldSettings, InterpolationPeriodHoldsTheCycle) {
  const struct {
    double cycle_s;
    std::uint32_t value;
    int exponent;
  } cases[] = {{0.001, 1, -3}, {0.002, 2, -3}, {0.0005, 5, -4}, {0.00125, 125, -5}, {0.5, 50, -2}};
  for (const auto& c : cases) {
    const gold::GoldProfile profile(gold_actuator(), {c.cycle_s, 0.005, 0.020});
    EXPECT_EQ(value_of(profile, {canopen::kInterpolationPeriod, 1}), c.value) << c.cycle_s;
    EXPECT_EQ(static_cast<std::int8_t>(value_of(profile, {canopen::kInterpolationPeriod, 2})), c.exponent);
  }
  EXPECT_THROW(gold::GoldProfile(gold_actuator(), {0.0012345678, 0.005, 0.020}), std::invalid_argument);
}

TEST(GoldSettings, ImpossibleActuatorsAreRefused) {
  ActuatorConfig config = gold_actuator();
  config.rated_current_A = 0.0;
  EXPECT_THROW(gold::GoldProfile(config, kGoldTiming), std::invalid_argument);
  config = gold_actuator();
  config.speed_limit_rad_s = -1.0;
  EXPECT_THROW(gold::GoldProfile(config, kGoldTiming).settings(), std::invalid_argument);
}

TEST(GoldSettings, NothingIsWrittenToObjectsWhoseMeaningIsAnotherOne) {
  const auto settings = gold::GoldProfile(gold_actuator(), kGoldTiming).settings();
  for (const DriveSetting& setting : settings) EXPECT_NE(setting.object.index, 0x2F01);
  ActuatorConfig config = gold_actuator();
  config.position_gains_object = 0x2F01;
  EXPECT_THAT([&] { gold::GoldProfile(config, kGoldTiming); },
              ::testing::ThrowsMessage<std::invalid_argument>(::testing::HasSubstr("closed_by: host")));
}

TEST(GoldSettings, SpeedCapIsWrittenOnlyWhereTheDriveHasAnObjectForIt) {
  ActuatorConfig config = gold_actuator();
  const std::size_t with = gold::GoldProfile(config, kGoldTiming).settings().size();
  config.speed_limit_object = 0;
  EXPECT_EQ(gold::GoldProfile(config, kGoldTiming).settings().size() + 1, with);
}

TEST(GoldPdos, EveryPdoIsMappedOrDisabled) {
  const gold::GoldProfile profile(gold_actuator(), kGoldTiming);
  int transmit = 0, disabled = 0;
  for (const PdoSetting& pdo : profile.pdos()) {
    transmit += pdo.transmit ? 1 : 0;
    disabled += pdo.entries.empty() ? 1 : 0;
    int bits = 0;
    for (const canopen::MapEntry& entry : pdo.entries) bits += entry.bits;
    EXPECT_LE(bits, 64);
    EXPECT_EQ(bits % 8, 0);
  }
  EXPECT_EQ(profile.pdos().size(), 8U);
  EXPECT_EQ(transmit, 4);
  EXPECT_EQ(disabled, 4);
}

TEST(GoldSample, IsInActuatorSpaceWithSignOffsetAndRatio) {
  ActuatorConfig config = gold_actuator();
  config.direction = -1.0;
  config.offset_rad = 0.5;
  const gold::GoldProfile profile(config, kGoldTiming);
  CanFrame frame;
  frame.id = 0x181;
  frame.length = 8;
  canopen::put_le(&frame.data[0], static_cast<std::uint32_t>(-131072 * 50),
                  4);  // half an output turn backwards
  canopen::put_le(&frame.data[4], 1000, 2);
  canopen::put_le(&frame.data[6], 0x0237, 2);
  DriveSample sample;
  ASSERT_TRUE(profile.decode_sample(frame, sample));
  EXPECT_NEAR(sample.measured_position_rad, std::acos(-1.0) + 0.5, 1e-12);
  EXPECT_NEAR(sample.measured_current_A, -7.0, 1e-12);
  EXPECT_EQ(sample.status_word, 0x0237);
}

TEST(GoldSample, FramesOfOthersAndShortOnesAreNotTaken) {
  const gold::GoldProfile profile(gold_actuator(), kGoldTiming);
  CanFrame frame;
  frame.id = 0x182;
  frame.length = 8;
  DriveSample sample;
  EXPECT_FALSE(profile.decode_sample(frame, sample));
  frame.id = 0x181;
  frame.length = 7;
  EXPECT_FALSE(profile.decode_sample(frame, sample));
  std::int8_t code = 0;
  EXPECT_FALSE(profile.decode_mode_display(frame, code));
  frame.id = 0x281;
  frame.length = 1;
  frame.data[0] = 0xFD;
  EXPECT_TRUE(profile.decode_mode_display(frame, code));
  EXPECT_EQ(code, -3);
}

TEST(GoldSetpoint, PositionSurvivesTheWireWithinOneCount) {
  for (const double direction : {1.0, -1.0}) {
    ActuatorConfig config = gold_actuator();
    config.direction = direction;
    const gold::GoldProfile profile(config, kGoldTiming);
    for (double position = -3.0; position < 3.0; position += 0.37) {
      const CanFrame sent = profile.encode_setpoint({0.0, position, DriveMode::kPosition});
      CanFrame back;
      back.id = 0x181;
      back.length = 8;
      canopen::put_le(&back.data[0], static_cast<std::uint32_t>(gold_position_of(sent)), 4);
      DriveSample sample;
      ASSERT_TRUE(profile.decode_sample(back, sample));
      EXPECT_NEAR(sample.measured_position_rad, position, 0.5 * 2 * std::acos(-1.0) / (131072 * 100) + 1e-12);
    }
  }
}

TEST(GoldSetpoint, TorqueIsRoundedHalfAwayFromZeroAndSaturates) {
  const gold::GoldProfile profile(gold_actuator(), kGoldTiming);
  const auto permille = [&](double torque_Nm) {
    return torque_of(profile.encode_setpoint({torque_Nm, 0, DriveMode::kTorque}));
  };
  EXPECT_EQ(permille(30.8), 1000);
  EXPECT_EQ(permille(-30.8), -1000);
  EXPECT_EQ(permille(0.0308 * 1.51), 2);
  EXPECT_EQ(permille(-0.0308 * 1.51), -2);
  EXPECT_EQ(permille(0.0308 * 1.49), 1);
  EXPECT_EQ(permille(1e9), 5571);
  EXPECT_EQ(permille(-1e9), -5571);
  EXPECT_EQ(permille(std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(GoldSetpoint, FrameHasSevenBytesWithTheModeLast) {
  const gold::GoldProfile profile(gold_actuator(), kGoldTiming);
  const CanFrame torque = profile.encode_setpoint({0, 0, DriveMode::kTorque});
  EXPECT_EQ(torque.id, 0x201U);
  EXPECT_EQ(torque.length, 7);
  EXPECT_EQ(torque.data[6], 10);
  EXPECT_EQ(profile.encode_setpoint({0, 0, DriveMode::kPosition}).data[6], 8);
  EXPECT_EQ(profile.shown_mode(8), DriveMode::kPosition);
  EXPECT_EQ(profile.shown_mode(10), DriveMode::kTorque);
  EXPECT_EQ(profile.shown_mode(1), DriveMode::kDisabled);
}

TEST(GoldSetpoint, FarPositionsSaturateInsteadOfWrapping) {
  const gold::GoldProfile profile(gold_actuator(), kGoldTiming);
  EXPECT_EQ(gold_position_of(profile.encode_setpoint({0, 1e12, DriveMode::kPosition})),
            std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(gold_position_of(profile.encode_setpoint({0, -1e12, DriveMode::kPosition})),
            std::numeric_limits<std::int32_t>::min());
}

}  // namespace
}  // namespace sprung
