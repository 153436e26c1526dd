#include "tools/station/frames/frames.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"
#include "signals/modes.h"
#include "sprung_msgs/auxiliary_state_t.hpp"
#include "sprung_msgs/body_state_t.hpp"
#include "sprung_msgs/joint_state_t.hpp"
#include "sprung_msgs/leg_command_t.hpp"
#include "sprung_msgs/sim_truth_t.hpp"
#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::station {
namespace {

using log::Kept;

class FramesTest : public testing::Test {
 protected:
  const Frame* add(const Kept& event, double time_s = 0.0) {
    return frames_.add(event.channel, reinterpret_cast<const std::uint8_t*>(event.data.data()),
                       event.data.size(), time_s);
  }
  float value(const Frame& frame, const std::string& name) const {
    const int field = find_field(frames_.fields(), name);
    EXPECT_GE(field, 0) << name;
    return field < 0 ? NAN : frame.values[static_cast<std::size_t>(field)];
  }
  static Kept truth(std::int64_t cycle, double z_m) {
    auto message = log::stamped<sprung_msgs::sim_truth_t>(cycle);
    message.n_joints = 2;
    message.joints.resize(2);
    message.n_legs = 1;
    message.legs.resize(1);
    message.base_in_world_m[2] = z_m;
    message.base_quaternion_wxyz[0] = 1.0;
    return log::kept(channels::kSimTruth, cycle, log::encoded(message));
  }
  /// Straight down at 0.45 m, the leg bent as robot.yaml's joints are.
  static Kept leg_command(std::int64_t cycle, ControlMode mode) {
    auto message = log::stamped<sprung_msgs::leg_command_t>(cycle);
    message.n_legs = 1;
    message.legs.resize(1);
    message.legs[0].desired_foot_in_hip_m[2] = -0.45;
    message.legs[0].control_mode = static_cast<std::int8_t>(mode);
    message.legs[0].desired_joint_position_rad[0] = 1.25;
    message.legs[0].desired_joint_position_rad[1] = 0.5;
    return log::kept(channels::kLegCommand, cycle, log::encoded(message));
  }

  RobotConfig robot_ = load_robot("single_leg");
  Frames frames_{robot_};
};

TEST_F(FramesTest, ACycleIsOneFrameHandedOutWhenTheNextBegins) {
  EXPECT_EQ(add(log::joint_event(4), 1.0), nullptr);
  EXPECT_EQ(add(log::motion_event(4, "standing"), 1.1), nullptr);
  const Frame* const frame = add(log::joint_event(5), 2.0);
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->seq, 4);
  EXPECT_EQ(frame->session, 77);
  EXPECT_EQ(frame->time_s, 1.0);
  EXPECT_FLOAT_EQ(value(*frame, "joints.hip.gear_output_torque_Nm"), 0.04F);
  EXPECT_FLOAT_EQ(value(*frame, "joints.knee.gear_output_torque_Nm"), 1.04F);
  const Frame* const last = frames_.finish();
  ASSERT_NE(last, nullptr);
  EXPECT_EQ(last->seq, 5);
  EXPECT_EQ(frames_.finish(), nullptr);
}

TEST_F(FramesTest, WhatNobodySaidIsNan) {
  add(log::joint_event(0));
  const Frame* const frame = frames_.finish();
  ASSERT_NE(frame, nullptr);
  EXPECT_TRUE(std::isnan(value(*frame, "safety.level")));
  EXPECT_TRUE(std::isnan(value(*frame, "truth.base_in_world_m.z")));
  EXPECT_TRUE(std::isnan(value(*frame, "joints.hip.desired_position_rad")));
}

TEST_F(FramesTest, ARepeatedMessageChangesNothing) {
  add(log::joint_event(8));
  add(log::joint_event(9));
  EXPECT_EQ(add(log::joint_event(8)), nullptr);
  const Frame* const frame = frames_.finish();
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->seq, 9);
  EXPECT_FLOAT_EQ(value(*frame, "joints.hip.gear_output_torque_Nm"), 0.09F);
}

TEST_F(FramesTest, SafetyStateStaysAndBeginsNoCycle) {
  add(log::joint_event(3));
  EXPECT_EQ(add(log::safety_event(9, "operational", "none", "")), nullptr);
  const Frame* frame = add(log::joint_event(4));
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->seq, 3);
  EXPECT_EQ(value(*frame, "safety.level"), 0.0F);
  frame = add(log::joint_event(5));
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(value(*frame, "safety.level"), 0.0F);
}

TEST_F(FramesTest, AFrameHasAPoseWhereAJointHasAPosition) {
  add(truth(1, 0.6));
  const Frame* frame = add(log::joint_event(2));
  ASSERT_NE(frame, nullptr);
  EXPECT_FALSE(frames_.has_pose(*frame)) << "nobody has said where its joints are";
  frame = frames_.finish();
  ASSERT_NE(frame, nullptr);
  EXPECT_TRUE(frames_.has_pose(*frame));
}

