#include "estimator/identification/fit_statistics.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/estimator/identification/identification_fixture.h"

namespace sprung::identification {
namespace {

Eigen::VectorXd truth() {
  Eigen::VectorXd out(4);
  out << 0.8, 7.0, 2.5, -0.3;
  return out;
}

/// Noise whose neighbours resemble each other: a first-order filter with this pole, of unit variance.
Eigen::VectorXd coloured_noise(double pole, Eigen::Index count, std::uint64_t seed) {
  Eigen::VectorXd out(count);
  out[0] = noise(seed, 0);
  for (Eigen::Index i = 1; i < count; ++i)
    out[i] = pole * out[i - 1] + std::sqrt(1.0 - pole * pole) * noise(seed, i);
  return out;
}

struct Known {
  Fit fit;
  FitStatistics statistics;
};

Known identified(const FitModel& model, const JointDataset& data, RobustLoss loss = RobustLoss::kHuber) {
  const std::vector<FitPiece> pieces{whole(data)};
  const FitProblem problem(model, pieces);
  FitOptions options;
  options.loss = loss;
  Known out{fit(problem, options), {}};
  out.statistics = statistics(problem, out.fit);
  return out;
}

/// Share of the true parameters within 1.96 standard errors, over 60 seeds.
double coverage(double pole, RobustLoss loss) {
  const LinearModel model = inertia_and_friction();
  int within = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    JointDataset data = simulated(model, truth(), swinging_joint(1400), 0.0, 1);
    data.measured_torque += 0.5 * coloured_noise(pole, data.size(), seed);
    const Known known = identified(model, data, loss);
    for (Eigen::Index i = 0; i < 4; ++i) {
      within += std::abs(known.fit.parameters[i] - truth()[i]) < 1.96 * known.statistics.standard_error[i];
      ++all;
    }
  }
  return static_cast<double>(within) / all;
}

TEST(FitStatistics, IntervalsCoverTheTruthInWhiteNoise) {
  EXPECT_GE(coverage(0.0, RobustLoss::kNone), 0.90);
  EXPECT_LE(coverage(0.0, RobustLoss::kNone), 0.99);
  EXPECT_GE(coverage(0.0, RobustLoss::kHuber), 0.90);
}

TEST(FitStatistics, IntervalsCoverTheTruthInNoiseWithMemory) {
  EXPECT_GE(coverage(0.9, RobustLoss::kHuber), 0.85);
  EXPECT_GE(coverage(0.97, RobustLoss::kHuber), 0.85);
}

TEST(FitStatistics, StandardErrorsOfALinearModelAreTheClosedForm) {
  const LinearModel model = inertia_and_friction();
  const JointDataset data = simulated(model, truth(), swinging_joint(1400), 0.5, 7);
  const Known known = identified(model, data, RobustLoss::kNone);
  Eigen::VectorXd none;
  Eigen::MatrixXd columns;
  model.predict(data, truth(), none, &columns);
  const Eigen::MatrixXd inverse = (columns.transpose() * columns).inverse();
  const double sigma = 0.5 * std::sqrt(known.statistics.autocorrelation_time);
  for (Eigen::Index i = 0; i < 4; ++i)
    EXPECT_NEAR(known.statistics.standard_error[i] / (sigma * std::sqrt(inverse(i, i))), 1.0, 0.06) << i;
  EXPECT_NEAR(known.statistics.correlation(1, 2), inverse(1, 2) / std::sqrt(inverse(1, 1) * inverse(2, 2)),
              1e-6);
  EXPECT_EQ(known.statistics.correlation(3, 3), 1.0);
}

TEST(FitStatistics, AutocorrelationTimeOfAFirstOrderFilter) {
  const std::vector<Eigen::Index> one{0, 40000};
  EXPECT_NEAR(autocorrelation_time(coloured_noise(0.0, 40000, 1), one), 1.0, 0.1);
  EXPECT_NEAR(autocorrelation_time(coloured_noise(0.9, 40000, 1), one), 19.0, 3.0);  // (1 + a) / (1 - a)
  EXPECT_EQ(autocorrelation_time(Eigen::VectorXd::Ones(10), {0, 10}), 1.0);
}

TEST(FitStatistics, LagsDoNotReachOverGaps) {
  // Alternating signs within stretches of two; equal signs across them.
  Eigen::VectorXd residual(8);
  residual << 1, -1, -1, 1, 1, -1, -1, 1;
  EXPECT_EQ(autocorrelation_time(residual, {0, 2, 4, 6, 8}), 1.0);
}

TEST(FitStatistics, ScoreIsAsTheProtocolSays) {
  Eigen::VectorXd measured(4), residual(4);
  measured << 1, 2, 3, 4;
  residual << 0.5, -0.5, 0.5, -0.5;
  FitScore found = score(measured, residual);
  EXPECT_NEAR(found.r2, 1.0 - 0.25 / 1.25, 1e-12);
  EXPECT_NEAR(found.rms, 0.5, 1e-12);
  found = score(measured, residual.array() + 10.0);
  EXPECT_NEAR(found.r2, 0.8, 1e-12);
  EXPECT_NEAR(found.rms, std::sqrt(100.25), 1e-12);
  EXPECT_EQ(found.samples, 4);
  EXPECT_TRUE(std::isnan(score(Eigen::VectorXd::Ones(4), residual).r2));
}

TEST(FitStatistics, ParametersThatTheDataDoNotTellHaveNoStandardErrorAndAreNamed) {
  const LinearModel model("twice", {{"offset", "Nm"}, {"coulomb", "Nm", 1.0, 0.0}, {"bias", "Nm"}},
                          {offset_column, coulomb_column, offset_column});
  const Known known = identified(model,
                                 simulated(model, Eigen::Vector3d(1, 2, 3), swinging_joint(700), 0.1, 1));
  EXPECT_TRUE(std::isnan(known.statistics.standard_error[0]));
  EXPECT_TRUE(std::isnan(known.statistics.standard_error[2]));
  EXPECT_GT(known.statistics.standard_error[1], 0.0);
  ASSERT_EQ(known.statistics.warnings.size(), 1u);
  EXPECT_NE(known.statistics.warnings[0].find("cannot tell 'offset' from 'bias'"), std::string::npos);
}

TEST(FitStatistics, ParameterOnItsBoundHasNoStandardError) {
  const LinearModel model("bounded", {{"coulomb", "Nm", 1.0, 0.0}, {"viscous", "", 1.0, 0.0}},
                          {coulomb_column, viscous_column});
  JointDataset data = swinging_joint(700);
  data.measured_torque = 5.0 * coulomb_column(data) - 2.0 * viscous_column(data);
  const Known known = identified(model, data);
  EXPECT_TRUE(std::isnan(known.statistics.standard_error[1])) << known.fit.parameters.transpose();
  EXPECT_GT(known.statistics.standard_error[0], 0.0);
}

}  // namespace
}  // namespace sprung::identification
