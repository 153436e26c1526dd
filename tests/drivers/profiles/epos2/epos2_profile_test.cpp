#include "drivers/profiles/epos2/epos2_profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "drivers/canopen/objects.h"
#include "drivers/profiles/epos2/epos2_units.h"
#include "signals/angles.h"
#include "tests/support/refusal.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;

constexpr DriveTiming kEpos2ProfileTiming{0.002, 0.005, 0.020};

ActuatorConfig actuator() {
  ActuatorConfig a;
  a.name = "fl_knee";
  a.node = 3;
  a.profile = "epos2";
  a.gear_ratio = 50.0;
  a.torque_constant_Nm_A = 0.217;
  a.rated_current_A = 2.12;
  a.encoder_counts_per_turn = 16384;
  a.torque_limit_Nm = 108.0;
  a.speed_limit_rad_s = 4.36;
  a.speed_limit_object = 0x6410;
  a.position_stiffness_Nm_rad = 500.0;
  a.position_damping_Nm_s_rad = 30.0;
  a.position_gains_object = 0x60FB;
  a.pole_pairs = 12;
  a.winding_time_constant_s = 52.6;
  return a;
}

const DriveSetting* find(const std::vector<DriveSetting>& settings, canopen::ObjectId object) {
  for (const DriveSetting& setting : settings) {
    if (setting.object == object) return &setting;
  }
  return nullptr;
}

std::uint32_t value_of(const ActuatorConfig& config, canopen::ObjectId object, int size) {
  const auto settings = epos2::Epos2Profile(config, kEpos2ProfileTiming).settings();
  const DriveSetting* setting = find(settings, object);
  if (setting == nullptr) {
    ADD_FAILURE() << "no setting " << std::hex << object.index << ":" << int{object.sub};
    return 0;
  }
  EXPECT_EQ(setting->size, size) << std::hex << object.index;
  return setting->value;
}

std::string refusal(const ActuatorConfig& config) {
  return test::refusal_of([&] { const epos2::Epos2Profile profile(config, kEpos2ProfileTiming); });
}

CanFrame frame(std::uint32_t id, int length) {
  CanFrame made;
  made.id = id;
  made.length = static_cast<std::uint8_t>(length);
  return made;
}
std::int16_t current_of(const CanFrame& sent) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(canopen::get_le(&sent.data[0], 2)));
}
std::int32_t position_of(const CanFrame& sent) {
  return static_cast<std::int32_t>(canopen::get_le(&sent.data[2], 4));
}

TEST(Epos2Settings, HeartbeatsAreWhatTheRobotSays) {
  EXPECT_EQ(value_of(actuator(), {canopen::kHeartbeatProducer, 0}, 2), 5U);
  EXPECT_EQ(value_of(actuator(), {canopen::kHeartbeatConsumer, 1}, 4), (127U << 16) | 20U);
  EXPECT_EQ(value_of(actuator(), {canopen::kAbortConnectionOption, 0}, 2), 2U);
}

TEST(Epos2Settings, WhateverEndsOperationEndsTheCurrent) {
  for (const std::uint16_t option :
       {canopen::kShutdownOption, canopen::kDisableOption, canopen::kFaultReactionOption})
    EXPECT_EQ(value_of(actuator(), {option, 0}, 2), 0U);
  EXPECT_EQ(
      find(epos2::Epos2Profile(actuator(), kEpos2ProfileTiming).settings(), {canopen::kQuickStopOption, 0}),
      nullptr)
      << "an EPOS2 has no 0x605A";
}

TEST(Epos2Settings, MotorDataFollowFromTheRobotsFile) {
  EXPECT_EQ(value_of(actuator(), {0x2210, 1}, 4), 4096U);  // pulses = counts / 4
  EXPECT_EQ(value_of(actuator(), {0x6410, 1}, 2), 2120U);
  EXPECT_EQ(value_of(actuator(), {0x6410, 2}, 2), 9954U);  // 108 / (50 * 0.217) A
  EXPECT_EQ(value_of(actuator(), {0x6410, 3}, 1), 12U);
  EXPECT_EQ(value_of(actuator(), {0x6410, 4}, 4), 2082U);  // 4.36 rad/s * 50, rpm
  EXPECT_EQ(value_of(actuator(), {0x6410, 5}, 2), 526U);   // facts canopen 8.1
}

