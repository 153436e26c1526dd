/// What holds for every kinematics, over the whole workspace: against tests/model/reference_chain.h.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "model/leg_kinematics.h"
#include "robots/robot_loader.h"
#include "signals/angles.h"
#include "tests/model/pegasus_leg.h"
#include "tests/model/reference_chain.h"

namespace sprung {
namespace {

struct NamedLeg {
  const char* name;
  LegConfig (*make)();
};

void PrintTo(const NamedLeg& leg, std::ostream* out) { *out << leg.name; }

const NamedLeg kLegs[] = {
    {"arm", [] { return load_robot("test_axis").legs[0]; }},
    {"single_leg", [] { return load_robot("single_leg").legs[0]; }},
    {"left", [] { return test::pegasus_leg(LegSide::kLeft); }},
    {"right", [] { return test::pegasus_leg(LegSide::kRight); }},
    {"uneven", [] { return test::uneven_leg(LegSide::kRight); }},
    {"without_offset",
     [] {
       LegConfig leg = test::uneven_leg(LegSide::kLeft);
       leg.links[0].length_m = 0.0;
       return leg;
     }},
};

class LegProperties : public testing::TestWithParam<NamedLeg> {
 protected:
  JointVector random(double limit) {
    std::uniform_real_distribution<double> within(-limit, limit);
    JointVector v(leg_->joint_count());
    for (int i = 0; i < v.size(); ++i) v[i] = within(random_);
    return v;
  }
  double smallest_stretch_m(const JointVector& q) const {
    const LegJacobian j = leg_->jacobian(q);
    return std::sqrt(
        std::max(0.0, Eigen::MatrixXd(j.transpose() * j).selfadjointView<Eigen::Upper>().eigenvalues()[0]));
  }

