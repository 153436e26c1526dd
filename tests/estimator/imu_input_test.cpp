#include "estimator/imu_input.h"

#include <gtest/gtest.h>

#include "tests/estimator/trunk_sample.h"

namespace sprung {
namespace {

constexpr double kImuInputCycle_s = 0.002;

Imu sample(std::int64_t seq) {
  return test::TrunkSample([](double t) {
           return test::TrunkPose{{0, 0, 0.4}, turned_by({0, 0, 2.0 * t})};
         })
      .imu(kImuInputCycle_s * static_cast<double>(seq), seq);
}

TEST(ImuInput, GoodSampleIsTakenAsItIs) {
  ImuInput input;
  const Imu imu = sample(7);
  const ImuReading* reading = input.update(&imu, 7, kImuInputCycle_s);
  ASSERT_NE(reading, nullptr);
  EXPECT_TRUE(reading->has_attitude);
  EXPECT_NEAR(yaw_rad(reading->attitude), 2.0 * 7 * kImuInputCycle_s, 1e-9);
  EXPECT_NEAR(reading->angular_velocity_rad_s.z(), 2.0, 1e-6);
  EXPECT_NEAR(reading->specific_force_m_s2.z(), 9.81, 1e-6);
}

TEST(ImuInput, OldSampleIsTurnedOnByItsRateAndAfterFiveCyclesSilence) {
  ImuInput input;
  const Imu imu = sample(7);
  ASSERT_NE(input.update(&imu, 7, kImuInputCycle_s), nullptr);
  for (std::int64_t seq = 8; seq <= 12; ++seq) {
    const ImuReading* reading = input.update(seq % 2 == 0 ? nullptr : &imu, seq, kImuInputCycle_s);
    ASSERT_NE(reading, nullptr) << seq;
    EXPECT_NEAR(yaw_rad(reading->attitude), 2.0 * static_cast<double>(seq) * kImuInputCycle_s, 1e-9);
  }
  EXPECT_EQ(input.update(&imu, 13, kImuInputCycle_s), nullptr);
}

TEST(ImuInput, WhatIsKnownToBeLateIsTurnedOnAsWell) {
  ImuInput input(0.005);
  input.reset();
  const Imu imu = sample(7);
  ASSERT_NE(input.update(&imu, 7, kImuInputCycle_s), nullptr);
  const ImuReading* reading = input.update(nullptr, 8, kImuInputCycle_s);
  ASSERT_NE(reading, nullptr);
  EXPECT_NEAR(yaw_rad(reading->attitude), 2.0 * (7 * kImuInputCycle_s + 0.007), 1e-9);
}

TEST(ImuInput, SampleThatIsAheadIsTurnedBack) {
  ImuInput input;
  const Imu imu = sample(9);
  const ImuReading* reading = input.update(&imu, 8, kImuInputCycle_s);
  ASSERT_NE(reading, nullptr);
  EXPECT_NEAR(yaw_rad(reading->attitude), 2.0 * 8 * kImuInputCycle_s, 1e-9);
}

/// A silent IMU says the same whether its last sample comes again, nothing comes, or its driver says that it
/// starts.
TEST(ImuInput, StartingIsNoSample) {
  ImuInput input, other;
  const Imu imu = sample(7);
  Imu starting;
  starting.stamp.seq = 8;
  EXPECT_EQ(input.update(&starting, 8, kImuInputCycle_s), nullptr);
  ASSERT_NE(input.update(&imu, 7, kImuInputCycle_s), nullptr);
  ASSERT_NE(other.update(&imu, 7, kImuInputCycle_s), nullptr);
  const ImuReading* a = input.update(&starting, 8, kImuInputCycle_s);
  const ImuReading* b = other.update(&imu, 8, kImuInputCycle_s);
  ASSERT_NE(a, nullptr);
  EXPECT_EQ(a->attitude.coeffs(), b->attitude.coeffs());
}

TEST(ImuInput, FaultIsNoSampleAtOnce) {
  ImuInput input;
  Imu imu = sample(7);
  ASSERT_NE(input.update(&imu, 7, kImuInputCycle_s), nullptr);
  imu = sample(8);
  imu.status = ImuStatus::kFault;
  EXPECT_EQ(input.update(&imu, 8, kImuInputCycle_s), nullptr);
}

TEST(ImuInput, WithoutAttitudeRatesAndForceAreLeft) {
  ImuInput input;
  Imu imu = sample(7);
  imu.status = ImuStatus::kNoAttitude;
  const ImuReading* reading = input.update(&imu, 7, kImuInputCycle_s);
  ASSERT_NE(reading, nullptr);
  EXPECT_FALSE(reading->has_attitude);
}

TEST(ImuInput, NumbersThatCannotBeAreNotUsed) {
  ImuInput input;
  Imu imu = sample(7);
  imu.measured_quaternion_wxyz = {0, 0, 0, 0};
  const ImuReading* reading = input.update(&imu, 7, kImuInputCycle_s);
  ASSERT_NE(reading, nullptr);
  EXPECT_FALSE(reading->has_attitude);
  imu.measured_quaternion_wxyz[2] = kNaN;
  EXPECT_FALSE(input.update(&imu, 7, kImuInputCycle_s)->has_attitude);
  imu.measured_angular_velocity_rad_s[1] = kNaN;
  EXPECT_EQ(input.update(&imu, 7, kImuInputCycle_s), nullptr);
}

TEST(ImuInput, NothingIsHeldOverAReset) {
  ImuInput input;
  const Imu imu = sample(7);
  ASSERT_NE(input.update(&imu, 7, kImuInputCycle_s), nullptr);
  input.reset();
  EXPECT_EQ(input.update(nullptr, 8, kImuInputCycle_s), nullptr);
}

}  // namespace
}  // namespace sprung
