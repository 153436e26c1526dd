#include "tools/lab/identify/record_in_process.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "robots/robot_loader.h"

namespace sprung::identify {
namespace {

const RecordOptions kShort{0.5, 0.05};

/// Every joint of both shipped robots has an actuator of its own.
double measured_rad(const DriveState& state, std::size_t joint) {
  return state.actuators[joint].measured_position_rad;
}

TEST(RecordInProcess, KneeOfTheHangingLegGoesThroughItsRangeAndComesBackWhileTheHipHolds) {
  const RobotConfig robot = load_robot("single_leg");
  const JointRecording recording = record_in_process(robot, {}, 1, kShort);
  const RecordRange range = record_range(robot, 1);
  double low_rad = 10.0, high_rad = -10.0;
  const double hip_rad = measured_rad(recording.states.front(), 0);
  for (const DriveState& state : recording.states) {
    const double knee_rad = measured_rad(state, 1);
    ASSERT_GT(knee_rad, robot.joints[1].position_min_rad);
    ASSERT_LT(knee_rad, robot.joints[1].position_max_rad);
    low_rad = std::min(low_rad, knee_rad);
    high_rad = std::max(high_rad, knee_rad);
    ASSERT_NEAR(measured_rad(state, 0), hip_rad, 0.05);
    ASSERT_EQ(state.safety, SafetyLevel::kOperational);
  }
  EXPECT_NEAR(low_rad, range.low_rad, 0.05);
  EXPECT_NEAR(high_rad, range.high_rad, 0.05);
  EXPECT_NEAR(measured_rad(recording.states.back(), 1), measured_rad(recording.states.front(), 1), 0.05);
}

TEST(RecordInProcess, EveryCycleIsThereAndEveryMoveHasItsOwn) {
  const RobotConfig robot = load_robot("single_leg");
  std::int64_t watched = 0;
  const JointRecording recording = record_in_process(robot, {}, 0, kShort,
                                                     [&](const CycleRecord&) { ++watched; });
  EXPECT_EQ(watched, static_cast<std::int64_t>(recording.states.size()));
  for (std::size_t k = 1; k < recording.states.size(); ++k)
    ASSERT_EQ(recording.states[k].stamp.seq, recording.states[k - 1].stamp.seq + 1);
  ASSERT_EQ(recording.began_at_seq.size(), recording.moves.size());
  for (std::size_t k = 1; k < recording.moves.size(); ++k)
    EXPECT_GT(recording.began_at_seq[k], recording.began_at_seq[k - 1]);
  EXPECT_GE(recording.began_at_seq.front(), recording.states.front().stamp.seq);
  EXPECT_LT(recording.began_at_seq.back(), recording.states.back().stamp.seq);
}

TEST(RecordInProcess, StaysInsideItsLimitsOnAPlantThatIsHeavierAndRougher) {
  const RobotConfig robot = load_robot("single_leg");
  SimOptions sim;
  sim.seed = 3;
  sim.plant = {{"armature_scale", 1.3}, {"friction_scale", 1.5}, {"mass_scale", 1.1}};
  for (const DriveState& state : record_in_process(robot, sim, 1, kShort).states) {
    ASSERT_GT(measured_rad(state, 1), robot.joints[1].position_min_rad);
    ASSERT_LT(measured_rad(state, 1), robot.joints[1].position_max_rad);
  }
}

TEST(RecordInProcess, WhatTheOperatorNarrowsHolds) {
  const RobotConfig robot = load_robot("single_leg");
  RecordOptions options = kShort;
  options.asked = {1.0, 1.8, 1.5};
  const JointRecording recording = record_in_process(robot, {}, 1, options);
  for (const RecordMove& move : recording.moves) {
    EXPECT_LE(move.speed_rad_s, 1.5);
    if (move.part == RecordPart::kReturn) continue;
    EXPECT_GE(move.target_rad, 1.0);
    EXPECT_LE(move.target_rad, 1.8);
  }
  options.asked = {1.8, 1.0, kNaN};
  EXPECT_THROW(record_in_process(robot, {}, 1, options), std::invalid_argument);
}

TEST(RecordInProcess, JointsOfTheHangingQuadrupedAreHomedFirst) {
  const RobotConfig robot = load_robot("pegasus");
  const JointRecording recording = record_in_process(robot, {}, 2, kShort);
  double low_rad = 10.0, high_rad = -10.0;
  for (const DriveState& state : recording.states) {
    for (std::size_t i = 0; i < 12; ++i) ASSERT_TRUE(state.actuators[i].referenced);
    low_rad = std::min(low_rad, measured_rad(state, 2));
    high_rad = std::max(high_rad, measured_rad(state, 2));
    ASSERT_NEAR(measured_rad(state, 1), measured_rad(recording.states.front(), 1), 0.1);
  }
  const RecordRange range = record_range(robot, 2);
  EXPECT_NEAR(low_rad, range.low_rad, 0.06);
  EXPECT_NEAR(high_rad, range.high_rad, 0.06);
}

TEST(RecordInProcess, SameSeedIsTheSameBits) {
  const RobotConfig robot = load_robot("single_leg");
  SimOptions sim;
  sim.seed = 5;
  const JointRecording a = record_in_process(robot, sim, 1, kShort);
  const JointRecording b = record_in_process(robot, sim, 1, kShort);
  ASSERT_EQ(a.states.size(), b.states.size());
  for (std::size_t k = 0; k < a.states.size(); ++k) {
    ASSERT_EQ(measured_rad(a.states[k], 1), measured_rad(b.states[k], 1));
    ASSERT_EQ(a.states[k].actuators[1].measured_current_A, b.states[k].actuators[1].measured_current_A);
  }
}

TEST(RecordInProcess, HangsSoThatStraightLegsEndAboveTheFloor) {
  EXPECT_NEAR(hanging_height_m(load_robot("single_leg")), 0.26 + 0.422 + 0.1, 1e-12);
}

/// Homing wants joints that are still, and a plant with little friction swings for longer than half a second.
TEST(RecordInProcess, ALegThatSwingsOutForLongIsHomedOnceItIsStill) {
  const RobotConfig robot = load_robot("pegasus");
  for (const double weight_kg : {0.0, 5.0}) {
    SimOptions sim;
    sim.plant = {{"family.stribeck", 1.0}, {"draw", 1.0}};
    RecordOptions options{0.3, 0.05};
    options.foot_weight_kg = weight_kg;
    options.loaded = true;
    EXPECT_FALSE(record_in_process(robot, sim, 1, options).states.empty()) << weight_kg;
  }
}

}  // namespace
}  // namespace sprung::identify
