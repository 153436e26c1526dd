#include "model/leg_kinematics.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <random>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "tests/support/allocation_count.h"

namespace sprung {
namespace {

JointVector joints(double hip, double knee) {
  JointVector q(2);
  q << hip, knee;
  return q;
}

class LegKinematicsTest : public testing::Test {
 protected:
  RobotConfig robot_ = load_robot("single_leg");
  std::unique_ptr<LegKinematics> leg_ = make_leg_kinematics(robot_.legs[0]);
};

TEST_F(LegKinematicsTest, UnknownKinematicsIsRefusedByName) {
  LegConfig leg = robot_.legs[0];
  leg.kinematics = "octopus";
  try {
    make_leg_kinematics(leg);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("octopus"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find(leg.name), std::string::npos);
  }
}

TEST_F(LegKinematicsTest, JointsAloneHaveNone) {
  LegConfig leg = robot_.legs[0];
  leg.kinematics = kNoKinematics;
  EXPECT_EQ(make_leg_kinematics(leg), nullptr);
}

TEST_F(LegKinematicsTest, DampedInverseInvertsTheTransposedJacobianInTheLegsPlane) {
  const LegJacobian jacobian = leg_->jacobian(joints(2.3, 1.4));
  const DampedInverse inverse = damped_inverse(jacobian);
  EXPECT_FALSE(inverse.singular);
  const Eigen::Vector3d force(12.0, 0.0, 80.0);
  const JointVector torque = jacobian.transpose() * force;
  EXPECT_LT((inverse.matrix * torque - force).norm(), 1e-9);
  const Eigen::Vector3d velocity(0.3, 0.0, -1.1);
  const JointVector rate = inverse.matrix.transpose() * velocity;
  EXPECT_LT((jacobian * rate - velocity).norm(), 1e-12);
}

TEST_F(LegKinematicsTest, StraightLegIsDampedAndSaysSo) {
  const DampedInverse straight = damped_inverse(leg_->jacobian(joints(1.57, 0.0)));
  EXPECT_TRUE(straight.singular);
  EXPECT_TRUE(straight.matrix.allFinite());
  // Along the straight leg no joint speed helps: the damped answer stays small instead of running away.
  const JointVector rate = straight.matrix.transpose() * Eigen::Vector3d(0.0, 0.0, -1.0);
  EXPECT_LT(rate.norm(), 30.0);
}

TEST_F(LegKinematicsTest, DampingSetsInWithoutAStep) {
  double before = damped_inverse(leg_->jacobian(joints(1.6, 0.5))).matrix.norm();
  bool was_singular = false;
  for (double knee = 0.5; knee > 0.0; knee -= 1e-4) {
    const DampedInverse inverse = damped_inverse(leg_->jacobian(joints(1.6, knee)));
    EXPECT_LT(std::abs(inverse.matrix.norm() - before), 0.05 * before) << knee;
    before = inverse.matrix.norm();
    was_singular = was_singular || inverse.singular;
  }
  EXPECT_TRUE(was_singular);
}

/// With the eigenvalues, and by LU, whatever the pose.
DampedInverse damped_inverse_by_hand(const LegJacobian& jacobian) {
  Eigen::MatrixXd gram = jacobian.transpose() * jacobian;
  const double smallest = std::max(0.0,
                                   Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram).eigenvalues()[0]);
  const bool singular = smallest < 0.02 * 0.02;
  if (singular) gram.diagonal().array() += 0.02 * 0.02 * (1.0 - smallest / (0.02 * 0.02));
  return {jacobian * Eigen::MatrixXd(gram.partialPivLu().inverse()), singular};
}

/// The bound that spares the eigenvalues, and the short way of a leg of three joints, must never change an
/// answer: over straight, folded and common poses.
TEST_F(LegKinematicsTest, DampedInverseIsTheSameWhetherOrNotTheEigenvaluesWereNeeded) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> hip(0.3, 3.0), knee(0.0, 2.6);
  int singular = 0;
  for (int i = 0; i < 2000; ++i) {
    const LegJacobian jacobian = leg_->jacobian(joints(hip(random), knee(random)));
    const DampedInverse inverse = damped_inverse(jacobian), expected = damped_inverse_by_hand(jacobian);
    EXPECT_EQ(inverse.singular, expected.singular);
    singular += inverse.singular ? 1 : 0;
    EXPECT_LT((inverse.matrix - expected.matrix).norm(), 1e-11 * expected.matrix.norm());
  }
  EXPECT_GT(singular, 10);
  EXPECT_LT(singular, 1000);
}

TEST_F(LegKinematicsTest, DampedInverseOfThreeJointsIsThatOfTheGeneralWay) {
  const auto leg = make_leg_kinematics(load_robot("pegasus").legs[0]);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> abduction(-0.6, 0.6), hip(0.4, 3.0), knee(0.0, 2.5);
  int singular = 0;
  for (int i = 0; i < 2000; ++i) {
    JointVector q(3);
    q << abduction(random), hip(random), knee(random);
    const LegJacobian jacobian = leg->jacobian(q);
    const DampedInverse inverse = damped_inverse(jacobian), expected = damped_inverse_by_hand(jacobian);
    ASSERT_EQ(inverse.singular, expected.singular) << q.transpose();
    singular += inverse.singular ? 1 : 0;
    ASSERT_LT((inverse.matrix - expected.matrix).norm(), 1e-12 * expected.matrix.norm()) << q.transpose();
  }
  EXPECT_GT(singular, 10);
  EXPECT_LT(singular, 1000);
}

/// From a common pose to the straight leg: the short way, then the general one without and with damping.
TEST_F(LegKinematicsTest, DampingOfThreeJointsSetsInWithoutAStep) {
  const auto leg = make_leg_kinematics(load_robot("pegasus").legs[0]);
  JointVector q(3);
  q << 0.1, 1.4, 1.2;
  DampedInverse before = damped_inverse(leg->jacobian(q));
  EXPECT_FALSE(before.singular);
  for (; q[2] > 0.0; q[2] -= 2e-5) {
    const DampedInverse inverse = damped_inverse(leg->jacobian(q));
    ASSERT_LT((inverse.matrix - before.matrix).norm(), 0.003 * before.matrix.norm()) << q[2];
    before = inverse;
  }
  EXPECT_TRUE(before.singular);
}

TEST_F(LegKinematicsTest, NothingIsAllocated) {
  const JointVector q = joints(2.2, 1.3);
  const std::int64_t before = test::allocation_count();
  const InverseResult inverse = leg_->inverse(leg_->foot_in_hip_m(q), q);
  const DampedInverse damped = damped_inverse(leg_->jacobian(inverse.position_rad));
  const JointVector torque = leg_->inverse_dynamics_Nm(q, q, q);
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_TRUE(damped.matrix.allFinite() && torque.allFinite());
}

}  // namespace
}  // namespace sprung
