#include "simulation/node/motor_wiring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "signals/angles.h"

namespace sprung::sim {
namespace {

constexpr double kCounts = 4096.0, kPi_2 = kPi / 2.0;

DriveWiring wiring(int pole_pairs) {
  DriveWiring out;
  out.given = true;
  out.pole_pairs = pole_pairs;
  return out;
}

double counts(double motor_rad) { return motor_rad * kCounts / kTurn_rad; }

TEST(Commutation, ARightDriveGivesAllOfTheTorqueAtEveryAngle) {
  Commutation commutation(wiring(7));
  commutation.align(0.3, counts(0.3));
  for (double rad = -10.0; rad < 10.0; rad += 0.37)
    EXPECT_NEAR(commutation.share(rad, counts(rad), {}, kCounts), 1.0, 1e-9);
}

TEST(Commutation, WrongPolePairsLetTheTorqueFadeWithTheAngleTravelled) {
  Commutation commutation(wiring(7));
  commutation.align(1.0, counts(1.0));
  MotorBelief belief;
  belief.pole_pairs = 8;
  EXPECT_NEAR(commutation.share(1.0, counts(1.0), belief, kCounts), 1.0, 1e-9);
  EXPECT_NEAR(commutation.share(1.0 + kPi_2, counts(1.0 + kPi_2), belief, kCounts), 0.0, 1e-9);
  EXPECT_NEAR(commutation.share(1.0 - kPi, counts(1.0 - kPi), belief, kCounts), -1.0, 1e-9);
}

TEST(Commutation, WrongCountsFadeLikeWrongPolePairs) {
  Commutation commutation(wiring(4));
  commutation.align(0.0, 0.0);
  MotorBelief belief;
  belief.encoder_counts_per_turn = 2.0 * kCounts;
  EXPECT_NEAR(commutation.share(kPi / 4.0, counts(kPi / 4.0), belief, kCounts), 0.0, 1e-9);
}

TEST(Commutation, SwappedPhasesTurnTwiceAsFastAgainstTheRotor) {
  DriveWiring swapped = wiring(3);
  swapped.phases_swapped = true;
  Commutation commutation(swapped);
  commutation.align(0.0, 0.0);
  EXPECT_NEAR(commutation.share(0.0, 0.0, {}, kCounts), -1.0, 1e-9);
  EXPECT_NEAR(commutation.share(kPi / 12.0, counts(kPi / 12.0), {}, kCounts), 0.0, 1e-9);
}

TEST(Commutation, SwappedPhasesWithAReversedEncoderTurnTheOtherWayAndStayInStep) {
  DriveWiring both = wiring(3);
  both.phases_swapped = true;
  Commutation commutation(both);
  commutation.align(0.0, 0.0);
  for (const double rad : {0.0, 0.4, 1.7})
    EXPECT_NEAR(commutation.share(rad, -counts(rad), {}, kCounts), -1.0, 1e-9);
}

TEST(Commutation, AnAngleThatIsOffCostsItsCosine) {
  DriveWiring off = wiring(5);
  off.commutation_error_rad = 1.0;
  Commutation commutation(off);
  commutation.align(0.2, counts(0.2));
  EXPECT_NEAR(commutation.share(0.9, counts(0.9), {}, kCounts), std::cos(1.0), 1e-9);
}

/// Of the last 20 ms of 60: largest difference from the set-point.
double late_error_A(double bandwidth_Hz, double gain) {
  GainedCurrentLoop loop(bandwidth_Hz, 0.00025);
  double worst_A = 0.0;
  for (int i = 0; i < 240; ++i) {
    const double current_A = loop.step(1.0, gain, gain, 60.0);
    if (i >= 160) worst_A = std::max(worst_A, std::abs(current_A - 1.0));
  }
  return worst_A;
}

TEST(GainedCurrentLoop, FittingGainsGiveTheBandwidth) {
  GainedCurrentLoop loop(100.0, 0.00025);
  double at_A = 0.0;
  const int lag = static_cast<int>(std::lround(1.0 / (kTurn_rad * 100.0) / 0.00025));
  for (int i = 0; i < lag; ++i) at_A = loop.step(1.0, 1.0, 1.0, 60.0);
  EXPECT_NEAR(at_A, 1.0 - std::exp(-1.0), 0.1);
  EXPECT_LT(late_error_A(100.0, 1.0), 1e-3);
  loop.switch_off();
  EXPECT_EQ(loop.current_A(), 0.0);
}

TEST(GainedCurrentLoop, GainsOfAnotherMotorAreSluggishOrSwingUp) {
  EXPECT_GT(late_error_A(100.0, 0.05), 1e-3) << "not there after 40 ms";
  EXPECT_GT(late_error_A(94.0, 21.0), 1.0);
  EXPECT_GT(late_error_A(146.0, 14.0), 1.0);
}

}  // namespace
}  // namespace sprung::sim
