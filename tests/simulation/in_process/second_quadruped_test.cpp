/// fennec, a quadruped that is nothing but files in robots/: other size, masses, motors, and encoders of 16
/// bits.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "robots/robot_loader.h"
#include "simulation/in_process/inprocess_robot.h"

namespace sprung {
namespace {

class SecondQuadruped : public testing::Test {
 protected:
  void start(std::map<std::string, double> plant = {}) {
    SimOptions options;
    options.plant = std::move(plant);
    robot_.emplace(config_, "best", options);
    robot_->boot();
    run(0.1);  // until the bridge has seen a good command
  }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds / config_.cycle_s)); ++i) robot_->tick();
  }
  /// @return the replies, in words.
  std::string order(OperatorKind kind, double seconds) {
    OperatorCommand command;
    command.kind = kind;
    command.request_id = ++request_;
    robot_->submit(command);
    run(seconds);
    std::string replies;
    for (OperatorReply reply; robot_->next_reply(reply);)
      replies += std::string(name(reply.outcome)) + " " + reply.reason + "; ";
    return replies;
  }
  /// In this gait for so long, then stopped. @return how far it went forward, m.
  double walk(const std::string& gait, double speed_m_s, double seconds, double until_it_stands_s) {
    OperatorCommand command;
    command.kind = OperatorKind::kWalk;
    while (config_.gaits.at(++command.gait).name != gait) {
    }
    command.walk_speed[0] = speed_m_s;
    command.request_id = ++request_;
    robot_->submit(command);
    const double from_m = robot_->truth().base_in_world_m[0];
    run(seconds);
    EXPECT_EQ(robot_->motion_state().state, MotionPhase::kWalking) << gait;
    const double way_m = robot_->truth().base_in_world_m[0] - from_m;
    const std::string replies = order(OperatorKind::kStop, until_it_stands_s);
    EXPECT_EQ(robot_->motion_state().state, MotionPhase::kStanding) << gait << ": " << replies;
    return way_m;
  }
  RobotConfig config_ = load_robot("fennec");
  std::optional<InProcessRobot> robot_;
  std::int64_t request_ = 0;
};

TEST_F(SecondQuadruped, DiffersFromPegasusInWhatItShallShow) {
  const RobotConfig pegasus = load_robot("pegasus");
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(config_.actuators[i].link_encoder.counts_per_turn, 65536);
    EXPECT_NE(config_.actuators[i].encoder_counts_per_turn, pegasus.actuators[i].encoder_counts_per_turn);
    EXPECT_NE(config_.actuators[i].torque_constant_Nm_A, pegasus.actuators[i].torque_constant_Nm_A);
  }
  for (std::size_t leg = 0; leg < 4; ++leg) {
    for (std::size_t link = 0; link < 3; ++link) {
      EXPECT_NE(config_.legs[leg].links[link].length_m, pegasus.legs[leg].links[link].length_m);
      EXPECT_NE(config_.legs[leg].links[link].mass_kg, pegasus.legs[leg].links[link].mass_kg);
    }
    EXPECT_NE(config_.legs[leg].links[1].length_m, config_.legs[leg].links[2].length_m);
  }
}

TEST_F(SecondQuadruped, ComesUpAndFindsItsZerosToAnEncodersCount) {
  start();
  EXPECT_EQ(robot_->bridge().safety().level, SafetyLevel::kOperational)
      << robot_->bridge().safety().detail.data();
  const std::string replies = order(OperatorKind::kHome, 1.0);
  for (std::size_t i = 0; i < 12; ++i) {
    const ActuatorState& actuator = robot_->drive_state().actuators[i];
    EXPECT_TRUE(actuator.referenced) << replies;
    EXPECT_EQ(actuator.fault_code, 0);
    // Count of 16 bits, noise, and kinematic error of the gear.
    EXPECT_NEAR(actuator.measured_position_rad, robot_->truth().joints[i].true_position_rad, 1e-3)
        << config_.joints[i].name;
  }
}

TEST_F(SecondQuadruped, FeetAreWhereTheEstimatorSaysTheyAre) {
  start();
  order(OperatorKind::kHome, 1.0);
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const Vec3& estimated = robot_->joint_state().legs[leg].estimated_foot_in_hip_m;
    const Vec3& foot = robot_->truth().legs[leg].true_foot_in_world_m;
    const Vec3& base = robot_->truth().base_in_world_m;
    const std::array<double, 3>& hip = config_.legs[leg].hip_in_trunk_m;
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(estimated[axis], foot[axis] - base[axis] - hip[axis], 1e-3) << leg << ' ' << axis;
  }
}

TEST_F(SecondQuadruped, StandsUpFromTheFloor) {
  start({{"lying", 1.0}});
  order(OperatorKind::kHome, 1.0);
  const std::string replies = order(OperatorKind::kStand, 5.0);
  EXPECT_EQ(robot_->motion_state().state, MotionPhase::kStanding)
      << replies << robot_->motion_state().last_transition;
  EXPECT_NEAR(robot_->truth().base_in_world_m[2], config_.preset("best").stand_length_m, 0.03);
  EXPECT_GT(robot_->truth().base_quaternion_wxyz[0], 0.999);
  double weight_N = 0.0;
  for (const TrueLeg& leg : robot_->truth().legs) weight_N += leg.true_contact_force_N[2];
  EXPECT_NEAR(weight_N, 16.0 * 9.81, 10.0);
}

TEST_F(SecondQuadruped, TrotsCrawlsAndStopsWithoutAFallOrATrip) {
  start({{"lying", 1.0}});
  order(OperatorKind::kHome, 1.0);
  order(OperatorKind::kStand, 3.0);
  EXPECT_NEAR(walk("trot", 0.3, 5.0, 4.5), 5.0 * 0.3 - 0.22, 0.25);  // ramp of 1.5 s
  EXPECT_NEAR(walk("crawl", 0.06, 7.2, 8.0), 7.2 * 0.06, 0.1);
  EXPECT_EQ(robot_->bridge().safety().level, SafetyLevel::kOperational);
  EXPECT_EQ(robot_->bridge().safety().commands_refused, 0);
  for (const MotionLeg& leg : robot_->motion_state().legs) {
    EXPECT_EQ(leg.event_counts[static_cast<std::size_t>(LegEvent::kNoGround)], 0);
    EXPECT_LE(leg.event_counts[static_cast<std::size_t>(LegEvent::kStumble)], 2);
  }
  EXPECT_NEAR(robot_->truth().base_in_world_m[2], config_.preset("best").stand_length_m, 0.03);
}

/// Drives whose own position loops smooth their set-points over less than a cycle: what they measure of the
/// current is not its mean, so that legs felt forces that were none, and looked for ground that was there.
TEST_F(SecondQuadruped, TrotsOnADrawnPlantWhoseDrivesSmoothTheirSetPoints) {
  start({{"draw", 1021}, {"lying", 1.0}});
  order(OperatorKind::kHome, 1.0);
  order(OperatorKind::kStand, 3.0);
  EXPECT_NEAR(walk("trot", 0.25, 6.0, 3.0), 0.25 * 6.0, 0.4);
}

}  // namespace
}  // namespace sprung
