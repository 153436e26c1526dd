#include "tools/lab/jump/jump_metrics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

/// Plays a made-up jump of known height through the metrics.
class JumpMetricsTest : public testing::Test {
 protected:
  /// @param foot_m of the foot above the floor; below: the floor is dented.
  void cycle(MotionPhase phase, double hip_height_m, double foot_m, double knee_torque_Nm = 0.0,
             double knee_output_Nm = 0.0, double desired_length_m = 0.3) {
    motion_.state = phase;
    truth_.stamp.utime_us += 1000;
    truth_.base_in_world_m[2] = hip_height_m;
    truth_.legs[0].true_foot_in_world_m[2] = floor_m_ + robot_.legs[0].foot_radius_m + foot_m;
    truth_.joints[1].true_gear_output_torque_Nm = knee_output_Nm;
    joints_.joints[0].motor_side_torque_Nm = 3.0;
    joints_.joints[1].motor_side_torque_Nm = knee_torque_Nm;
    joints_.joints[1].estimated_position_rad = knee_rad_;
    desired_.legs[0].desired_foot_in_hip_m = {0.0, 0.0, -desired_length_m};
    metrics_.add(motion_, joints_, truth_, &desired_);
  }
  /// Take-off 100 ms after the thrust began, with the hip at 0.50 m; touchdown after `flight_cycles` more.
  void jump(int flight_cycles = 200) {
    cycle(MotionPhase::kStanding, 0.40, -0.005);
    for (int i = 0; i < 100; ++i)
      cycle(MotionPhase::kThrust, 0.35 + 0.001 * i, -0.005, i == 6 ? -120.0 : 40.0, 0.0, i == 80 ? 0.5 : 0.4);
    for (int i = 0; i < flight_cycles; ++i)
      cycle(MotionPhase::kFlight, i == 90 ? 0.65 : 0.50, i == 12 ? 0.001 : 0.1, i == 40 ? 170.0 : 30.0);
    for (int i = 0; i < 200; ++i)
      cycle(MotionPhase::kLanding, 0.38, -0.01, i == 7 ? 25.0 : 10.0, i == 9 ? -60.0 : 20.0);
  }

  double floor_m_ = 0.0;
  RobotConfig robot_ = load_robot("single_leg");
  JumpMetrics metrics_{robot_};
  MotionState motion_{1};
  JointState joints_{2, 1};
  SimTruth truth_{2, 1};
  LegCommand desired_{1};
  double knee_rad_ = 1.5;
};

TEST_F(JumpMetricsTest, HeightIsTheRiseAboveWhereTheFootLeavesTheFloor) {
  jump();
  cycle(MotionPhase::kStanding, 0.45, -0.005);
  ASSERT_EQ(metrics_.jumps().size(), 1u);
  const JumpResult& result = metrics_.jumps()[0];
  EXPECT_TRUE(result.upright);
  EXPECT_NEAR(result.height_mm, 150.0, 1e-9);
  EXPECT_NEAR(result.takeoff_time_ms, 100.0, 1e-9);
  EXPECT_NEAR(result.touchdown_time_ms, 300.0, 1e-9);
  EXPECT_NEAR(result.touchdown_leg_mm, 370.0, 1e-9);  // hip to the middle of the foot
}

TEST_F(JumpMetricsTest, FloorMayBeElsewhere) {
  metrics_ = JumpMetrics(robot_, floor_m_ = -0.2);
  jump();
  EXPECT_NEAR(metrics_.jumps()[0].takeoff_time_ms, 100.0, 1e-9);
}

TEST_F(JumpMetricsTest, LagIsTheLongestLegBehindTheLongestDesired) {
  jump();  // 180 ms: hip at 0.50 + 0.09 m with the foot at 0.1 m; desired longest at 80 ms
  const double longest_ms = 100.0 + 90.0;
  EXPECT_NEAR(metrics_.jumps()[0].y_lag_ms, longest_ms - 80.0, 1e-9);
}

