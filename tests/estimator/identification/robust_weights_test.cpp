#include "estimator/identification/robust_weights.h"

#include <gtest/gtest.h>

#include "tests/estimator/identification/identification_fixture.h"

namespace sprung::identification {
namespace {

TEST(RobustWeights, ScaleIsTheStandardDeviationOfNormalNoiseWhateverAFewOutliersSay) {
  Eigen::VectorXd residual(4000);
  for (Eigen::Index i = 0; i < residual.size(); ++i) residual[i] = 0.3 * noise(1, i);
  EXPECT_NEAR(robust_scale(residual), 0.3, 0.012);
  for (Eigen::Index i = 0; i < 200; ++i) residual[20 * i] = 1e6;
  EXPECT_NEAR(robust_scale(residual), 0.3, 0.04);
  EXPECT_EQ(robust_scale(Eigen::VectorXd()), 0.0);
}

TEST(RobustWeights, FallAsTheLossSays) {
  Eigen::VectorXd residual(4);
  residual << 0.0, -2.9, 6.0, -30.0;
  const Eigen::VectorXd huber = robust_weights(residual, 1.0, RobustLoss::kHuber);
  EXPECT_EQ(huber[0], 1.0);
  EXPECT_EQ(huber[1], 1.0);
  EXPECT_NEAR(huber[2], 0.5, 1e-12);
  EXPECT_NEAR(huber[3], 0.1, 1e-12);
  const Eigen::VectorXd tukey = robust_weights(residual, 1.0, RobustLoss::kTukey);
  EXPECT_NEAR(tukey[1], std::pow(1.0 - 2.9 * 2.9 / (4.685 * 4.685), 2), 1e-12);
  EXPECT_EQ(tukey[3], 0.0);
  EXPECT_EQ(robust_weights(residual, 1.0, RobustLoss::kNone), Eigen::VectorXd::Ones(4));
}

TEST(RobustWeights, AreOneWhereAllResidualsAreZero) {
  EXPECT_EQ(robust_weights(Eigen::VectorXd::Zero(3), 0.0, RobustLoss::kTukey), Eigen::VectorXd::Ones(3));
}

}  // namespace
}  // namespace sprung::identification
