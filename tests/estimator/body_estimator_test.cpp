#include "estimator/body_estimator.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "tests/estimator/trunk_sample.h"
#include "tests/support/allocation_count.h"

namespace sprung {
namespace {

using test::TrunkPose;
using test::TrunkSample;

constexpr double kBodyEstimatorDegree = M_PI / 180.0;
constexpr double kCycle_s = 0.002;

/// A trot at 0.3 m/s, forward and a little to the left.
TrunkPose trotting(double t) {
  return {
      {0.3 * t, 0.05 * t, 0.42 + 0.008 * std::sin(4 * M_PI * t)},
      test::rpy(0.03 * std::sin(4 * M_PI * t), 0.02 * std::cos(4 * M_PI * t), 0.02 * std::sin(2 * M_PI * t))};
}

struct Errors {
  double attitude_rad = 0.0;  ///< worst
  double velocity_m_s = 0.0;  ///< rms
  double height_m = 0.0;      ///< worst
};

class BodyEstimatorTest : public testing::Test {
 protected:
  /// As robots/pegasus/sim.yaml.
  Imu noisy_imu() {
    Imu imu = trunk_.imu(time_s_, seq_, 0.7);
    for (std::size_t i = 0; i < 3; ++i) {
      imu.measured_angular_velocity_rad_s[i] += 0.002 + 0.003 * normal_(random_);
      imu.measured_specific_force_m_s2[i] += 0.03 + 0.03 * normal_(random_);
    }
    Eigen::Quaterniond q(imu.measured_quaternion_wxyz[0], imu.measured_quaternion_wxyz[1],
                         imu.measured_quaternion_wxyz[2], imu.measured_quaternion_wxyz[3]);
    q = q * turned_by({0.004 + 0.0005 * normal_(random_), 0.004, 0.0});
    imu.measured_quaternion_wxyz = {q.w(), q.x(), q.y(), q.z()};
    return imu;
  }
  const EstimatedBody& step(const Imu* imu) {
    estimator_.step(trunk_.legs(time_s_), trunk_.link_rates_rad_s(time_s_), imu, seq_, kCycle_s, body_);
    return body_;
  }
  void next() {
    time_s_ += kCycle_s;
    ++seq_;
    if (trots_) trunk_.trot(time_s_);
  }
  Errors run(ImuStatus status, bool imu, double duration_s) {
    Errors errors;
    int n = 0;
    for (double t = 0; t < duration_s; t += kCycle_s, ++n) {
      next();
      Imu sample = noisy_imu();
      sample.status = status;
      step(imu ? &sample : nullptr);
      const Eigen::Vector3d up = trunk_.pose(time_s_).to_world.conjugate() * Eigen::Vector3d::UnitZ();
      const double cosine = (test::quaternion(body_) * up).z();
      errors.attitude_rad = std::max(errors.attitude_rad, std::acos(std::min(1.0, cosine)));
      errors.velocity_m_s += (to_eigen(body_.estimated_velocity_m_s) - trunk_.velocity_m_s(time_s_))
                                 .squaredNorm();
      errors.height_m = std::max(errors.height_m,
                                 std::abs(body_.estimated_height_m - trunk_.height_m(time_s_)));
    }
    errors.velocity_m_s = std::sqrt(errors.velocity_m_s / n);
    return errors;
  }

