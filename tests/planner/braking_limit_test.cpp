#include "planner/braking_limit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

class BrakingLimitTest : public testing::Test {
 protected:
  BrakingLimitTest() : robot_(load_robot("single_leg")), preset_(robot_.preset("best")) {}

  /// Of a fall over `drop_m`.
  double most_m_s2(double drop_m = 0.3) const {
    FootFall fall(preset_.adaptive_landing, preset_.landing_length_m);
    fall.begin(0, {{preset_.adaptive_landing.foot_x_m, 0.0, -preset_.landing_length_m}, {}, {}},
               fall_from_rest(0, std::sqrt(2.0 * drop_m / kGravity_m_s2)));
    return BrakingLimit(robot_, robot_.legs[0]).most_braking_m_s2(fall, wished_m_s2());
  }
  double wished_m_s2() const { return preset_.adaptive_landing.braking_m_s2; }
  void set_viscous(double viscous_Nm_s_rad) {
    for (JointConfig& joint : robot_.joints) joint.friction->parameters.viscous_Nm_s_rad = viscous_Nm_s_rad;
  }

  RobotConfig robot_;
  PresetConfig preset_;
};

TEST_F(BrakingLimitTest, StrongMotorsCanWhatIsWished) {
  for (ActuatorConfig& actuator : robot_.actuators) actuator.torque_limit_Nm *= 2.0;
  EXPECT_EQ(most_m_s2(), wished_m_s2());
}

TEST_F(BrakingLimitTest, WhatFrictionTakesIsNotLeftForBraking) {
  set_viscous(5.0);
  const double some_m_s2 = most_m_s2();
  set_viscous(9.0);
  const double more_m_s2 = most_m_s2();
  EXPECT_LT(more_m_s2, some_m_s2);
  EXPECT_LT(more_m_s2, 0.9 * wished_m_s2());
  EXPECT_GT(more_m_s2, 0.4 * wished_m_s2());
}

TEST_F(BrakingLimitTest, WeakerMotorsAndHeavierRotorsBrakeLess) {
  for (ActuatorConfig& actuator : robot_.actuators) actuator.torque_limit_Nm *= 0.7;
  EXPECT_LT(most_m_s2(), wished_m_s2());
  robot_ = load_robot("single_leg");
  for (JointConfig& joint : robot_.joints) joint.armature_kg_m2 *= 1.5;
  EXPECT_LT(most_m_s2(), wished_m_s2());
}

TEST_F(BrakingLimitTest, MotorsThatCanNothingAreAskedForAThird) {
  for (ActuatorConfig& actuator : robot_.actuators) actuator.torque_limit_Nm = 1.0;
  EXPECT_NEAR(most_m_s2(), wished_m_s2() / 3.0, 1e-9);
}

TEST_F(BrakingLimitTest, FallThatIsTooShortToBrakeAsksNothing) { EXPECT_EQ(most_m_s2(0.02), wished_m_s2()); }

}  // namespace
}  // namespace sprung
