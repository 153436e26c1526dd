#include "model/posed_leg.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

/// Foot acceleration of joints that move so, by differences of the foot's place.
Eigen::Vector3d posed_leg_foot_m_s2(const LegKinematics& leg, const JointVector& q, const JointVector& w,
                                    const JointVector& a) {
  const auto foot_m = [&](double t) {
    const JointVector at = q + t * w + 0.5 * t * t * a;
    return Eigen::Vector3d(leg.foot_in_hip_m(leg.pose(at)));
  };
  constexpr double kStep_s = 1e-4;
  return (foot_m(kStep_s) - 2.0 * foot_m(0.0) + foot_m(-kStep_s)) / (kStep_s * kStep_s);
}

TEST(PosedLegTest, JointsFollowAFootsVelocityAndAcceleration) {
  for (const char* name : {"single_leg", "pegasus"}) {
    const RobotConfig robot = load_robot(name);
    const auto leg = make_leg_kinematics(robot.legs[0]);
    const auto n = static_cast<Eigen::Index>(robot.legs[0].joints.size());
    JointVector q(n), w(n), a(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const JointConfig& joint = robot.joints[static_cast<std::size_t>(robot.legs[0].joints[i])];
      q[i] = 0.4 * joint.position_min_rad + 0.6 * joint.position_max_rad;
      w[i] = 1.0 - 0.7 * static_cast<double>(i);
      a[i] = -3.0 + 2.5 * static_cast<double>(i);
    }
    const PosedLeg at = posed(*leg, q);
    const Eigen::Vector3d foot_m_s = leg->jacobian(at.pose) * w;
    EXPECT_LT((joint_velocity_rad_s(at, foot_m_s) - w).norm(), 1e-2 * w.norm()) << name;
    const Eigen::Vector3d foot_m_s2 = posed_leg_foot_m_s2(*leg, q, w, a);
    EXPECT_LT((joint_acceleration_rad_s2(*leg, at, foot_m_s2, w) - a).norm(), 1e-2 * a.norm()) << name;
  }
}

}  // namespace
}  // namespace sprung
