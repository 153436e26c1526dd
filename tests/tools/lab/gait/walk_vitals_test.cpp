#include "tools/lab/gait/walk_vitals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

/// pegasus stands, at 0.5 m over its feet, with nothing at a limit.
class WalkVitalsTest : public testing::Test {
 protected:
  WalkVitalsTest() {
    truth_.base_in_world_m = {0.0, 0.0, 0.5};
    for (TrueJoint& joint : truth_.joints) joint.true_velocity_rad_s = joint.true_motor_torque_Nm = 0.0;
    for (EstimatedJoint& joint : joints_.joints) joint.status = JointStatus::kOk;
    safety_.level = SafetyLevel::kOperational;
    motion_.state = MotionPhase::kWalking;
  }
  void add(int cycles = 1) {
    for (int i = 0; i < cycles; ++i) watch_.add({drives_, joints_, motion_, safety_, truth_});
  }
  const WalkVitals& result() const { return watch_.result(); }

  RobotConfig robot_ = load_robot("pegasus");
  DriveState drives_{12};
  JointState joints_{12, 4};
  MotionState motion_{4};
  SafetyState safety_;
  SimTruth truth_{12, 4};
  VitalsWatch watch_{robot_};
};

TEST_F(WalkVitalsTest, ARobotThatWalksIsWell) {
  add(500);
  EXPECT_FALSE(result().fell);
  EXPECT_EQ(result().trips, 0);
  EXPECT_NEAR(result().watched_s, 1.0, 1e-9);
  EXPECT_EQ(result().saturated_share, 0.0);
  EXPECT_TRUE(result().why.empty());
}

TEST_F(WalkVitalsTest, ATrunkOnItsSideHasFallenWhateverThePlannerSays) {
  add(100);
  truth_.base_quaternion_wxyz = {std::cos(0.5), std::sin(0.5), 0.0, 0.0};  // rolled by 1 rad
  add();
  EXPECT_TRUE(result().fell);
  EXPECT_FALSE(result().caught);
  EXPECT_NEAR(result().fell_at_s, 101 * robot_.cycle_s, 1e-9);
}

TEST_F(WalkVitalsTest, ASunkTrunkHasFallen) {
  truth_.base_in_world_m[2] = robot_.body.fallen_height_m - 0.01;
  add();
  EXPECT_TRUE(result().fell);
}

TEST_F(WalkVitalsTest, HeightCountsFromTheLowestFoot) {
  truth_.base_in_world_m[2] = 0.2;
  truth_.legs[2].true_foot_in_world_m[2] = -0.3;
  add();
  EXPECT_FALSE(result().fell);
}

TEST_F(WalkVitalsTest, AFallThatThePlannerNoticesIsCaughtAlsoWhenItNoticesLate) {
  truth_.base_in_world_m[2] = 0.1;
  add(10);
  EXPECT_FALSE(result().caught);
  motion_.state = MotionPhase::kFallen;
  motion_.last_transition = "a fall was detected";
  add();
  EXPECT_TRUE(result().caught);
  EXPECT_NEAR(result().fell_at_s, robot_.cycle_s, 1e-9);
}

TEST_F(WalkVitalsTest, AStopOfARobotThatHasFallenIsNoTrip) {
  motion_.state = MotionPhase::kFallen;
  add();
  safety_.level = SafetyLevel::kDamping;
  add();
  EXPECT_EQ(result().trips, 0);
}

TEST_F(WalkVitalsTest, EachTimeThatSafetyLeavesOperationalIsATrip) {
  for (int i = 0; i < 2; ++i) {
    safety_.level = SafetyLevel::kQuickStop;
    safety_.cause = SafetyCause::kDriveFault;
    add(5);
    safety_.level = SafetyLevel::kOperational;
    add(5);
  }
  EXPECT_EQ(result().trips, 2);
  EXPECT_NE(result().why.find("drive fault"), std::string::npos);
}

TEST_F(WalkVitalsTest, SaturationIsAShareOfJointsAndCycles) {
  joints_.joints[3].status = JointStatus::kSaturated;
  add(50);
  joints_.joints[3].status = JointStatus::kOk;
  add(50);
  EXPECT_NEAR(result().saturated_share, 0.5 / 12, 1e-12);
}

TEST_F(WalkVitalsTest, ThePeaksAreThoseBeforeTheFall) {
  truth_.joints[5].true_velocity_rad_s = -3.0;
  truth_.joints[7].true_motor_torque_Nm = -80.0;
  add();
  motion_.state = MotionPhase::kFallen;
  truth_.joints[5].true_velocity_rad_s = 9.0;
  truth_.joints[7].true_motor_torque_Nm = 108.0;
  add();
  EXPECT_EQ(result().fastest_rad_s, 3.0);
  EXPECT_EQ(result().strongest_Nm, 80.0);
}

}  // namespace
}  // namespace sprung
