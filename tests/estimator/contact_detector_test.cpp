#include "estimator/contact_detector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace sprung {
namespace {

constexpr double kDt_s = 0.001;
constexpr double kLever_m = 0.2;
const ContactParams kParams{25.0, 10.0, 0.003, 0.006};
constexpr ErrorShares kPrior{0.15, 0.02, 0.03, 0.6};

/// One joint; nothing known to be wrong unless a test says so.
class ContactDetectorTest : public testing::Test {
 protected:
  ContactDetectorTest() : detector_(kParams, {{kPrior, 0.05, kDt_s}}) {}

  ContactEstimate step(double force_N, const ErrorShares& part_Nm = {}, double unknown_Nm = 0.0) {
    std::vector<ContactEvidence> evidence(1);
    evidence[0].lever_m = kLever_m;
    evidence[0].residual = {force_N * kLever_m, part_Nm, unknown_Nm};
    return detector_.step(evidence, kDt_s);
  }
  /// Samples until the answer becomes `wanted`, at most 100.
  int samples_until(bool wanted, double force_N, const ErrorShares& part_Nm = {}, double unknown_Nm = 0.0) {
    for (int k = 0; k < 100; ++k) {
      if (step(force_N, part_Nm, unknown_Nm).contact == wanted) return k;
    }
    return -1;
  }
  ContactDetector detector_;
};

TEST_F(ContactDetectorTest, ImpossibleSettingsAreRefused) {
  EXPECT_THROW((ContactDetector{{10.0, 10.0, 0.0, 0.0}, {}}), std::invalid_argument);
  EXPECT_THROW((ContactDetector{{25.0, 10.0, -0.001, 0.0}, {}}), std::invalid_argument);
}

TEST_F(ContactDetectorTest, RisesAndFallsAfterTheirOwnDelays) {
  EXPECT_EQ(samples_until(true, 60.0), 3);
  EXPECT_EQ(samples_until(false, 0.0), 6);
}

TEST_F(ContactDetectorTest, BetweenTheThresholdsNothingChanges) {
  EXPECT_EQ(samples_until(true, 17.0), -1);
  samples_until(true, 60.0);
  EXPECT_EQ(samples_until(false, 17.0), -1);
}

TEST_F(ContactDetectorTest, ShortSpikesAreForgotten) {
  for (int k = 0; k < 50; ++k) EXPECT_FALSE(step(k % 3 == 0 ? 0.0 : 100.0).contact);
}

TEST_F(ContactDetectorTest, WhatTheModelMayGetWrongMakesNoContact) {
  const ErrorShares accelerating{0.0, 150.0, 0.0, 0.0};  // 2 % of it are 3 Nm, 15 N: three of them are 45
  EXPECT_EQ(samples_until(true, 40.0, accelerating), -1);
  detector_.reset();
  EXPECT_EQ(samples_until(true, 60.0, accelerating), 3);
}

TEST_F(ContactDetectorTest, LiftOffDoesNotWaitForCertainty) {
  const ErrorShares accelerating{0.0, 150.0, 0.0, 0.0};
  samples_until(true, 100.0);
  EXPECT_EQ(samples_until(false, 35.0), -1);
  EXPECT_EQ(samples_until(false, 25.0, accelerating), 6);
}

TEST_F(ContactDetectorTest, LiftOffIsSeenThroughNoiseThatCrossesTheThresholdNowAndThen) {
  samples_until(true, 60.0);
  int samples = 0;
  for (bool contact = true; contact && samples < 100; ++samples)
    contact = step(samples % 4 == 3 ? 15.0 : 0.0).contact;
  EXPECT_LE(samples, 13);
}

TEST_F(ContactDetectorTest, AFootWhoseForceIsBelowTheThresholdHalfOfTheTimeStands) {
  samples_until(true, 60.0);
  for (int k = 0; k < 200; ++k) EXPECT_TRUE(step(k % 2 == 0 ? 0.0 : 15.0).contact) << k;
}

TEST_F(ContactDetectorTest, JointAtRestCouldHoldTheLoad) {
  EXPECT_EQ(samples_until(true, 30.0, {}, 7.0), -1);  // 7 Nm hold 35 N
  EXPECT_EQ(samples_until(true, 60.0, {}, 7.0), 3);
  EXPECT_EQ(samples_until(false, 0.0, {}, 7.0), -1);  // and may have taken it over
  EXPECT_EQ(samples_until(false, -20.0, {}, 7.0), 6);
}

TEST_F(ContactDetectorTest, ErrorThatTheSwingShowedIsTakenOff) {
  const ErrorShares moving{7.0, 0.0, 0.0, 0.0};  // friction is 20 % larger than known: 1.4 Nm, 7 N
  for (int k = 0; k < 1000; ++k) EXPECT_FALSE(step(7.0, moving).contact);
  EXPECT_NEAR(step(7.0, moving).force_N, 0.0, 1.5);
  EXPECT_NEAR(step(47.0, moving).force_N, 40.0, 1.5);
}

TEST_F(ContactDetectorTest, ForceThatNoErrorExplainsIsFoundHoweverLongItTook) {
  const ErrorShares moving{7.0, 0.0, 0.0, 0.0};
  bool found = false;
  for (int k = 0; k < 2000 && !found; ++k) found = step(0.06 * k, moving).contact;  // 60 N/s
  EXPECT_TRUE(found);
}

TEST_F(ContactDetectorTest, SwingsOfAnyPlantRaiseNoAlarm) {
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, 1.5);  // N: 0.3 Nm
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  int alarms = 0;
  for (int swing = 0; swing < 300; ++swing) {
    ContactDetector detector(kParams, {{kPrior, 0.5, kDt_s}});
    const ErrorShares truth{0.25 * even(random), 0.03 * even(random), 0.05 * even(random), 0.5};
    bool alarm = false;
    for (int k = 0; k < 400; ++k) {
      const double phase = 0.016 * k;
      std::vector<ContactEvidence> evidence(1);
      JointResidual& in = evidence[0].residual;
      in.part_Nm = {7.0, 60.0 * std::sin(phase), 65.0 * std::sin(phase) + 7.0, 0.5};
      in.torque_Nm = kLever_m * noise(random);
      for (std::size_t i = 0; i < kErrorSources; ++i) in.torque_Nm += truth[i] * in.part_Nm[i];
      evidence[0].lever_m = kLever_m;
      alarm = detector.step(evidence, kDt_s).contact || alarm;
    }
    alarms += alarm ? 1 : 0;
  }
  EXPECT_LE(alarms, 1);
}

