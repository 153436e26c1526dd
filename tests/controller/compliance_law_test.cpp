#include "controller/compliance_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "controller/two_link.h"
#include "robots/robot_loader.h"

namespace sprung {
namespace {

class ComplianceLawTest : public testing::Test {
 protected:
  ComplianceLawTest() {
    desired_.stiffness_N_m = {2000.0, 0.0, 1500.0};
    desired_.damping_N_s_m = {40.0, 0.0, 60.0};
    measured_.position_rad = pair(2.3, 1.4);
    measured_.velocity_rad_s = pair(0.0, 0.0);
    foot_ = {leg_.foot_in_hip_m(measured_.position_rad), Eigen::Vector3d::Zero()};
  }
  static JointVector pair(double a, double b) {
    JointVector v(2);
    v << a, b;
    return v;
  }
  JointVector torque() const {
    return compliance_torque_Nm(leg_, desired_, foot_, measured_, coulomb_Nm_, 0.05);
  }
  /// Force that the leg puts on the world at its foot.
  Eigen::Vector3d force() const {
    const JointVector motion = torque() - leg_.gravity_torque_Nm(measured_.position_rad);
    return damped_inverse(leg_.jacobian(measured_.position_rad)).matrix * motion;
  }

  TwoLink leg_{load_robot("single_leg").legs[0]};
  DesiredLeg desired_;
  FootMotion foot_;
  LegMotion measured_;
  JointVector coulomb_Nm_ = pair(1.79, 1.79);
};

TEST_F(ComplianceLawTest, AtTheTargetOnlyTheLegsOwnWeightIsHeld) {
  EXPECT_LT((torque() - leg_.gravity_torque_Nm(measured_.position_rad)).norm(), 1e-12);
}

TEST_F(ComplianceLawTest, ActsAsASpringTowardTheTarget) {
  foot_.position_m += Eigen::Vector3d(0.01, 0.0, -0.02);
  EXPECT_LT((force() - Eigen::Vector3d(20.0, 0.0, -30.0)).norm(), 1e-9);
}

TEST_F(ComplianceLawTest, DampingTakesEnergyOutWhateverTheMotion) {
  desired_.friction_compensation = 0.0;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> rate(-10.0, 10.0);
  for (int i = 0; i < 200; ++i) {  // errata E2
    measured_.velocity_rad_s = pair(rate(random), rate(random));
    const JointVector motion = torque() - leg_.gravity_torque_Nm(measured_.position_rad);
    EXPECT_LT(motion.dot(measured_.velocity_rad_s), 0.0);
  }
}

TEST_F(ComplianceLawTest, ShareOfTheDesiredVelocityIsFedForward) {
  desired_.velocity_feedforward = 0.5;
  foot_.velocity_m_s = {0.0, 0.0, -2.0};
  EXPECT_NEAR(force().z(), 60.0 * 0.5 * -2.0, 1e-9);
}

TEST_F(ComplianceLawTest, FeedForwardIsTheGroundsForceOnTheFoot) {
  desired_.feedforward_force_N = {0.0, 0.0, 51.0};  // to be carried: the leg must push down
  EXPECT_NEAR(force().z(), -51.0, 1e-9);
}

TEST_F(ComplianceLawTest, FrictionIsCompensatedWithTheMeasuredSpeedAndNotAtRest) {
  desired_.friction_compensation = 0.8;
  desired_.damping_N_s_m = {0.0, 0.0, 0.0};
  const JointVector at_rest = torque();
  measured_.velocity_rad_s = pair(5.0, -5.0);
  const JointVector moving = torque() - at_rest;
  EXPECT_NEAR(moving[0], 0.8 * 1.79, 1e-9);
  EXPECT_NEAR(moving[1], -0.8 * 1.79, 1e-9);
}

TEST(FootMotionTest, ExtrapolatesWithConstantAcceleration) {
  DesiredLeg desired;
  desired.desired_foot_in_hip_m = {0.0, 0.0, -0.4};
  desired.desired_foot_velocity_m_s = {0.0, 0.0, -2.0};
  desired.desired_foot_acceleration_m_s2 = {0.0, 0.0, 10.0};
  const FootMotion foot = extrapolate(desired, 0.01);
  EXPECT_NEAR(foot.position_m.z(), -0.4 - 0.02 + 0.0005, 1e-15);
  EXPECT_NEAR(foot.velocity_m_s.z(), -1.9, 1e-15);
}

}  // namespace
}  // namespace sprung