TEST_F(FramesTest, TemperaturesAndBatteryComeOnceASecondAndStay) {
  robot_.actuators[1].temperature.reading.index = 0x22A2;
  robot_.battery.bus = 0;
  Frames frames(robot_);
  const auto say = [&](const Kept& event) {
    return frames.add(event.channel, reinterpret_cast<const std::uint8_t*>(event.data.data()),
                      event.data.size(), 0.0);
  };
  auto message = log::stamped<sprung_msgs::auxiliary_state_t>(9);
  message.n_actuators = 2;
  message.measured_temperature_degC = {NAN, 41.5};
  message.battery_voltage_V = 47.5;
  say(log::joint_event(3));
  EXPECT_EQ(say(log::kept(channels::kAuxiliaryState, 9, log::encoded(message))), nullptr)
      << "it begins no cycle";
  say(log::joint_event(4));
  const Frame* const frame = frames.finish();
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->seq, 4);
  const auto said = [&](const char* name) {
    return frame->values.at(static_cast<std::size_t>(find_field(frames.fields(), name)));
  };
  EXPECT_EQ(said("actuators.knee_motor.measured_temperature_degC"), 41.5F);
  EXPECT_EQ(said("auxiliary.battery_voltage_V"), 47.5F);
}

TEST_F(FramesTest, AnotherSessionBeginsAnewAndItsCyclesMayBeLower) {
  add(log::safety_event(9, "operational", "none", ""));
  add(log::joint_event(9));
  const Frame* frame = add(log::joint_event(0, 78));
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->session, 77);
  frame = frames_.finish();
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->session, 78);
  EXPECT_EQ(frame->seq, 0);
  EXPECT_TRUE(std::isnan(value(*frame, "safety.level")));
}

TEST_F(FramesTest, WhatWasSentBeforeCycleZeroIsNoFrame) {
  add(log::joint_event(-1));
  EXPECT_EQ(frames_.finish(), nullptr);
}

TEST_F(FramesTest, BytesOfNoKnownTypeAreCountedByChannelAndDoNoHarm) {
  add(log::joint_event(0));
  EXPECT_EQ(add({0, 0, channels::kJointState, "no message"}), nullptr);
  EXPECT_EQ(add({0, 0, "SOMEBODY_ELSES", "no message"}), nullptr);
  for (const Frames::Source& source : frames_.sources()) {
    const bool joints = source.channel == channels::kJointState;
    EXPECT_EQ(source.decoded, joints ? 1 : 0) << source.channel;
    EXPECT_EQ(source.not_decoded, joints ? 1 : 0) << source.channel;
  }
  EXPECT_NE(frames_.finish(), nullptr);
}

TEST_F(FramesTest, TheTrunkIsWhereTheSimulationSays) {
  add(truth(2, 0.61));
  add(log::joint_event(2));
  const Frame* const frame = frames_.finish();
  ASSERT_NE(frame, nullptr);
  EXPECT_FLOAT_EQ(value(*frame, "trunk.z_m"), 0.61F);
  EXPECT_EQ(value(*frame, "trunk.qw"), 1.0F);
  EXPECT_EQ(value(*frame, "trunk.source"), static_cast<float>(TrunkSource::kSimulation));
}

TEST_F(FramesTest, WithoutASimulationTheTrunkIsWhereOdometrySays) {
  auto odometry = log::stamped<sprung_msgs::body_state_t>(0);
  odometry.estimated_position_in_world_m[0] = 2.0;
  odometry.estimated_quaternion_wxyz[0] = 1.0;
  const auto say = [&] { return add(log::kept(channels::kBodyState, 0, log::encoded(odometry))); };
  EXPECT_EQ(say(), nullptr) << "it begins no cycle";
  auto joints = log::stamped<sprung_msgs::joint_state_t>(1);
  joints.body.estimated_quaternion_wxyz[0] = 1.0;
  add(log::kept(channels::kJointState, 1, log::encoded(joints)));
  ASSERT_NE(frames_.finish(), nullptr);
  odometry.estimated_position_in_world_m[0] = 2.5;
  say();
  joints.seq = 2;
  add(log::kept(channels::kJointState, 2, log::encoded(joints)));
  const Frame* const frame = frames_.finish();
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(value(*frame, "trunk.source"), static_cast<float>(TrunkSource::kOdometry));
  EXPECT_FLOAT_EQ(value(*frame, "trunk.x_m"), 0.5F);
  EXPECT_FLOAT_EQ(value(*frame, "odometry.estimated_position_in_world_m.x"), 2.5F);
}

TEST_F(FramesTest, TheGhostReachesTheDesiredFoot) {
  add(log::joint_event(2));
  add(leg_command(2, ControlMode::kCompliance));
  const Frame* const frame = frames_.finish();
  ASSERT_NE(frame, nullptr);
  const auto kinematics = make_leg_kinematics(robot_.legs[0]);
  const JointVector ghost = JointVector(Eigen::Vector2d{value(*frame, "joints.hip.desired_position_rad"),
                                                        value(*frame, "joints.knee.desired_position_rad")});
  EXPECT_NEAR(kinematics->foot_in_hip_m(ghost).z(), -0.45, 1e-6);
  EXPECT_NEAR(kinematics->foot_in_hip_m(ghost).x(), 0.0, 1e-6);
}

TEST_F(FramesTest, TheGhostFollowsSingleJointsAndIsGoneWhereNothingIsDesired) {
  add(log::joint_event(2));
  add(leg_command(2, ControlMode::kJoint));
  const Frame* frame = add(log::joint_event(3));
  ASSERT_NE(frame, nullptr);
  EXPECT_FLOAT_EQ(value(*frame, "joints.hip.desired_position_rad"), 1.25F);
  EXPECT_FLOAT_EQ(value(*frame, "joints.knee.desired_position_rad"), 0.5F);
  add(leg_command(3, ControlMode::kDamping));
  frame = frames_.finish();
  ASSERT_NE(frame, nullptr);
  EXPECT_TRUE(std::isnan(value(*frame, "joints.hip.desired_position_rad")));
}

}  // namespace
}  // namespace sprung::station