TEST(Epos2Settings, PositionLoopIsASpringAndADamperInJointUnits) {
  const double mA_per_qc = value_of(actuator(), {0x60FB, 1}, 2) * epos2::kProportionalUnit_mA_qc;
  const double mA_s_per_qc = value_of(actuator(), {0x60FB, 3}, 2) * epos2::kDerivativeUnit_mA_s_qc;
  const double qc_per_rad = 16384 * 50 / (2 * kPi), Nm_per_mA = 50 * 0.217e-3;
  EXPECT_NEAR(mA_per_qc * qc_per_rad * Nm_per_mA, 500.0, 1.0);
  EXPECT_NEAR(mA_s_per_qc * qc_per_rad * Nm_per_mA, 30.0, 0.02);
  for (const std::uint8_t sub : {std::uint8_t{2}, std::uint8_t{4}, std::uint8_t{5}})
    EXPECT_EQ(value_of(actuator(), {0x60FB, sub}, 2), 0U);
}

TEST(Epos2Settings, FollowingErrorLeavesRoomForASoftLoop) {
  const double rad = value_of(actuator(), {0x6065, 0}, 4) * 2 * kPi / (16384 * 50);
  EXPECT_NEAR(rad, 4 * 108.0 / 500.0, 1e-5);
}

TEST(Epos2Settings, WhatTheRobotLeavesOpenStaysTheDrivesOwn) {
  ActuatorConfig config = actuator();
  config.pole_pairs = 0;
  config.winding_time_constant_s = 0.0;
  config.speed_limit_object = config.position_gains_object = 0;
  const auto settings = epos2::Epos2Profile(config, kEpos2ProfileTiming).settings();
  for (const canopen::ObjectId object : std::vector<canopen::ObjectId>{
           {0x6410, 3}, {0x6410, 4}, {0x6410, 5}, {0x60FB, 1}, {0x60FB, 3}, {0x6065, 0}})
    EXPECT_EQ(find(settings, object), nullptr) << std::hex << object.index << ":" << int{object.sub};
}

TEST(Epos2Settings, BeyondTheDrivesLimitsIsRefusedWithWhatItCan) {
  ActuatorConfig config = actuator();
  config.torque_limit_Nm = 127.0;
  EXPECT_THAT(refusal(config),
              ::testing::AllOf(HasSubstr("'fl_knee'"), HasSubstr("11.7"), HasSubstr("108.5")));
  config = actuator();
  config.rated_current_A = 5.1;
  EXPECT_THAT(refusal(config), HasSubstr("5 A"));
  config = actuator();
  config.encoder_counts_per_turn = 16383;
  EXPECT_THAT(refusal(config), HasSubstr("0x2210:01"));
  config = actuator();
  config.speed_limit_object = 0x6080;
  EXPECT_THAT(refusal(config), HasSubstr("0x6410"));
  config = actuator();
  config.position_gains_object = 0x2F01;
  EXPECT_THAT(refusal(config), HasSubstr("0x60FB"));
  config = actuator();
  config.speed_limit_rad_s = 60.0;  // 28648 rpm
  EXPECT_THAT(refusal(config), HasSubstr("speed_limit"));
  config = actuator();
  config.position_stiffness_Nm_rad = 5e4;
  EXPECT_THAT(refusal(config), HasSubstr("position stiffness"));
  config = actuator();
  config.winding_time_constant_s = 541.0;
  EXPECT_THAT(refusal(config), HasSubstr("winding_time_constant"));
  config = actuator();
  config.emergency_input.bit = 16;
  EXPECT_THAT(refusal(config), HasSubstr("emergency_input.bit must be 0 to 15"));
}

