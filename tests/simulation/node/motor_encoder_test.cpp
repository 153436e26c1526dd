#include "simulation/node/motor_encoder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung::sim {
namespace {

/// 1000 counts a turn, ratio 10: 10000 counts a turn of the output.
EncoderTruth truth(bool absolute) {
  EncoderTruth truth;
  truth.counts_per_turn = 1000;
  truth.gear_ratio = 10.0;
  truth.absolute = absolute;
  truth.index_rad = 1.0;
  truth.seed = 1;
  return truth;
}

constexpr double kTurn = 2 * M_PI;

TEST(MotorEncoder, AbsoluteCountsRoundDownFromTheTrueZero) {
  MotorEncoder encoder(truth(true));
  EXPECT_EQ(encoder.tick(0.5 * kTurn + 1e-9), 5000.0);
  EXPECT_EQ(encoder.read(-1e-9), -1.0);
}

TEST(MotorEncoder, IncrementalCountsFromWhereTheShaftWasAtPowerOn) {
  MotorEncoder encoder(truth(false));
  EXPECT_EQ(encoder.tick(1.2345), 0.0);
  EXPECT_EQ(encoder.tick(1.2345 + 0.01 * kTurn), 100.0);
  encoder.power_on();
  EXPECT_EQ(encoder.tick(1.2345 + 0.01 * kTurn), 0.0);
}

TEST(MotorEncoder, IndexPulseLatchesTheSameCountBothWays) {
  MotorEncoder encoder(truth(false));
  const double pulse_rad = (kTurn + 1.0) / 10.0;  // output, second motor turn
  encoder.tick(pulse_rad - 0.02);
  EXPECT_EQ(encoder.counts_at_index(), 0.0);
  const double counts = encoder.tick(pulse_rad + 0.001);
  const double up = encoder.counts_at_index();
  EXPECT_NEAR(up, counts - 0.001 * encoder.counts_per_rad(), 1.0);
  encoder.tick(pulse_rad + 0.01);
  EXPECT_EQ(encoder.counts_at_index(), up);
  encoder.tick(pulse_rad - 0.01);
  EXPECT_EQ(encoder.counts_at_index(), up);
  encoder.tick(pulse_rad - kTurn / 10.0 - 0.001);
  EXPECT_EQ(encoder.counts_at_index(), up - 1000.0);
}

TEST(MotorEncoder, StuckEncoderShowsTheLastCountUntilItIsFree) {
  MotorEncoder encoder(truth(true));
  const double before = encoder.tick(1.0);
  encoder.set_fault(FaultKind::kEncoderStuck, 0.0, true);
  EXPECT_EQ(encoder.tick(2.0), before);
  EXPECT_EQ(encoder.read(2.0), before);
  encoder.set_fault(FaultKind::kEncoderStuck, 0.0, false);
  EXPECT_GT(encoder.tick(2.0), before);
}

TEST(MotorEncoder, JumpStaysNoiseEnds) {
  MotorEncoder encoder(truth(true));
  const double before = encoder.tick(1.0);
  encoder.set_fault(FaultKind::kEncoderJump, 0.01, true);
  encoder.set_fault(FaultKind::kEncoderJump, 0.01, false);
  EXPECT_EQ(encoder.tick(1.0), before + std::round(0.01 * encoder.counts_per_rad()));
  encoder.power_on();
  EXPECT_EQ(encoder.tick(1.0), before);
  encoder.set_fault(FaultKind::kEncoderNoise, 0.01, true);
  double square = 0.0;
  for (int i = 0; i < 2000; ++i) square += std::pow(encoder.tick(1.0) - before, 2);
  EXPECT_NEAR(std::sqrt(square / 2000) / encoder.counts_per_rad(), 0.01, 0.001);
  encoder.set_fault(FaultKind::kEncoderNoise, 0.01, false);
  EXPECT_EQ(encoder.tick(1.0), before);
}

}  // namespace
}  // namespace sprung::sim