TEST_F(JumpMetricsTest, WithoutLegCommandThereIsNoLag) {
  motion_.state = MotionPhase::kThrust;
  metrics_.add(motion_, joints_, truth_);
  metrics_.add(motion_, joints_, truth_);
  EXPECT_TRUE(std::isnan(metrics_.jumps()[0].y_lag_ms));
}

TEST_F(JumpMetricsTest, TimeToPeakCountsFromTheFirstSetPointACycleLater) {
  jump();
  EXPECT_NEAR(metrics_.jumps()[0].time_to_peak_ms, 5.0, 1e-9);
}

TEST_F(JumpMetricsTest, PositiveWorkLeavesBrakingOutAndEndsAtTakeOff) {
  truth_.joints[0] = {};
  truth_.joints[0].true_motor_torque_Nm = 20.0;
  truth_.joints[0].true_velocity_rad_s = 5.0;
  truth_.joints[1].true_motor_torque_Nm = -30.0;
  truth_.joints[1].true_velocity_rad_s = 2.0;
  jump();
  EXPECT_NEAR(metrics_.jumps()[0].positive_work_J, 20.0 * 5.0 * 0.1, 1e-9);
}

TEST_F(JumpMetricsTest, PeaksAreAbsoluteAndApartForJumpAndLanding) {
  jump();
  const JumpResult& result = metrics_.jumps()[0];
  EXPECT_DOUBLE_EQ(result.peak_knee_torque_Nm, 120.0);
  EXPECT_DOUBLE_EQ(result.peak_hip_torque_Nm, 3.0);
  EXPECT_DOUBLE_EQ(result.flight_knee_torque_Nm, 170.0);
  EXPECT_DOUBLE_EQ(result.landing_hip_torque_Nm, 3.0);
  EXPECT_DOUBLE_EQ(result.landing_knee_torque_Nm, 25.0);
  EXPECT_DOUBLE_EQ(result.landing_knee_output_torque_Nm, 60.0);
}

TEST_F(JumpMetricsTest, FoldedLegIsNoJump) {
  knee_rad_ = robot_.joints[1].position_max_rad;
  jump();
  cycle(MotionPhase::kStanding, 0.45, -0.005);
  EXPECT_FALSE(metrics_.jumps()[0].upright);
  EXPECT_TRUE(std::isnan(metrics_.jumps()[0].height_mm));
}

TEST_F(JumpMetricsTest, UnfinishedJumpHasNoHeight) {
  jump();
  EXPECT_FALSE(metrics_.jumps()[0].upright);
  EXPECT_TRUE(std::isnan(metrics_.jumps()[0].height_mm));
}

TEST_F(JumpMetricsTest, LegThatNeverLandsHasNoLandingTorque) {
  cycle(MotionPhase::kStanding, 0.40, -0.005);
  for (int i = 0; i < 100; ++i) cycle(MotionPhase::kThrust, 0.35 + 0.001 * i, i < 80 ? -0.005 : 0.1, 40.0);
  EXPECT_DOUBLE_EQ(metrics_.jumps()[0].peak_knee_torque_Nm, 40.0);
  EXPECT_TRUE(std::isnan(metrics_.jumps()[0].landing_knee_torque_Nm));
  EXPECT_TRUE(std::isnan(metrics_.jumps()[0].landing_knee_output_torque_Nm));
}

TEST_F(JumpMetricsTest, ShortHopIsNoFlight) {
  jump(10);
  EXPECT_TRUE(std::isnan(metrics_.jumps()[0].touchdown_time_ms));
}

TEST_F(JumpMetricsTest, EveryJumpIsListed) {
  jump();
  cycle(MotionPhase::kCrouch, 0.45, -0.005);
  jump();
  cycle(MotionPhase::kStanding, 0.45, -0.005);
  EXPECT_EQ(metrics_.jumps().size(), 2u);
  EXPECT_TRUE(metrics_.jumps()[0].upright);
}

TEST(JumpMetrics, RobotWithoutAKneeIsRefused) {
  RobotConfig robot = load_robot("single_leg");
  robot.joints[1].name = "ankle";
  EXPECT_THROW(JumpMetrics{robot}, std::invalid_argument);
}

}  // namespace
}  // namespace sprung