TEST(Epos2Pdos, InputsTravelWithTheModeDisplayWhereOneOfThemStops) {
  ActuatorConfig config = actuator();
  config.emergency_input = {3, false};
  const epos2::Epos2Profile profile(config, kEpos2ProfileTiming);
  const auto pdos = profile.pdos();
  ASSERT_EQ(pdos[1].entries.size(), 2u);
  EXPECT_EQ(pdos[1].entries[1].object.index, 0x2071);
  CanFrame shown = frame(0x283, 3);
  shown.data[0] = 0xFD;
  shown.data[1] = 0x34;
  shown.data[2] = 0x12;
  std::int8_t mode = 0;
  std::uint32_t levels = 0;
  EXPECT_TRUE(profile.decode_mode_display(shown, mode));
  EXPECT_EQ(mode, -3);
  EXPECT_TRUE(profile.decode_inputs(shown, levels));
  EXPECT_EQ(levels, 0x1234u);
  EXPECT_FALSE(profile.decode_inputs(frame(0x283, 1), levels)) << "without them it is another's frame";
  EXPECT_FALSE(epos2::Epos2Profile(actuator(), kEpos2ProfileTiming).decode_inputs(shown, levels));
}

TEST(Epos2Pdos, SetpointsAndModeTravelInOneFrame) {
  const auto pdos = epos2::Epos2Profile(actuator(), kEpos2ProfileTiming).pdos();
  const auto entry = [](std::uint16_t index, std::uint8_t bits) {
    return canopen::MapEntry{{index, 0}, bits};
  };
  const std::vector<canopen::MapEntry> setpoint{entry(0x2030, 16), entry(0x2062, 32), entry(0x6060, 8)};
  const std::vector<canopen::MapEntry> sample{entry(0x6064, 32), entry(0x6078, 16), entry(0x6041, 16)};
  int disabled = 0;
  for (const PdoSetting& pdo : pdos) {
    const auto same = [&](const std::vector<canopen::MapEntry>& wanted) {
      ASSERT_EQ(pdo.entries.size(), wanted.size());
      for (std::size_t i = 0; i < wanted.size(); ++i)
        EXPECT_EQ(canopen::encode_map_entry(pdo.entries[i]), canopen::encode_map_entry(wanted[i]));
    };
    EXPECT_EQ(pdo.event_timer_ms, 0) << "an EPOS2 has no event timer: its absent object must not be written";
    disabled += pdo.entries.empty() ? 1 : 0;
    if (pdo.number == 0) {
      same(pdo.transmit ? sample : setpoint);
      EXPECT_EQ(pdo.transmission_type, pdo.transmit ? 1 : 255);
    } else if (pdo.number == 1) {
      same({pdo.transmit ? entry(0x6061, 8) : entry(0x6040, 16)});
      EXPECT_EQ(pdo.inhibit_100us, pdo.transmit ? 100 : 0);
    }
  }
  EXPECT_EQ(pdos.size(), 8U);
  EXPECT_EQ(disabled, 4);
}

TEST(Epos2Sample, IsInActuatorSpaceWithSignOffsetAndRatio) {
  ActuatorConfig config = actuator();
  config.direction = -1.0;
  config.offset_rad = 0.5;
  const epos2::Epos2Profile profile(config, kEpos2ProfileTiming);
  CanFrame received = frame(0x183, 8);
  canopen::put_le(&received.data[0], static_cast<std::uint32_t>(-16384 * 25),
                  4);  // half an output turn backwards
  canopen::put_le(&received.data[4], static_cast<std::uint32_t>(1500), 2);
  canopen::put_le(&received.data[6], 0x0737, 2);
  DriveSample sample;
  ASSERT_TRUE(profile.decode_sample(received, sample));
  EXPECT_NEAR(sample.measured_position_rad, kPi + 0.5, 1e-12);
  EXPECT_NEAR(sample.measured_current_A, -1.5, 1e-12);
  EXPECT_EQ(sample.status_word, 0x0737);
}

TEST(Epos2Sample, FramesOfOthersAndShortOnesAreNotTaken) {
  const epos2::Epos2Profile profile(actuator(), kEpos2ProfileTiming);
  DriveSample sample;
  EXPECT_FALSE(profile.decode_sample(frame(0x182, 8), sample));
  EXPECT_FALSE(profile.decode_sample(frame(0x183, 7), sample));
  std::int8_t code = 0;
  EXPECT_FALSE(profile.decode_mode_display(frame(0x183, 1), code));
  EXPECT_FALSE(profile.decode_mode_display(frame(0x283, 2), code));
  CanFrame display = frame(0x283, 1);
  display.data[0] = 0xFD;
  ASSERT_TRUE(profile.decode_mode_display(display, code));
  EXPECT_EQ(code, -3);
}

