#include "tools/lab/identify/loading_pose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/leg_kinematics.h"
#include "robots/robot_loader.h"

namespace sprung::identify {
namespace {

TEST(LoadingPose, HipIsRecordedWithTheLegAsStraightAsItGoes) {
  const RobotConfig robot = load_robot("single_leg");
  const auto pose = loading_pose(robot, 0);
  ASSERT_EQ(pose.size(), 1u);
  EXPECT_EQ(pose[0].joint, 1);
  EXPECT_NEAR(pose[0].position_rad, record_range(robot, 1).low_rad, 1e-9);
}

TEST(LoadingPose, WeightHasALeverOfHalfTheShankAtLeastAboutTheKnee) {
  const RobotConfig robot = load_robot("single_leg");
  const auto pose = loading_pose(robot, 1);
  ASSERT_EQ(pose.size(), 1u);
  const auto leg = make_leg_kinematics(robot.legs[0]);
  const RecordRange range = record_range(robot, 1);
  double sum_m2 = 0.0;
  for (int k = 0; k <= 20; ++k) {
    JointVector pose_rad(2);
    pose_rad << pose[0].position_rad, range.low_rad + (range.high_rad - range.low_rad) * k / 20;
    sum_m2 += std::pow(leg->jacobian(pose_rad)(2, 1), 2) / 21;
  }
  EXPECT_GT(std::sqrt(sum_m2), 0.5 * robot.legs[0].links[1].length_m);
}

TEST(LoadingPose, MovesAreOfTheOtherJointsOfTheLegAlone) {
  const RobotConfig robot = load_robot("pegasus");
  const int knee = robot.legs[1].joints[2];
  const auto moves = loading_moves(robot, knee);
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_EQ(moves[0].joint, robot.legs[1].joints[0]);
  EXPECT_EQ(moves[1].joint, robot.legs[1].joints[1]);
  for (const RecordMove& move : moves) EXPECT_GT(move.speed_rad_s, 0.0);
}

TEST(LoadingPose, JointThatIsAloneHasNobodyBesideIt) {
  EXPECT_TRUE(loading_pose(load_robot("test_axis"), 0).empty());
}

}  // namespace
}  // namespace sprung::identify
