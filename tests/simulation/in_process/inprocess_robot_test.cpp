#include "simulation/in_process/inprocess_robot.h"

#include <gtest/gtest.h>

#include <string>

#include "robots/robot_loader.h"
#include "tests/simulation/in_process/operator_order.h"

namespace sprung {
namespace {

using test::order_of;

class InProcess : public testing::Test {
 protected:
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / config_.cycle_s); ++i) robot_.tick();
  }
  void stand() {
    robot_.boot();
    run(0.1);
    robot_.submit(order_of(OperatorKind::kStand, 1));
    run(3.0);
    ASSERT_EQ(robot_.motion_state().state, MotionPhase::kStanding);
  }
  bool any_enabled() const {
    for (const ActuatorState& actuator : robot_.drive_state().actuators) {
      if (actuator.power_state == PowerState::kOperationEnabled) return true;
    }
    return false;
  }
  RobotConfig config_ = load_robot("single_leg");
  InProcessRobot robot_{config_, "best", SimOptions{}};
};

TEST_F(InProcess, BootsToCycleZeroWithoutTorque) {
  robot_.boot();
  EXPECT_EQ(robot_.cycle(), 0);
  run(1.0);
  EXPECT_EQ(robot_.cycle(), 1000);
  EXPECT_FALSE(any_enabled());
  EXPECT_EQ(robot_.motion_state().state, MotionPhase::kIdle);
}

TEST_F(InProcess, StandsOnCommand) {
  stand();
  EXPECT_TRUE(any_enabled());
  EXPECT_NEAR(robot_.truth().base_in_world_m[2], config_.preset("best").stand_length_m, 0.03);
}

TEST_F(InProcess, OneJointHoldsAVirtualSpringsTorque) {
  stand();
  double static_Nm = 0.0;
  for (const EstimatedJoint& joint : robot_.joint_state().joints)
    static_Nm += std::abs(joint.motor_side_torque_Nm);
  EXPECT_GT(static_Nm, 1.0);  // 5 kg stand on a bent leg
  EXPECT_LT(static_Nm, 60.0);
}

TEST_F(InProcess, EmergencyStopInAJumpSwitchesOffWithinTheCycleAfter) {
  stand();
  robot_.submit(order_of(OperatorKind::kJump, 2));
  while (robot_.motion_state().state != MotionPhase::kThrust) ASSERT_TRUE(robot_.tick());
  run(0.05);
  robot_.submit(order_of(OperatorKind::kEstop, 3));
  run(0.003);
  EXPECT_FALSE(any_enabled());
  EXPECT_EQ(robot_.bridge().safety().cause, SafetyCause::kEmergencyStop);
  run(2.0);
  EXPECT_FALSE(any_enabled());
}

TEST_F(InProcess, ClearAloneNeverSwitchesOn) {
  stand();
  robot_.submit(order_of(OperatorKind::kEstop, 2));
  run(0.5);
  robot_.submit(order_of(OperatorKind::kClear, 3));
  OperatorReply reply;
  std::string outcomes;
  while (robot_.next_reply(reply)) outcomes += std::string(name(reply.outcome)) + " ";
  run(2.0);
  EXPECT_FALSE(any_enabled()) << outcomes;
  EXPECT_EQ(robot_.bridge().safety().level, SafetyLevel::kOperational);
  robot_.submit(order_of(OperatorKind::kStand, 4));
  run(3.0);
  EXPECT_EQ(robot_.motion_state().state, MotionPhase::kStanding);
}

TEST_F(InProcess, DriveThatFaultsInAJumpStopsTheWholeRobot) {
  stand();
  robot_.submit(order_of(OperatorKind::kJump, 2));
  while (robot_.motion_state().state != MotionPhase::kFlight) ASSERT_TRUE(robot_.tick());
  SimControl fault;
  fault.kind = SimControlKind::kDriveFault;
  fault.actuator = 0;
  robot_.sim().control(fault);
  run(6.0);  // it lands, is damped until it rests, then stopped
  EXPECT_FALSE(any_enabled());
  EXPECT_EQ(robot_.bridge().safety().cause, SafetyCause::kDriveFault);
  EXPECT_TRUE(robot_.bridge().safety().latched);
  EXPECT_EQ(robot_.bridge().safety().actuator, 0);
}

TEST_F(InProcess, DriveThatFallsSilentStopsTheWholeRobot) {
  stand();
  SimControl silence;
  silence.kind = SimControlKind::kDriveSilent;
  silence.actuator = 1;
  silence.value = 1.0;
  robot_.sim().control(silence);
  run(1.0);
  EXPECT_EQ(robot_.bridge().safety().cause, SafetyCause::kDriveSilent);
  EXPECT_EQ(robot_.bridge().safety().actuator, 1);
  EXPECT_NE(robot_.drive_state().actuators[0].power_state, PowerState::kOperationEnabled);
}

TEST_F(InProcess, JumpsInEveryModeAndLandsOnItsFoot) {
  stand();
  std::int64_t id = 10;
  for (const JumpMode mode : {JumpMode::kPosition, JumpMode::kTorque, JumpMode::kHybrid}) {
    OperatorCommand jump = order_of(OperatorKind::kJump, ++id);
    jump.jump_mode = mode;
    robot_.submit(jump);
    double top_m = 0.0;
    for (int i = 0; i < 5000; ++i) {
      robot_.tick();
      top_m = std::max(top_m, robot_.truth().base_in_world_m[2]);
    }
    EXPECT_EQ(robot_.motion_state().state, MotionPhase::kStanding) << name(mode);
    EXPECT_GT(top_m, 0.55) << name(mode);
  }
}

}  // namespace
}  // namespace sprung
