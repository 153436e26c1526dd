#include "simulation/plant/imu_sensor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung::sim {
namespace {

constexpr double kCycle_s = 0.002;

Stamp at(std::int64_t cycle) { return {2000 * cycle, cycle}; }

BaseMotion turned(double angle_rad, int axis) {
  BaseMotion motion;
  motion.quaternion_wxyz = {std::cos(0.5 * angle_rad), 0, 0, 0};
  motion.quaternion_wxyz[1 + axis] = std::sin(0.5 * angle_rad);
  return motion;
}

void expect_near(const Vec3& found, const Vec3& wanted, double tolerance = 1e-12) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], wanted[i], tolerance) << i;
}

/// Two samples, since specific force is the mean between them.
Imu sampled(ImuSensor& sensor, const BaseMotion& before, const BaseMotion& now) {
  sensor.sample(before, at(0), 0.0);
  sensor.sample(now, at(1), kCycle_s);
  return sensor.newest();
}

TEST(ImuSensor, AtRestReadsGravityUpwardInTheTrunksAxes) {
  ImuSensor sensor({}, 1);
  expect_near(sampled(sensor, {}, {}).measured_specific_force_m_s2, {0, 0, 9.81});
  ImuSensor nose_down({}, 1);  // about +y: the nose goes down, up is partly backward
  const BaseMotion pitched = turned(0.3, 1);
  expect_near(sampled(nose_down, pitched, pitched).measured_specific_force_m_s2,
              {-9.81 * std::sin(0.3), 0, 9.81 * std::cos(0.3)});
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(nose_down.newest().measured_quaternion_wxyz[i], pitched.quaternion_wxyz[i], 1e-15);
  EXPECT_EQ(nose_down.newest().status, ImuStatus::kGood);
}

TEST(ImuSensor, SpecificForceIsTheMeanAccelerationSinceTheLastSample) {
  ImuSensor sensor({}, 1);
  BaseMotion now;
  now.velocity_m_s = {0.004, 0.0, -9.81 * kCycle_s};  // falling, and pushed forward with 2 m/s^2
  expect_near(sampled(sensor, {}, now).measured_specific_force_m_s2, {2.0, 0, 0});
}

TEST(ImuSensor, FirstSampleAndTheOneAfterAResetAreNotGoodYet) {
  ImuSensor sensor({}, 1);
  sensor.sample({}, at(0), 0.0);
  EXPECT_EQ(sensor.newest().status, ImuStatus::kStarting);
  EXPECT_EQ(sensor.newest().stamp.seq, 0);
  sensor.sample({}, at(1), kCycle_s);
  EXPECT_EQ(sensor.newest().status, ImuStatus::kGood);
  sensor.forget_motion();
  sensor.sample({}, at(2), 2 * kCycle_s);
  EXPECT_EQ(sensor.newest().status, ImuStatus::kStarting);
  EXPECT_TRUE(std::isnan(sensor.newest().measured_specific_force_m_s2[2]));
}

TEST(ImuSensor, NoiseHasItsRmsAndBiasStaysForARun) {
  ImuConfig config;
  config.rate_noise_rad_s = 0.01;
  config.force_bias_m_s2 = 0.05;
  ImuSensor sensor(config, 7);
  double squares = 0.0, first_bias = 0.0;
  for (int k = 0; k < 4000; ++k) {
    sensor.sample({}, at(k), k * kCycle_s);
    if (k == 0) continue;
    squares += std::pow(sensor.newest().measured_angular_velocity_rad_s[0], 2);
    if (k == 1) first_bias = sensor.newest().measured_specific_force_m_s2[0];
    ASSERT_NEAR(sensor.newest().measured_specific_force_m_s2[0], first_bias, 1e-12);
  }
  EXPECT_NEAR(std::sqrt(squares / 3999), 0.01, 0.0005);
  EXPECT_NE(first_bias, 0.0);
  ImuSensor other(config, 8);
  EXPECT_NE(sampled(other, {}, {}).measured_specific_force_m_s2[0], first_bias);
}

TEST(ImuSensor, HeadingDriftsAndTiltDoesNot) {
  ImuConfig config;
  config.yaw_drift_rad_s = 0.001;
  ImuSensor sensor(config, 3);
  sensor.sample({}, at(0), 0.0);
  double last = 0.0;
  for (int k = 1; k <= 10; ++k) {
    sensor.sample({}, at(k), k * 10.0);
    const std::array<double, 4>& q = sensor.newest().measured_quaternion_wxyz;
    const double yaw = 2.0 * std::atan2(q[3], q[0]);
    EXPECT_GT(std::abs(yaw), std::abs(last));
    if (k > 1) {
      EXPECT_NEAR(yaw / last, k / (k - 1.0), 1e-9);
    }
    EXPECT_NEAR(q[1], 0.0, 1e-12);
    EXPECT_NEAR(q[2], 0.0, 1e-12);
    last = yaw;
  }
}

