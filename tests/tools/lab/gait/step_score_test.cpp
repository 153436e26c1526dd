#include "tools/lab/gait/step_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

/// pegasus' left front leg steps as the test says; the others stand.
class StepScoreTest : public testing::Test {
 protected:
  StepScoreTest() {
    for (std::size_t i = 0; i < 4; ++i) {
      joints_.legs[i].estimated_foot_in_hip_m = command_.legs[i].desired_foot_in_hip_m = {0.0, 0.0, -0.5};
      motion_.legs[i].phase = LegPhase::kStance;
      truth_.legs[i].true_contact_force_N = {0.0, 0.0, 75.0};
    }
    for (TrueJoint& joint : truth_.joints) joint.true_gear_output_torque_Nm = 0.0;
  }
  void swing(int cycles, const Vec3& error_m) {
    motion_.legs[0].phase = LegPhase::kSwing;
    truth_.legs[0].true_contact_force_N = {0.0, 0.0, 0.0};
    joints_.legs[0].estimated_foot_in_hip_m = {error_m[0], error_m[1], -0.5 + error_m[2]};
    add(cycles);
  }
  void touch(int cycles, double force_N, double knee_Nm) {
    truth_.legs[0].true_contact_force_N = {0.0, 0.0, force_N};
    truth_.joints[robot_.legs[0].joints[2]].true_gear_output_torque_Nm = knee_Nm;
    add(cycles);
  }
  void add(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      ++truth_.stamp.seq;
      score_.add({joints_, command_, motion_, truth_});
    }
  }
  static constexpr int kImpact = 75;  // cycles of StepScore::kImpact_s

  RobotConfig robot_ = load_robot("pegasus");
  JointState joints_{12, 4};
  LegCommand command_{4};
  MotionState motion_{4};
  SimTruth truth_{12, 4};
  StepScore score_{robot_};
};

TEST_F(StepScoreTest, StandingFeetHaveNoSwingAndNoTouchdown) {
  add(500);
  EXPECT_TRUE(std::isnan(score_.swing_rms_m()));
  EXPECT_TRUE(score_.touchdowns().empty());
  EXPECT_TRUE(std::isnan(touchdown_peaks(score_.touchdowns()).worst_N));
}

TEST_F(StepScoreTest, SwingRmsIsOfTheDistanceInAllAxes) {
  swing(100, {0.003, 0.0, 0.004});
  EXPECT_NEAR(score_.swing_rms_m(), 0.005, 1e-12);
  swing(100, {0.0, 0.0, 0.0});
  EXPECT_NEAR(score_.swing_rms_m(), 0.005 / std::sqrt(2.0), 1e-12);
}

TEST_F(StepScoreTest, CyclesAfterContactAreNoSwingThoughThePlannerHasNotNoticed) {
  swing(100, {0.0, 0.0, 0.010});
  joints_.legs[0].estimated_foot_in_hip_m = {0.0, 0.0, -0.4};
  touch(20, 100.0, 10.0);
  EXPECT_NEAR(score_.swing_rms_m(), 0.010, 1e-12);
}

TEST_F(StepScoreTest, APeakIsTheHighestWithinTheImpactAndNoLater) {
  swing(50, {});
  truth_.legs[0].true_ground_height_m = 0.02;
  touch(10, 100.0, -12.0);
  touch(10, 300.0, -40.0);
  touch(kImpact - 20, 150.0, -10.0);
  touch(50, 900.0, -90.0);
  ASSERT_EQ(score_.touchdowns().size(), 1u);
  const Touchdown& t = score_.touchdowns()[0];
  EXPECT_EQ(t.leg, 0u);
  EXPECT_EQ(t.force_N, 300.0);
  EXPECT_EQ(t.knee_Nm, 40.0);
  EXPECT_EQ(t.ground_error_m, 0.02);
  EXPECT_NEAR(t.time_s, 50 * robot_.cycle_s, 1e-9);
}

TEST_F(StepScoreTest, AFootThatBouncesWithinAnImpactTouchesDownOnce) {
  swing(50, {});
  touch(5, 200.0, 0.0);
  swing(5, {});
  touch(kImpact, 100.0, 0.0);
  EXPECT_EQ(score_.touchdowns().size(), 1u);
}

TEST_F(StepScoreTest, WorstAndMeanAreOverAllTouchdowns) {
  const TouchdownPeaks peaks = touchdown_peaks({{0, 0.0, 0.0, 100.0, 10.0}, {1, 1.0, 0.0, 300.0, 20.0}});
  EXPECT_EQ(peaks.worst_N, 300.0);
  EXPECT_EQ(peaks.mean_N, 200.0);
  EXPECT_EQ(peaks.worst_Nm, 20.0);
  EXPECT_EQ(peaks.mean_Nm, 15.0);
}

TEST(TravelScore, SpeedIsDistanceOverTimeAndTurningDoesNotWrap) {
  TravelScore travel;
  SimTruth truth(12, 4);
  for (int i = 0; i <= 100; ++i) {
    truth.base_in_world_m = {0.3 * 0.1 * i, 0.4 * 0.1 * i, 0.5};
    const double yaw_rad = 3.0 + 0.01 * i;  // through half a turn
    truth.base_quaternion_wxyz = {std::cos(0.5 * yaw_rad), 0.0, 0.0, std::sin(0.5 * yaw_rad)};
    travel.add(truth, 0.1);
  }
  EXPECT_NEAR(travel.distance_m(), 5.0, 1e-9);
  EXPECT_NEAR(travel.speed_m_s(), 0.5, 1e-9);
  EXPECT_NEAR(travel.drift_rad(), 1.0, 1e-9);
}

}  // namespace
}  // namespace sprung
