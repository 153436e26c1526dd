#include "tools/lab/jump/jump_trace.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

class JumpTraceTest : public testing::Test {
 protected:
  void cycles(MotionPhase phase, int count) {
    for (int i = 0; i < count; ++i) {
      motion_.state = phase;
      truth_.stamp.utime_us += 1000;
      trace_.add({drives_, joints_, motion_, commands_, truth_, legs_});
    }
  }

  RobotConfig robot_ = load_robot("single_leg");
  JumpTrace trace_{robot_};
  DriveState drives_{2};
  JointState joints_{2, 1};
  MotionState motion_{1};
  DriveCommand commands_{2};
  SimTruth truth_{2, 1};
  LegCommand legs_{1};
};

TEST_F(JumpTraceTest, GoesFromShortlyBeforeTheThrustToASecondAfter) {
  cycles(MotionPhase::kStanding, 100);
  cycles(MotionPhase::kCrouch, 300);
  cycles(MotionPhase::kThrust, 200);
  cycles(MotionPhase::kFlight, 400);
  cycles(MotionPhase::kStanding, 3000);
  const std::vector<JumpSample>& samples = trace_.samples();
  ASSERT_EQ(samples.size(), 50u + 1u + 1000u);
  EXPECT_NEAR(samples.front().time_s, -0.05, 1e-9);
  EXPECT_NEAR(samples[50].time_s, 0.0, 1e-9);
  EXPECT_EQ(samples[49].phase, MotionPhase::kCrouch);
  EXPECT_EQ(samples[50].phase, MotionPhase::kThrust);
  EXPECT_NEAR(samples.back().time_s, 1.0, 1e-9);
}

TEST_F(JumpTraceTest, HeightsAreOfTheFootBelowTheHip) {
  truth_.base_in_world_m[2] = 0.5;
  truth_.legs[0].true_foot_in_world_m[2] = 0.1;
  legs_.legs[0].desired_foot_in_hip_m = {0.0, 0.0, -0.45};
  cycles(MotionPhase::kThrust, 1);
  EXPECT_DOUBLE_EQ(trace_.samples()[0].y_m, -0.4);
  EXPECT_DOUBLE_EQ(trace_.samples()[0].desired_y_m, -0.45);
}

TEST_F(JumpTraceTest, StandingAloneIsNoJump) {
  cycles(MotionPhase::kStanding, 100);
  EXPECT_TRUE(trace_.samples().empty());
}

TEST(JumpTrace, RobotWithOneJointIsRefused) {
  EXPECT_THROW(JumpTrace{load_robot("test_axis")}, std::invalid_argument);
}

}  // namespace
}  // namespace sprung
