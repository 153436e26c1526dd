#include "estimator/body_filter.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/estimator/trunk_sample.h"
#include "tests/support/allocation_count.h"

namespace sprung {
namespace {

using test::TrunkPose;
using test::TrunkSample;

constexpr double kFilterCycle_s = 0.002;

/// Stands still for a second, then goes in a circle, swaying.
TrunkPose circling(double t) {
  const double s = std::max(0.0, t - 1.0), turned = 0.2 * s;
  return {{std::sin(turned), 1.0 - std::cos(turned), 0.42 + 0.01 * std::sin(9 * s)},
          test::rpy(0.03 * std::sin(7 * s), 0.02 * std::sin(8 * s), turned)};
}

class BodyFilterTest : public testing::Test {
 protected:
  BodyMeasurement measured() {
    BodyMeasurement out;
    const Eigen::Quaterniond true_attitude = trunk_.pose(time_s_).to_world;
    out.by_imu = imu_;
    out.angular_velocity_rad_s = trunk_.angular_velocity_rad_s(time_s_) + noise(0.003);
    if (imu_) {
      out.angular_velocity_rad_s += rate_bias_rad_s_;
      out.specific_force_m_s2 = trunk_.specific_force_m_s2(time_s_) + force_bias_m_s2_ + noise(0.03);
    }
    out.has_up = has_up_;
    out.up = turned_by(noise(0.0005)) * (true_attitude.conjugate() * Eigen::Vector3d::UnitZ());
    return out;
  }
  Eigen::Vector3d noise(double rms) {
    return rms * Eigen::Vector3d(normal_(random_), normal_(random_), normal_(random_));
  }
  void step() {
    time_s_ += kFilterCycle_s;
    if (walks_ && time_s_ >= 1.0) trunk_.trot(time_s_);
    std::vector<EstimatedLeg> legs = trunk_.legs(time_s_);
    for (std::size_t i = 0; i < 4 && sinks_m_N_ > 0.0; ++i) {
      const double stood_s = std::fmod(time_s_ + (i == 0 || i == 3 ? 0.0 : 0.25), 0.5);
      const double load_N = 300.0 * std::clamp(std::min(stood_s, 0.26 - stood_s) / 0.08, 0.1, 1.0);
      legs[i].foot_force_N[2] = load_N;
      legs[i].estimated_foot_in_hip_m[2] -= sinks_m_N_ * load_N;
    }
    if (slides_m_s_ != 0.0) {
      slid_m_ += slides_m_s_ * kFilterCycle_s;
      legs[2].estimated_foot_in_hip_m[1] += slid_m_;
    }
    feet_.update(legs, trunk_.link_rates_rad_s(time_s_), kFilterCycle_s);
    if (filter_.runs()) filter_.step(measured(), feet_, kFilterCycle_s);
  }
  void run(double duration_s) {
    if (!filter_.runs()) filter_.start(trunk_.pose(time_s_).to_world);
    for (double t = 0.0; t < duration_s - 1e-9; t += kFilterCycle_s) step();
  }
  Eigen::Vector3d error_m() const {
    return filter_.position_in_world_m() - (trunk_.pose(time_s_).in_world_m - trunk_.pose(0.0).in_world_m);
  }
  double turned_off_rad() const {
    return filter_.trunk_to_world().angularDistance(trunk_.pose(time_s_).to_world);
  }
  double heading_variance_rad2() const { return filter_.attitude_covariance_rad2()(2, 2); }
  double place_variance_m2() const {
    const Eigen::Matrix3d all = filter_.position_covariance_m2();
    return all(0, 0) + all(1, 1);
  }
  Eigen::Vector3d velocity_error_m_s() const {
    return filter_.velocity_in_trunk_m_s() - trunk_.velocity_m_s(time_s_);
  }

