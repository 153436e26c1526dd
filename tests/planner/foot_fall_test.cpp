#include "planner/foot_fall.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

constexpr std::int64_t kStepOfFall_us = 1000;
constexpr std::int64_t kTouchdown_us = 247'310;  // sqrt(2 * 0.3 m / 9.81 m/s^2)

class FootFallTest : public testing::Test {
 protected:
  FootFallTest() : preset_(load_robot("single_leg").preset("best")) {
    fall_.begin(0, {{0.0, 0.0, -preset_.landing_length_m}, {}, {}}, fall_from_rest(0, 1e-6 * kTouchdown_us));
  }
  void until(std::int64_t utime_us) {
    while (fall_.utime_us() < utime_us) fall_.step(fall_.utime_us() + kStepOfFall_us);
  }
  double approach_m_s() const { return -(fall_.hip_velocity_m_s() + fall_.foot().velocity_m_s[2]); }

  PresetConfig preset_;
  FootFall fall_{preset_.adaptive_landing, preset_.landing_length_m};
};

TEST_F(FootFallTest, HipFallsFreelyToItsLandingLength) {
  EXPECT_NEAR(fall_.hip_height_m(), preset_.landing_length_m + 0.3, 1e-5);
  EXPECT_NEAR(fall_.hip_velocity_m_s(), 0.0, 1e-9);
  until(kTouchdown_us);
  EXPECT_NEAR(fall_.hip_height_m(), preset_.landing_length_m, 0.003);
}

TEST_F(FootFallTest, BrakedFootGoesOnWithItsApproachSpeed) {
  until(kTouchdown_us);
  ASSERT_TRUE(fall_.braked());
  EXPECT_NEAR(approach_m_s(), fall_.slow_m_s(), 0.02);
}

TEST_F(FootFallTest, ApproachSpeedIsAShareOfTheHipsSpeedAtTouchdownUpToItsLimit) {
  AdaptiveLandingConfig config = preset_.adaptive_landing;
  config.approach_share = 0.3;
  const auto slow_m_s = [&](double limit_m_s) {
    config.approach_m_s = limit_m_s;
    FootFall fall(config, preset_.landing_length_m);
    fall.begin(0, {}, {200'000, 2.0});
    return fall.slow_m_s();
  };
  EXPECT_NEAR(slow_m_s(1.0), 0.6, 1e-12);
  EXPECT_NEAR(slow_m_s(0.5), 0.5, 1e-12);
}

TEST_F(FootFallTest, SofterBrakingBeginsEarlierAndArrivesJustSo) {
  const auto begins_us = [](FootFall fall) {
    while (!fall.braking() && fall.utime_us() < kTouchdown_us) fall.step(fall.utime_us() + kStepOfFall_us);
    return fall.utime_us();
  };
  FootFall soft = fall_;
  soft.set_braking(0.6 * preset_.adaptive_landing.braking_m_s2);
  EXPECT_LT(begins_us(soft), begins_us(fall_) - 5 * kStepOfFall_us);
  double hardest_m_s2 = 0.0;
  while (soft.utime_us() < kTouchdown_us) {
    soft.step(soft.utime_us() + kStepOfFall_us);
    if (soft.braking())
      hardest_m_s2 = std::max(hardest_m_s2, soft.foot().acceleration_m_s2[2] - kGravity_m_s2);
  }
  EXPECT_TRUE(soft.braked());
  EXPECT_NEAR(hardest_m_s2, 0.6 * preset_.adaptive_landing.braking_m_s2, 0.5);
  EXPECT_NEAR(-(soft.hip_velocity_m_s() + soft.foot().velocity_m_s[2]), soft.slow_m_s(), 0.02);
}

TEST_F(FootFallTest, CopyTellsWhatIsToComeAndLeavesTheOriginal) {
  FootFall copy = fall_;
  copy.step(100'000);
  EXPECT_EQ(fall_.utime_us(), 0);
  EXPECT_EQ(fall_.foot().position_m[2], -preset_.landing_length_m);
}

}  // namespace
}  // namespace sprung
