#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "signals/auxiliary_state.h"
#include "signals/body_state.h"
#include "signals/messages.h"
#include "signals/motion_state.h"
#include "signals/operator.h"
#include "signals/safety_state.h"
#include "signals/sensors.h"
#include "signals/simulation.h"
#include "signals/vec3.h"
#include "tests/signals/message_bytes.h"

namespace sprung {
namespace {

using test::encoded;
using test::random_message;

template <class Signal>
void expect_round_trip() {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto message = random_message(MessageOf<Signal>{}, 0, seed);
    Signal signal;
    ASSERT_TRUE(from_message(message, signal));
    MessageOf<Signal> back{};
    to_message(signal, message.session, back);
    EXPECT_EQ(encoded(back), encoded(message)) << "seed " << seed;
  }
}

TEST(EventMessages, OperatorCommandSurvivesBitForBit) { expect_round_trip<OperatorCommand>(); }

TEST(EventMessages, SimControlSurvivesBitForBit) { expect_round_trip<SimControl>(); }

/// Found by fuzzing the simulated devices: counts, steps and emergency codes are made of these numbers.
TEST(EventMessages, SimControlOfNumbersThatNoExperimentHasIsRefused) {
  sprung_msgs::sim_control_t good{};
  good.value = good.wrench[5] = 65535.0;
  good.duration_s = 1e6;
  SimControl signal;
  EXPECT_TRUE(from_message(good, signal));
  for (const double bad : {kNaN, std::numeric_limits<double>::infinity(), 65536.0, -1e300}) {
    sprung_msgs::sim_control_t value = good, duration = good, wrench = good;
    value.value = wrench.wrench[2] = bad;
    duration.duration_s = 200.0 * bad;
    EXPECT_FALSE(from_message(value, signal)) << bad;
    EXPECT_FALSE(from_message(duration, signal)) << bad;
    EXPECT_FALSE(from_message(wrench, signal)) << bad;
  }
}

TEST(EventMessages, TorqueSensorSurvivesBitForBit) { expect_round_trip<TorqueSensor>(); }

TEST(EventMessages, BodyStateKeepsPlaceAttitudeCovariancesAndSlips) {
  BodyState signal;
  signal.stamp = {10, 20};
  signal.estimated_position_in_world_m = {1.0, 2.0, 3.0};
  signal.estimated_quaternion_wxyz = {0.5, 0.5, 0.5, 0.5};
  signal.estimated_rate_bias_rad_s = {0.1, 0.2, 0.3};
  signal.estimated_force_bias_m_s2 = {0.4, 0.5, 0.6};
  signal.estimated_imu_tilt_rad = {0.7, 0.8};
  signal.estimated_sinking_m_N = 0.9;
  signal.imu_tilt_covariance_rad2 = {30.0, 31.0, 32.0, 33.0};
  for (std::size_t i = 0; i < 9; ++i) {
    signal.position_covariance_m2[i] = 1.0 + static_cast<double>(i);
    signal.attitude_covariance_rad2[i] = 10.0 + static_cast<double>(i);
    signal.velocity_covariance_m2_s2[i] = 20.0 + static_cast<double>(i);
  }
  signal.slips = 7;
  signal.uses_imu = true;
  sprung_msgs::body_state_t message{};
  to_message(signal, 5, message);
  EXPECT_EQ(message.session, 5);
  EXPECT_TRUE(std::isnan(message.estimated_velocity_m_s[0]));
  BodyState back;
  ASSERT_TRUE(from_message(message, back));
  EXPECT_EQ(back.stamp.seq, 20);
  EXPECT_EQ(back.estimated_position_in_world_m, signal.estimated_position_in_world_m);
  EXPECT_EQ(back.estimated_quaternion_wxyz, signal.estimated_quaternion_wxyz);
  EXPECT_EQ(back.estimated_rate_bias_rad_s, signal.estimated_rate_bias_rad_s);
  EXPECT_EQ(back.estimated_force_bias_m_s2, signal.estimated_force_bias_m_s2);
  EXPECT_EQ(back.estimated_imu_tilt_rad, signal.estimated_imu_tilt_rad);
  EXPECT_EQ(back.estimated_sinking_m_N, signal.estimated_sinking_m_N);
  EXPECT_EQ(back.imu_tilt_covariance_rad2, signal.imu_tilt_covariance_rad2);
  EXPECT_EQ(back.position_covariance_m2, signal.position_covariance_m2);
  EXPECT_EQ(back.attitude_covariance_rad2, signal.attitude_covariance_rad2);
  EXPECT_EQ(back.velocity_covariance_m2_s2, signal.velocity_covariance_m2_s2);
  EXPECT_EQ(back.slips, 7);
  EXPECT_TRUE(back.uses_imu);
}

TEST(EventMessages, AuxiliaryStateKeepsEachActuatorsTemperatureAndTheBattery) {
  AuxiliaryState signal(2);
  signal.stamp = {10, 20};
  signal.measured_temperature_degC[1] = 41.5;
  signal.battery_charge_share = 0.5;
  sprung_msgs::auxiliary_state_t message{};
  to_message(signal, 5, message);
  EXPECT_EQ(message.n_actuators, 2);
  EXPECT_TRUE(std::isnan(message.measured_temperature_degC[0]));
  AuxiliaryState back(0);
  ASSERT_TRUE(from_message(message, back));
  EXPECT_EQ(back.measured_temperature_degC[1], 41.5);
  EXPECT_EQ(back.battery_charge_share, 0.5);
  EXPECT_EQ(back.stamp.seq, 20);
  message.n_actuators = 3;
  EXPECT_FALSE(from_message(message, back)) << "a count that differs from what comes with it";
}

TEST(EventMessages, MotionStateKeepsItsNumbersAndTexts) {
  MotionState signal(2);
  signal.stamp = {10, 20};
  signal.legs[1] = {LegPhase::kPreStance, 0.25, LegEvent::kSlip, {0, 1, 2, 3, 4, 5}, -0.5, 0.01};
  signal.state = MotionPhase::kThrust;
  signal.jumps_done = 3;
  signal.jumps_left = 4;
  signal.jump_height_scale = 0.75;
  signal.jump_mode = JumpMode::kTorque;
  signal.gait = 3;
  signal.gait_phase = 0.625;
  signal.desired_speed = {0.3, -0.1, 0.2};
  signal.estimated_ground_slope = {0.1, -0.05};
  signal.estimated_ground_slope_bound = {0.02, 0.04};
  signal.payload = {4.5, 1.5, {0.2, -0.1}};
  signal.last_transition = "crouch ended";
  sprung_msgs::motion_state_t message{};
  to_message(signal, 5, message);
  EXPECT_EQ(message.state_name, name(MotionPhase::kThrust));
  MotionState back;
  ASSERT_TRUE(from_message(message, back));
  EXPECT_STREQ(back.last_transition, "crouch ended");
  sprung_msgs::motion_state_t again{};
  to_message(back, 5, again);
  EXPECT_EQ(encoded(again), encoded(message));
  EXPECT_EQ(back.legs[1].phase_time_s, 0.25);
  EXPECT_EQ(back.legs[1].phase, LegPhase::kPreStance);
  EXPECT_EQ(back.legs[1].last_event, LegEvent::kSlip);
  EXPECT_EQ(back.legs[1].event_counts, (std::array<std::int32_t, kLegEventCount>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(back.legs[0].last_event, LegEvent::kNone);
  EXPECT_EQ(back.gait, 3);
  EXPECT_EQ(back.gait_phase, 0.625);
  EXPECT_EQ(back.desired_speed, (Vec3{0.3, -0.1, 0.2}));
  EXPECT_EQ(back.legs[1].estimated_ground_z_m, -0.5);
  EXPECT_EQ(back.legs[1].estimated_ground_z_bound_m, 0.01);
  EXPECT_EQ(back.estimated_ground_slope, (std::array<double, 2>{0.1, -0.05}));
  EXPECT_EQ(back.estimated_ground_slope_bound, (std::array<double, 2>{0.02, 0.04}));
  EXPECT_EQ(back.payload.mass_kg, 4.5);
  EXPECT_EQ(back.payload.mass_bound_kg, 1.5);
  EXPECT_EQ(back.payload.in_trunk_m, (std::array<double, 2>{0.2, -0.1}));
  EXPECT_EQ(back.jumps_left, 4);
}

TEST(EventMessages, SafetyStateKeepsItsNumbersAndTexts) {
  SafetyState signal;
  signal.stamp = {10, 20};
  signal.level = SafetyLevel::kQuickStop;
  signal.cause = SafetyCause::kBusLost;
  signal.latched = true;
  signal.actuator = 1;
  signal.since_seq = 19;
  signal.commands_refused = 2;
  signal.overruns = 3;
  signal.missed_cycles = 4;
  std::snprintf(signal.detail.data(), signal.detail.size(), "bus leg is off");
  sprung_msgs::safety_state_t message{};
  to_message(signal, 5, message);
  EXPECT_EQ(message.level_name, name(SafetyLevel::kQuickStop));
  EXPECT_EQ(message.cause_name, name(SafetyCause::kBusLost));
  SafetyState back;
  ASSERT_TRUE(from_message(message, back));
  sprung_msgs::safety_state_t again{};
  to_message(back, 5, again);
  EXPECT_EQ(encoded(again), encoded(message));
  EXPECT_EQ(back.missed_cycles, 4);
  EXPECT_STREQ(back.detail.data(), "bus leg is off");
}

TEST(EventMessages, DetailWithoutATerminatorIsCutAtItsEnd) {
  SafetyState signal;
  signal.detail.fill('x');
  sprung_msgs::safety_state_t message{};
  to_message(signal, 5, message);
  EXPECT_EQ(message.detail, std::string(signal.detail.size(), 'x'));
  SafetyState back;
  ASSERT_TRUE(from_message(message, back));
  EXPECT_EQ(std::string(back.detail.data()), std::string(signal.detail.size() - 1, 'x'));
}

TEST(EventMessages, OperatorReplyKeepsItsNumbersAndTexts) {
  OperatorReply signal;
  signal.stamp = {10, 20};
  signal.request_id = 42;
  signal.took_effect_at_seq = 21;
  signal.outcome = OperatorOutcome::kQueued;
  signal.answered_by = "planner";
  signal.reason = "no contact";
  sprung_msgs::operator_reply_t message{};
  to_message(signal, 5, message);
  OperatorReply back;
  ASSERT_TRUE(from_message(message, back));
  EXPECT_EQ(back.stamp.seq, 20);
  EXPECT_EQ(back.request_id, 42);
  EXPECT_EQ(back.took_effect_at_seq, 21);
  EXPECT_EQ(back.outcome, OperatorOutcome::kQueued);
  EXPECT_STREQ(back.answered_by, "planner");
  EXPECT_STREQ(back.reason, "no contact");
}

TEST(EventMessages, WalkKeepsWhatItAsksFor) {
  OperatorCommand signal;
  signal.kind = OperatorKind::kWalk;
  signal.gait = 2;
  signal.walk_speed = {0.3, -0.1, 0.2};
  signal.stance_width_m = 0.05;
  signal.gait_control = GaitControl::kPreStance;
  signal.hold_s = 1.5;
  sprung_msgs::operator_command_t message{};
  to_message(signal, 5, message);
  OperatorCommand back;
  ASSERT_TRUE(from_message(message, back));
  EXPECT_EQ(back.kind, OperatorKind::kWalk);
  EXPECT_EQ(back.gait, 2);
  EXPECT_EQ(back.walk_speed, (Vec3{0.3, -0.1, 0.2}));
  EXPECT_TRUE(std::isnan(back.body_height_m)) << "left open: the preset's";
  EXPECT_EQ(back.stance_width_m, 0.05);
  EXPECT_EQ(back.gait_control, GaitControl::kPreStance);
  EXPECT_EQ(back.hold_s, 1.5);
}

TEST(EventMessages, UnknownLegEventsPhasesAndGaitControlsAreRefused) {
  sprung_msgs::motion_state_t state{};
  to_message(MotionState(1), 5, state);
  MotionState signal;
  ASSERT_TRUE(from_message(state, signal));
  for (const int bad : {-1, 6, 127}) {
    sprung_msgs::motion_state_t wrong = state;
    wrong.legs[0].last_event = static_cast<std::int8_t>(bad);
    EXPECT_FALSE(from_message(wrong, signal)) << bad;
  }
  state.legs[0].phase = static_cast<std::int8_t>(LegPhase::kStance) + 1;
  EXPECT_FALSE(from_message(state, signal));
  sprung_msgs::operator_command_t command{};
  OperatorCommand out;
  command.gait_control = static_cast<std::int8_t>(GaitControl::kAdaptive);
  EXPECT_TRUE(from_message(command, out));
  ++command.gait_control;
  EXPECT_FALSE(from_message(command, out));
}

TEST(EventMessages, UnknownOperatorKindIsRefused) {
  sprung_msgs::operator_command_t message{};
  message.kind = 100;
  OperatorCommand signal;
  const Reading reading = from_message(message, signal);
  EXPECT_FALSE(reading);
  EXPECT_EQ(reading.found, 100);
  EXPECT_EQ(reading.largest, static_cast<int>(OperatorKind::kReadParameter));
}

TEST(EventMessages, TheFirstNumberThatIsUnknownIsTold) {
  sprung_msgs::operator_command_t message{};
  message.jump_mode = 77;
  message.gait_control = 88;
  message.utime = std::int64_t{1} << 60;
  OperatorCommand signal;
  EXPECT_EQ(from_message(message, signal).found, 77);
  message.jump_mode = message.gait_control = 0;
  EXPECT_EQ(from_message(message, signal).found, message.utime);
}

}  // namespace
}  // namespace sprung
