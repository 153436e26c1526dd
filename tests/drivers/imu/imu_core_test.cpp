#include "drivers/imu/imu_core.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "tests/drivers/imu/xbus_bytes.h"

namespace sprung::imu {
namespace {

constexpr double kImuCycle_s = 0.002;
constexpr double kQuarter_rad = 1.5707963267948966;

ImuDriverConfig config() {
  ImuDriverConfig out;
  out.device = "/dev/null";
  out.range_rad_s = 30.0;
  out.range_m_s2 = 150.0;
  out.longest_silence_s = 0.01;
  return out;
}

class ImuCoreTest : public testing::Test {
 protected:
  void start(const ImuDriverConfig& with) {
    core_ = std::make_unique<ImuCore>(with, kImuCycle_s);
    core_->cycle({1'000'000, 500});
  }
  void SetUp() override { start(config()); }
  /// @return whether a sample came of it.
  bool feed(const test::Bytes& bytes, std::int64_t time_us = 1'000'000) {
    bool any = false;
    for (const std::uint8_t byte : bytes) any = core_->take(byte, time_us, imu_) || any;
    return any;
  }
  void expect_vector(const Vec3& found, double x, double y, double z) const {
    EXPECT_NEAR(found[0], x, 1e-6);
    EXPECT_NEAR(found[1], y, 1e-6);
    EXPECT_NEAR(found[2], z, 1e-6);
  }

