#include "drivers/bridge/impact_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace sprung {
namespace {

constexpr double kHard_rad_s = 7.2;

/// 171.6 Nm on 0.82 kg m^2: three times that takes 5.02 rad/s away in 8 ms.
class Impact : public ::testing::TestWithParam<double> {
 protected:
  /// @return seconds until it is found, by positions over time; -1: not in a second.
  double found(const std::function<double(double)>& position_rad) {
    for (double t_s = 0.0; t_s < 1.0; t_s += GetParam()) {
      time_us_ += std::llround(1e6 * GetParam());
      const double now_rad = position_rad(t_s);
      watch_.add({now_rad, link_rad_ ? link_rad_(now_rad) : kNaN, torque_Nm_}, time_us_);
      if (watch_.hit()) return t_s;
    }
    return -1.0;
  }
  static std::function<double(double)> stops_at_half_a_second(double velocity_rad_s) {
    return [=](double t_s) { return velocity_rad_s * std::min(t_s - 0.5, 0.0); };
  }

  ImpactWatch watch_{171.6, 0.82, GetParam()};
  std::function<double(double)> link_rad_;  ///< by the motor's; none: there is no link encoder
  double torque_Nm_ = 0.0;
  std::int64_t time_us_ = 0;
};

TEST_P(Impact, FullTorqueEitherWayIsNone) {
  EXPECT_EQ(found([](double t_s) { return 0.5 * 209.0 * t_s * t_s; }), -1.0);
  watch_.forget();
  const auto and_back = [](double t_s) {
    return t_s < 0.05 ? 104.5 * t_s * t_s : 0.5225 - 104.5 * (0.1 - t_s) * (0.1 - t_s);
  };
  EXPECT_EQ(found([&](double t_s) { return and_back(std::min(t_s, 0.1)); }), -1.0);
}

TEST_P(Impact, StopThatIsHitIsFoundWithinTwelveMilliseconds) {
  const double found_s = found(stops_at_half_a_second(-6.0));
  EXPECT_GE(found_s, 0.5);
  EXPECT_LE(found_s, 0.512);
  EXPECT_NEAR(watch_.change_rad_s(), 6.0, 1.0);
}

TEST_P(Impact, SlowerOneIsNoMoreThanALandingMayBe) { EXPECT_EQ(found(stops_at_half_a_second(5.0)), -1.0); }

TEST_P(Impact, JointWhoseLinkEncoderWentAlongMayBeStopped) {
  link_rad_ = [](double motor_rad) { return motor_rad - 0.3; };
  EXPECT_EQ(found(stops_at_half_a_second(kHard_rad_s)), -1.0);
  torque_Nm_ = 0.4 * 171.6;
  watch_.forget();
  EXPECT_EQ(found(stops_at_half_a_second(kHard_rad_s)), -1.0);
}

TEST_P(Impact, ButNotIfItsMotorGoesOnToPushItThere) {
  link_rad_ = [](double motor_rad) { return motor_rad - 0.3; };
  torque_Nm_ = -0.6 * 171.6;
  const double found_s = found(stops_at_half_a_second(kHard_rad_s));
  EXPECT_GE(found_s, 0.56);
  EXPECT_LE(found_s, 0.58);
}

TEST_P(Impact, JointThatBouncesBackFromWhereItWasStoppedGoesOn) {
  link_rad_ = [](double motor_rad) { return motor_rad - 0.3; };
  torque_Nm_ = -0.6 * 171.6;
  const auto bounces = [](double t_s) {
    return t_s < 0.5 ? kHard_rad_s * (t_s - 0.5) : std::min(0.1, 1.5 * (t_s - 0.5)) * -1.0;
  };
  EXPECT_EQ(found(bounces), -1.0);
}

TEST_P(Impact, LinkEncoderThatStandsStillProvesNothing) {
  link_rad_ = [](double) { return 0.1; };
  const double found_s = found(stops_at_half_a_second(-kHard_rad_s));
  EXPECT_GE(found_s, 0.5);
  EXPECT_LE(found_s, 0.512);
}

TEST_P(Impact, StaysUntilItIsForgotten) {
  ASSERT_GT(found(stops_at_half_a_second(12.0)), 0.0);
  EXPECT_EQ(found([](double) { return 0.0; }), 0.0) << "rest does not undo it";
  watch_.forget();
  EXPECT_FALSE(watch_.hit());
  EXPECT_EQ(found([](double) { return 0.0; }), -1.0);
}

TEST_P(Impact, GapBeginsAnew) {
  ASSERT_EQ(found([](double t_s) { return 12.0 * t_s; }), -1.0);
  time_us_ += 20'000;
  EXPECT_EQ(found([](double) { return 0.0; }), -1.0) << "what was in the gap is not known";
}

TEST_P(Impact, NothingIsWatchedWithoutAnInertia) {
  watch_ = ImpactWatch(171.6, 0.0, GetParam());
  EXPECT_EQ(found(stops_at_half_a_second(100.0)), -1.0);
}

TEST_P(Impact, JitterOfAnEncoderIsNone) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise_rad(0.0, 0.002);
  EXPECT_EQ(found([&](double) { return noise_rad(random); }), -1.0) << "noisy_encoder_watch.h's";
}

INSTANTIATE_TEST_SUITE_P(Cycles, Impact, ::testing::Values(0.0005, 0.001, 0.002, 0.004));

}  // namespace
}  // namespace sprung
