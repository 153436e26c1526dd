#include "planner/gait/body_frame.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace sprung {
namespace {

TEST(BodyFrame, LevelIsTheTrunkWithoutPitchAndRoll) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> tilt(-1.5, 1.5), turn(-3.1, 3.1);
  for (int i = 0; i < 200; ++i) {
    const Attitude given{turn(random), tilt(random), turn(random)};
    const Eigen::Quaterniond level_of_trunk = Eigen::AngleAxisd(given.pitch_rad, Eigen::Vector3d::UnitY()) *
                                              Eigen::AngleAxisd(given.roll_rad, Eigen::Vector3d::UnitX());
    const Eigen::Quaterniond world = Eigen::AngleAxisd(given.yaw_rad, Eigen::Vector3d::UnitZ()) *
                                     level_of_trunk;
    const Attitude seen = attitude({world.w(), world.x(), world.y(), world.z()});
    EXPECT_NEAR(seen.roll_rad, given.roll_rad, 1e-12);
    EXPECT_NEAR(seen.pitch_rad, given.pitch_rad, 1e-12);
    EXPECT_NEAR(seen.yaw_rad, given.yaw_rad, 1e-12);
    EXPECT_LT((level_from_trunk(given) - level_of_trunk.toRotationMatrix()).norm(), 1e-14);
  }
}

TEST(BodyFrame, TrunkAlongAPlaneHasBothItsAxesInIt) {
  const Eigen::Vector2d slope(0.3, -0.2);
  const Eigen::Matrix3d level = level_from_trunk(attitude_along(slope));
  for (const int axis : {0, 1}) EXPECT_NEAR(level(2, axis), slope.dot(level.col(axis).head<2>()), 1e-12);
  EXPECT_NEAR(level(1, 0), 0.0, 1e-12);                  // its heading stays
  EXPECT_LT(attitude_along({0.1, 0.0}).pitch_rad, 0.0);  // uphill ahead: nose up
  EXPECT_GT(attitude_along({0.0, 0.1}).roll_rad, 0.0);   // uphill to the left: left side up
}

TEST(BodyFrame, AnglesAreWrappedToHalfATurn) {
  EXPECT_NEAR(wrapped_rad(3.5), 3.5 - 6.283185307179586, 1e-15);
  EXPECT_NEAR(wrapped_rad(-3.5), 6.283185307179586 - 3.5, 1e-15);
  EXPECT_EQ(wrapped_rad(1.0), 1.0);
}

}  // namespace
}  // namespace sprung