TEST(ImuSensor, MountedAskewItShowsMotionInItsOwnAxes) {
  ImuConfig config;
  config.mounting_rad = {0.0, 0.0, M_PI / 2};  // its x looks to the trunk's left
  ImuSensor sensor(config, 1);
  BaseMotion rolling;
  rolling.angular_velocity_rad_s = {1.0, 0.0, 0.0};
  const Imu seen = sampled(sensor, rolling, rolling);
  expect_near(seen.measured_angular_velocity_rad_s, {0.0, -1.0, 0.0});
  expect_near(seen.measured_specific_force_m_s2, {0, 0, 9.81});
  EXPECT_NEAR(seen.measured_quaternion_wxyz[3], std::sqrt(0.5), 1e-12);
  config.mounting_rad = {0.02, -0.01, 0.0};
  ImuSensor tilted(config, 1);
  const Vec3 force = sampled(tilted, {}, {}).measured_specific_force_m_s2;
  EXPECT_NEAR(force[1], 9.81 * std::sin(0.02), 1e-4);
  EXPECT_NEAR(force[0], 9.81 * std::sin(0.01), 1e-3);
}

TEST(ImuSensor, LatencyShowsTheMotionOfBefore) {
  ImuConfig config;
  config.latency_s = 2.5 * kCycle_s;
  ImuSensor sensor(config, 1);
  for (int k = 0; k < 300; ++k) {  // spins up about z with 10 rad/s^2, falls freely
    const double now_s = k * kCycle_s;
    BaseMotion motion = turned(5.0 * now_s * now_s, 2);
    motion.angular_velocity_rad_s = {0.0, 0.0, 10.0 * now_s};
    motion.velocity_m_s = {0.0, 0.0, -9.81 * now_s};
    sensor.sample(motion, at(k), now_s);
    if (k < 4) continue;
    const double then_s = now_s - config.latency_s;
    ASSERT_NEAR(sensor.newest().measured_angular_velocity_rad_s[2], 10.0 * then_s, 1e-9) << k;
    const std::array<double, 4>& q = sensor.newest().measured_quaternion_wxyz;
    ASSERT_NEAR(2.0 * std::atan2(q[3], q[0]), 5.0 * then_s * then_s, 1e-4) << k;
    ASSERT_EQ(sensor.newest().stamp.seq, k) << "and nobody is told";
  }
  sensor.forget_motion();
  sensor.sample({}, at(300), 300 * kCycle_s);
  sensor.sample({}, at(301), 301 * kCycle_s);
  expect_near(sensor.newest().measured_angular_velocity_rad_s, {0, 0, 0});
}

/// Over many seeds the wandering after 4 s is twice that after 1 s.
TEST(ImuSensor, BiasWandersWithTheRootOfTime) {
  ImuConfig config;
  config.rate_walk_rad_s = 0.001;
  double after_1_s = 0.0, after_4_s = 0.0;
  constexpr int kSeeds = 400;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    ImuSensor sensor(config, static_cast<std::uint64_t>(seed));
    for (int k = 0; k <= 400; ++k) {
      sensor.sample({}, at(k), 0.01 * k);
      const double square = std::pow(sensor.newest().measured_angular_velocity_rad_s[0], 2);
      if (k == 100) after_1_s += square / kSeeds;
      if (k == 400) after_4_s += square / kSeeds;
    }
  }
  EXPECT_NEAR(std::sqrt(after_1_s), 0.001, 1e-4);
  EXPECT_NEAR(std::sqrt(after_4_s), 0.002, 2e-4);
}

TEST(ImuSensor, FaultsSilenceItOrTakeWhatTheySay) {
  ImuSensor sensor({}, 1);
  sampled(sensor, {}, {});
  sensor.set_fault(1);
  sensor.sample({}, at(2), 2 * kCycle_s);
  EXPECT_EQ(sensor.newest().stamp.seq, 1);
  sensor.set_fault(2);
  sensor.sample({}, at(3), 3 * kCycle_s);
  EXPECT_EQ(sensor.newest().stamp.seq, 3);
  EXPECT_EQ(sensor.newest().status, ImuStatus::kFault);
  sensor.set_fault(3);
  sensor.sample({}, at(4), 4 * kCycle_s);
  EXPECT_EQ(sensor.newest().status, ImuStatus::kNoAttitude);
  EXPECT_TRUE(std::isnan(sensor.newest().measured_quaternion_wxyz[0]));
  expect_near(sensor.newest().measured_specific_force_m_s2, {0, 0, 9.81});
  sensor.set_fault(0);
  sensor.sample({}, at(5), 5 * kCycle_s);
  EXPECT_EQ(sensor.newest().status, ImuStatus::kGood);
}

}  // namespace
}  // namespace sprung::sim
