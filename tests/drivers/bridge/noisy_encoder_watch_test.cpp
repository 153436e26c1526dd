#include "drivers/bridge/noisy_encoder_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace sprung {
namespace {

/// 171.6 Nm on 0.82 kg m^2 at 1 kHz: 8 times that is 1.7 mrad of second difference.
class NoisyEncoder : public ::testing::Test {
 protected:
  /// @return the sample, counted from 1, with which it is found noisy; -1: none of `samples`.
  int found(const std::function<double(int)>& position_rad, int samples = 1000) {
    for (int i = 1; i <= samples; ++i) {
      watch_.add(position_rad(i), time_us_ += 1000);
      if (watch_.noisy()) return i;
    }
    return -1;
  }
  std::function<double(int)> noise(double rms_rad, unsigned seed) {
    return [rms_rad, random = std::mt19937(seed)](int) mutable {
      return std::normal_distribution<double>(0.0, rms_rad)(random);
    };
  }

  NoisyEncoderWatch watch_{171.6, 0.82, 4.8e-7, 0.001};
  std::int64_t time_us_ = 0;
};

TEST_F(NoisyEncoder, FastestMotionOfAHealthyJointIsWell) {
  EXPECT_EQ(found([](int i) { return 0.5 * 209.0 * 1e-6 * i * i; }, 57), -1) << "full torque up to 12 rad/s";
  EXPECT_EQ(found([](int i) { return 0.02 * std::sin(0.2 * i); }), -1) << "32 Hz";
}

TEST_F(NoisyEncoder, NoiseIsFoundWithinTwentyMilliseconds) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    watch_.forget();
    const int sample = found(noise(0.002, seed));
    EXPECT_GT(sample, 0) << seed;
    EXPECT_LE(sample, 22) << seed;
    EXPECT_NEAR(watch_.noise_rad(), 0.002, 0.0015);
  }
}

TEST_F(NoisyEncoder, NoiseThatDampsAsWellAsNothingIsNot) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    watch_.forget();
    EXPECT_EQ(found(noise(0.0002, seed)), -1) << seed;
  }
}

TEST_F(NoisyEncoder, JumpOrAnImpactIsNoNoise) {
  EXPECT_EQ(found([](int i) { return i < 500 ? 0.0 : 0.3; }), -1);
  EXPECT_EQ(found([](int i) { return i < 500 ? 0.0 : 0.01 * (i - 500); }), -1);
}

TEST_F(NoisyEncoder, GapBeginsAnew) {
  for (int i = 0; i < 100; ++i) watch_.add(i % 2 == 0 ? 0.0 : 0.1, time_us_ += 3000);
  EXPECT_FALSE(watch_.noisy());
}

TEST_F(NoisyEncoder, RoundingIsNoNoise) {
  NoisyEncoderWatch coarse(1.0, 1.0, 1e-3, 0.001);
  for (int i = 0; i < 1000; ++i) coarse.add(i % 2 == 0 ? 0.0 : 1e-3, time_us_ += 1000);
  EXPECT_FALSE(coarse.noisy());
}

TEST_F(NoisyEncoder, WithoutInertiaNothingIsWatched) {
  NoisyEncoderWatch blind(171.6, 0.0, 4.8e-7, 0.001);
  for (int i = 0; i < 1000; ++i) blind.add(i % 2 == 0 ? 0.0 : 1.0, time_us_ += 1000);
  EXPECT_FALSE(blind.noisy());
}

}  // namespace
}  // namespace sprung
