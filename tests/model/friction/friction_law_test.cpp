#include "model/friction/friction_law.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/model/friction/friction_examples.h"
#include "tests/model/friction/parameter_sets.h"

namespace sprung {
namespace {

double gradient(const FrictionValue& value, FrictionParameter parameter) {
  return value.gradient[static_cast<std::size_t>(parameter)];
}

TEST(FrictionLawTest, CoulombIsTheSignAndNoneAtRest) {
  FrictionParameters p;
  p.coulomb_Nm = 1.79;
  EXPECT_EQ(friction_torque_Nm(p, at(0.4)), 1.79);
  EXPECT_EQ(friction_torque_Nm(p, at(-0.4)), -1.79);
  EXPECT_EQ(friction_torque_Nm(p, at(0.0)), 0.0);  // errata E5
}

TEST(FrictionLawTest, StribeckFallsFromBreakawayToCoulomb) {
  FrictionParameters p;
  p.coulomb_Nm = 3.0;
  p.stribeck_Nm = 1.0;
  p.stribeck_speed_rad_s = 0.2;
  EXPECT_NEAR(friction_torque_Nm(p, at(1e-9)), 4.0, 1e-9);
  EXPECT_NEAR(friction_torque_Nm(p, at(0.2)), 3.0 + std::exp(-1.0), 1e-15);
  EXPECT_NEAR(friction_torque_Nm(p, at(5.0)), 3.0, 1e-15);
}

TEST(FrictionLawTest, FullLawIsTheFormulaOfTheHeader) {
  const FrictionParameters p = full_friction();
  const double w = -0.3, load = 8.0, warm = 26.0;  // driven: load and motion oppose each other
  const double dry = (3.3 + std::exp(-std::pow(0.3 / 0.15, 1.7))) * std::exp(-0.004 * warm);
  const double expected = -(1.0 - 0.07) * (dry + 0.12 * load) -
                          1.3 * std::exp(-0.03 * warm) * std::pow(0.3, 0.8);
  EXPECT_NEAR(friction_torque_Nm(p, at(w, load, 50.0)), expected, 1e-12);
}

TEST(FrictionLawTest, LoadShareDependsOnTheDirectionOfPower) {
  FrictionParameters p;
  p.load_share_driving = 0.05;
  p.load_share_driven = 0.2;
  EXPECT_DOUBLE_EQ(friction_torque_Nm(p, at(1.0, 100.0)), 5.0);
  EXPECT_DOUBLE_EQ(friction_torque_Nm(p, at(1.0, -100.0)), 20.0);
  EXPECT_DOUBLE_EQ(friction_torque_Nm(p, at(-1.0, -100.0)), -5.0);
}

TEST(FrictionLawTest, ShortAnswersAreThoseOfTheWholeLaw) {
  for (const double w : {-0.7, -0.1, 0.0, 0.2, 3.0}) {
    for (const double load : {-40.0, 0.0, 25.0}) {
      const FrictionInput in = at(w, load, 31.0);
      const FrictionValue whole = evaluate(full_friction(), in);
      EXPECT_EQ(friction_torque_Nm(full_friction(), in), whole.torque_Nm);
      EXPECT_EQ(loaded_friction(full_friction(), in).torque_Nm, whole.torque_Nm);
      EXPECT_EQ(loaded_friction(full_friction(), in).by_load, whole.by_load);
    }
  }
}

/// An exponential that is 1 is not worked out: the law must not step there.
TEST(FrictionLawTest, AtRestAndAtTheReferenceTemperatureItIsTheLimit) {
  const FrictionParameters p = full_friction();
  FrictionInput rest = at(0.0, 5.0, p.reference_temperature_C),
                nearly = at(1e-13, 5.0, 1e-10 + p.reference_temperature_C);
  rest.sign = nearly.sign = 1.0;
  EXPECT_NEAR(friction_torque_Nm(p, rest), friction_torque_Nm(p, nearly), 1e-9);
}

TEST(FrictionLawTest, WithoutTemperatureItIsTheReferences) {
  const FrictionParameters p = full_friction();
  FrictionInput in = at(0.3, 5.0);
  const double reference = friction_torque_Nm(p, in);
  in.temperature_C = std::nan("");
  EXPECT_EQ(friction_torque_Nm(p, in), reference);
  EXPECT_LT(friction_torque_Nm(p, at(0.3, 5.0, 50.0)), reference);
}

TEST(FrictionLawTest, GivenSignTakesThePlaceOfTheVelocitys) {
  FrictionParameters p;
  p.coulomb_Nm = 2.0;
  p.viscous_Nm_s_rad = 10.0;
  FrictionInput in = at(0.01);
  in.sign = -0.5;
  EXPECT_DOUBLE_EQ(friction_torque_Nm(p, in), -1.0 + 0.1);
}

TEST(FrictionLawTest, IsOddWithoutAsymmetry) {
  FrictionParameters p = full_friction();
  p.asymmetry = 0.0;
  for (const FrictionInput& in : many_points()) {
    const FrictionInput mirrored = at(-in.velocity_rad_s, -in.gear_output_torque_Nm, in.temperature_C);
    EXPECT_EQ(friction_torque_Nm(p, mirrored), -friction_torque_Nm(p, in));
  }
}

TEST(FrictionLawTest, OnlyEverTakesEnergy) {
  for (const FrictionInput& in : many_points())
    EXPECT_GT(friction_torque_Nm(full_friction(), in) * in.velocity_rad_s, 0.0);
}

TEST(FrictionLawTest, GradientIsThatOfFiniteDifferences) {
  const FrictionVector here = to_vector(full_friction());
  for (const FrictionInput& in : many_points()) {
    const FrictionValue value = evaluate(test::from_vector(here), in);
    EXPECT_EQ(value.torque_Nm, friction_torque_Nm(test::from_vector(here), in));
    for (const FrictionParameterInfo& row : friction_parameter_table()) {
      const auto i = static_cast<std::size_t>(row.index);
      const double step = 1e-5 * here[i];
      FrictionVector above = here, below = here;
      above[i] += step;
      below[i] -= step;
      const double difference = (friction_torque_Nm(test::from_vector(above), in) -
                                 friction_torque_Nm(test::from_vector(below), in)) /
                                (2.0 * step);
      EXPECT_NEAR(value.gradient[i], difference, 1e-6 * (1.0 + std::abs(difference))) << row.name;
    }
  }
}

TEST(FrictionLawTest, DerivativesByVelocityLoadAndSignAreThoseOfFiniteDifferences) {
  const FrictionParameters p = full_friction();
  for (FrictionInput in : many_points()) {
    in.sign = in.velocity_rad_s > 0.0 ? 0.6 : -0.6;
    const FrictionValue value = evaluate(p, in);
    const auto slope = [&](double FrictionInput::*member, double step) {
      FrictionInput above = in, below = in;
      above.*member += step;
      below.*member -= step;
      return (friction_torque_Nm(p, above) - friction_torque_Nm(p, below)) / (2.0 * step);
    };
    EXPECT_NEAR(value.by_velocity_Nm_s_rad, slope(&FrictionInput::velocity_rad_s, 1e-7), 1e-4);
    EXPECT_NEAR(value.by_load, slope(&FrictionInput::gear_output_torque_Nm, 1e-3), 1e-9);
    EXPECT_NEAR(value.by_sign_Nm, slope(&FrictionInput::sign, 1e-4), 1e-8);
  }
}

TEST(FrictionLawTest, GradientByPreslidingFollowsTheSigns) {
  FrictionParameters p;
  p.coulomb_Nm = 4.0;
  FrictionInput in = at(0.0);
  in.sign = 0.5;
  in.sign_by_presliding_1_rad = -300.0;
  EXPECT_DOUBLE_EQ(gradient(evaluate(p, in), FrictionParameter::kPresliding), -1200.0);
}

TEST(FrictionLawTest, EverythingIsFiniteAtRest) {
  const FrictionValue value = evaluate(full_friction(), at(0.0, 30.0, 40.0));
  EXPECT_EQ(value.torque_Nm, 0.0);
  EXPECT_EQ(value.by_velocity_Nm_s_rad, 0.0);
  for (const double part : value.gradient) EXPECT_EQ(part, 0.0);
}

TEST(FrictionLawTest, RicherModelsEndInThePoorerOnesWhereTheirTermsVanish) {
  const FrictionParameters full = full_friction();
  for (const FrictionModelKind kind : kFrictionModels) {
    FrictionParameters faded = full;
    for (const FrictionParameterInfo& row : friction_parameter_table()) {
      if (!allows(kind, row.index)) faded.*(row.member) = row.off + 1e-9 * (full.*(row.member) - row.off);
    }
    for (const FrictionInput& in : many_points()) {
      EXPECT_NEAR(friction_torque_Nm(faded, in), friction_torque_Nm(restricted(full, kind), in), 1e-6);
    }
  }
}

}  // namespace
}  // namespace sprung
