#include "planner/fall_reflex.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"
#include "tests/planner/gait/standing_robot.h"

namespace sprung {
namespace {

constexpr double kFolded_m = 0.24, kStraight_m = 0.52;

class FallReflexTest : public testing::Test {
 protected:
  FallReflexTest() { in_.body.estimated_velocity_m_s = {0.5, 0.0, 0.0}; }
  DesiredLeg at(double time_s, std::size_t leg = 0) {
    in_.stamp.utime_us = static_cast<std::int64_t>(1e6 * time_s);
    reflex_.step(in_);
    DesiredLeg out;
    reflex_.write(leg, out);
    return out;
  }
  void begin() { reflex_.begin(in_, kFolded_m, kStraight_m); }

  const RobotConfig robot_ = load_robot("pegasus");
  FallReflex reflex_{robot_};
  JointState in_ = test::standing(robot_);
};

TEST_F(FallReflexTest, BeginsWhereTheFeetAreAndFoldsThemAsSprings) {
  EXPECT_FALSE(reflex_.acts());
  begin();
  const DesiredLeg first = at(0.0);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(first.desired_foot_in_hip_m[k], in_.legs[0].estimated_foot_in_hip_m[k], 1e-9);
  EXPECT_EQ(first.control_mode, ControlMode::kCompliance);
  EXPECT_NEAR(first.stiffness_N_m[2], 3000.0, 1e-6) << "by its 30 kg";
  EXPECT_GT(at(0.05).desired_foot_in_hip_m[2], -0.36);
  EXPECT_GT(at(0.05).desired_foot_velocity_m_s[2], 2.0);
  EXPECT_NEAR(at(0.3).desired_foot_in_hip_m[2], -1.1 * kFolded_m, 1e-9);
  EXPECT_EQ(at(0.3).desired_foot_velocity_m_s[2], 0.0);
}

TEST_F(FallReflexTest, FeetGoAheadByTheBodysSpeedAndNoFurtherThanLegsReach) {
  begin();
  EXPECT_NEAR(at(0.3).desired_foot_in_hip_m[0], 0.2, 1e-9);
  in_.body.estimated_velocity_m_s = {0.0, -5.0, 0.0};
  const DesiredLeg far = at(0.6, 1);
  EXPECT_NEAR(far.desired_foot_in_hip_m[1], -0.08 - 0.75 * kStraight_m, 1e-9);
  in_.body.estimated_velocity_m_s = {kNaN, kNaN, kNaN};
  EXPECT_EQ(at(0.602, 1).desired_foot_in_hip_m, far.desired_foot_in_hip_m) << "the last that was known";
}

TEST_F(FallReflexTest, FeetHangDownWhateverTheTrunksTilt) {
  in_.body.estimated_velocity_m_s = {0.0, 0.0, 0.0};
  begin();
  const double pitch_rad = 0.4;
  in_.body.estimated_quaternion_wxyz = {std::cos(0.5 * pitch_rad), 0.0, std::sin(0.5 * pitch_rad), 0.0};
  const Vec3 foot_m = at(0.3).desired_foot_in_hip_m;
  EXPECT_NEAR(foot_m[0], 1.1 * kFolded_m * std::sin(pitch_rad), 1e-9);
  EXPECT_NEAR(foot_m[2], -1.1 * kFolded_m * std::cos(pitch_rad), 1e-9);
}

TEST_F(FallReflexTest, EndsOnItsBackAndDoesNotBeginWithAFootThatIsNotKnown) {
  begin();
  in_.body.estimated_quaternion_wxyz = {std::cos(1.15), std::sin(1.15), 0.0, 0.0};
  (void)at(0.1);
  EXPECT_FALSE(reflex_.acts());
  in_.body.estimated_quaternion_wxyz = {1.0, 0.0, 0.0, 0.0};
  in_.legs[2].estimated_foot_in_hip_m[0] = kNaN;
  begin();
  EXPECT_FALSE(reflex_.acts());
}

TEST_F(FallReflexTest, EndsByItselfAndWhenToldTo) {
  begin();
  (void)at(FallReflex::kLasts_s - 0.002);
  EXPECT_TRUE(reflex_.acts());
  (void)at(FallReflex::kLasts_s + 0.002);
  EXPECT_FALSE(reflex_.acts());
  begin();
  EXPECT_TRUE(reflex_.acts());
  reflex_.end();
  EXPECT_FALSE(reflex_.acts());
}

}  // namespace
}  // namespace sprung
