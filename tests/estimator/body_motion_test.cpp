#include <gtest/gtest.h>

#include "estimator/body_estimator.h"
#include "tests/estimator/trunk_sample.h"

namespace sprung {
namespace {

using test::TrunkPose;
using test::TrunkSample;

TrunkPose pushed(double t) {
  return {{0.05 * std::sin(6 * t), 0.03 * std::sin(9 * t), 0.42 + 0.02 * std::sin(12 * t)},
          test::rpy(0.05 * std::sin(6 * t), 0.04 * std::sin(8 * t), 0.1 * std::sin(2 * t))};
}

class BodyMotionTest : public testing::Test {
 protected:
  void step(bool imu) {
    time_s_ += 0.002;
    ++seq_;
    feet_.update(trunk_.legs(time_s_), trunk_.link_rates_rad_s(time_s_), 0.002);
    Imu sample = trunk_.imu(time_s_, seq_);
    for (std::size_t i = 0; i < 3; ++i) sample.measured_specific_force_m_s2[i] += force_bias_m_s2_[i];
    motion_.step(imu ? imu_.update(&sample, seq_, 0.002) : nullptr,
                 {trunk_.pose(time_s_).to_world, trunk_.angular_velocity_rad_s(time_s_)}, feet_, 0.002);
  }
  void run(bool imu, double duration_s) {
    for (double t = 0; t < duration_s; t += 0.002) step(imu);
  }
  Eigen::Vector3d error_m_s() const { return motion_.velocity_m_s() - trunk_.velocity_m_s(time_s_); }
  double rms_m_s(bool imu, double duration_s) {
    double sum = 0.0;
    int n = 0;
    for (double t = 0; t < duration_s; t += 0.002, ++n) {
      step(imu);
      sum += error_m_s().squaredNorm();
    }
    return std::sqrt(sum / n);
  }