TEST_F(ContactDetectorTest, TheJointThatKnowsBetterCountsMore) {
  ContactDetector detector(kParams, {{kPrior, 0.1, kDt_s}, {kPrior, 0.1, kDt_s}});
  std::vector<ContactEvidence> evidence(2);
  evidence[0] = {{30.0 * 0.2, {}, 0.0}, 0.2};
  evidence[1] = {{-100.0 * 0.2, {}, 20.0}, 0.2};  // stuck
  EXPECT_NEAR(detector.step(evidence, kDt_s).force_N, 30.0, 1.0);
}

/// Hip and knee of a leg under a trunk that walks: a force along the floor loads the hip by half a metre, a
/// vertical one by 20 mm.
class TangentialForceTest : public testing::Test {
 protected:
  static ContactParams params(double tangential_N) {
    ContactParams out = kParams;
    out.tangential_N = tangential_N;
    return out;
  }
  static ContactEstimate estimate(double tangential_N, double forward_N, double sideways_N, double up_N,
                                  double unknown_abduction_Nm = 0.0) {
    ContactDetector detector(params(tangential_N),
                             {{kPrior, 0.5, kDt_s}, {kPrior, 0.5, kDt_s}, {kPrior, 0.5, kDt_s}});
    std::vector<ContactEvidence> evidence(3);
    const double lever_m[3][3] = {{0.0, 0.5, 0.09}, {-0.5, 0.0, 0.02}, {-0.25, 0.0, 0.18}};
    for (std::size_t j = 0; j < 3; ++j) {
      evidence[j].tangential_lever_m = {lever_m[j][0], lever_m[j][1]};
      evidence[j].lever_m = lever_m[j][2];
      evidence[j].residual.torque_Nm = lever_m[j][0] * forward_N + lever_m[j][1] * sideways_N +
                                       lever_m[j][2] * up_N;
    }
    evidence[0].residual.unknown_friction_Nm = unknown_abduction_Nm;
    return detector.step(evidence, kDt_s);
  }
};

