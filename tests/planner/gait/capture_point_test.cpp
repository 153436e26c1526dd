#include "planner/gait/capture_point.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/leg_kinematics.h"
#include "robots/robot_loader.h"
#include "tests/planner/gait/standing_robot.h"

namespace sprung {
namespace {

/// Feet at the corners of 0.8 x 0.4 m, 0.5 m below the centre of mass.
BodyView standing() {
  BodyView view;
  view.com_m = {0.0, 0.0, 0.0};
  view.foot_m = {Eigen::Vector3d(0.4, 0.2, -0.5), Eigen::Vector3d(0.4, -0.2, -0.5),
                 Eigen::Vector3d(-0.4, 0.2, -0.5), Eigen::Vector3d(-0.4, -0.2, -0.5)};
  view.velocity_known = true;
  return view;
}

TEST(CapturePoint, TimeIsThatOfAPendulumOfTheHeight) {
  EXPECT_NEAR(capture_s(standing(), 4), std::sqrt(0.5 / kGravity_m_s2), 1e-12);
}

TEST(CapturePoint, AtRestItIsInsideByTheNearestSide) {
  BodyView view = standing();
  EXPECT_NEAR(beyond_feet_m(view, 4), -0.2, 1e-12);
  view.com_m.x() = 0.3;
  EXPECT_NEAR(beyond_feet_m(view, 4), -0.1, 1e-12);
  view.com_m.y() = -0.35;
  EXPECT_NEAR(beyond_feet_m(view, 4), 0.15, 1e-12);
}

TEST(CapturePoint, SpeedTakesItAhead) {
  BodyView view = standing();
  view.velocity_m_s.y() = 0.3 / capture_s(view, 4);
  EXPECT_NEAR(beyond_feet_m(view, 4), 0.1, 1e-12);
}

TEST(CapturePoint, FootInsideTheOthersMakesNoSide) {
  BodyView view = standing();
  view.foot_m[3] = {0.2, 0.1, -0.5};
  view.com_m = {-0.3, -0.3, 0.0};
  EXPECT_GT(beyond_feet_m(view, 4), 0.2);
  EXPECT_NEAR(beyond_feet_m(view, 4), beyond_feet_m(view, 3), 1e-12);
}

TEST(CapturePoint, OfTwoFeetNothingIsKnownAndALineHasNoInside) {
  BodyView view = standing();
  EXPECT_TRUE(std::isnan(beyond_feet_m(view, 2)));
  view.foot_m[3].x() = kNaN;
  EXPECT_TRUE(std::isnan(beyond_feet_m(view, 4)));
  view = standing();
  for (std::size_t i = 0; i < 4; ++i) view.foot_m[i].y() = 0.0;
  EXPECT_NEAR(beyond_feet_m(view, 4), 0.0, 1e-12);
}

TEST(CapturePoint, ShareOfTheHeightIsKnownWhereSpeedAndHeightAre) {
  const RobotConfig robot = load_robot("pegasus");
  const BodyShape shape(robot);
  JointState in = test::standing(robot);
  EXPECT_NEAR(capture_beyond(in, shape), -0.2 / 0.5, 0.01) << "feet 0.2 m beside the middle";
  in.body.estimated_velocity_m_s = {kNaN, kNaN, kNaN};
  EXPECT_TRUE(std::isnan(capture_beyond(in, shape)));
  in = test::standing(robot);
  in.body.estimated_height_m = kNaN;
  EXPECT_TRUE(std::isnan(capture_beyond(in, shape)));
}

}  // namespace
}  // namespace sprung