  TrunkSample trunk_{pushed};
  StandingFeet feet_{trunk_.robot.legs};
  ImuInput imu_;
  BodyMotion motion_;
  double time_s_ = 0.0;
  std::int64_t seq_ = 0;
  Vec3 force_bias_m_s2_{};
};

TEST_F(BodyMotionTest, NothingIsKnownBeforeAFootStands) {
  trunk_.stands = {false, false, false, false};
  run(true, 0.2);
  EXPECT_FALSE(motion_.known());
  trunk_.stands = {true, false, false, false};
  run(true, 0.05);
  EXPECT_TRUE(motion_.known());
}

TEST_F(BodyMotionTest, StandingFeetGiveVelocityAndHeightWithAndWithoutImu) {
  for (const bool imu : {true, false}) {
    motion_.reset();
    run(imu, 0.5);
    EXPECT_LT(rms_m_s(imu, 2.0), imu ? 0.005 : 0.03) << imu;
    EXPECT_NEAR(motion_.height_m(), trunk_.height_m(time_s_), 0.002) << imu;
  }
}

TEST_F(BodyMotionTest, NoiseOfTheFeetIsSmoothed) {
  trunk_.foot_noise_m_s = 0.1;
  run(true, 0.5);
  EXPECT_LT(rms_m_s(true, 2.0), 0.015);
  EXPECT_LT(rms_m_s(false, 2.0), 0.05);
}

/// Without it 0.4 s of flight are 28 mm/s.
TEST_F(BodyMotionTest, BiasOfTheSpecificForceIsLearnedFromFeetThatStandAndKnownInAFlight) {
  force_bias_m_s2_ = {0.05, -0.04, 0.03};
  run(true, 30.0);
  EXPECT_LT(rms_m_s(true, 2.0), 0.005);  // 0.008 without
  trunk_.stands = {false, false, false, false};
  run(true, 0.4);
  ASSERT_TRUE(motion_.known());
  EXPECT_LT(error_m_s().norm(), 0.01);
}

TEST_F(BodyMotionTest, AfterAResetNoBiasIsKnown) {
  force_bias_m_s2_ = {0.2, 0.0, 0.0};
  run(true, 30.0);
  force_bias_m_s2_ = {};
  motion_.reset();
  run(true, 0.2);
  trunk_.stands = {false, false, false, false};
  run(true, 0.2);
  EXPECT_LT(error_m_s().norm(), 0.01);
}

/// What is beyond drives the velocity in a flight: nobody takes five for a bias.
TEST_F(BodyMotionTest, BiasIsNoMoreThanATiltAndASensorMakeWhateverTheFeetSay) {
  force_bias_m_s2_ = {5.0, 0.0, 0.0};
  run(true, 30.0);
  const double before_m_s = error_m_s().x();
  trunk_.stands = {false, false, false, false};
  run(true, 0.2);
  EXPECT_NEAR(error_m_s().x() - before_m_s, (5.0 - 0.3) * 0.2, 0.15);
}

TEST_F(BodyMotionTest, AShortFlightIsBridgedByTheImuAndALongOneIsNotKnown) {
  run(true, 0.5);
  trunk_.stands = {false, false, false, false};
  run(true, 0.3);
  ASSERT_TRUE(motion_.known());
  EXPECT_LT(error_m_s().norm(), 0.03);
  EXPECT_NEAR(motion_.height_m(), trunk_.pose(time_s_).in_world_m.z(), 0.005);
  run(true, 0.21);
  EXPECT_FALSE(motion_.known());
  trunk_.stands = {true, true, true, true};
  run(true, 0.1);
  EXPECT_TRUE(motion_.known());
  EXPECT_LT(error_m_s().norm(), 0.01);
}

TEST_F(BodyMotionTest, WithoutImuAFlightKeepsTheLastVelocityForAsLong) {
  run(false, 0.5);
  const double before = motion_.velocity_m_s().norm();
  trunk_.stands = {false, false, false, false};
  run(false, 0.4);
  ASSERT_TRUE(motion_.known());
  EXPECT_NEAR(motion_.velocity_m_s().norm(), before, 1e-12);
  run(false, 0.12);
  EXPECT_FALSE(motion_.known());
}

TEST_F(BodyMotionTest, FeetThatRollSayTheSameAsPoints) {
  const auto velocity_m_s = [this] {
    time_s_ = 0.0;
    seq_ = 0;
    motion_.reset();
    feet_.reset();
    run(false, 0.5);
    return motion_.velocity_m_s();
  };
  const Eigen::Vector3d points_m_s = velocity_m_s();
  for (LegConfig& leg : trunk_.robot.legs) leg.foot_radius_m = 0.02;
  trunk_.link_turning_rad_s = {0.4, 2.0, 0.1};  // the balls' centres go at 40 mm/s
  EXPECT_GT((velocity_m_s() - points_m_s).norm(), 0.03) << "whoever takes them for points";
  feet_ = StandingFeet(trunk_.robot.legs);
  EXPECT_LT((velocity_m_s() - points_m_s).norm(), 1e-6);
}

TEST_F(BodyMotionTest, AFootThatSlidesCountsLess) {
  run(true, 0.5);
  for (int k = 0; k < 100; ++k) {
    time_s_ += 0.002;
    ++seq_;
    std::vector<EstimatedLeg> legs = trunk_.legs(time_s_);
    legs[2].estimated_foot_velocity_m_s[1] += 1.0;
    feet_.update(legs, trunk_.link_rates_rad_s(time_s_), 0.002);
    const Imu sample = trunk_.imu(time_s_, seq_);
    motion_.step(imu_.update(&sample, seq_, 0.002),
                 {trunk_.pose(time_s_).to_world, trunk_.angular_velocity_rad_s(time_s_)}, feet_, 0.002);
  }
  EXPECT_LT(error_m_s().norm(), 0.05);  // a plain mean would be 0.25 m/s off
}

TEST_F(BodyMotionTest, SteppingOntoAnotherHeightMakesNoJumpOfTheHeight) {
  trunk_.stands = {true, true, true, false};
  trunk_.feet_in_world_m[3].z() = 0.04;
  run(true, 0.5);
  const double before = motion_.height_m() - trunk_.pose(time_s_).in_world_m.z();
  trunk_.stands[3] = true;
  double last = motion_.height_m(), longest = 0.0;
  for (int k = 0; k < 200; ++k) {
    step(true);
    longest = std::max(longest, std::abs(motion_.height_m() - last));
    last = motion_.height_m();
  }
  EXPECT_NEAR(motion_.height_m() - trunk_.pose(time_s_).in_world_m.z() - before, -0.01, 0.001);
  EXPECT_LT(longest, 0.0012);  // the trunk itself moves by 0.0005 in a cycle
}

}  // namespace
}  // namespace sprung
