#include "model/three_joint.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "signals/angles.h"
#include "tests/model/pegasus_leg.h"
#include "tests/support/allocation_count.h"

namespace sprung {
namespace {

JointVector pose(double abduction, double hip, double knee) {
  JointVector q(3);
  q << abduction, hip, knee;
  return q;
}

Eigen::Vector3d mirrored(Eigen::Vector3d v) {
  v.y() = -v.y();
  return v;
}

JointVector mirrored_joints(JointVector q) {
  q[0] = -q[0];
  return q;
}

/// S1: foot 0.5 m under the hip, knee behind; hip axis 0.08 m beside the abduction axis.
const Eigen::Vector3d kStandingFoot(0.0, 0.08, -0.5);

class ThreeJointTest : public testing::Test {
 protected:
  JointVector random(double limit) {
    std::uniform_real_distribution<double> within(-limit, limit);
    return pose(within(random_), within(random_), within(random_));
  }

  ThreeJoint left_{test::pegasus_leg(LegSide::kLeft)};
  ThreeJoint right_{test::pegasus_leg(LegSide::kRight)};
  std::mt19937 random_{11};
};

TEST_F(ThreeJointTest, TheLastLinkTurnsAsItsEndMovesAboutTheKnee) {
  LegConfig config = test::pegasus_leg(LegSide::kLeft);
  config.links[0].length_m = 0.0;
  config.links[1].length_m = 1e-9;  // the knee at the hip
  const ThreeJoint leg(config);
  for (int i = 0; i < 50; ++i) {
    const JointVector at = random(2.0), w = random(3.0);
    const Eigen::Vector3d turning_rad_s = leg.last_link_rate_rad_s(leg.pose(at), w);
    const Eigen::Vector3d end_m_s = leg.jacobian(at) * w;
    EXPECT_TRUE(end_m_s.isApprox(turning_rad_s.cross(leg.foot_in_hip_m(at)), 1e-6));
  }
}

TEST_F(ThreeJointTest, NeedsThreeJointsAndThreeLinks) {
  LegConfig leg = test::pegasus_leg(LegSide::kLeft);
  leg.links.pop_back();
  EXPECT_THROW(ThreeJoint{leg}, std::invalid_argument);
  leg = test::pegasus_leg(LegSide::kLeft);
  leg.joints.pop_back();
  EXPECT_THROW(ThreeJoint{leg}, std::invalid_argument);
  leg = test::pegasus_leg(LegSide::kLeft);
  leg.links[1].length_m = 0.0;
  EXPECT_THROW(ThreeJoint{leg}, std::invalid_argument);
  leg = test::pegasus_leg(LegSide::kLeft);
  leg.links[0].length_m = 0.0;  // the offset may be none
  EXPECT_EQ(ThreeJoint{leg}.joint_count(), 3);
}

TEST_F(ThreeJointTest, KnownPoses) {
  EXPECT_LT((left_.foot_in_hip_m(pose(0, kPi / 2, 0)) - Eigen::Vector3d(0, 0.08, -0.6)).norm(), 1e-15);
  EXPECT_LT((right_.foot_in_hip_m(pose(0, kPi / 2, 0)) - Eigen::Vector3d(0, -0.08, -0.6)).norm(), 1e-15);
  // Abduction is toward the left, of either leg.
  EXPECT_LT((left_.foot_in_hip_m(pose(kPi / 2, kPi / 2, 0)) - Eigen::Vector3d(0, 0.6, 0.08)).norm(), 1e-15);
  EXPECT_LT((right_.foot_in_hip_m(pose(kPi / 2, kPi / 2, 0)) - Eigen::Vector3d(0, 0.6, -0.08)).norm(), 1e-15);
}

TEST_F(ThreeJointTest, StandsAsPegasusDoes) {
  // sim.yaml's initial pose: [C6], [S1].
  const InverseResult stand = left_.inverse(kStandingFoot, pose(0, 2, 1));
  ASSERT_TRUE(stand.reachable);
  EXPECT_LT((stand.position_rad - pose(0.0, 2.1565, 1.1714)).norm(), 1e-4) << stand.position_rad.transpose();
  // 73.6 N under the foot: the knee carries what C6 says, the hip nothing, the abduction what the offset
  // makes.
  const JointVector torque = left_.jacobian(stand.position_rad).transpose() * Eigen::Vector3d(0, 0, 73.6);
  EXPECT_NEAR(torque[0], 73.6 * 0.08, 1e-9);
  EXPECT_NEAR(torque[1], 0.0, 1e-9);
  EXPECT_NEAR(torque[2], 12.2, 0.05);
}

TEST_F(ThreeJointTest, WeightOfALeftLegPullsItTowardTheRight) {
  const JointVector q = pose(0, kPi / 2, 0);
  // All of it hangs left of the axis: held by a torque that lifts it to the left.
  EXPECT_NEAR(left_.gravity_torque_Nm(q)[0], 9.81 * (3.3 * 0.04 + 1.2 * 0.08), 1e-12);
  EXPECT_NEAR(right_.gravity_torque_Nm(q)[0], -left_.gravity_torque_Nm(q)[0], 1e-12);
}

TEST_F(ThreeJointTest, RightLegIsTheMirrorImageOfTheLeft) {
  for (int i = 0; i < 2000; ++i) {
    const JointVector q = random(kPi), w = random(10.0), a = random(100.0);
    const JointVector q_right = mirrored_joints(q);
    EXPECT_EQ(right_.foot_in_hip_m(q_right), mirrored(left_.foot_in_hip_m(q)));
    LegJacobian image = left_.jacobian(q);
    image.row(1) = -image.row(1);
    image.col(0) = -image.col(0);
    EXPECT_EQ(right_.jacobian(q_right), image);
    const JointVector torque = left_.inverse_dynamics_Nm(q, w, a);
    const JointVector torque_right = right_.inverse_dynamics_Nm(q_right, mirrored_joints(w),
                                                                mirrored_joints(a));
    EXPECT_LT((torque_right - mirrored_joints(torque)).norm(), 1e-12);
    const InverseResult back = left_.inverse(left_.foot_in_hip_m(q), q);
    const InverseResult back_right = right_.inverse(right_.foot_in_hip_m(q_right), q_right);
    EXPECT_LT((back_right.position_rad - mirrored_joints(back.position_rad)).norm(), 1e-9);
  }
}

TEST_F(ThreeJointTest, FourPosesReachAFootAndNearChooses) {
  const Eigen::Vector3d foot(0.1, 0.2, -0.4);
  const double other_side = 2.0 * std::atan2(foot.z(), foot.y());  // mirrored at the direction of the foot
  const double abduction = left_.inverse(foot, pose(0, 2, 1)).position_rad[0];
  std::vector<JointVector> found;
  for (const double near_abduction : {abduction, other_side - abduction}) {
    for (const double knee : {1.0, -1.0}) {
      const InverseResult out = left_.inverse(foot, pose(near_abduction, 2.0, knee));
      EXPECT_TRUE(out.reachable);
      EXPECT_LT((left_.foot_in_hip_m(out.position_rad) - foot).norm(), 1e-12);
      EXPECT_GT(out.position_rad[1 + 1] * knee, 0.0);
      EXPECT_NEAR(out.position_rad[0], near_abduction, 1e-9);
      for (const JointVector& other : found) EXPECT_GT((other - out.position_rad).norm(), 0.1);
      found.push_back(out.position_rad);
    }
  }
}

TEST_F(ThreeJointTest, FoldedLegWhoseFootIsAboveItsAxisDoesNotTurnOverToReachDown) {
  const JointVector folded = pose(0.0, 0.4, 2.5);
  ASSERT_GT(left_.foot_in_hip_m(folded).z(), 0.1);
  const InverseResult down = left_.inverse(kStandingFoot, folded);
  EXPECT_NEAR(down.position_rad[0], 0.0, 1e-12);
}

/// Distance from a foot to the nearest that any pose of the leg reaches, from a fine grid of poses.
double distance_to_reach_m(const ThreeJoint& leg, const Eigen::Vector3d& foot) {
  const double from_axis = std::hypot(foot.y(), foot.z());
  double nearest = 1e9;
  for (double hip = -kPi; hip <= kPi; hip += 0.02) {
    for (double knee = 0.0; knee <= kPi; knee += 0.02) {
      const Eigen::Vector3d reached = leg.foot_in_hip_m(pose(0, hip, knee));
      nearest = std::min(
          nearest, std::hypot(reached.x() - foot.x(), std::hypot(reached.y(), reached.z()) - from_axis));
    }
  }
  return nearest;
}

TEST_F(ThreeJointTest, OutOfReachGivesThePoseOfTheNearestFoot) {
  const ThreeJoint uneven(test::uneven_leg(LegSide::kLeft));
  const std::vector<Eigen::Vector3d> feet = {
      {0.0, 0.08, -0.9},    {0.5, 0.4, -0.4},   {0.9, 0.02, 0.01},  // too far
      {0.3, 0.02, -0.05},   {-0.2, 0.0, 0.05},                      // at the axis
      {0.02, -0.08, -0.03}, {0.09, 0.01, 0.02}, {0.0, 0.06, 0.0},   // near the hip
      {0.7, 0.0, 0.0},      {-0.3, 0.0, 0.0},   {0.0, 0.0, 0.0}};
  for (const Eigen::Vector3d& foot : feet) {
    const InverseResult out = uneven.inverse(foot, pose(0.1, 2.0, 1.0));
    EXPECT_FALSE(out.reachable) << foot.transpose();
    const double away_m = (uneven.foot_in_hip_m(out.position_rad) - foot).norm();
    const double least_m = distance_to_reach_m(uneven, foot);
    EXPECT_LT(away_m, least_m + 1e-9) << foot.transpose();
    EXPECT_GT(away_m, least_m - 1e-2) << foot.transpose();  // the grid's width
  }
}

TEST_F(ThreeJointTest, FootOnTheCylinderAroundItsAxisIsReached) {
  for (double angle = -3.0; angle < 3.0; angle += 0.1) {
    const Eigen::Vector3d foot(0.35, 0.08 * std::cos(angle), 0.08 * std::sin(angle));
    const InverseResult out = left_.inverse(foot, pose(angle, 0.5, 1.0));
    EXPECT_TRUE(out.reachable) << angle;
    EXPECT_NEAR(out.position_rad[0], angle, 1e-6);
    EXPECT_LT((left_.foot_in_hip_m(out.position_rad) - foot).norm(), 1e-9);
    EXPECT_TRUE(damped_inverse(left_.jacobian(out.position_rad)).singular);
    const Eigen::Vector3d inside = foot.cwiseProduct(Eigen::Vector3d(1.0, 0.99, 0.99));
    EXPECT_FALSE(left_.inverse(inside, pose(angle, 0.5, 1.0)).reachable);
  }
}

TEST_F(ThreeJointTest, WhereADirectionIsUndefinedJointsStayWhereTheyAre) {
  const JointVector near = pose(0.3, 1.9, 1.2);
  EXPECT_NEAR(left_.inverse({0.4, 0.0, 0.0}, near).position_rad[0], 0.3, 1e-12);  // on the abduction axis
  const Eigen::Vector3d at_hip = left_.foot_in_hip_m(pose(0.3, 1.0, kPi));        // on the hip axis
  const InverseResult folded = left_.inverse(at_hip, near);
  EXPECT_NEAR(folded.position_rad[0], 0.3, 1e-6);
  EXPECT_NEAR(folded.position_rad[1], 1.9, 1e-9);
  EXPECT_NEAR(folded.position_rad[2], kPi, 1e-6);
  EXPECT_EQ(left_.inverse({0.1, kNaN, -0.4}, near).position_rad, near);
}

TEST_F(ThreeJointTest, SingularPosesAreThoseOfTheDeterminant) {
  for (int i = 0; i < 2000; ++i) {
    const JointVector q = random(kPi);
    const double depth = 0.3 * std::sin(q[1]) + 0.3 * std::sin(q[1] - q[2]);
    EXPECT_NEAR(left_.jacobian(q).determinant(), depth * 0.3 * 0.3 * std::sin(q[2]), 1e-15);
  }
  EXPECT_FALSE(damped_inverse(left_.jacobian(pose(0, 2.1565, 1.1714))).singular);
  EXPECT_TRUE(damped_inverse(left_.jacobian(pose(0, kPi / 2, 0.0))).singular);       // straight
  EXPECT_TRUE(damped_inverse(left_.jacobian(pose(0.2, 1.0, kPi - 0.01))).singular);  // folded
  EXPECT_TRUE(damped_inverse(left_.jacobian(pose(0.2, 0.6, 1.2))).singular);         // foot beside the axis
}

TEST_F(ThreeJointTest, DampedInverseBalancesAForceInAnyDirection) {
  const LegJacobian jacobian = left_.jacobian(pose(0.2, 2.1, 1.2));
  const DampedInverse inverse = damped_inverse(jacobian);
  const Eigen::Vector3d force(10.0, -20.0, 70.0);
  EXPECT_LT((inverse.matrix * (jacobian.transpose() * force) - force).norm(), 1e-10);
}

TEST_F(ThreeJointTest, DampingKeepsJointSpeedsBoundedAndSetsInWithoutAStep) {
  const auto at = [&](double knee) { return damped_inverse(left_.jacobian(pose(0.1, 1.3 + knee, knee))); };
  Eigen::MatrixXd before = at(0.6).matrix;
  for (double knee = 0.6; knee > 0.0; knee -= 1e-4) {
    const DampedInverse now = at(knee);
    EXPECT_LT((now.matrix - before).norm(), 0.02 * before.norm()) << knee;
    EXPECT_LT(now.matrix.norm(), 1.0 / 0.02 + 5.0) << knee;
    before = now.matrix;
  }
  EXPECT_TRUE(at(0.0).singular);
}

TEST_F(ThreeJointTest, NothingIsAllocated) {
  const JointVector q = pose(0.1, 2.2, 1.3);
  const std::int64_t before = test::allocation_count();
  const InverseResult inverse = left_.inverse(left_.foot_in_hip_m(q), q);
  const DampedInverse damped = damped_inverse(left_.jacobian(inverse.position_rad));
  const JointVector torque = left_.inverse_dynamics_Nm(q, q, q);
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_TRUE(damped.matrix.allFinite() && torque.allFinite());
}

}  // namespace
}  // namespace sprung
