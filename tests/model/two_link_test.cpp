#include "model/two_link.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "signals/angles.h"

namespace sprung {
namespace {

JointVector pose(double hip, double knee) {
  JointVector q(2);
  q << hip, knee;
  return q;
}

class TwoLinkTest : public testing::Test {
 protected:
  JointVector random_pose() { return pose(hip_(random_), knee_(random_)); }

  LegConfig config_ = load_robot("single_leg").legs[0];
  TwoLink leg_{config_};
  std::mt19937 random_{42};
  std::uniform_real_distribution<double> hip_{-kPi, kPi};
  std::uniform_real_distribution<double> knee_{-3.0, 3.0};
  std::uniform_real_distribution<double> rate_{-12.0, 12.0};
};

TEST_F(TwoLinkTest, NeedsTwoJointsAndTwoLinks) {
  LegConfig leg = config_;
  leg.links.pop_back();
  EXPECT_THROW(TwoLink{leg}, std::invalid_argument);
  leg = config_;
  leg.joints.push_back(2);
  EXPECT_THROW(TwoLink{leg}, std::invalid_argument);
  leg = config_;
  leg.links[1].length_m = 0.0;
  EXPECT_THROW(TwoLink{leg}, std::invalid_argument);
}

TEST_F(TwoLinkTest, KnownPoses) {
  EXPECT_NEAR(leg_.foot_in_hip_m(pose(kPi / 2, 0.0)).z(), -0.682, 1e-12);
  EXPECT_NEAR(leg_.foot_in_hip_m(pose(0.0, 0.0)).x(), 0.682, 1e-12);
  // Thigh straight back, shank straight down: the knee is behind.
  const Eigen::Vector3d foot = leg_.foot_in_hip_m(pose(kPi, kPi / 2));
  EXPECT_NEAR(foot.x(), -0.260, 1e-12);
  EXPECT_NEAR(foot.z(), -0.422, 1e-12);
}

TEST_F(TwoLinkTest, JacobianIsTheDerivativeOfTheFootOverTheWholeWorkspace) {
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 2000; ++i) {
    const JointVector q = random_pose();
    const LegJacobian jacobian = leg_.jacobian(q);
    for (int j = 0; j < 2; ++j) {
      JointVector ahead = q, behind = q;
      ahead[j] += kStep;
      behind[j] -= kStep;
      const Eigen::Vector3d difference = (leg_.foot_in_hip_m(ahead) - leg_.foot_in_hip_m(behind)) /
                                         (2 * kStep);
      EXPECT_LT((jacobian.col(j) - difference).norm(), 1e-9);
    }
  }
}

TEST_F(TwoLinkTest, InverseUndoesForwardOnBothBranches) {
  for (int i = 0; i < 20000; ++i) {
    const JointVector q = random_pose();
    const InverseResult back = leg_.inverse(leg_.foot_in_hip_m(q), q);
    ASSERT_TRUE(back.reachable);
    // Near straight, arccos loses half the digits; the foot does not.
    ASSERT_LT((leg_.foot_in_hip_m(back.position_rad) - leg_.foot_in_hip_m(q)).norm(), 1e-12);
    ASSERT_LT((back.position_rad - q).norm(), 1e-5) << q.transpose();
  }
}

TEST_F(TwoLinkTest, FootAboveTheHipIsFoundToo) {
  // Errata E3: the papers' arctan is wrong by pi here.
  const Eigen::Vector3d foot(0.1, 0.0, 0.4);
  const InverseResult up = leg_.inverse(foot, pose(0.0, 1.0));
  ASSERT_TRUE(up.reachable);
  EXPECT_LT((leg_.foot_in_hip_m(up.position_rad) - foot).norm(), 1e-12);
}

TEST_F(TwoLinkTest, KneeIsBehindForPositiveFlexion) {
  const InverseResult back = leg_.inverse({0.0, 0.0, -0.45}, pose(2.0, 1.0));
  EXPECT_GT(back.position_rad[1], 0.0);
  EXPECT_LT(config_.links[0].length_m * std::cos(back.position_rad[0]), 0.0);
}

TEST_F(TwoLinkTest, HipAngleTurnsTowardWhereTheLegIs) {
  const InverseResult near = leg_.inverse({-0.3, 0.0, 0.2}, pose(3.6, 1.0));
  EXPECT_NEAR(near.position_rad[0], 3.6, kPi);
}

TEST_F(TwoLinkTest, OutOfReachIsSaidAndClampedToTheNearestPose) {
  const InverseResult far = leg_.inverse({0.0, 0.0, -0.9}, pose(1.5, 0.5));
  EXPECT_FALSE(far.reachable);
  EXPECT_NEAR(leg_.foot_in_hip_m(far.position_rad).z(), -0.682, 1e-9);
  const InverseResult close = leg_.inverse({0.0, 0.0, -0.1}, pose(1.5, 0.5));
  EXPECT_FALSE(close.reachable);
  EXPECT_NEAR(leg_.foot_in_hip_m(close.position_rad).norm(), 0.162, 1e-9);
  EXPECT_FALSE(leg_.inverse({0.0, 0.0, 0.0}, pose(1.5, 0.5)).reachable);
  EXPECT_FALSE(leg_.inverse({0.0, 0.05, -0.4}, pose(1.5, 0.5)).reachable);
  EXPECT_FALSE(leg_.inverse({kNaN, 0.0, -0.4}, pose(1.5, 0.5)).reachable);
}

TEST_F(TwoLinkTest, GravityTorqueIsTheGradientOfThePotentialEnergy) {
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 2000; ++i) {
    const JointVector q = random_pose();
    const JointVector torque = leg_.gravity_torque_Nm(q);
    for (int j = 0; j < 2; ++j) {
      JointVector ahead = q, behind = q;
      ahead[j] += kStep;
      behind[j] -= kStep;
      const double slope = (leg_.potential_energy_J(ahead) - leg_.potential_energy_J(behind)) / (2 * kStep);
      EXPECT_NEAR(torque[j], slope, 1e-8);
    }
  }
}