  LegConfig config_ = GetParam().make();
  std::unique_ptr<LegKinematics> leg_ = make_leg_kinematics(config_);
  test::ReferenceChain reference_{config_};
  std::mt19937 random_{7};
};

TEST_P(LegProperties, FootIsWhereTheRotationsPutIt) {
  for (int i = 0; i < 2000; ++i) {
    const JointVector q = random(kPi);
    ASSERT_LT((leg_->foot_in_hip_m(q) - reference_.foot_m(q)).norm(), 1e-14) << q.transpose();
  }
}

TEST_P(LegProperties, JacobianIsTheDerivativeOfTheFoot) {
  constexpr double kStep_rad = 1e-6;
  for (int i = 0; i < 2000; ++i) {
    const JointVector q = random(kPi);
    const LegJacobian jacobian = leg_->jacobian(q);
    for (int j = 0; j < q.size(); ++j) {
      JointVector ahead = q, behind = q;
      ahead[j] += kStep_rad;
      behind[j] -= kStep_rad;
      const Eigen::Vector3d slope = (leg_->foot_in_hip_m(ahead) - leg_->foot_in_hip_m(behind)) /
                                    (2 * kStep_rad);
      ASSERT_LT((jacobian.col(j) - slope).norm(), 1e-9) << q.transpose();
    }
  }
}

TEST_P(LegProperties, EvenMotionAcceleratesTheFootByTheJacobiansChange) {
  constexpr double kStep_s = 1e-6;
  for (int i = 0; i < 2000; ++i) {
    const JointVector q = random(kPi), w = random(10.0);
    const JointVector ahead = q + kStep_s * w, behind = q - kStep_s * w;
    const Eigen::Vector3d change = (leg_->jacobian(ahead) - leg_->jacobian(behind)) * w / (2 * kStep_s);
    ASSERT_LT((leg_->even_motion_acceleration_m_s2(leg_->pose(q), w) - change).norm(), 1e-6) << q.transpose();
  }
}

TEST_P(LegProperties, OnePoseAnswersAsJointAnglesDo) {
  for (int i = 0; i < 200; ++i) {
    const JointVector q = random(kPi), w = random(10.0), a = random(200.0);
    const LegPose pose = leg_->pose(q);
    ASSERT_EQ(leg_->foot_in_hip_m(pose), leg_->foot_in_hip_m(q));
    ASSERT_EQ(leg_->jacobian(pose), leg_->jacobian(q));
    ASSERT_EQ(leg_->gravity_torque_Nm(pose), leg_->gravity_torque_Nm(q));
    ASSERT_EQ(leg_->inverse_dynamics_Nm(pose, w, a), leg_->inverse_dynamics_Nm(q, w, a));
  }
}

TEST_P(LegProperties, GravityTorqueIsTheGradientOfThePotentialEnergy) {
  for (int i = 0; i < 1000; ++i) {
    const JointVector q = random(kPi);
    ASSERT_LT((leg_->gravity_torque_Nm(q) - reference_.gravity_torque_Nm(q)).norm(), 1e-8) << q.transpose();
  }
}

TEST_P(LegProperties, InverseDynamicsIsLagrangesEquation) {
  for (int i = 0; i < 300; ++i) {
    const JointVector q = random(kPi), w = random(10.0), a = random(200.0);
    const JointVector torque = leg_->inverse_dynamics_Nm(q, w, a);
    ASSERT_LT((torque - reference_.torque_Nm(q, w, a)).norm(), 1e-6 * (1.0 + torque.norm())) << q.transpose();
  }
}

TEST_P(LegProperties, InertiaIsSymmetricAndPositive) {
  for (int i = 0; i < 200; ++i) {
    const JointVector q = random(kPi), rest = JointVector::Zero(q.size());
    const JointVector gravity = leg_->gravity_torque_Nm(q);
    Eigen::MatrixXd inertia(q.size(), q.size());
    for (int j = 0; j < q.size(); ++j) {
      JointVector a = rest;
      a[j] = 1.0;
      inertia.col(j) = leg_->inverse_dynamics_Nm(q, rest, a) - gravity;
    }
    ASSERT_LT((inertia - inertia.transpose()).norm(), 1e-12);
    ASSERT_GT(inertia.selfadjointView<Eigen::Upper>().eigenvalues()[0], 1e-4) << q.transpose();
  }
}

TEST_P(LegProperties, InverseUndoesForwardOnEveryBranch) {
  for (int i = 0; i < 10000; ++i) {
    const JointVector q = random(3.1);
    const Eigen::Vector3d foot = leg_->foot_in_hip_m(q);
    const InverseResult back = leg_->inverse(foot, q);
    ASSERT_TRUE(back.reachable) << q.transpose();
    ASSERT_LT((leg_->foot_in_hip_m(back.position_rad) - foot).norm(), 1e-10) << q.transpose();
    // The nearer to singular, the more of the foot's digits it takes to tell the joints' angles.
    const double stretch_m = smallest_stretch_m(q);
    ASSERT_LT((back.position_rad - q).norm(), stretch_m > 1e-3 ? 1e-9 : 1e-4)
        << q.transpose() << ", " << stretch_m;
  }
}

TEST_P(LegProperties, InverseIsContinuousAwayFromSingularPoses) {
  constexpr double kStep_m = 1e-6;
  int compared = 0;
  for (int i = 0; i < 5000; ++i) {
    const JointVector q = random(3.1);
    const double stretch_m = smallest_stretch_m(q);
    if (stretch_m < 0.02) continue;
    const LegJacobian jacobian = leg_->jacobian(q);
    const Eigen::Vector3d step = kStep_m * (jacobian * random(1.0)).normalized();
    const InverseResult moved = leg_->inverse(leg_->foot_in_hip_m(q) + step, q);
    ASSERT_TRUE(moved.reachable);
    ASSERT_LT((moved.position_rad - q).norm(), 1.01 * kStep_m / stretch_m) << q.transpose();
    ++compared;
  }
  EXPECT_GT(compared, 1000);
}

/// Through the whole workspace and out of it, each answer the next question's `near`: as a controller asks.
/// Within a millimetre of the hip's or the abduction's axis a foot turns about it at any speed.
TEST_P(LegProperties, FollowedFootNeverMakesTheJointsJumpEvenOutOfReach) {
  constexpr double kStep_m = 1e-5;
  const double offset_m = leg_->joint_count() == 3 ? config_.links[0].length_m : 0.0;
  for (int line = 0; line < 20; ++line) {
    const JointVector start = random(3.1);
    const Eigen::AngleAxisd turn(0.7 * line, Eigen::Vector3d::UnitX());
    const Eigen::Vector3d step = kStep_m * (turn * Eigen::Vector3d(0.6, 0.2, 0.77).normalized());
    Eigen::Vector3d foot = leg_->foot_in_hip_m(start);
    JointVector before = leg_->inverse(foot, start).position_rad;
    double largest_rad = 0.0;
    for (int i = 0; i < 15000; ++i) {
      foot += step;
      const JointVector now = leg_->inverse(foot, before).position_rad;
      const double from_hip_m = std::sqrt(leg_->foot_in_hip_m(now).squaredNorm() - offset_m * offset_m +
                                          1e-18);
      const bool at_axis = from_hip_m < 1e-3 || std::hypot(foot.y(), foot.z()) < 1e-3;
      if (!at_axis) largest_rad = std::max(largest_rad, (now - before).norm());
      before = now;
    }
    EXPECT_LT(largest_rad, 0.03) << line << ": from " << start.transpose();
  }
}

TEST_P(LegProperties, OutOfReachIsSaidAndThePoseIsFiniteOnTheBoundary) {
  for (int i = 0; i < 2000; ++i) {
    const JointVector near = random(3.1);
    const Eigen::Vector3d far = 2.0 * Eigen::Vector3d(std::cos(i), std::sin(3.0 * i), std::sin(i));
    if (far.norm() < 0.8) continue;
    const InverseResult out = leg_->inverse(far, near);
    EXPECT_FALSE(out.reachable);
    ASSERT_TRUE(out.position_rad.allFinite());
  }
  const JointVector near = random(1.0);
  EXPECT_FALSE(leg_->inverse({kNaN, 0.0, -0.4}, near).reachable);
}

INSTANTIATE_TEST_SUITE_P(Kinematics, LegProperties, testing::ValuesIn(kLegs),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace sprung
