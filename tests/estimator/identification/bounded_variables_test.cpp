#include "estimator/identification/bounded_variables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung::identification {
namespace {

const double kInf = std::numeric_limits<double>::infinity();

std::vector<FitParameter> all_kinds() {
  return {{"free", "", -2.0},
          {"lower", "", 3.0, 1.0},
          {"upper", "", -4.0, -kInf, 0.5},
          {"both", "", 0.3, 0.0, 2.0},
          {"fixed", "", 7.0, 7.0, 7.0}};
}

Eigen::VectorXd initials() {
  Eigen::VectorXd out(5);
  out << -2.0, 3.0, -4.0, 0.3, 7.0;
  return out;
}

TEST(BoundedVariables, StartInsideIsKept) {
  const BoundedVariables variables(all_kinds(), initials());
  EXPECT_LT((variables.parameters(variables.start()) - initials()).norm(), 1e-12);
}

TEST(BoundedVariables, NoVariableLeadsOutOfTheBounds) {
  const BoundedVariables variables(all_kinds(), initials());
  for (double u = -50.0; u < 50.0; u += 0.37) {
    const Eigen::VectorXd x = variables.parameters(Eigen::VectorXd::Constant(4, u));
    EXPECT_EQ(x[0], u);
    EXPECT_GE(x[1], 1.0);
    EXPECT_LE(x[2], 0.5);
    EXPECT_GE(x[3], 0.0);
    EXPECT_LE(x[3], 2.0);
    EXPECT_EQ(x[4], 7.0);
  }
}

TEST(BoundedVariables, SlopeIsTheDerivative) {
  const BoundedVariables variables(all_kinds(), initials());
  for (double u = -3.0; u < 3.0; u += 0.21) {
    const auto at = [&](double value) { return variables.parameters(Eigen::VectorXd::Constant(4, value)); };
    const Eigen::VectorXd difference = ((at(u + 1e-5) - at(u - 1e-5)) / 2e-5).head(4);
    EXPECT_LT((difference - variables.slope(Eigen::VectorXd::Constant(4, u))).norm(), 1e-8) << u;
  }
}

TEST(BoundedVariables, MovedInsideTheSlopeIsNotZero) {
  Eigen::VectorXd start = initials();
  start[1] = 1.0;
  start[2] = 0.5;
  start[3] = 2.0;
  for (const int i : {1, 2, 3}) start[i] = moved_inside(all_kinds()[i], start[i]);
  const BoundedVariables variables(all_kinds(), start);
  const Eigen::VectorXd slope = variables.slope(variables.start());
  for (const int i : {1, 2, 3}) {
    EXPECT_GT(std::abs(slope[i]), 1e-3) << i;
    EXPECT_FALSE(variables.at_bound(variables.parameters(variables.start()), i)) << i;
  }
}

TEST(BoundedVariables, MovedInsideLeavesWhatIsInside) {
  for (const int i : {0, 1, 2, 3}) EXPECT_EQ(moved_inside(all_kinds()[i], initials()[i]), initials()[i]) << i;
}

TEST(BoundedVariables, WhatStartsOnABoundOrHasNoRoomIsNoVariable) {
  Eigen::VectorXd start = initials();
  start[1] = 1.0;
  start[3] = 2.0;
  const BoundedVariables variables(all_kinds(), start);
  EXPECT_THAT(variables.free(), testing::ElementsAre(0, 2));
  Eigen::VectorXd moved = start;
  moved[0] = 5.0;
  Eigen::VectorXd u = variables.start();
  u[0] = 5.0;
  EXPECT_LT((variables.parameters(u) - moved).norm(), 1e-12);
}

TEST(BoundedVariables, KnowsWhatLiesOnABound) {
  const BoundedVariables variables(all_kinds(), initials());
  Eigen::VectorXd x = initials();
  for (const int i : {0, 1, 2, 3}) EXPECT_FALSE(variables.at_bound(x, i)) << i;
  EXPECT_TRUE(variables.at_bound(x, 4));
  x << 0.0, 1.0, 0.5, 2.0 - 1e-9, 7.0;
  EXPECT_FALSE(variables.at_bound(x, 0));
  for (const int i : {1, 2, 3}) EXPECT_TRUE(variables.at_bound(x, i)) << i;
}

TEST(BoundedVariables, CrossedBoundsAreRefusedByName) {
  const std::vector<FitParameter> crossed = {{"coulomb", "Nm", 1.0, 2.0, 0.0}};
  try {
    BoundedVariables variables(crossed, Eigen::VectorXd::Ones(1));
    FAIL() << "was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("coulomb"));
  }
}

}  // namespace
}  // namespace sprung::identification
