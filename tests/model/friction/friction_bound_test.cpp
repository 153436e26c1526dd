#include "model/friction/friction_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/model/friction/friction_examples.h"

namespace sprung {
namespace {

TEST(FrictionBoundTest, QuantilesAreThoseOfTheNormalDistribution) {
  EXPECT_NEAR(two_sided_quantile(0.95), 1.959963984540054, 1e-12);
  EXPECT_NEAR(two_sided_quantile(0.6826894921370859), 1.0, 1e-12);
}

TEST(FrictionBoundTest, CertainParametersLeaveNothing) {
  EXPECT_EQ(friction_bound_Nm(evaluate(full_friction(), at(1.0)), {}, 0.95), 0.0);
}

TEST(FrictionBoundTest, RelativeUncertaintyScalesWithTheTorque) {
  FrictionParameters p;
  p.coulomb_Nm = 5.0;
  FrictionUncertainty uncertainty;
  uncertainty.relative = 0.1;
  EXPECT_NEAR(friction_bound_Nm(evaluate(p, at(-1.0)), uncertainty, 0.95), 0.98, 1e-3);
}

TEST(FrictionBoundTest, HoldsTheStatedShareOfDrawnParameters) {
  const FrictionParameters p = full_friction();
  FrictionUncertainty uncertainty;
  const FrictionVector here = to_vector(p);
  for (std::size_t i = 0; i < here.size(); ++i) uncertainty.standard_errors[i] = 0.02 * here[i];
  const FrictionInput in = at(0.2, 40.0, 35.0);
  const FrictionValue value = evaluate(p, in);
  const double bound_Nm = friction_bound_Nm(value, uncertainty, 0.9);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  int inside = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    FrictionVector drawn = here;
    for (std::size_t i = 0; i < drawn.size(); ++i)
      drawn[i] += uncertainty.standard_errors[i] * normal(random);
    inside += std::abs(friction_torque_Nm(from_vector(drawn), in) - value.torque_Nm) <= bound_Nm;
  }
  EXPECT_NEAR(inside / 20000.0, 0.9, 0.01);
}

}  // namespace
}  // namespace sprung
