#include "estimator/imu_mounting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "estimator/rotation.h"
#include "tests/estimator/trunk_sample.h"

namespace sprung {
namespace {

/// pegasus in a trot, or a crawl, on ground of any shape; its IMU is mounted askew.
class ImuMountingTest : public testing::Test {
 protected:
  using Ground = double (*)(const Eigen::Vector3d& in_world_m);

  static double level(const Eigen::Vector3d&) { return 0.0; }
  static double ramp(const Eigen::Vector3d& at_m) { return 0.1 * at_m.x() - 0.05 * at_m.y(); }
  /// Up from one metre on, level again two metres later.
  static double hill(const Eigen::Vector3d& at_m) { return 0.15 * std::clamp(at_m.x() - 1.0, 0.0, 2.0); }

  using Group = std::vector<std::size_t>;  ///< legs that come down together

  /// A step of each group in turn, the trunk along at the same attitude; in a crawl all others stand.
  void step(Ground ground, double forward_m, double turning_rad) {
    const std::vector<Group> groups = crawls_ ? std::vector<Group>{{2}, {0}, {3}, {1}}
                                              : std::vector<Group>{{0, 3}, {1, 2}};
    for (const Group& group : groups) {
      const double share = 1.0 / static_cast<double>(groups.size());
      heading_rad_ += share * turning_rad;
      at_m_ += turned_about_z(heading_rad_) * Eigen::Vector3d(share * forward_m, 0.0, 0.0);
      const auto in_group = [&](std::size_t leg) {
        return std::find(group.begin(), group.end(), leg) != group.end();
      };
      feel([&](std::size_t leg) { return crawls_ && !in_group(leg); }, 1);
      for (const std::size_t leg : group) {
        foot_m_[leg] = at_m_ + turned_about_z(heading_rad_) * to_eigen(robot_.legs[leg].hip_in_trunk_m);
        foot_m_[leg].z() = ground(foot_m_[leg]) + 0.005 * normal_(random_);
      }
      feel([&](std::size_t leg) { return crawls_ || in_group(leg); }, 30);
    }
  }
  void feel(const std::function<bool(std::size_t leg)>& stands, int cycles) {
    const Eigen::Quaterniond trunk_to_world = turned_about_z(heading_rad_) * test::rpy(0.02, -0.03, 0.0);
    std::vector<EstimatedLeg> legs(4);
    for (std::size_t i = 0; i < 4; ++i) {
      legs[i].contact = stands(i);
      legs[i].contact_confidence = 1.0;
      legs[i].foot_force_N = {0.0, 0.0, 200.0};
      legs[i].estimated_foot_velocity_m_s = {};
      const Eigen::Vector3d in_trunk_m = trunk_to_world.conjugate() *
                                         (foot_m_[i] - at_m_ - Eigen::Vector3d(0.0, 0.0, 0.4));
      legs[i].estimated_foot_in_hip_m = to_vec3(in_trunk_m - to_eigen(robot_.legs[i].hip_in_trunk_m));
    }
    const Eigen::Quaterniond measured = trunk_to_world * turned_by({askew_rad_.x(), askew_rad_.y(), 0.0});
    for (int k = 0; k < cycles; ++k) {
      feet_.update(legs, std::vector<Eigen::Vector3d>(4, Eigen::Vector3d::Zero()), 0.002);
      mounting_.step(measured * mounting_.sensor_to_trunk().conjugate(), feet_);
    }
  }
  void walk(Ground ground, int steps, double forward_m, double turning_rad) {
    for (int k = 0; k < steps; ++k) step(ground, forward_m, turning_rad);
  }
  /// Each footprint is off by millimetres: ten walks, their RMS.
  void learns_by_turning(Ground ground) {
    double squares_rad2 = 0.0;
    for (unsigned seed = 0; seed < 10; ++seed) {
      random_.seed(seed);
      mounting_ = ImuMounting();
      const double before_rad = bound_rad();
      walk(ground, 60, 0.0, 0.1);
      EXPECT_LT(off_rad(), bound_rad()) << seed;
      EXPECT_LT(bound_rad(), 0.5 * before_rad) << seed;
      squares_rad2 += 0.1 * off_rad() * off_rad();
    }
    EXPECT_LT(std::sqrt(squares_rad2), 0.005);
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
  std::array<Eigen::Vector3d, 4> foot_m_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                         Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  double heading_rad_ = 0.0;
  bool crawls_ = false;
};

TEST_F(ImuMountingTest, WhoTurnsOnTheSpotLearnsItOnLevelGroundAndOnARamp) {
  for (const Ground ground : {level, ramp}) learns_by_turning(ground);
}

TEST_F(ImuMountingTest, ACrawlLearnsItAsWellFromFeetThatComeDownAmongThree) {
  crawls_ = true;
  learns_by_turning(ramp);
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
