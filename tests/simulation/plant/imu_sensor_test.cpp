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
