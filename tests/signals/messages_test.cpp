#include "signals/messages.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/sensors.h"
#include "signals/simulation.h"
#include "signals/vec3.h"
#include "tests/signals/message_bytes.h"

namespace sprung {
namespace {

using test::encoded;
using test::random_message;

constexpr unsigned kSeeds = 20;

/// Message to signal to message: a field that one way forgets, or writes elsewhere, changes the bytes.
template <class Signal>
void expect_round_trip(const MessageOf<Signal>& prototype, std::size_t counts) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const auto message = random_message(prototype, counts, seed);
    Signal signal;
    ASSERT_TRUE(from_message(message, signal));
    MessageOf<Signal> back{};
    to_message(signal, message.session, back);
    EXPECT_EQ(encoded(back), encoded(message)) << "seed " << seed;
  }
}

template <class M>
M with_joints_and_legs(int joints, int legs) {
  M message{};
  message.n_joints = joints;
  message.n_legs = legs;
  message.joints.resize(static_cast<std::size_t>(joints));
  message.legs.resize(static_cast<std::size_t>(legs));
  return message;
}

sprung_msgs::drive_state_t drive_state_of(int actuators) {
  sprung_msgs::drive_state_t message{};
  message.n = actuators;
  message.actuators.resize(static_cast<std::size_t>(actuators));
  return message;
}

std::uint64_t bits(double value) {
  std::uint64_t result = 0;
  std::memcpy(&result, &value, sizeof result);
  return result;
}

TEST(Messages, DriveStateSurvivesBitForBit) { expect_round_trip<DriveState>(drive_state_of(12), 1); }

TEST(Messages, DriveCommandSurvivesBitForBit) {
  sprung_msgs::drive_command_t prototype{};
  prototype.n = 3;
  prototype.actuators.resize(3);
  expect_round_trip<DriveCommand>(prototype, 1);
}

TEST(Messages, JointStateSurvivesBitForBit) {
  expect_round_trip<JointState>(with_joints_and_legs<sprung_msgs::joint_state_t>(12, 4), 2);
}

TEST(Messages, TrunkOfAJointStateIsKeptFieldByField) {
  JointState signal(1, 1);
  signal.body.estimated_quaternion_wxyz = {0.5, -0.5, 0.5, -0.5};
  signal.body.estimated_angular_velocity_rad_s = {1.0, 2.0, 3.0};
  signal.body.estimated_velocity_m_s = {4.0, 5.0, 6.0};
  signal.body.estimated_height_m = 0.5;
  signal.body.uses_imu = true;
  sprung_msgs::joint_state_t message{};
  to_message(signal, 1, message);
  JointState back;
  ASSERT_TRUE(from_message(message, back));
  EXPECT_EQ(back.body.estimated_quaternion_wxyz, signal.body.estimated_quaternion_wxyz);
  EXPECT_EQ(back.body.estimated_angular_velocity_rad_s, signal.body.estimated_angular_velocity_rad_s);
  EXPECT_EQ(back.body.estimated_velocity_m_s, signal.body.estimated_velocity_m_s);
  EXPECT_EQ(back.body.estimated_height_m, 0.5);
  EXPECT_TRUE(back.body.uses_imu);
}

TEST(Messages, LegCommandSurvivesBitForBit) {
  sprung_msgs::leg_command_t prototype{};
  prototype.n_legs = 4;
  prototype.legs.resize(4);
  expect_round_trip<LegCommand>(prototype, 1);
}

TEST(Messages, SimTruthSurvivesBitForBit) {
  expect_round_trip<SimTruth>(with_joints_and_legs<sprung_msgs::sim_truth_t>(2, 1), 2);
}

TEST(Messages, ImuSurvivesBitForBit) { expect_round_trip<Imu>(sprung_msgs::imu_t{}, 0); }

TEST(Messages, ImuOfAnUnknownStatusIsRefused) {
  sprung_msgs::imu_t message{};
  Imu signal;
  message.status = static_cast<std::int8_t>(ImuStatus::kFault);
  EXPECT_TRUE(from_message(message, signal));
  message.status = static_cast<std::int8_t>(ImuStatus::kFault) + 1;
  EXPECT_FALSE(from_message(message, signal));
}

TEST(Messages, NotANumberKeepsItsPayload) {
  double payload_nan = kNaN;
  std::uint64_t pattern = bits(kNaN) | 0x1234U;
  std::memcpy(&payload_nan, &pattern, sizeof pattern);
  DriveState signal(1);
  signal.actuators[0].measured_velocity_rad_s = payload_nan;
  sprung_msgs::drive_state_t message{};
  to_message(signal, 1, message);
  const auto bytes = encoded(message);
  sprung_msgs::drive_state_t received{};
  ASSERT_GT(received.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
  DriveState back;
  ASSERT_TRUE(from_message(received, back));
  EXPECT_EQ(bits(back.actuators[0].measured_velocity_rad_s), pattern);
  EXPECT_EQ(bits(back.actuators[0].measured_position_rad), bits(kNaN));
}

TEST(Messages, SessionAndStampAreCarried) {
  LegCommand command(1);
  command.stamp = {123456, 77};
  sprung_msgs::leg_command_t message{};
  to_message(command, -9, message);
  EXPECT_EQ(message.session, -9);
  EXPECT_EQ(message.utime, 123456);
  EXPECT_EQ(message.seq, 77);
}

TEST(Messages, UnknownEnumerationValuesAreRefused) {
  DriveState signal;
  for (const int bad : {-1, 4, 127}) {
    auto message = drive_state_of(2);
    message.actuators[1].shown_mode = static_cast<std::int8_t>(bad);
    EXPECT_FALSE(from_message(message, signal)) << bad;
  }
  auto message = drive_state_of(2);
  message.safety = 5;
  EXPECT_FALSE(from_message(message, signal));
}

/// Found by fuzzing: the age of such a LEG_COMMAND overflowed in the leg controller.
TEST(Messages, StampsWhoseDifferencesDoNotFitAreRefused) {
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  sprung_msgs::leg_command_t message{};
  LegCommand signal;
  for (const std::int64_t far : {kLeast, kLeast / 2, kMost / 2 + 1, kMost}) {
    message.utime = far;
    message.seq = 0;
    EXPECT_FALSE(from_message(message, signal)) << far;
    message.utime = 0;
    message.seq = far;
    EXPECT_FALSE(from_message(message, signal)) << far;
  }
  message.seq = -1;
  message.utime = std::int64_t{1} << 59U;
  EXPECT_TRUE(from_message(message, signal));
}

TEST(Messages, CountThatIsNotTheVectorsIsRefused) {
  DriveState signal;
  for (const int bad : {-1, 1, 3}) {
    auto message = drive_state_of(2);
    message.n = bad;
    EXPECT_FALSE(from_message(message, signal)) << bad;
  }
}

TEST(Messages, ConvertingIntoSizedStorageKeepsIt) {
  DriveState signal(2);
  sprung_msgs::drive_state_t message = drive_state_of(2);
  const auto* const signal_storage = signal.actuators.data();
  const auto* const message_storage = message.actuators.data();
  to_message(signal, 1, message);
  ASSERT_TRUE(from_message(message, signal));
  EXPECT_EQ(signal.actuators.data(), signal_storage);
  EXPECT_EQ(message.actuators.data(), message_storage);
}

}  // namespace
}  // namespace sprung