  TrunkSample trunk_{trotting};
  BodyEstimator estimator_{trunk_.robot};
  EstimatedBody body_;
  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
  bool trots_ = false;
  double time_s_ = 0.0;
  std::int64_t seq_ = 0;
};

TEST_F(BodyEstimatorTest, NothingIsKnownWithoutFeetAndImu) {
  trunk_.stands = {false, false, false, false};
  const EstimatedBody& body = step(nullptr);
  EXPECT_TRUE(std::isnan(body.estimated_quaternion_wxyz[0]));
  EXPECT_TRUE(std::isnan(body.estimated_angular_velocity_rad_s[0]));
  EXPECT_TRUE(std::isnan(body.estimated_velocity_m_s[0]));
  EXPECT_TRUE(std::isnan(body.estimated_height_m));
  EXPECT_FALSE(body.uses_imu);
}

TEST_F(BodyEstimatorTest, TrotWithImuIsKnownToHalfADegreeThreeCentimetresASecondAndFiveMillimetres) {
  run(ImuStatus::kGood, true, 0.3);
  trots_ = true;
  trunk_.foot_noise_m_s = 0.05;
  const Errors errors = run(ImuStatus::kGood, true, 4.0);
  EXPECT_TRUE(body_.uses_imu);
  EXPECT_LT(errors.attitude_rad, 0.5 * kBodyEstimatorDegree);
  EXPECT_LT(errors.velocity_m_s, 0.03);
  EXPECT_LT(errors.height_m, 0.005);
}

/// Of the odometry's velocity, worst, of a trunk that bounces and sways, with an IMU that is 6 ms late.
double worst_odometry_m_s(double latency_s) {
  TrunkSample trunk([](double t) {
    return TrunkPose{{0.02 * std::sin(5 * M_PI * t), 0.0, 0.42 + 0.01 * std::sin(8 * M_PI * t)},
                     test::rpy(0.01 * std::sin(6 * M_PI * t), 0.01 * std::cos(7 * M_PI * t), 0.0)};
  });
  trunk.robot.body.imu_latency_s = latency_s;
  BodyEstimator estimator(trunk.robot);
  EstimatedBody body;
  BodyState odometry;
  double worst_m_s = 0.0;
  for (std::int64_t seq = 10; seq < 2000; ++seq) {
    const double now_s = kCycle_s * static_cast<double>(seq);
    Imu late = trunk.imu(now_s - 0.006, seq, 0.0);
    estimator.step(trunk.legs(now_s), trunk.link_rates_rad_s(now_s), &late, seq, kCycle_s, body);
    estimator.odometry(odometry);
    if (seq < 1000) continue;
    const Eigen::Vector3d off_m_s = to_eigen(odometry.estimated_velocity_m_s) - trunk.velocity_m_s(now_s);
    worst_m_s = std::max(worst_m_s, off_m_s.norm());
  }
  return worst_m_s;
}

TEST_F(BodyEstimatorTest, OdometryHoldsAnImuThatIsLateAgainstFeetOfThatTime) {
  EXPECT_GT(worst_odometry_m_s(0.0), 0.02);
  EXPECT_LT(worst_odometry_m_s(0.006), 0.01);
}

/// Walks a circle, its IMU askew by `askew` (sensor to trunk): how far the attitude is off at its end.
TEST(BodyEstimatorMounting, AnImuThatIsAskewIsLearnedInACircleTakenOffAndKeptOverAReset) {
  const Eigen::Quaterniond askew = turned_by({0.012, -0.01, 0.0});
  double now_s = 0.0;
  TrunkSample trunk([](double t) {
    const double turned = 0.3 * t;
    return TrunkPose{{std::sin(turned), 1.0 - std::cos(turned), 0.42},
                     test::rpy(0.02 * std::sin(7 * t), 0.02 * std::sin(8 * t), turned)};
  });
  BodyEstimator estimator(trunk.robot);
  EstimatedBody body;
  BodyState odometry;
  const auto run_to = [&](double end_s) {
    for (; now_s < end_s; now_s += kCycle_s) {
      const auto seq = std::llround(now_s / kCycle_s);
      trunk.trot(now_s);
      Imu imu = trunk.imu(now_s, seq);
      const auto to_sensor = [&](const Vec3& v) { return to_vec3(askew.conjugate() * to_eigen(v)); };
      imu.measured_angular_velocity_rad_s = to_sensor(imu.measured_angular_velocity_rad_s);
      imu.measured_specific_force_m_s2 = to_sensor(imu.measured_specific_force_m_s2);
      const Eigen::Quaterniond q = trunk.pose(now_s).to_world * askew;
      imu.measured_quaternion_wxyz = {q.w(), q.x(), q.y(), q.z()};
      estimator.step(trunk.legs(now_s), trunk.link_rates_rad_s(now_s), &imu, seq, kCycle_s, body);
    }
    estimator.odometry(odometry);
  };
  const auto tilt_off_rad = [&](const Eigen::Quaterniond& estimated) {
    return tilt_rad(estimated * trunk.pose(now_s - kCycle_s).to_world.conjugate());
  };
  run_to(0.5);
  EXPECT_GT(tilt_off_rad(test::quaternion(body)), 0.012);
  run_to(20.0);
  const auto& q = odometry.estimated_quaternion_wxyz;
  EXPECT_LT(tilt_off_rad(test::quaternion(body)), 0.003);
  EXPECT_LT(tilt_off_rad({q[0], q[1], q[2], q[3]}), 0.004);
  EXPECT_NEAR(odometry.estimated_imu_tilt_rad[0], 0.012, 0.003);
  EXPECT_NEAR(odometry.estimated_imu_tilt_rad[1], -0.01, 0.003);
  estimator.reset();
  run_to(20.6);
  EXPECT_LT(tilt_off_rad(test::quaternion(body)), 0.004);
}

TEST_F(BodyEstimatorTest, HowTheImuIsMountedIsTold) {
  run(ImuStatus::kGood, true, 0.3);
  BodyState odometry;
  estimator_.odometry(odometry);
  EXPECT_NEAR(odometry.imu_tilt_covariance_rad2[0], 0.012 * 0.012 + 0.003 * 0.003, 1e-5);
  EXPECT_NEAR(odometry.estimated_imu_tilt_rad[0], 0.0, 0.001);
  const double tilt_rad2 = odometry.attitude_covariance_rad2[0];
  EXPECT_GT(tilt_rad2, odometry.imu_tilt_covariance_rad2[0]) << "it is part of it";
}

TEST_F(BodyEstimatorTest, TrotWithAnImuThatGivesNoAttitudeIsKnownToOneDegree) {
  run(ImuStatus::kNoAttitude, true, 0.3);
  trots_ = true;
  trunk_.foot_noise_m_s = 0.05;
  const Errors errors = run(ImuStatus::kNoAttitude, true, 4.0);
  EXPECT_TRUE(body_.uses_imu);
  EXPECT_LT(errors.attitude_rad, 1.0 * kBodyEstimatorDegree);
  EXPECT_LT(errors.velocity_m_s, 0.03);
  EXPECT_LT(errors.height_m, 0.005);
}

TEST_F(BodyEstimatorTest, StandingWithoutImuOnALevelFloorIsKnownToHalfADegree) {
  run(ImuStatus::kGood, false, 0.3);
  trunk_.foot_noise_m_s = 0.02;
  const Errors errors = run(ImuStatus::kGood, false, 1.0);
  EXPECT_LT(errors.attitude_rad, 0.5 * kBodyEstimatorDegree);
  EXPECT_LT(errors.velocity_m_s, 0.03);
  EXPECT_LT(errors.height_m, 0.005);
}

/// Two feet do not show how the trunk turns about the line between them (0.4 rad/s, 0.42 m over it).
TEST_F(BodyEstimatorTest, TrotWithoutImuOnALevelFloorIsKnownToFourDegrees) {
  run(ImuStatus::kGood, false, 0.05);
  trots_ = true;
  trunk_.foot_noise_m_s = 0.05;
  const Errors errors = run(ImuStatus::kGood, false, 4.0);
  EXPECT_FALSE(body_.uses_imu);
  EXPECT_LT(errors.attitude_rad, 4.0 * kBodyEstimatorDegree);
  EXPECT_LT(errors.velocity_m_s, 0.12);
  EXPECT_LT(errors.height_m, 0.010);
}

TEST_F(BodyEstimatorTest, StatusSaysWhetherTheImuIsUsed) {
  const auto uses = [&](ImuStatus status) {
    next();
    Imu imu = noisy_imu();
    imu.status = status;
    return step(&imu).uses_imu;
  };
  EXPECT_FALSE(uses(ImuStatus::kStarting));
  EXPECT_TRUE(uses(ImuStatus::kGood));
  EXPECT_TRUE(uses(ImuStatus::kNoAttitude));
  EXPECT_FALSE(uses(ImuStatus::kFault));
  EXPECT_TRUE(uses(ImuStatus::kGood));
}

TEST_F(BodyEstimatorTest, RobotWithoutAnImuIgnoresOne) {
  trunk_.robot.body.imu = false;
  BodyEstimator estimator(trunk_.robot);
  const Imu imu = noisy_imu();
  estimator.step(trunk_.legs(time_s_), trunk_.link_rates_rad_s(time_s_), &imu, seq_, kCycle_s, body_);
  EXPECT_FALSE(body_.uses_imu);
}

TEST_F(BodyEstimatorTest, OdometryTellsPlaceVelocityAndHowSureThatIsAndGoesOnAfterAReset) {
  run(ImuStatus::kGood, true, 1.0);
  trots_ = true;
  trunk_.foot_noise_m_s = 0.05;
  const Eigen::Vector3d from_m = trunk_.pose(time_s_).in_world_m;
  BodyState before, after;
  estimator_.odometry(before);
  run(ImuStatus::kGood, true, 5.0);
  estimator_.odometry(after);
  const Eigen::Vector3d went_m = to_eigen(after.estimated_position_in_world_m) -
                                 to_eigen(before.estimated_position_in_world_m);
  EXPECT_LT((went_m - (trunk_.pose(time_s_).in_world_m - from_m)).norm(), 0.03);
  EXPECT_LT((to_eigen(after.estimated_velocity_m_s) - trunk_.velocity_m_s(time_s_)).norm(), 0.05);
  EXPECT_GT(after.position_covariance_m2[0], before.position_covariance_m2[0]);
  EXPECT_GT(after.attitude_covariance_rad2[8], before.attitude_covariance_rad2[8]);
  EXPECT_TRUE(after.uses_imu);
  estimator_.reset();
  BodyState unknown;
  estimator_.odometry(unknown);
  EXPECT_TRUE(std::isnan(unknown.estimated_position_in_world_m[0]));
  const Eigen::Vector3d reset_at_m = trunk_.pose(time_s_).in_world_m;
  run(ImuStatus::kGood, true, 1.0);
  estimator_.odometry(unknown);
  const Eigen::Vector3d since_m = to_eigen(unknown.estimated_position_in_world_m) -
                                  to_eigen(after.estimated_position_in_world_m);
  EXPECT_LT((since_m - (trunk_.pose(time_s_).in_world_m - reset_at_m)).norm(), 0.05);
}

TEST_F(BodyEstimatorTest, SilenceOfFiveCyclesIsBridgedAndThenTheFeetTakeOver) {
  run(ImuStatus::kGood, true, 0.3);
  Imu last = noisy_imu();
  for (int age = 1; age <= 8; ++age) {
    next();
    EXPECT_EQ(step(age % 2 == 0 ? nullptr : &last).uses_imu, age <= 5) << age;
    EXPECT_TRUE(std::isfinite(body_.estimated_velocity_m_s[2]));
  }
}

TEST_F(BodyEstimatorTest, OnceKnownNoInputMakesANumberThatIsNone) {
  run(ImuStatus::kGood, true, 0.3);
  trots_ = true;
  std::uniform_int_distribution<int> dice(0, 9);
  for (int k = 0; k < 5000; ++k) {
    next();
    Imu imu = noisy_imu();
    if (dice(random_) == 0) imu.measured_quaternion_wxyz[1] = kNaN;
    if (dice(random_) == 0) imu.measured_specific_force_m_s2 = {0, 0, 0};
    if (dice(random_) == 0) imu.measured_angular_velocity_rad_s[2] = kNaN;
    if (dice(random_) == 0) imu.status = static_cast<ImuStatus>(dice(random_) % 4);
    std::vector<EstimatedLeg> legs = trunk_.legs(time_s_);
    if (dice(random_) == 0) legs[dice(random_) % 4] = EstimatedLeg{};
    estimator_.step(legs, trunk_.link_rates_rad_s(time_s_), dice(random_) < 3 ? nullptr : &imu, seq_,
                    kCycle_s, body_);
    for (const double value : body_.estimated_quaternion_wxyz) ASSERT_TRUE(std::isfinite(value)) << k;
    for (const double value : body_.estimated_angular_velocity_rad_s) ASSERT_TRUE(std::isfinite(value)) << k;
    for (const double value : body_.estimated_velocity_m_s) ASSERT_TRUE(std::isfinite(value)) << k;
    ASSERT_TRUE(std::isfinite(body_.estimated_height_m)) << k;
    ASSERT_NEAR(test::quaternion(body_).norm(), 1.0, 1e-12);
  }
}

TEST_F(BodyEstimatorTest, SameInputsGiveTheSameBitsAndNothingIsAllocated) {
  BodyEstimator other(trunk_.robot);
  EstimatedBody twin;
  for (int k = 0; k < 500; ++k) {
    next();
    const Imu imu = noisy_imu();
    const std::vector<EstimatedLeg> legs = trunk_.legs(time_s_);
    const std::vector<Eigen::Vector3d> rates_rad_s = trunk_.link_rates_rad_s(time_s_);
    const Imu* const given = k % 100 < 70 ? &imu : nullptr;
    const std::int64_t before = test::allocation_count();
    estimator_.step(legs, rates_rad_s, given, seq_, kCycle_s, body_);
    EXPECT_EQ(test::allocation_count(), before);
    other.step(legs, rates_rad_s, given, seq_, kCycle_s, twin);
    ASSERT_EQ(
        std::memcmp(&body_.estimated_quaternion_wxyz, &twin.estimated_quaternion_wxyz, 4 * sizeof(double)),
        0);
    ASSERT_EQ(std::memcmp(&body_.estimated_velocity_m_s, &twin.estimated_velocity_m_s, 3 * sizeof(double)),
              0);
  }
}

TEST_F(BodyEstimatorTest, AfterAResetAllButTheHeadingIsNew) {
  run(ImuStatus::kGood, true, 0.5);
  estimator_.reset();
  trunk_.stands = {false, false, false, false};
  next();
  EXPECT_TRUE(std::isnan(step(nullptr).estimated_quaternion_wxyz[0]));
  EXPECT_TRUE(std::isnan(body_.estimated_height_m));
}

}  // namespace
}  // namespace sprung
