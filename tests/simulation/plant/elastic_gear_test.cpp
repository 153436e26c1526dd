#include "simulation/plant/elastic_gear.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung::sim {
namespace {

constexpr double kStep_s = 0.25e-3;
constexpr double kArmature = 0.81;
/// Facts papers C4, size 25 at 50:1.
constexpr TorsionConfig kTwoSlopes{2.5e4, 3.4e4, 14.0, 0.0};
constexpr TorsionConfig kPlain{2.5e4, 2.5e4, 0.0, 0.0};

ElasticGear at_rest(const TorsionConfig& torsion, double link_rad = 0.0) {
  ElasticGear gear(torsion, kArmature);
  gear.reset(link_rad);
  return gear;
}

TEST(ElasticGear, SpringHasTwoStiffnessesAndIsOdd) {
  const ElasticGear gear = at_rest(kTwoSlopes, 0.3);
  const double knee_rad = 14.0 / 2.5e4;
  EXPECT_EQ(gear.output_torque_Nm(0.3, 0.0), 0.0);
  EXPECT_NEAR(gear.output_torque_Nm(0.3 - 0.5 * knee_rad, 0.0), 7.0, 1e-9);
  EXPECT_NEAR(gear.output_torque_Nm(0.3 - knee_rad - 1e-4, 0.0), 14.0 + 3.4, 1e-8);
  EXPECT_NEAR(gear.output_torque_Nm(0.3 + knee_rad + 1e-4, 0.0), -17.4, 1e-8);
}

TEST(ElasticGear, DamperPullsTheLinkAlong) {
  const ElasticGear gear = at_rest({2.5e4, 2.5e4, 0.0, 5.0});
  EXPECT_NEAR(gear.output_torque_Nm(0.0, 2.0), -10.0, 1e-12);
}

/// Rotor against a fixed link: a mass on a spring.
TEST(ElasticGear, SwingsAtItsNaturalFrequencyAndKeepsItsEnergy) {
  ElasticGear gear = at_rest(kPlain, 0.001);  // 1 mrad of twist against a link at 0
  const auto energy_J = [&] {
    return 0.5 * kArmature * gear.velocity_rad_s() * gear.velocity_rad_s() +
           0.5 * 2.5e4 * gear.position_rad() * gear.position_rad();
  };
  const double start_J = energy_J();
  int crossings = 0;
  double first_s = 0.0, last_s = 0.0;
  for (int i = 0; i < 40000; ++i) {
    const double before = gear.position_rad();
    gear.step(0.0, gear.output_torque_Nm(0.0, 0.0), 0.0, 0.0, kStep_s);
    ASSERT_NEAR(energy_J(), start_J, 0.03 * start_J) << "step " << i;
    if (before < 0.0 && gear.position_rad() >= 0.0) {
      last_s = kStep_s * (i + before / (before - gear.position_rad()));
      if (crossings++ == 0) first_s = last_s;
    }
  }
  EXPECT_NEAR((crossings - 1) / (last_s - first_s), std::sqrt(2.5e4 / kArmature) / (2.0 * M_PI), 0.01);
}

TEST(ElasticGear, TransmitsNothingInThePlayOfItsTeeth) {
  const ElasticGear gear = at_rest({2.5e4, 2.5e4, 0.0, 5.0, 4e-4}, 0.3);
  EXPECT_EQ(gear.output_torque_Nm(0.3, 0.0), 0.0);
  EXPECT_EQ(gear.output_torque_Nm(0.3 - 1.9e-4, 2.0), 0.0) << "nor does the damper";
  EXPECT_EQ(gear.output_torque_Nm(0.3 + 1.9e-4, -2.0), 0.0);
  EXPECT_NEAR(gear.output_torque_Nm(0.3 - 2e-4 - 1e-3, 0.0), 25.0, 1e-8) << "behind it the spring";
  EXPECT_NEAR(gear.output_torque_Nm(0.3 + 2e-4 + 1e-3, 0.0), -25.0, 1e-8);
}

TEST(ElasticGear, FlanksThatPartDoNotPull) {
  const ElasticGear gear = at_rest({2.5e4, 2.5e4, 0.0, 5.0, 4e-4});
  EXPECT_GT(gear.output_torque_Nm(-3e-4, 0.4), 0.0);
  EXPECT_EQ(gear.output_torque_Nm(-3e-4, 4.0), 0.0);
}

/// Without friction a rotor thrown between two flanks is thrown back by each: the play's way there at the
/// speed that it has, half a swing of mass and spring in each flank.
TEST(ElasticGear, RotorBouncesBetweenItsFlanks) {
  ElasticGear gear = at_rest({2.5e4, 2.5e4, 0.0, 0.0, 4e-3});
  gear.step(kArmature * 0.5 / kStep_s, 0.0, 0.0, 0.0, kStep_s);
  const double start_rad_s = gear.velocity_rad_s();
  ASSERT_NEAR(start_rad_s, 0.5, 1e-12);
  int turns = 0;
  double first_s = 0.0, last_s = 0.0;
  for (int i = 0; i < 40000; ++i) {
    const double before_rad = gear.position_rad();
    gear.step(0.0, gear.output_torque_Nm(0.0, 0.0), 0.0, 0.0, kStep_s);
    if (before_rad < 0.0 && gear.position_rad() >= 0.0) {
      last_s = kStep_s * i;
      if (turns++ == 0) first_s = last_s;
      ASSERT_NEAR(gear.velocity_rad_s(), start_rad_s, 0.05 * start_rad_s);
    }
  }
  const double expected_s = 2 * 4e-3 / start_rad_s + 2 * M_PI / std::sqrt(2.5e4 / kArmature);
  EXPECT_NEAR((last_s - first_s) / (turns - 1), expected_s, 0.02 * expected_s);
}

TEST(ElasticGear, StaticTwistIsTorqueOverStiffness) {
  ElasticGear gear = at_rest({2.5e4, 3.4e4, 14.0, 50.0});
  for (int i = 0; i < 40000; ++i) gear.step(20.0, gear.output_torque_Nm(0.0, 0.0), 0.0, 0.0, kStep_s);
  EXPECT_NEAR(gear.position_rad(), 14.0 / 2.5e4 + 6.0 / 3.4e4, 1e-9);
  EXPECT_NEAR(gear.output_torque_Nm(0.0, 0.0), 20.0, 1e-6);
}

TEST(ElasticGear, DryFrictionHoldsExactlyUpToItsValue) {
  ElasticGear gear = at_rest(kPlain);
  for (int i = 0; i < 40000; ++i) gear.step(0.999 * 3.0, 0.0, 3.0, 0.0, kStep_s);
  EXPECT_EQ(gear.position_rad(), 0.0);
  EXPECT_NEAR(gear.friction_torque_Nm(), 0.999 * 3.0, 1e-12);
  gear.step(1.01 * 3.0, 0.0, 3.0, 0.0, kStep_s);
  EXPECT_GT(gear.position_rad(), 0.0);
}

TEST(ElasticGear, DryFrictionStopsItInTheTimeOfTheClosedForm) {
  ElasticGear gear = at_rest(kPlain);
  while (gear.velocity_rad_s() < 1.0) gear.step(kArmature / kStep_s * 0.1, 0.0, 0.0, 0.0, kStep_s);
  const double start_rad_s = gear.velocity_rad_s();
  int steps = 0;
  while (gear.velocity_rad_s() != 0.0 && steps < 100000) {
    gear.step(0.0, 0.0, 3.0, 0.0, kStep_s);
    ASSERT_LE(std::abs(gear.friction_torque_Nm()), 3.0 + 1e-12);
    ++steps;
  }
  EXPECT_NEAR(steps * kStep_s, start_rad_s * kArmature / 3.0, 2 * kStep_s);
  const double stopped_rad = gear.position_rad();
  gear.step(0.0, 0.0, 3.0, 0.0, kStep_s);
  EXPECT_EQ(gear.position_rad(), stopped_rad) << "and does not turn back";
}

TEST(ElasticGear, ViscousFrictionGivesTheTerminalSpeedWhateverItsSize) {
  for (const double viscous : {1.3, 7.4, 1e5}) {
    ElasticGear gear = at_rest(kPlain);
    for (int i = 0; i < 40000; ++i) gear.step(10.0, 0.0, 2.0, viscous, kStep_s);
    EXPECT_NEAR(gear.velocity_rad_s(), 8.0 / viscous, 1e-4 * 8.0 / viscous);
    EXPECT_NEAR(gear.friction_torque_Nm(), 10.0, 1e-3);
    EXPECT_NEAR(gear.dry_friction_Nm(), 2.0, 1e-12);
  }
}

/// Momentum balance of every step: J (v' - v) / dt = motor - output - friction.
TEST(ElasticGear, FrictionIsExactlyWhatIsMissingInTheBalance) {
  ElasticGear gear = at_rest(kTwoSlopes);
  for (int i = 0; i < 4000; ++i) {
    const double before = gear.velocity_rad_s();
    const double motor_Nm = 30.0 * std::sin(0.01 * i);
    const double output_Nm = gear.output_torque_Nm(0.0, 0.0);
    gear.step(motor_Nm, output_Nm, 4.0, 7.0, kStep_s);
    const double rotor_Nm = kArmature * (gear.velocity_rad_s() - before) / kStep_s;
    ASSERT_NEAR(gear.friction_torque_Nm(), motor_Nm - output_Nm - rotor_Nm, 1e-8) << i;
    ASSERT_GE(gear.friction_torque_Nm() * gear.velocity_rad_s(), 0.0);
  }
}

}  // namespace
}  // namespace sprung::sim