TEST_F(TangentialForceTest, HidesTheVerticalOneWhereItIsNotExpected) {
  // (0.09 * 10.8 - 0.02 * 27.6 + 0.18 * 6.6) Nm m / 0.0409 m^2
  EXPECT_NEAR(estimate(0.0, 60.0, 0.0, 120.0).force_N, 39.3, 0.1);
}

TEST_F(TangentialForceTest, IsToldFromTheVerticalOneWhereItIs) {
  EXPECT_NEAR(estimate(100.0, 60.0, 0.0, 120.0).force_N, 120.0, 3.0);
  EXPECT_NEAR(estimate(100.0, -60.0, 30.0, 120.0).force_N, 120.0, 3.0);
  EXPECT_NEAR(estimate(100.0, 60.0, -30.0, 0.0).force_N, 0.0, 3.0);
}

TEST_F(TangentialForceTest, OfASideThatAStuckJointDoesNotShowChangesLittle) {
  EXPECT_NEAR(estimate(100.0, 0.0, 60.0, 120.0, 40.0).force_N, 120.0, 6.0);
}

TEST_F(TangentialForceTest, CostsCertainty) {
  EXPECT_GT(estimate(100.0, 0.0, 0.0, 100.0).force_std_N, estimate(0.0, 0.0, 0.0, 100.0).force_std_N);
}

TEST_F(TangentialForceTest, MustNotBeNegative) {
  EXPECT_THROW((ContactDetector{params(-1.0), {}}), std::invalid_argument);
}

TEST_F(ContactDetectorTest, PoseThatFeelsNoVerticalForceChangesNothing) {
  samples_until(true, 60.0);
  std::vector<ContactEvidence> evidence(1);
  for (int k = 0; k < 50; ++k) EXPECT_TRUE(detector_.step(evidence, kDt_s).contact);
}

TEST_F(ContactDetectorTest, ConfidenceGrowsWithForceAndShrinksWithUncertainty) {
  const double none = step(-20.0).confidence;
  const double middle = step(17.5).confidence;
  const double sure = step(60.0).confidence;
  const double unsure = step(60.0, {}, 20.0).confidence;
  EXPECT_GE(none, 0.0);
  EXPECT_LT(none, 0.01);
  EXPECT_NEAR(middle, 0.5, 1e-3);
  EXPECT_GT(sure, 0.99);
  EXPECT_LE(sure, 1.0);
  EXPECT_LT(unsure, 0.75);
  EXPECT_GT(unsure, 0.5);
}

TEST_F(ContactDetectorTest, WhatIsNotFiniteIsNoContactAtOnce) {
  samples_until(true, 60.0);
  const ContactEstimate lost = step(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(lost.contact);
  EXPECT_EQ(lost.confidence, 0.0);
  EXPECT_EQ(samples_until(true, 60.0), 3);  // and it starts anew
}

TEST_F(ContactDetectorTest, EvidenceOfAnotherLegIsNoContact) {
  samples_until(true, 60.0);
  EXPECT_FALSE(detector_.step(std::vector<ContactEvidence>(3), kDt_s).contact);
}

}  // namespace
}  // namespace sprung