  std::unique_ptr<ImuCore> core_;
  test::XbusSample sample_;
  Imu imu_;
};

TEST_F(ImuCoreTest, SampleHasItsNumbersAndItsCycle) {
  ASSERT_TRUE(feed(sample_.bytes(), 1'000'300));
  EXPECT_EQ(imu_.status, ImuStatus::kGood);
  EXPECT_EQ(imu_.stamp.seq, 500);
  EXPECT_EQ(imu_.stamp.utime_us, 1'000'300);
  expect_vector(imu_.measured_angular_velocity_rad_s, 0.1, 0.2, 0.3);
  expect_vector(imu_.measured_specific_force_m_s2, 0.0, 0.0, 9.81);
  EXPECT_NEAR(imu_.measured_quaternion_wxyz[0], 1.0, 1e-9);
}

TEST_F(ImuCoreTest, CycleIsTheOneNearestToTheMeasurement) {
  ImuDriverConfig late = config();
  late.latency_s = 0.004;
  start(late);
  ASSERT_TRUE(feed(sample_.bytes(), 1'004'100));
  EXPECT_EQ(imu_.stamp.seq, 500);
  EXPECT_EQ(imu_.stamp.utime_us, 1'000'100);
  ASSERT_TRUE(feed(sample_.bytes(), 1'007'300));
  EXPECT_EQ(imu_.stamp.seq, 502);
}

TEST_F(ImuCoreTest, FasterSensorGivesOneSampleACycle) {
  EXPECT_TRUE(feed(sample_.bytes(), 1'000'000));
  EXPECT_FALSE(feed(sample_.bytes(), 1'000'500));
  EXPECT_TRUE(feed(sample_.bytes(), 1'001'500));
  EXPECT_EQ(core_->counters().surplus, 1);
  EXPECT_EQ(core_->counters().samples, 2);
}

TEST_F(ImuCoreTest, BeforeTheFirstCycleThereIsNothingToGive) {
  ImuCore fresh(config(), kImuCycle_s);
  for (const std::uint8_t byte : sample_.bytes()) EXPECT_FALSE(fresh.take(byte, 5, imu_));
  EXPECT_FALSE(fresh.watch(1'000'000, imu_));
}

// A sensor that was turned by a quarter about z: its x is the trunk's y.
TEST_F(ImuCoreTest, MountingTurnsEverythingIntoTrunkAxes) {
  ImuDriverConfig turned = config();
  turned.mounting_yaw_rad = kQuarter_rad;
  start(turned);
  sample_.rate = {1.0F, 0.0F, 0.0F};
  sample_.force = {0.0F, 2.0F, 9.0F};
  ASSERT_TRUE(feed(sample_.bytes()));
  expect_vector(imu_.measured_angular_velocity_rad_s, 0.0, 1.0, 0.0);
  expect_vector(imu_.measured_specific_force_m_s2, -2.0, 0.0, 9.0);
  // The sensor's axes are the world's, so the trunk is turned back by a quarter.
  EXPECT_NEAR(imu_.measured_quaternion_wxyz[0], std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(imu_.measured_quaternion_wxyz[3], -std::sqrt(0.5), 1e-6);
}

// Upside down under the trunk: the force that holds it up comes from the sensor's -z.
TEST_F(ImuCoreTest, SensorThatHangsUpsideDownMeasuresUpAsUp) {
  ImuDriverConfig hanging = config();
  hanging.mounting_roll_rad = 2 * kQuarter_rad;
  start(hanging);
  sample_.force = {0.0F, 0.0F, -9.81F};
  sample_.quaternion = {0.0F, 1.0F, 0.0F, 0.0F};
  ASSERT_TRUE(feed(sample_.bytes()));
  expect_vector(imu_.measured_specific_force_m_s2, 0.0, 0.0, 9.81);
  EXPECT_NEAR(std::abs(imu_.measured_quaternion_wxyz[0]), 1.0, 1e-6);
}

TEST_F(ImuCoreTest, AttitudeThatIsMissingInvalidOrUpsideDownIsNone) {
  test::XbusSample none = sample_, invalid = sample_, down = sample_, broken = sample_;
  none.quaternion.clear();
  invalid.status = 0x1;
  down.quaternion_id = 0x2014;
  broken.quaternion[2] = std::numeric_limits<float>::quiet_NaN();
  std::int64_t time_us = 1'000'000;
  for (const test::XbusSample& sample : {none, invalid, down, broken}) {
    ASSERT_TRUE(feed(sample.bytes(), time_us += 2000));
    EXPECT_EQ(imu_.status, ImuStatus::kNoAttitude);
    EXPECT_TRUE(std::isnan(imu_.measured_quaternion_wxyz[0]));
    expect_vector(imu_.measured_angular_velocity_rad_s, 0.1, 0.2, 0.3);
  }
}

TEST_F(ImuCoreTest, ClippedNumbersAreAFaultAndCounted) {
  test::XbusSample rate = sample_, force = sample_, said = sample_;
  rate.rate[1] = -35.0F;
  force.force[0] = 157.0F;
  said.status |= 1U << 12;
  std::int64_t time_us = 1'000'000;
  for (const test::XbusSample& sample : {rate, force, said}) {
    ASSERT_TRUE(feed(sample.bytes(), time_us += 2000));
    EXPECT_EQ(imu_.status, ImuStatus::kFault);
    EXPECT_TRUE(std::isnan(imu_.measured_angular_velocity_rad_s[0]));
  }
  EXPECT_EQ(core_->counters().clipped, 3);
}

TEST_F(ImuCoreTest, NumberThatIsNoneIsAFault) {
  sample_.force[2] = std::numeric_limits<float>::infinity();
  ASSERT_TRUE(feed(sample_.bytes()));
  EXPECT_EQ(imu_.status, ImuStatus::kFault);
  EXPECT_EQ(core_->counters().not_finite, 1);
}

TEST_F(ImuCoreTest, MessageWithoutRateOrForceIsNoSample) {
  sample_.rate.clear();
  EXPECT_FALSE(feed(sample_.bytes()));
  EXPECT_EQ(core_->counters().incomplete, 1);
}

TEST_F(ImuCoreTest, LostMessagesAreCountedOverTheCountersEnd) {
  for (const int counter : {65534, 65535, 0, 3}) {
    sample_.counter = static_cast<std::uint16_t>(counter);
    feed(sample_.bytes());
  }
  EXPECT_EQ(core_->counters().lost, 2);
}

TEST_F(ImuCoreTest, SilenceIsSaidOnceACycleAndEndsWithTheNextSample) {
  EXPECT_FALSE(core_->watch(1'000'000, imu_));
  ASSERT_TRUE(feed(sample_.bytes(), 1'000'000));
  EXPECT_FALSE(core_->watch(1'010'000, imu_));
  core_->cycle({1'010'000, 505});
  ASSERT_TRUE(core_->watch(1'010'500, imu_));
  EXPECT_EQ(imu_.status, ImuStatus::kFault);
  EXPECT_EQ(imu_.stamp.seq, 505);
  EXPECT_FALSE(core_->watch(1'011'000, imu_)) << "once a cycle";
  core_->cycle({1'012'000, 506});
  EXPECT_TRUE(core_->watch(1'012'500, imu_));
  EXPECT_TRUE(core_->silent());
  EXPECT_EQ(core_->counters().silences, 1);
  core_->cycle({1'014'000, 507});
  ASSERT_TRUE(feed(sample_.bytes(), 1'014'000));
  EXPECT_EQ(imu_.status, ImuStatus::kGood);
  EXPECT_FALSE(core_->silent());
}

TEST_F(ImuCoreTest, BytesWithoutAMessageAreNamed) {
  EXPECT_FALSE(core_->not_understood(0));
  const test::Bytes noise(500, 0x55);
  feed(noise);
  EXPECT_FALSE(core_->not_understood(500'000)) << "judged over a second";
  EXPECT_TRUE(core_->not_understood(1'000'000));
  feed(sample_.bytes());
  EXPECT_FALSE(core_->not_understood(2'000'000));
}

TEST_F(ImuCoreTest, OtherMessagesAreNoSamples) {
  EXPECT_FALSE(feed({0xFA, 0xFF, 0x3E, 0x00, 0xC3}));
  EXPECT_EQ(core_->line().messages, 1);
}

}  // namespace
}  // namespace sprung::imu
