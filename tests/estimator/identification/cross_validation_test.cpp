#include "estimator/identification/cross_validation.h"

#include <gtest/gtest.h>

#include "estimator/identification/fit_statistics.h"
#include "tests/estimator/identification/identification_fixture.h"

namespace sprung::identification {
namespace {

const LinearModel kOffset("offset", {{"offset", "Nm"}}, {offset_column});

/// A ramp of 200 samples in two pieces; the first sample of each does not count.
std::vector<FitPiece> ramp() {
  std::vector<FitPiece> out{whole(swinging_joint(101)), whole(swinging_joint(101))};
  for (int p = 0; p < 2; ++p) {
    out[p].weight[0] = 0.0;
    for (Eigen::Index i = 0; i < 101; ++i)
      out[p].data.measured_torque[i] = 100.0 * p + static_cast<double>(i);
  }
  return out;
}

CrossValidationOptions plain(int blocks) {
  CrossValidationOptions out;
  out.blocks = blocks;
  out.fit.loss = RobustLoss::kNone;
  return out;
}

TEST(CrossValidation, EachBlockIsScoredByTheMeanOfTheOthers) {
  const CrossValidation found = cross_validate(kOffset, ramp(), plain(4));
  ASSERT_EQ(found.mean_square.size(), 4u);
  // Values 1..200; the block 1..50 is predicted by the mean of 51..200.
  const double variance = (200.0 * 200.0 - 1.0) / 12.0, within = (50.0 * 50.0 - 1.0) / 12.0;
  EXPECT_NEAR(found.mean_square[0], (within + 100.0 * 100.0) / variance, 1e-6);
  EXPECT_NEAR(found.mean_square[3], (within + 100.0 * 100.0) / variance, 1e-6);
  EXPECT_NEAR(found.mean_square[1], (within + std::pow(100.0 / 3.0, 2)) / variance, 1e-6);
  EXPECT_NEAR(found.r2(), 1.0 - (found.mean_square[0] + found.mean_square[1]) / 2.0, 1e-9);
}

TEST(CrossValidation, PredictionsAreBoundByWhatBlocksWereOffByWhileLeftOut) {
  // The mean of the others, 125.5, is off by 124.5 at most for the first block, and for the last one.
  EXPECT_NEAR(cross_validate(kOffset, ramp(), plain(4)).prediction_bound, 120.5, 1e-6)
      << "tenth largest of 200";
}

TEST(CrossValidation, DifferenceIsTakenBlockByBlock) {
  const CrossValidation a{{1.0, 5.0, 9.0}}, b{{0.5, 4.0, 7.5}};
  const Difference found = difference(a, b);
  EXPECT_NEAR(found.mean, 1.0, 1e-12);
  EXPECT_NEAR(found.standard_error, 0.5 / std::sqrt(3.0), 1e-12);
}

TEST(CrossValidation, ABoundOtherThanZeroThatActsIsSaid) {
  JointDataset data = swinging_joint(400);
  const std::vector<FitPiece> pieces = {whole(data)};
  CrossValidationOptions options;
  options.blocks = 4;
  const auto strained = [&](double lower, double upper, double torque) {
    std::vector<FitPiece> changed = pieces;
    changed[0].data.measured_torque.setConstant(torque);
    changed[0].data.measured_torque[7] += 0.1;  // a variance
    const LinearModel model("bounded", {{"offset", "Nm", 1.0, lower, upper}}, {offset_column});
    return cross_validate(model, changed, options).out_of_bounds;
  };
  EXPECT_TRUE(strained(0.0, 2.0, 3.0));
  EXPECT_FALSE(strained(0.0, 4.0, 3.0));
  EXPECT_FALSE(strained(0.0, 4.0, -3.0)) << "zero only switches the term off";
}

TEST(CrossValidation, TooFewSamplesAreRefused) {
  EXPECT_THROW(cross_validate(kOffset, ramp(), plain(11)), std::invalid_argument);
  EXPECT_THROW(cross_validate(kOffset, ramp(), plain(1)), std::invalid_argument);
}

TEST(CrossValidation, OnlyWhatAFitCanMoveCountsAsParameter) {
  const LinearModel model("fixed", {{"a", "", 1.0, 1.0, 1.0}, {"b", ""}}, {offset_column, coulomb_column});
  EXPECT_EQ(free_parameters(model), 1);
}

}  // namespace
}  // namespace sprung::identification