TEST_F(TwoLinkTest, ForceUnderTheHipNeedsNoHipTorque) {
  const InverseResult under = leg_.inverse({0.0, 0.0, -0.45}, pose(2.0, 1.0));
  const JointVector torque = leg_.jacobian(under.position_rad).transpose() * Eigen::Vector3d(0.0, 0.0, 100.0);
  EXPECT_NEAR(torque[0], 0.0, 1e-12);
  EXPECT_NEAR(torque[1], 100.0 * -config_.links[0].length_m * std::cos(under.position_rad[0]), 1e-9);
}

/// Kinetic energy from the velocities of the centres of mass alone: knows nothing of M and V.
double kinetic_energy_J(const LegConfig& leg, const JointVector& q, const JointVector& w) {
  const LinkConfig& thigh = leg.links[0];
  const LinkConfig& shank = leg.links[1];
  const double a = q[0], b = q[0] - q[1], wa = w[0], wb = w[0] - w[1];
  const double vx = -thigh.length_m * std::sin(a) * wa - shank.com_m * std::sin(b) * wb;
  const double vz = -thigh.length_m * std::cos(a) * wa - shank.com_m * std::cos(b) * wb;
  return 0.5 * ((thigh.inertia_kg_m2 + thigh.mass_kg * thigh.com_m * thigh.com_m) * wa * wa +
                shank.inertia_kg_m2 * wb * wb + shank.mass_kg * (vx * vx + vz * vz));
}

TEST_F(TwoLinkTest, PowerOfTheDynamicsIsTheChangeOfEnergy) {
  constexpr double kStep_s = 1e-6;
  for (int i = 0; i < 500; ++i) {
    const JointVector q = random_pose();
    const JointVector w = pose(rate_(random_), rate_(random_));
    const JointVector a = pose(10 * rate_(random_), 10 * rate_(random_));
    const auto energy = [&](double t) {
      const JointVector qt = q + t * w + 0.5 * t * t * a;
      return kinetic_energy_J(config_, qt, w + t * a) + leg_.potential_energy_J(qt);
    };
    const double power = w.dot(leg_.inverse_dynamics_Nm(q, w, a));
    EXPECT_NEAR(power, (energy(kStep_s) - energy(-kStep_s)) / (2 * kStep_s), 1e-4 * (1.0 + std::abs(power)));
  }
}

TEST_F(TwoLinkTest, InertiaIsSymmetric) {
  const JointVector q = pose(2.1, 1.2);
  const JointVector rest = pose(0.0, 0.0);
  const JointVector gravity = leg_.gravity_torque_Nm(q);
  const double m12 = (leg_.inverse_dynamics_Nm(q, rest, pose(0.0, 1.0)) - gravity)[0];
  const double m21 = (leg_.inverse_dynamics_Nm(q, rest, pose(1.0, 0.0)) - gravity)[1];
  EXPECT_NEAR(m12, m21, 1e-12);
  EXPECT_LT(m12, 0.0);
}

}  // namespace
}  // namespace sprung
