/// A gait that asks more of its motors than they have for long: S1's robot with smaller motors, trotting on
/// short, high steps. Without MotorHeat their drives hold them at the rated current, and it falls.
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/gait/motor_heat.h"
#include "robots/robot_loader.h"
#include "tools/lab/gait/walking_robot.h"

namespace sprung {
namespace {

constexpr double kWarmTrot_s = 60.0;

RobotConfig with_hot_trot() {
  RobotConfig robot = load_robot("pegasus");
  GaitConfig& trot = robot.gaits[static_cast<std::size_t>(gait_index(robot, "trot"))];
  trot.period_s = 0.6;
  trot.lift_m = 0.05;
  for (ActuatorConfig& actuator : robot.actuators) actuator.rated_current_A *= 0.8;
  return robot;
}

TEST(WarmMotorsTest, AHotTrotEndsStandingAndNotInAFall) {
  const RobotConfig robot = with_hot_trot();
  SimOptions sim;
  sim.seed = 1;
  WalkingRobot walker(robot, "best", sim);
  walker.walk("trot", {0.3, 0.0, 0.0});
  double warmest = 0.0;
  walker.run(kWarmTrot_s, [&](InProcessRobot& process) {
    for (const EstimatedJoint& joint : process.joint_state().joints)
      warmest = std::max(warmest, joint.winding_share);
  });
  EXPECT_FALSE(walker.vitals().fell) << walker.vitals().why;
  EXPECT_EQ(walker.vitals().trips, 0);
  EXPECT_GT(warmest, MotorHeat::kSlowFrom) << "it did not get warm: the test shows nothing";
  EXPECT_LT(warmest, 1.0);
  EXPECT_EQ(walker.robot().motion_state().state, MotionPhase::kStanding);
}

}  // namespace
}  // namespace sprung
