#include "estimator/imu_mounting.h"

#include <gtest/gtest.h>

#include <random>

#include "estimator/rotation.h"
#include "tests/estimator/trunk_sample.h"

namespace sprung {
namespace {

/// pegasus in a trot on ground of any shape; its IMU is mounted askew.
class ImuMountingTest : public testing::Test {
 protected:
  using Ground = double (*)(const Eigen::Vector3d& in_world_m);

  static double level(const Eigen::Vector3d&) { return 0.0; }
  static double ramp(const Eigen::Vector3d& at_m) { return 0.1 * at_m.x() - 0.05 * at_m.y(); }
  /// Up from one metre on, level again two metres later.
  static double hill(const Eigen::Vector3d& at_m) { return 0.15 * std::clamp(at_m.x() - 1.0, 0.0, 2.0); }

  /// One step of each diagonal pair, the trunk along the feet that stand.
  void step(Ground ground, double forward_m, double turning_rad) {
    for (const std::array<std::size_t, 2> pair : {std::array<std::size_t, 2>{0, 3}, {1, 2}}) {
      heading_rad_ += 0.5 * turning_rad;
      at_m_ += turned_about_z(heading_rad_) * Eigen::Vector3d(0.5 * forward_m, 0.0, 0.0);
      std::vector<EstimatedLeg> legs(4);
      const Eigen::Quaterniond trunk_to_world = turned_about_z(heading_rad_) * test::rpy(0.02, -0.03, 0.0);
      for (const std::size_t i : pair) {
        const Eigen::Vector3d hip_m = to_eigen(robot_.legs[i].hip_in_trunk_m);
        Eigen::Vector3d foot_m = at_m_ + turned_about_z(heading_rad_) * hip_m;
        foot_m.z() = ground(foot_m) + 0.005 * normal_(random_);
        legs[i].contact = true;
        legs[i].contact_confidence = 1.0;
        legs[i].foot_force_N = {0.0, 0.0, 200.0};
        legs[i].estimated_foot_in_hip_m = to_vec3(
            trunk_to_world.conjugate() * (foot_m - at_m_ - Eigen::Vector3d(0.0, 0.0, 0.4)) - hip_m);
        legs[i].estimated_foot_velocity_m_s = {};
      }
      const Eigen::Quaterniond measured = trunk_to_world * turned_by({askew_rad_.x(), askew_rad_.y(), 0.0});
      for (int k = 0; k < 30; ++k) {
        feet_.update(legs, std::vector<Eigen::Vector3d>(4, Eigen::Vector3d::Zero()), 0.002);
        mounting_.step(measured * mounting_.sensor_to_trunk().conjugate(), feet_);
      }
    }
  }
  void walk(Ground ground, int steps, double forward_m, double turning_rad) {
    for (int k = 0; k < steps; ++k) step(ground, forward_m, turning_rad);
  }
  double off_rad() const { return (mounting_.tilt_rad() - askew_rad_).norm(); }
  double bound_rad() const { return 2.0 * std::sqrt(mounting_.covariance_rad2().trace()); }

  RobotConfig robot_ = test::four_legs();
  StandingFeet feet_{robot_.legs};
  ImuMounting mounting_;
  Eigen::Vector2d askew_rad_{0.015, -0.012};
  std::mt19937 random_{3};
  std::normal_distribution<double> normal_;
  Eigen::Vector3d at_m_ = Eigen::Vector3d::Zero();
  double heading_rad_ = 0.0;
};

TEST_F(ImuMountingTest, WhoTurnsOnTheSpotLearnsItOnLevelGroundAndOnARamp) {
  for (const Ground ground : {level, ramp}) {
    mounting_ = ImuMounting();
    const double before_rad = bound_rad();
    walk(ground, 60, 0.0, 0.1);
    EXPECT_LT(off_rad(), 0.005);
    EXPECT_LT(off_rad(), bound_rad());
    EXPECT_LT(bound_rad(), 0.5 * before_rad);
  }
}

TEST_F(ImuMountingTest, WhoGoesStraightLearnsNothingAndTakesNoRampForIt) {
  for (const Ground ground : {level, ramp, hill}) {
    mounting_ = ImuMounting();
    at_m_.setZero();
    walk(ground, 60, 0.1, 0.0);
    EXPECT_LT(mounting_.tilt_rad().norm(), 0.003);
    EXPECT_GT(bound_rad(), 0.025);
  }
}

TEST_F(ImuMountingTest, WhoKnowsItKeepsItOverAHill) {
  walk(level, 60, 0.0, 0.105);
  heading_rad_ = 0.0;
  walk(hill, 60, 0.1, 0.0);
  EXPECT_LT(off_rad(), 0.005);
}

TEST_F(ImuMountingTest, WhoStandsLearnsNothing) {
  walk(ramp, 1, 0.0, 0.0);
  const double bound = bound_rad();
  for (int k = 0; k < 1000; ++k) mounting_.step(Eigen::Quaterniond::Identity(), feet_);
  EXPECT_EQ(bound_rad(), bound);
}

}  // namespace
}  // namespace sprung
