#include "estimator/body_attitude.h"

#include <gtest/gtest.h>

#include <optional>

#include "tests/estimator/trunk_sample.h"

namespace sprung {
namespace {

using test::angle_rad;
using test::TrunkPose;
using test::TrunkSample;

constexpr double kDegree = M_PI / 180.0;
enum class Source { kAttitude, kRates, kNone };

TrunkPose swaying(double t) {
  return {{0.1 * std::sin(2 * t), 0, 0.4},
          test::rpy(0.08 * std::sin(3 * t), 0.05 + 0.05 * std::sin(5 * t), 0.5 + 0.2 * t)};
}

class BodyAttitudeTest : public testing::Test {
 protected:
  void step(Source source) {
    time_s_ += 0.002;
    ++seq_;
    feet_.update(trunk_.legs(time_s_), trunk_.link_rates_rad_s(time_s_), 0.002);
    Imu sample = trunk_.imu(time_s_, seq_, imu_yaw_rad_);
    if (source == Source::kRates) sample.status = ImuStatus::kNoAttitude;
    const ImuReading* reading = source == Source::kNone ? nullptr : imu_.update(&sample, seq_, 0.002);
    const std::optional<Eigen::Quaterniond> before = attitude_.known()
                                                         ? std::optional(attitude_.trunk_to_world())
                                                         : std::nullopt;
    attitude_.step(reading, feet_, 0.002);
    if (before)
      longest_jump_rad_ = std::max(longest_jump_rad_, angle_rad(*before, attitude_.trunk_to_world()));
  }
  void run(Source source, double duration_s) {
    for (double t = 0; t < duration_s; t += 0.002) step(source);
  }
  /// With the heading of the first sample taken off.
  double error_rad(double start_yaw_rad = 0.5 + 0.2 * 0.002) const {
    return angle_rad(turned_about_z(-start_yaw_rad) * trunk_.pose(time_s_).to_world,
                     attitude_.trunk_to_world());
  }
  double tilt_error_rad() const {
    const Eigen::Vector3d up = trunk_.pose(time_s_).to_world.conjugate() * Eigen::Vector3d::UnitZ();
    return std::acos(std::min(1.0, (attitude_.trunk_to_world() * up).z()));
  }

