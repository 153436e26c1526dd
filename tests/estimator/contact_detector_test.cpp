#include "estimator/contact_detector.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace sprung {
namespace {

constexpr double kDt_s = 0.001;
const ContactParams kParams{25.0, 10.0, 0.003, 0.006};

/// Samples until the answer becomes `wanted`, at most 100.
int samples_until(ContactDetector& detector, bool wanted, double force_N, double bound_N = 0.0) {
  for (int k = 0; k < 100; ++k) {
    if (detector.step(force_N, bound_N, kDt_s).contact == wanted) return k;
  }
  return -1;
}

TEST(ContactDetectorTest, ImpossibleSettingsAreRefused) {
  EXPECT_THROW((ContactDetector{{10.0, 10.0, 0.0, 0.0}}), std::invalid_argument);
  EXPECT_THROW((ContactDetector{{25.0, 10.0, -0.001, 0.0}}), std::invalid_argument);
}

TEST(ContactDetectorTest, RisesAndFallsAfterTheirOwnDelays) {
  ContactDetector detector(kParams);
  EXPECT_EQ(samples_until(detector, true, 60.0), 3);
  EXPECT_EQ(samples_until(detector, false, 0.0), 6);
}

TEST(ContactDetectorTest, BetweenTheThresholdsNothingChanges) {
  ContactDetector detector(kParams);
  EXPECT_EQ(samples_until(detector, true, 17.0), -1);
  samples_until(detector, true, 60.0);
  EXPECT_EQ(samples_until(detector, false, 17.0), -1);
}

TEST(ContactDetectorTest, ShortSpikesAreForgotten) {
  ContactDetector detector(kParams);
  for (int k = 0; k < 50; ++k) {
    EXPECT_FALSE(detector.step(k % 3 == 0 ? 0.0 : 100.0, 0.0, kDt_s).contact);
  }
}

TEST(ContactDetectorTest, WhatTheEstimateMayGetWrongMakesNoContact) {
  ContactDetector detector(kParams);
  EXPECT_EQ(samples_until(detector, true, 60.0, 40.0), -1);
  EXPECT_EQ(samples_until(detector, true, 66.0, 40.0), 3);
  EXPECT_EQ(samples_until(detector, false, 11.0, 40.0), -1);
  EXPECT_EQ(samples_until(detector, false, 9.0, 40.0), 6);
}

TEST(ContactDetectorTest, ConfidenceGrowsWithForceAndShrinksWithUncertainty) {
  ContactDetector detector(kParams);
  const double none = detector.step(-20.0, 0.0, kDt_s).confidence;
  const double middle = detector.step(17.5, 0.0, kDt_s).confidence;
  const double sure = detector.step(60.0, 0.0, kDt_s).confidence;
  const double unsure = detector.step(60.0, 100.0, kDt_s).confidence;
  EXPECT_GE(none, 0.0);
  EXPECT_LT(none, 0.01);
  EXPECT_NEAR(middle, 0.5, 1e-12);
  EXPECT_GT(sure, 0.99);
  EXPECT_LE(sure, 1.0);
  EXPECT_LT(unsure, 0.75);
  EXPECT_GT(unsure, 0.5);
}

TEST(ContactDetectorTest, ForceThatIsNotFiniteIsNoContactAtOnce) {
  ContactDetector detector(kParams);
  samples_until(detector, true, 60.0);
  const ContactEstimate lost = detector.step(std::numeric_limits<double>::quiet_NaN(), 0.0, kDt_s);
  EXPECT_FALSE(lost.contact);
  EXPECT_EQ(lost.confidence, 0.0);
  EXPECT_EQ(samples_until(detector, true, 60.0), 3);  // and it starts anew
}

}  // namespace
}  // namespace sprung