TEST(Epos2Sample, NoSupplyVoltageIsKnown) {
  const epos2::Epos2Profile profile(actuator(), kEpos2ProfileTiming);
  EXPECT_EQ(profile.supply_voltage_object().index, 0);
  EXPECT_TRUE(std::isnan(profile.supply_V(48000)));
}

TEST(Epos2Setpoint, CurrentIsTorqueByRatioAndConstantAndSaturatesAtTheLimit) {
  for (const double direction : {1.0, -1.0}) {
    ActuatorConfig config = actuator();
    config.direction = direction;
    const epos2::Epos2Profile profile(config, kEpos2ProfileTiming);
    const auto mA = [&](double torque_Nm) {
      return direction * current_of(profile.encode_setpoint({torque_Nm, 0, DriveMode::kTorque}));
    };
    EXPECT_EQ(mA(10.85), 1000);
    EXPECT_EQ(mA(-10.85), -1000);
    EXPECT_EQ(mA(0.01085 * 1.51), 2);
    EXPECT_EQ(mA(-0.01085 * 1.51), -2);
    EXPECT_EQ(mA(1e9), 9954);
    EXPECT_EQ(mA(-std::numeric_limits<double>::infinity()), -9954);
    EXPECT_EQ(mA(std::numeric_limits<double>::quiet_NaN()), 0);
  }
}

TEST(Epos2Setpoint, PositionSurvivesTheWireWithinHalfACount) {
  for (const double direction : {1.0, -1.0}) {
    ActuatorConfig config = actuator();
    config.direction = direction;
    config.offset_rad = -0.7;
    const epos2::Epos2Profile profile(config, kEpos2ProfileTiming);
    for (double position = -3.0; position < 3.0; position += 0.37) {
      const CanFrame sent = profile.encode_setpoint({0.0, position, DriveMode::kPosition});
      CanFrame back = frame(0x183, 8);
      canopen::put_le(&back.data[0], static_cast<std::uint32_t>(position_of(sent)), 4);
      DriveSample sample;
      ASSERT_TRUE(profile.decode_sample(back, sample));
      EXPECT_NEAR(sample.measured_position_rad, position, kPi / (16384 * 50) + 1e-12);
    }
  }
}

TEST(Epos2Setpoint, FarPositionsSaturateInsteadOfWrapping) {
  const epos2::Epos2Profile profile(actuator(), kEpos2ProfileTiming);
  const auto qc = [&](double rad) {
    return position_of(profile.encode_setpoint({0, rad, DriveMode::kPosition}));
  };
  EXPECT_EQ(qc(1e12), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(qc(-1e12), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(qc(std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(Epos2Setpoint, FrameHasSevenBytesWithTheModeLast) {
  const epos2::Epos2Profile profile(actuator(), kEpos2ProfileTiming);
  const CanFrame torque = profile.encode_setpoint({0, 0, DriveMode::kTorque});
  EXPECT_EQ(torque.id, 0x203U);
  EXPECT_EQ(torque.length, 7);
  EXPECT_EQ(static_cast<std::int8_t>(torque.data[6]), -3);
  EXPECT_EQ(static_cast<std::int8_t>(profile.encode_setpoint({0, 0, DriveMode::kPosition}).data[6]), -1);
  EXPECT_EQ(profile.shown_mode(-3), DriveMode::kTorque);
  EXPECT_EQ(profile.shown_mode(-1), DriveMode::kPosition);
  EXPECT_EQ(profile.shown_mode(10), DriveMode::kDisabled);
}

TEST(Epos2Setpoint, ControlWordHasItsOwnFrame) {
  const CanFrame word = epos2::Epos2Profile(actuator(), kEpos2ProfileTiming).encode_control_word(0x010F);
  EXPECT_EQ(word.id, 0x303U);
  EXPECT_EQ(word.length, 2);
  EXPECT_EQ(word.data[0], 0x0F);
  EXPECT_EQ(word.data[1], 0x01);
}

}  // namespace
}  // namespace sprung
