#include "planner/gait/body_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/leg_kinematics.h"
#include "robots/robot_loader.h"

namespace sprung {
namespace {

std::array<double, 4> quaternion(double yaw_rad, double pitch_rad, double roll_rad) {
  const Eigen::Quaterniond q = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
  return {q.w(), q.x(), q.y(), q.z()};
}

class BodyViewTest : public testing::Test {
 protected:
  BodyViewTest() {
    for (std::size_t i = 0; i < 4; ++i) {
      Eigen::Vector3d foot = shape_.foot_beside_hip_m[i];
      foot.z() = -0.5;
      in_.legs[i].estimated_foot_in_hip_m = to_vec3(foot);
    }
  }
  BodyView view() const { return BodyView::of(in_, shape_); }

  const RobotConfig robot_ = load_robot("pegasus");
  const BodyShape shape_{robot_};
  JointState in_{12, 4};
};

TEST_F(BodyViewTest, ShapeIsTheRobotsOwn) {
  EXPECT_EQ(shape_.legs, 4u);
  EXPECT_NEAR(shape_.mass_kg, 30.0, 1e-9);  // [C6]
  EXPECT_EQ(shape_.side, (std::array<double, 4>{1.0, -1.0, 1.0, -1.0}));
  EXPECT_NEAR(shape_.foot_beside_hip_m[0].y(), 0.08, 1e-12);
  EXPECT_NEAR(shape_.foot_beside_hip_m[1].y(), -0.08, 1e-12);
}

TEST_F(BodyViewTest, MassIsInTheMiddleOfARobotThatStandsSquare) {
  const Eigen::Vector3d com_m = shape_.com_in_trunk_m(in_);
  EXPECT_NEAR(com_m.head<2>().norm(), 0.0, 1e-12);
  EXPECT_LT(com_m.z(), 0.0);
  EXPECT_GT(com_m.z(), -0.25);
}

TEST_F(BodyViewTest, MassGoesWithAFootThatIsSwungAheadAndIgnoresOneThatIsNotKnown) {
  const double before_m = shape_.com_in_trunk_m(in_).x();
  in_.legs[0].estimated_foot_in_hip_m[0] += 0.2;
  EXPECT_NEAR(shape_.com_in_trunk_m(in_).x() - before_m, 1.2 / 30.0 * 0.1, 1e-9);
  in_.legs[0].estimated_foot_in_hip_m = {kNaN, kNaN, kNaN};
  EXPECT_TRUE(shape_.com_in_trunk_m(in_).allFinite());
}

TEST_F(BodyViewTest, LoadIsCarriedAndTakenOffAgain) {
  BodyShape loaded(robot_);
  loaded.carry({5.0, {0.03, -0.01}});
  EXPECT_NEAR(loaded.mass_kg, 35.0, 1e-9);
  const Eigen::Vector3d by_m = loaded.com_in_trunk_m(in_) - shape_.com_in_trunk_m(in_);
  EXPECT_TRUE(by_m.isApprox(Eigen::Vector3d(0.03, -0.01, 0.0), 1e-9)) << by_m.transpose();
  loaded.carry({});
  EXPECT_NEAR(loaded.mass_kg, 30.0, 1e-9);
  EXPECT_TRUE(loaded.com_in_trunk_m(in_).isApprox(shape_.com_in_trunk_m(in_), 1e-12));
}

TEST_F(BodyViewTest, WhatIsNotKnownCountsAsLevelAndAtRest) {
  const BodyView seen = view();
  EXPECT_TRUE(seen.level_from_trunk.isIdentity());
  EXPECT_FALSE(seen.velocity_known);
  EXPECT_TRUE(seen.velocity_m_s.isZero());
  EXPECT_TRUE(seen.angular_velocity_rad_s.isZero());
  EXPECT_NEAR(seen.foot_m[2].x(), -0.33, 1e-12);
  EXPECT_NEAR(seen.foot_m[2].y(), 0.2, 1e-12);
  EXPECT_NEAR(seen.foot_m[2].z(), -0.5, 1e-12);
}

TEST_F(BodyViewTest, LevelAxesGoWithTheHeadingAndNotWithTheTilt) {
  in_.body.estimated_quaternion_wxyz = quaternion(1.2, 0.2, 0.0);  // nose down
  const BodyView seen = view();
  EXPECT_NEAR(seen.attitude.yaw_rad, 1.2, 1e-12);
  EXPECT_NEAR(seen.attitude.pitch_rad, 0.2, 1e-12);
  // Front hips sink under the level plane by the trunk's half length, and their feet come back with the legs.
  const Eigen::Vector3d foot_in_trunk_m = shape_.hip_in_trunk_m[0] +
                                          to_eigen(in_.legs[0].estimated_foot_in_hip_m);
  const Eigen::Vector3d expected_m = Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()) * foot_in_trunk_m;
  EXPECT_TRUE(seen.foot_m[0].isApprox(expected_m, 1e-12));
  EXPECT_LT(seen.foot_m[0].z(), seen.foot_m[2].z());
}

TEST_F(BodyViewTest, VelocitiesTurnFromTrunkToLevelAxes) {
  in_.body.estimated_quaternion_wxyz = quaternion(-2.0, 0.0, 0.3);
  in_.body.estimated_velocity_m_s = {0.4, 0.0, 1.0};
  in_.body.estimated_angular_velocity_rad_s = {0.0, 0.0, 1.0};
  const BodyView seen = view();
  ASSERT_TRUE(seen.velocity_known);
  EXPECT_TRUE(seen.velocity_m_s.isApprox(Eigen::Vector3d(0.4, -std::sin(0.3), std::cos(0.3)), 1e-12));
  EXPECT_TRUE(
      seen.angular_velocity_rad_s.isApprox(Eigen::Vector3d(0.0, -std::sin(0.3), std::cos(0.3)), 1e-12));
}

TEST(BodyFrameTest, AttitudeIsWhatTheQuaternionWasMadeOf) {
  for (const double yaw : {-3.0, 0.0, 2.0}) {
    for (const double pitch : {-1.2, 0.0, 0.7}) {
      for (const double roll : {-2.5, 0.0, 1.0}) {
        const Attitude a = attitude(quaternion(yaw, pitch, roll));
        EXPECT_NEAR(a.yaw_rad, yaw, 1e-9);
        EXPECT_NEAR(a.pitch_rad, pitch, 1e-9);
        EXPECT_NEAR(a.roll_rad, roll, 1e-9);
      }
    }
  }
  EXPECT_TRUE(std::isnan(attitude({kNaN, kNaN, kNaN, kNaN}).pitch_rad));
}

TEST(BodyFrameTest, AnglesAreWrappedToTheNearerWay) {
  EXPECT_NEAR(wrapped_rad(3.5), 3.5 - 6.283185307179586, 1e-12);
  EXPECT_NEAR(wrapped_rad(-6.0), 6.283185307179586 - 6.0, 1e-12);
  EXPECT_NEAR(wrapped_rad(1.0), 1.0, 1e-15);
}

TEST(BodyShapeTest, MoreLegsThanAWalkKnowsAreRefused) {
  RobotConfig robot = load_robot("pegasus");
  robot.legs.push_back(robot.legs.back());
  EXPECT_THROW(BodyShape{robot}, std::invalid_argument);
}

}  // namespace
}  // namespace sprung
