#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "estimator/imu_input.h"
#include "tests/estimator/trunk_sample.h"

namespace sprung {
namespace {

constexpr double kImuWatchCycle_s = 0.002;

class ImuWatchTest : public testing::Test {
 protected:
  /// Of a trunk that sways by 0.3 rad, once in a second, with the noise of a cheap sensor.
  Imu next() {
    ++seq_;
    const double t = kImuWatchCycle_s * static_cast<double>(seq_);
    Imu imu = test::TrunkSample([](double at_s) {
                return test::TrunkPose{{0, 0, 0.4}, turned_by({0.3 * std::sin(6.28 * at_s), 0, 0})};
              }).imu(t, seq_);
    for (double& rate : imu.measured_angular_velocity_rad_s) rate += 0.01 * noise_(random_);
    for (double& force : imu.measured_specific_force_m_s2) force += 0.05 * noise_(random_);
    return imu;
  }
  bool trusts(const Imu& imu) { return watch_.trusts(imu, kImuWatchCycle_s); }
  void follow(int samples) {
    for (int i = 0; i < samples; ++i) ASSERT_TRUE(trusts(next())) << "sample " << i;
  }
  /// @return samples until it is believed again.
  int distrusted() {
    int count = 0;
    while (count < 1000 && !trusts(next())) ++count;
    return count;
  }

  ImuWatch watch_;
  std::int64_t seq_ = 0;
  std::mt19937_64 random_{5};
  std::normal_distribution<> noise_;
};

TEST_F(ImuWatchTest, FollowsATrunkThatSways) { follow(2000); }

TEST_F(ImuWatchTest, SpikeIsNotFollowedNorWhatComesRightAfterIt) {
  follow(100);
  Imu spike = next();
  spike.measured_angular_velocity_rad_s[0] += 10.0;
  EXPECT_FALSE(trusts(spike));
  EXPECT_EQ(distrusted(), kAgree_samples);
}

TEST_F(ImuWatchTest, AttitudeThatItsRatesDenyIsNotFollowed) {
  follow(120);
  Imu tilted = next();
  const Eigen::Quaterniond q = turned_by({0.0, 0.2, 0.0});
  tilted.measured_quaternion_wxyz = {q.w(), q.x(), q.y(), q.z()};
  EXPECT_FALSE(trusts(tilted));
}

/// The sensor's attitude filter hangs, its gyro does not; or the other way round.
TEST_F(ImuWatchTest, HalfASensorThatHangsIsNoticedWhileTheTrunkTurnsAtMoreThanHalfARadianPerSecond) {
  for (const bool attitude_hangs : {true, false}) {
    watch_.reset();
    follow(100);
    const Imu hung = next();
    int samples = 0;
    for (bool trusted = true; trusted && samples < 250; ++samples) {
      Imu imu = next();
      if (attitude_hangs) {
        imu.measured_quaternion_wxyz = hung.measured_quaternion_wxyz;
      } else {
        for (double& rate : imu.measured_angular_velocity_rad_s) rate = 0.01 * noise_(random_);
      }
      trusted = trusts(imu);
    }
    EXPECT_LE(kImuWatchCycle_s * samples, 0.15) << attitude_hangs;
  }
}

TEST_F(ImuWatchTest, OffsetOfAGyroIsNotFollowedForLong) {
  follow(100);
  int followed = 0;
  for (int i = 0; i < 500; ++i) {
    Imu imu = next();
    imu.measured_angular_velocity_rad_s[1] += 3.0;
    followed += trusts(imu) ? 1 : 0;
  }
  EXPECT_LE(kImuWatchCycle_s * followed, 0.1);
}

TEST_F(ImuWatchTest, AttitudeThatLagsBehindAndAScaleAreFollowed) {
  Imu late[6];
  for (int i = 0; i < 2000; ++i) {
    Imu imu = next();
    const auto now = imu.measured_quaternion_wxyz;
    imu.measured_quaternion_wxyz = i < 5 ? now : late[i % 5].measured_quaternion_wxyz;  // 10 ms
    late[i % 5].measured_quaternion_wxyz = now;
    for (double& rate : imu.measured_angular_velocity_rad_s) rate *= 1.03;
    ASSERT_TRUE(trusts(imu)) << i;
  }
}

TEST_F(ImuWatchTest, SpikeOfTheForceIsNotFollowed) {
  follow(100);
  Imu spike = next();
  spike.measured_specific_force_m_s2[2] = 500.0;
  EXPECT_FALSE(trusts(spike));
}

TEST_F(ImuWatchTest, RatesThatHangAloneAreNoticedWithin50ms) {
  follow(100);
  const Imu hung = next();
  int samples = 0;
  for (bool trusted = true; trusted && samples < 100; ++samples) {
    Imu imu = next();
    imu.measured_angular_velocity_rad_s = hung.measured_angular_velocity_rad_s;
    trusted = trusts(imu);
  }
  EXPECT_LE(kImuWatchCycle_s * samples, 0.05);
}

TEST_F(ImuWatchTest, FrozenSensorIsNoticedWithin50ms) {
  follow(100);
  Imu imu = next();
  int samples = 0;
  for (; samples < 100 && trusts(imu); ++samples) ++imu.stamp.seq;
  EXPECT_LE(kImuWatchCycle_s * samples, 0.05);
}

TEST_F(ImuWatchTest, BeyondASensorsRangeOrNotANumberIsNotFollowed) {
  for (double rate : {40.0, kNaN}) {
    watch_.reset();
    Imu imu = next();
    imu.measured_angular_velocity_rad_s[2] = rate;
    EXPECT_FALSE(trusts(imu)) << rate;
  }
}

TEST_F(ImuWatchTest, NothingIsHeldAgainstOneThatWasSilent) {
  follow(100);
  seq_ += 50;  // in which the trunk turned
  EXPECT_TRUE(trusts(next()));
}

TEST_F(ImuWatchTest, WithoutAttitudeRatesAreJudgedAlone) {
  for (int i = 0; i < 100; ++i) {
    Imu imu = next();
    imu.status = ImuStatus::kNoAttitude;
    imu.measured_quaternion_wxyz = {kNaN, kNaN, kNaN, kNaN};
    ASSERT_TRUE(trusts(imu));
  }
}

}  // namespace
}  // namespace sprung
