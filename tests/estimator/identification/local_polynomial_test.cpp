#include "estimator/identification/local_polynomial.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung::identification {
namespace {

Eigen::VectorXd times(Eigen::Index n, double period_s) {
  return Eigen::VectorXd::LinSpaced(n, 0.0, period_s * static_cast<double>(n - 1));
}

TEST(LocalPolynomial, PolynomialsOfItsDegreeAreExactUpToTheEnds) {
  const Eigen::ArrayXd t = times(40, 0.01).array();
  const Eigen::VectorXd signal = 3.0 - 2.0 * t + 7.0 * t * t;
  const Eigen::VectorXd slope = -2.0 + 14.0 * t;
  EXPECT_LT((local_polynomial(signal, 0.01, 4, 2, 0) - signal).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((local_polynomial(signal, 0.01, 4, 2, 1) - slope).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((local_polynomial(signal, 0.01, 4, 2, 2).array() - 14.0).abs().maxCoeff(), 1e-7);
}

TEST(LocalPolynomial, HasNoPhase) {
  const Eigen::ArrayXd t = times(400, 0.01).array();
  const double w = 2.0 * M_PI * 1.5;
  const Eigen::ArrayXd slope = local_polynomial((w * t).sin().matrix(), 0.01, 4, 2, 1).array();
  // Against cosine and sine over whole periods: no part of the derivative may follow the signal itself.
  const Eigen::Index periods = 200;  // 3 turns of 0.667 s
  const auto inner = slope.segment(100, periods);
  const double in_phase = (inner * (w * t.segment(100, periods)).cos()).mean() * 2.0 / w;
  const double out_of_phase = (inner * (w * t.segment(100, periods)).sin()).mean() * 2.0 / w;
  EXPECT_NEAR(in_phase, 1.0, 0.02);
  EXPECT_NEAR(out_of_phase, 0.0, 1e-9);
}

TEST(LocalPolynomial, PublishedWeightsOfFivePointsDegreeTwo) {
  // Savitzky and Golay 1964: (-3, 12, 17, 12, -3) / 35.
  Eigen::VectorXd impulse = Eigen::VectorXd::Zero(11);
  impulse[5] = 35.0;
  const Eigen::VectorXd smooth = local_polynomial(impulse, 1.0, 2, 2, 0);
  EXPECT_NEAR(smooth[3], -3.0, 1e-9);
  EXPECT_NEAR(smooth[4], 12.0, 1e-9);
  EXPECT_NEAR(smooth[5], 17.0, 1e-9);
}

TEST(LocalPolynomial, VeryShortSignalsStillHaveADerivative) {
  Eigen::VectorXd signal(2);
  signal << 1.0, 3.0;
  EXPECT_NEAR(local_polynomial(signal, 0.5, 4, 2, 1)[0], 4.0, 1e-12);
  EXPECT_THROW(local_polynomial(signal, 0.5, 4, 2, 2), std::invalid_argument);
}

}  // namespace
}  // namespace sprung::identification