  TrunkSample trunk_{swaying};
  StandingFeet feet_{trunk_.robot.legs};
  ImuInput imu_;
  BodyAttitude attitude_;
  double time_s_ = 0.0;
  double imu_yaw_rad_ = 0.0;
  std::int64_t seq_ = 0;
  double longest_jump_rad_ = 0.0;
};

TEST_F(BodyAttitudeTest, ImusAttitudeIsUsedWithHeadingFromTheFirstSample) {
  imu_yaw_rad_ = 1.0;
  step(Source::kAttitude);
  ASSERT_TRUE(attitude_.known());
  EXPECT_NEAR(yaw_rad(attitude_.trunk_to_world()), 0.0, 1e-12);
  run(Source::kAttitude, 2.0);
  EXPECT_LT(error_rad(), 1e-3);
  EXPECT_NEAR((attitude_.angular_velocity_rad_s() - trunk_.angular_velocity_rad_s(time_s_)).norm(), 0.0,
              1e-6);
}

TEST_F(BodyAttitudeTest, NoiseOfAnImusAttitudeIsSmoothedWithItsRates) {
  constexpr double kNoise_rad = 1e-3;
  run(Source::kAttitude, 0.5);
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  double worst_rad = 0.0;
  for (int k = 0; k < 200; ++k) {
    ImuReading noisy;
    noisy.has_attitude = true;
    noisy.angular_velocity_rad_s.setZero();
    noisy.attitude = Eigen::AngleAxisd(k % 2 == 0 ? kNoise_rad : -kNoise_rad, axis);
    const Eigen::Quaterniond before = attitude_.trunk_to_world();
    attitude_.step(&noisy, feet_, 0.002);
    if (k >= 150) worst_rad = std::max(worst_rad, angle_rad(before, attitude_.trunk_to_world()));
  }
  EXPECT_LT(worst_rad, 0.05 * 2.0 * kNoise_rad);
}

TEST_F(BodyAttitudeTest, RatesAndGravityGiveTheAttitudeToHalfADegree) {
  step(Source::kRates);
  ASSERT_TRUE(attitude_.known());
  EXPECT_NEAR(yaw_rad(attitude_.trunk_to_world()), 0.0, 1e-12);
  double worst_rad = 0.0;
  run(Source::kRates, 3.0);
  for (int k = 0; k < 1000; ++k) {
    step(Source::kRates);
    worst_rad = std::max(worst_rad, tilt_error_rad());
  }
  // Swaying with 0.4 m/s^2 turns the specific force by 40 mrad; the filter leaves a quarter of it.
  EXPECT_LT(worst_rad, 0.02);
}

TEST_F(BodyAttitudeTest, SpecificForceThatIsNotGravityTellsNoDirection) {
  step(Source::kRates);
  trunk_ = TrunkSample([](double t) {  // falls forward and down
    return TrunkPose{{3.0 * t * t, 0, 0.4 - 3.0 * t * t}, swaying(0.002).to_world};
  });
  run(Source::kRates, 1.0);
  EXPECT_LT(tilt_error_rad(), 0.01);
}

TEST_F(BodyAttitudeTest, InFreeFallRatesAloneGiveNoStart) {
  trunk_ = TrunkSample([](double t) {
    return TrunkPose{{0, 0, 0.4 - 4.9 * t * t}, Eigen::Quaterniond::Identity()};
  });
  step(Source::kRates);
  EXPECT_FALSE(attitude_.known());
}

TEST_F(BodyAttitudeTest, WithoutImuThreeFeetThatStandGiveTheTilt) {
  trunk_.stands = {true, true, false, false};
  run(Source::kNone, 0.2);
  EXPECT_FALSE(attitude_.known());
  trunk_.stands = {true, true, true, false};
  run(Source::kNone, 0.2);
  ASSERT_TRUE(attitude_.known());
  run(Source::kNone, 3.0);
  EXPECT_LT(tilt_error_rad(), 0.1 * kDegree);
}

TEST_F(BodyAttitudeTest, WithoutImuHeadingFollowsTheFeetToo) {
  run(Source::kNone, 0.1);
  const double start = yaw_rad(trunk_.pose(time_s_).to_world) - yaw_rad(attitude_.trunk_to_world());
  run(Source::kNone, 3.0);
  EXPECT_NEAR(yaw_rad(trunk_.pose(time_s_).to_world) - yaw_rad(attitude_.trunk_to_world()), start,
              0.5 * kDegree);
  EXPECT_NEAR((attitude_.angular_velocity_rad_s() - trunk_.angular_velocity_rad_s(time_s_)).norm(), 0.0,
              0.03);
}

TEST_F(BodyAttitudeTest, WithoutImuASlopeIsTakenForLevel) {
  for (Eigen::Vector3d& foot : trunk_.feet_in_world_m) foot.z() = 0.1 * foot.x();
  trunk_ = [this] {
    TrunkSample sloping([](double) { return TrunkPose{{0, 0, 0.4}, Eigen::Quaterniond::Identity()}; });
    sloping.feet_in_world_m = trunk_.feet_in_world_m;
    return sloping;
  }();
  run(Source::kNone, 0.5);
  EXPECT_NEAR(tilt_rad(attitude_.trunk_to_world()), std::atan(0.1), 1e-3);
}

/// The trot: each pair of feet shows what the other cannot, so that the error is what the trunk does about
/// the line of the feet within one step, 0.28 rad/s for 0.25 s, and does not grow.
TEST_F(BodyAttitudeTest, WithoutImuDiagonalPairsInTurnHoldTheTilt) {
  run(Source::kNone, 0.5);
  for (int k = 0; k < 40; ++k) {
    const bool even = k % 2 == 0;
    trunk_.stands = {even, !even, !even, even};
    for (int n = 0; n < 125; ++n) {
      step(Source::kNone);
      ASSERT_LT(tilt_error_rad(), 0.1) << k;
    }
  }
}

TEST_F(BodyAttitudeTest, WithNoFootAndNoImuTheAttitudeStaysAndTheRateFades) {
  run(Source::kNone, 0.5);
  const Eigen::Quaterniond before = attitude_.trunk_to_world();
  trunk_.stands = {false, false, false, false};
  run(Source::kNone, 1.0);
  EXPECT_LT(attitude_.angular_velocity_rad_s().norm(), 1e-3);
  EXPECT_LT(angle_rad(before, attitude_.trunk_to_world()), 0.06);
}

TEST_F(BodyAttitudeTest, ImuThatComesAndGoesMakesNoJump) {
  trunk_.feet_in_world_m[0].z() = 0.02;  // so that feet and IMU do not agree
  run(Source::kAttitude, 0.5);
  run(Source::kNone, 1.0);
  const double off_rad = tilt_error_rad();
  EXPECT_GT(off_rad, 0.5 * kDegree);
  imu_yaw_rad_ = -2.0;  // it was started anew
  run(Source::kAttitude, 2.0);
  EXPECT_LT(tilt_error_rad(), 1e-3);
  run(Source::kRates, 0.5);
  run(Source::kAttitude, 0.5);
  EXPECT_LT(error_rad(), 1.0 * kDegree);
  EXPECT_LT(longest_jump_rad_, 0.002);  // the trunk itself turns by 0.001 in a cycle
}

TEST_F(BodyAttitudeTest, HeadingGoesOnOverAReset) {
  run(Source::kAttitude, 3.0);
  const double yaw = yaw_rad(attitude_.trunk_to_world());
  ASSERT_GT(yaw, 0.5);
  attitude_.reset();
  EXPECT_FALSE(attitude_.known());
  step(Source::kAttitude);
  EXPECT_NEAR(yaw_rad(attitude_.trunk_to_world()), yaw, 0.002);
}

}  // namespace
}  // namespace sprung
