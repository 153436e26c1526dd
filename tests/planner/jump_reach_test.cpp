#include "planner/jump_reach.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

class JumpReachTest : public testing::Test {
 protected:
  std::string validate() const {
    const char* why = JumpReach(robot_).validate(curve());
    return why == nullptr ? "" : why;
  }
  JumpCurve curve() const {
    JumpCurve out(preset_);
    out.forward(forward_m_, 0.4);
    return out;
  }
  RobotConfig robot_ = load_robot("single_leg");
  PresetConfig preset_ = robot_.preset("best");
  double forward_m_ = 0.0;
};

TEST_F(JumpReachTest, EveryPresetsOwnCurveCanBeFollowed) {
  for (const PresetConfig& preset : robot_.presets) {
    preset_ = preset;
    EXPECT_EQ(validate(), "") << preset.name;
  }
}

TEST_F(JumpReachTest, CurveBeyondTheStrokeIsRefusedOfAnyDegree) {
  preset_.jump_curve.lengths_m = {0.35, 0.35, 0.67, 0.85, 0.95, 0.67, 0.478, 0.478};
  preset_.landing_length_m = 0.478;
  preset_.jump_curve.duration_s = 20.0;  // no matter of speed
  EXPECT_EQ(validate(), "the leg's stroke is too short for it");
  preset_.jump_curve.lengths_m = {0.17, 0.3, 0.478};  // folded farther than the knee goes
  EXPECT_EQ(validate(), "the leg's stroke is too short for it");
}

TEST_F(JumpReachTest, DrivesThatTurnTooSlowlyAreNamed) {
  preset_.jump_curve.duration_s = 0.05;
  EXPECT_EQ(validate(), "the drives' speed limit is too low for it");
}

TEST_F(JumpReachTest, DrivesThatAreTooWeakAreNamed) {
  for (ActuatorConfig& actuator : robot_.actuators) actuator.torque_limit_Nm = 5.0;
  EXPECT_EQ(validate(), "the drives' torque limit is too low for it");
}

TEST_F(JumpReachTest, WayForwardCountsToo) {
  forward_m_ = 0.05;
  EXPECT_EQ(validate(), "");
  forward_m_ = 2.0;
  EXPECT_NE(validate(), "");
}

}  // namespace
}  // namespace sprung
