#include "model/one_link.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "signals/angles.h"

namespace sprung {
namespace {

JointVector at(double angle) {
  JointVector q(1);
  q << angle;
  return q;
}

class OneLinkTest : public testing::Test {
 protected:
  LegConfig config_ = load_robot("test_axis").legs[0];
  OneLink arm_{config_};
};

TEST_F(OneLinkTest, NeedsOneJointAndOneLink) {
  LegConfig leg = config_;
  leg.joints.push_back(1);
  EXPECT_THROW(OneLink{leg}, std::invalid_argument);
  leg = config_;
  leg.links.clear();
  EXPECT_THROW(OneLink{leg}, std::invalid_argument);
  leg = config_;
  leg.links[0].length_m = 0.0;
  EXPECT_THROW(OneLink{leg}, std::invalid_argument);
}

TEST_F(OneLinkTest, HangsAtZeroAndSwingsTowardX) {
  EXPECT_LT((arm_.foot_in_hip_m(at(0.0)) - Eigen::Vector3d(0, 0, -0.4)).norm(), 1e-12);
  EXPECT_LT((arm_.foot_in_hip_m(at(kPi / 2)) - Eigen::Vector3d(0.4, 0, 0)).norm(), 1e-12);
}

TEST_F(OneLinkTest, JacobianIsTheDerivativeOfTheEnd) {
  for (double angle = -3.0; angle < 3.0; angle += 0.1) {
    const Eigen::Vector3d slope = (arm_.foot_in_hip_m(at(angle + 1e-6)) -
                                   arm_.foot_in_hip_m(at(angle - 1e-6))) /
                                  2e-6;
    EXPECT_LT((arm_.jacobian(at(angle)).col(0) - slope).norm(), 1e-9) << angle;
  }
}

TEST_F(OneLinkTest, InverseFindsTheAngleOnTheTurnOfTheArm) {
  for (double angle = -5.0; angle < 5.0; angle += 0.1) {
    const InverseResult found = arm_.inverse(arm_.foot_in_hip_m(at(angle)), at(angle + 0.3));
    EXPECT_TRUE(found.reachable);
    EXPECT_NEAR(found.position_rad[0], angle, 1e-12);
  }
}

TEST_F(OneLinkTest, OnlyTheArmsCircleIsReachable) {
  EXPECT_FALSE(arm_.inverse({0.3, 0.0, -0.3}, at(0.0)).reachable);
  EXPECT_FALSE(arm_.inverse({0.0, 0.01, -0.4}, at(0.0)).reachable);
  // A foot extrapolated along the tangent for 2 ms at 12 rad/s is still on it.
  EXPECT_TRUE(arm_.inverse({0.4 * 0.024, 0.0, -0.4}, at(0.0)).reachable);
}

TEST_F(OneLinkTest, WeightIsTheGradientOfItsEnergyAndPullsBack) {
  const LinkConfig& link = config_.links[0];
  for (double angle = -3.0; angle < 3.0; angle += 0.25) {
    const auto energy_J = [&](double q) { return -link.mass_kg * 9.81 * link.com_m * std::cos(q); };
    const double slope_Nm = (energy_J(angle + 1e-5) - energy_J(angle - 1e-5)) / 2e-5;
    EXPECT_NEAR(arm_.gravity_torque_Nm(at(angle))[0], slope_Nm, 1e-7);
  }
  EXPECT_NEAR(arm_.gravity_torque_Nm(at(kPi / 2))[0], 12.753, 1e-3);
}

/// A rod and a disc about the axis, summed by hand.
TEST_F(OneLinkTest, InertiaIsThatOfRodAndDisc) {
  const double rod = 0.5 * 0.4 * 0.4 / 3.0;
  const double disc = 3.0 * 0.4 * 0.4 + 0.5 * 3.0 * 0.05 * 0.05;
  EXPECT_NEAR(arm_.inverse_dynamics_Nm(at(0.0), at(2.0), at(10.0))[0], 10.0 * (rod + disc), 1e-4);
  EXPECT_NEAR(arm_.inverse_dynamics_Nm(at(1.0), at(2.0), at(0.0))[0], arm_.gravity_torque_Nm(at(1.0))[0],
              1e-12);
}

TEST_F(OneLinkTest, DampedInverseBalancesATangentialForce) {
  const LegJacobian jacobian = arm_.jacobian(at(0.7));
  const DampedInverse inverse = damped_inverse(jacobian);
  EXPECT_FALSE(inverse.singular);
  const Eigen::Vector3d force = 10.0 * jacobian.col(0).normalized();
  EXPECT_LT((inverse.matrix * (jacobian.transpose() * force) - force).norm(), 1e-12);
}

TEST_F(OneLinkTest, IsMadeByItsName) {
  const auto made = make_leg_kinematics(config_);
  ASSERT_NE(made, nullptr);
  EXPECT_EQ(made->joint_count(), 1);
}

}  // namespace
}  // namespace sprung
