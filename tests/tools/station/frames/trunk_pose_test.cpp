#include "tools/station/frames/trunk_pose.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "signals/vec3.h"

namespace sprung::station {
namespace {

const Eigen::Vector3d kUnknown{kNaN, kNaN, kNaN};
const Eigen::Quaterniond kNoAttitude{kNaN, kNaN, kNaN, kNaN};

TrunkInput nothing() {
  return {kUnknown, kNoAttitude, kNoAttitude, kUnknown, kNaN, kUnknown, kNoAttitude, {}};
}

/// To the left by 90 degrees.
Eigen::Quaterniond turned() {
  return Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()));
}

TEST(TrunkPose, TheSimulationIsBelievedFirst) {
  TrunkPose pose(load_robot("pegasus").legs);
  TrunkInput input = nothing();
  input.true_position_m = {1, 2, 3};
  input.true_attitude = turned();
  input.estimated_attitude = Eigen::Quaterniond::Identity();
  pose.update(input, 0.0);
  EXPECT_EQ(pose.source(), TrunkSource::kSimulation);
  EXPECT_EQ(pose.position_m(), Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(pose.attitude().isApprox(turned()));
}

TEST(TrunkPose, AnEstimatedVelocityIsSummedUpInWorldAxes) {
  TrunkPose pose(load_robot("pegasus").legs);
  TrunkInput input = nothing();
  input.estimated_attitude = turned();
  input.estimated_velocity_m_s = {0.5, 0, 0.3};
  input.estimated_height_m = 0.42;
  pose.update(input, 0.0);
  for (int i = 0; i < 10; ++i) pose.update(input, 0.1);
  EXPECT_EQ(pose.source(), TrunkSource::kEstimate);
  EXPECT_NEAR(pose.position_m().x(), 0.0, 1e-12);
  EXPECT_NEAR(pose.position_m().y(), 0.5, 1e-12);  // forward is to the left now
  EXPECT_EQ(pose.position_m().z(), 0.42);
}

TEST(TrunkPose, InFlightTheLastHeightStays) {
  TrunkPose pose(load_robot("pegasus").legs);
  TrunkInput input = nothing();
  input.estimated_attitude = Eigen::Quaterniond::Identity();
  input.estimated_height_m = 0.42;
  pose.update(input, 0.0);
  input.estimated_height_m = kNaN;
  pose.update(input, 0.1);
  EXPECT_EQ(pose.position_m(), Eigen::Vector3d(0, 0, 0.42));
}

TEST(TrunkPose, OdometryIsFollowedFromWhereItBeginsAndGoneOnFromBetween) {
  TrunkPose pose(load_robot("pegasus").legs);
  TrunkInput input = nothing();
  input.estimated_attitude = Eigen::Quaterniond::Identity();
  input.estimated_velocity_m_s = {0.5, 0, 0};
  input.estimated_height_m = 0.42;
  pose.update(input, 0.0);
  input.odometry_m = {0, 0, 0};
  input.odometry_attitude = turned();
  pose.update(input, 0.1);
  EXPECT_EQ(pose.source(), TrunkSource::kOdometry);
  EXPECT_TRUE(pose.position_m().isApprox(Eigen::Vector3d(0.05, 0, 0.42))) << "no jump when it begins";
  EXPECT_TRUE(pose.attitude().isApprox(turned()));
  pose.update(input, 0.1);
  EXPECT_TRUE(pose.position_m().isApprox(Eigen::Vector3d(0.05, 0.05, 0.42))) << "no news";
  input.odometry_m = {0.0, 0.2, 0.03};
  pose.update(input, 0.1);
  EXPECT_TRUE(pose.position_m().isApprox(Eigen::Vector3d(0.05, 0.2, 0.45))) << "up a ramp";
}

TEST(TrunkPose, OdometryThatStopsLeavesTheEstimateAndBeginsAnewWhereItIs) {
  TrunkPose pose(load_robot("pegasus").legs);
  TrunkInput input = nothing();
  input.estimated_attitude = Eigen::Quaterniond::Identity();
  input.estimated_height_m = 0.42;
  input.odometry_m = {3, 0, 0};
  input.odometry_attitude = Eigen::Quaterniond::Identity();
  pose.update(input, 0.0);
  input.odometry_m = kUnknown;
  input.estimated_height_m = 0.3;
  pose.update(input, 0.1);
  EXPECT_EQ(pose.source(), TrunkSource::kEstimate);
  pose.update(input, 0.1);
  EXPECT_EQ(pose.position_m().z(), 0.3);
  input.odometry_m = {0, 0, 0};
  pose.update(input, 0.1);
  EXPECT_TRUE(pose.position_m().isApprox(Eigen::Vector3d(0, 0, 0.3)));
}

TEST(TrunkPose, OfAnotherSessionNothingIsKept) {
  TrunkPose pose(load_robot("pegasus").legs);
  TrunkInput input = nothing();
  input.estimated_attitude = Eigen::Quaterniond::Identity();
  input.odometry_m = {3, 0, 0};
  input.odometry_attitude = turned();
  pose.update(input, 0.0);
  pose.reset();
  EXPECT_EQ(pose.position_m(), Eigen::Vector3d::Zero());
  pose.update(input, 0.0);
  EXPECT_EQ(pose.position_m(), Eigen::Vector3d::Zero()) << "begins anew";
}

TEST(TrunkPose, WithoutAttitudeTheLowestFootStandsOnTheFloor) {
  const RobotConfig robot = load_robot("single_leg");
  TrunkPose pose(robot.legs);
  TrunkInput input = nothing();
  input.foot_in_hip_m = {{0.1, 0, -0.45}};
  pose.update(input, 0.0);
  EXPECT_EQ(pose.source(), TrunkSource::kLegs);
  EXPECT_NEAR(pose.position_m().z(), 0.45 + robot.legs[0].foot_radius_m, 1e-12);
  input.foot_in_hip_m = {kUnknown};
  pose.update(input, 0.1);
  EXPECT_NEAR(pose.position_m().z(), 0.45 + robot.legs[0].foot_radius_m, 1e-12) << "stays where it was";
  pose.reset();
  EXPECT_EQ(pose.position_m().z(), 0.0);
}

}  // namespace
}  // namespace sprung::station
