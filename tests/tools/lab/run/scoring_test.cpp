#include "tools/lab/run/scoring.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "signals/vec3.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(MeasuredJoint, IsTheIndexInRobotYaml) {
  const RobotConfig robot = load_robot("single_leg");
  EXPECT_EQ(measured_joint(robot, "hip"), 0u);
  EXPECT_EQ(measured_joint(robot, "knee"), 1u);
}

TEST(MeasuredJoint, ARobotWithoutItIsNamed) {
  try {
    measured_joint(load_robot("test_axis"), "knee");
    FAIL() << "found a knee";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("test_axis"), HasSubstr("'knee'")));
  }
}

TEST(RaisePeak, FollowsTheLargestSizeOfEitherSignAndSaysWhenItIsNew) {
  double peak = kNaN;
  EXPECT_TRUE(raise_peak(peak, -3.0));
  EXPECT_EQ(peak, 3.0);
  EXPECT_FALSE(raise_peak(peak, 2.0));
  EXPECT_FALSE(raise_peak(peak, 3.0));
  EXPECT_EQ(peak, 3.0);
  EXPECT_TRUE(raise_peak(peak, 4.0));
  EXPECT_EQ(peak, 4.0);
}

TEST(RaisePeak, NothingMeasuredIsNoPeak) {
  double none = kNaN, some = 1.0;
  EXPECT_FALSE(raise_peak(none, kNaN));
  EXPECT_TRUE(std::isnan(none));
  EXPECT_FALSE(raise_peak(some, kNaN));
  EXPECT_EQ(some, 1.0);
}

}  // namespace
}  // namespace sprung