  TrunkSample trunk_{circling};
  StandingFeet feet_{trunk_.robot.legs};
  BodyFilter filter_;
  std::mt19937 random_{5};
  std::normal_distribution<double> normal_;
  Eigen::Vector3d rate_bias_rad_s_{0.002, -0.001, 0.003}, force_bias_m_s2_{0.05, -0.03, 0.04};
  bool imu_ = true, has_up_ = true, walks_ = false;
  double slides_m_s_ = 0.0, slid_m_ = 0.0;
  double sinks_m_N_ = 0.0;
  double time_s_ = 0.0;
};

TEST_F(BodyFilterTest, WayAndHeadingOfACircleAreKnownThoughTheImuHasABiasThatNobodyTold) {
  walks_ = true;
  run(32.0);  // a whole turn, 6.2 m
  EXPECT_LT(error_m().norm(), 0.06);
  EXPECT_LT(turned_off_rad(), 0.01);
  EXPECT_LT(velocity_error_m_s().norm(), 0.02);
  EXPECT_LT((filter_.rate_bias_rad_s() - rate_bias_rad_s_).norm(), 0.001);
  EXPECT_EQ(filter_.slips(), 0);
}

TEST_F(BodyFilterTest, HowFarFeetSinkInIsLearnedAndLiftsNoWorld) {
  for (const double sinks_m_N : {1.0 / 15e3, 1.0 / 60e3}) {
    time_s_ = 1.0;
    filter_ = BodyFilter();
    feet_.reset();
    walks_ = true;
    sinks_m_N_ = sinks_m_N;
    run(20.0);
    EXPECT_NEAR(filter_.sinks_m_N(), sinks_m_N, 0.15 / 30e3);
    const double gone_m = filter_.position_in_world_m().z() - trunk_.pose(time_s_).in_world_m.z() +
                          trunk_.pose(1.0).in_world_m.z();
    EXPECT_NEAR(gone_m, 0.0, 0.01);
  }
}

TEST_F(BodyFilterTest, HeadingAndPlaceAreNeverTakenForSeen) {
  walks_ = true;
  run(5.0);
  double heading_rad2 = heading_variance_rad2(), place_m2 = place_variance_m2();
  for (int k = 0; k < 5; ++k) {
    run(2.0);
    EXPECT_GT(heading_variance_rad2(), heading_rad2);
    EXPECT_GT(place_variance_m2(), place_m2);
    heading_rad2 = heading_variance_rad2();
    place_m2 = place_variance_m2();
  }
}

TEST_F(BodyFilterTest, TiltIsFoundWithoutAnAttitudeFromTheImu) {
  has_up_ = false;
  force_bias_m_s2_.setZero();
  filter_.start(test::rpy(0.05, -0.04, 0.0));
  run(20.0);
  EXPECT_LT(turned_off_rad(), 0.01);
}

TEST_F(BodyFilterTest, WithoutImuFeetAndTheirPlaneTellTheWay) {
  imu_ = false;
  walks_ = true;
  run(17.0);
  EXPECT_LT(error_m().norm(), 0.15);
  EXPECT_EQ(filter_.rate_bias_rad_s().norm(), 0.0);
  EXPECT_EQ(filter_.force_bias_m_s2().norm(), 0.0);
}

/// Its innovation says so: three feet stay, and the IMU agrees with them.
TEST_F(BodyFilterTest, AFootThatSlidesIsFoundAndMovesNobody) {
  run(0.9);
  slides_m_s_ = 0.3;
  for (int k = 0; k < 25; ++k) step();
  slides_m_s_ = 1e-12;
  EXPECT_GE(filter_.slips(), 1);
  run(0.1);
  EXPECT_LT(error_m().norm(), 0.01);  // it slid by 15 mm
  EXPECT_LT(velocity_error_m_s().norm(), 0.03);
}

/// A robot that sits, or hangs from its crane, is still about there when it stands up.
TEST_F(BodyFilterTest, TrunkThatNoFootHoldsForLongStaysAboutWhereItIsAndKnowsHowSurely) {
  run(0.9);
  feet_.reset();
  BodyMeasurement at_rest;
  at_rest.by_imu = at_rest.has_up = true;
  at_rest.angular_velocity_rad_s = rate_bias_rad_s_;
  at_rest.specific_force_m_s2 = Eigen::Vector3d(0.0, 0.0, kGravity_m_s2) + force_bias_m_s2_;
  const double before_m2 = place_variance_m2();
  for (int k = 0; k < 300 * 500; ++k) filter_.step(at_rest, feet_, kFilterCycle_s);  // five minutes
  EXPECT_LT(error_m().norm(), 2.0);
  EXPECT_LT(filter_.velocity_in_world_m_s().norm(), 0.02);
  EXPECT_GT(place_variance_m2() - before_m2, error_m().squaredNorm());
}

TEST_F(BodyFilterTest, AShortFlightIsTheImus) {
  run(0.9);
  feet_.reset();
  BodyMeasurement falls;
  falls.by_imu = true;
  falls.angular_velocity_rad_s = rate_bias_rad_s_;
  falls.specific_force_m_s2 = force_bias_m_s2_;
  for (int k = 0; k < 200; ++k) filter_.step(falls, feet_, kFilterCycle_s);
  EXPECT_NEAR(filter_.velocity_in_world_m_s().z(), -kGravity_m_s2 * 0.4, 0.05);
}

TEST_F(BodyFilterTest, FeetThatRollSayTheSameAsPoints) {
  for (LegConfig& leg : trunk_.robot.legs) leg.foot_radius_m = 0.02;
  trunk_.link_turning_rad_s = {0.2, 1.0, 0.1};  // the balls' centres go at 20 mm/s
  feet_ = StandingFeet(trunk_.robot.legs);
  run(0.9);
  EXPECT_LT(error_m().norm(), 0.005);
  EXPECT_LT(velocity_error_m_s().norm(), 0.01);
}

TEST_F(BodyFilterTest, NewStartGoesOnWhereItWasLessSure) {
  walks_ = true;
  run(10.0);
  const Eigen::Vector3d before_m = filter_.position_in_world_m();
  const double heading_rad = yaw_rad(filter_.trunk_to_world());
  const double doubt_rad2 = heading_variance_rad2();
  const Eigen::Matrix3d place_m2 = filter_.position_covariance_m2();
  filter_.stop();
  EXPECT_FALSE(filter_.runs());
  filter_.start(test::rpy(0.02, 0.0, 2.5));
  EXPECT_EQ(filter_.position_in_world_m(), before_m);
  EXPECT_NEAR(yaw_rad(filter_.trunk_to_world()), heading_rad, 1e-9);
  EXPECT_GT(heading_variance_rad2(), doubt_rad2);
  EXPECT_TRUE(filter_.position_covariance_m2().isApprox(place_m2, 1e-9));
  EXPECT_EQ(filter_.velocity_in_world_m_s().norm(), 0.0);
}

TEST_F(BodyFilterTest, NothingIsAllocatedAndNumbersStayNumbers) {
  run(0.1);
  const BodyMeasurement sample = measured();
  const std::int64_t before = test::allocation_count();
  for (int k = 0; k < 100; ++k) filter_.step(sample, feet_, kFilterCycle_s);
  EXPECT_EQ(test::allocation_count(), before);
  feet_.reset();
  for (int k = 0; k < 50000; ++k) filter_.step(sample, feet_, kFilterCycle_s);  // 100 s in the air
  EXPECT_TRUE(filter_.position_covariance_m2().allFinite());
  EXPECT_TRUE(filter_.position_in_world_m().allFinite());
  EXPECT_NEAR(filter_.trunk_to_world().norm(), 1.0, 1e-12);
}

}  // namespace
}  // namespace sprung
