#include "simulation/plant/gear_friction.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung::sim {
namespace {

FrictionConfig rich() {
  FrictionConfig friction;
  friction.coulomb_Nm = 4.0;
  friction.breakaway_Nm = 6.0;
  friction.stribeck_speed_rad_s = 0.2;
  friction.viscous_Nm_s_rad = 7.0;
  friction.driving_share = 0.1;
  friction.back_driving_share = 0.2;
  friction.asymmetry = 0.05;
  friction.temperature = {0.03, 24.0, 0.25};
  return friction;
}

TEST(GearFriction, CoulombAloneDoesNotVary) {
  FrictionConfig plain;
  plain.coulomb_Nm = plain.breakaway_Nm = 7.3;
  plain.viscous_Nm_s_rad = 2.0;
  const GearFriction gear(plain, {}, 50.0);
  EXPECT_FALSE(gear.varies());
  EXPECT_FALSE(gear.heats());
  EXPECT_FALSE(gear.has_temperature());
  EXPECT_EQ(gear.dry_Nm(3.0, 100.0, 1.0), 7.3);
  EXPECT_EQ(gear.viscous_Nm_s_rad(-1.0), 2.0);
}

TEST(GearFriction, EachTermAloneMakesItVary) {
  const auto varies = [](auto change) {
    FrictionConfig friction;
    friction.coulomb_Nm = friction.breakaway_Nm = 1.0;
    change(friction);
    return GearFriction(friction, {}, 24.0).varies();
  };
  EXPECT_FALSE(varies([](FrictionConfig&) {}));
  EXPECT_TRUE(varies([](FrictionConfig& f) { f.breakaway_Nm = 1.1; }));
  EXPECT_TRUE(varies([](FrictionConfig& f) { f.driving_share = 0.1; }));
  EXPECT_TRUE(varies([](FrictionConfig& f) { f.back_driving_share = 0.1; }));
  EXPECT_TRUE(varies([](FrictionConfig& f) { f.asymmetry = -0.1; }));
  EXPECT_TRUE(varies([](FrictionConfig& f) { f.temperature.per_K = 0.03; }));
  EXPECT_TRUE(varies([](FrictionConfig& f) { f.motor_ripple.share = 0.05; }));
  EXPECT_TRUE(varies([](FrictionConfig& f) { f.joint_ripple.share = 0.05; }));
  EXPECT_TRUE(varies([](FrictionConfig& f) { f.presliding_rad = 1e-4; }));
}

TEST(GearFriction, RipplesByBothAngles) {
  FrictionConfig friction;
  EXPECT_EQ(GearFriction(friction, {}, 24.0).ripple(1.0, 2.0), 1.0);
  friction.motor_ripple = {0.05, 2.0, 0.3};
  friction.joint_ripple = {0.1, 1.0, 0.0};
  const GearFriction gear(friction, {}, 24.0);
  EXPECT_NEAR(gear.ripple(1.0, 2.0), (1 + 0.05 * std::sin(2.3)) * (1 + 0.1 * std::sin(2.0)), 1e-12);
  EXPECT_NEAR(gear.ripple(1.0 + M_PI, 2.0), gear.ripple(1.0, 2.0), 1e-12) << "twice in each turn";
}

/// Facts papers D1 by hand, at the reference temperature.
TEST(GearFriction, LawOfSpeedLoadAndDirection) {
  const GearFriction gear(rich(), {}, 24.0);
  EXPECT_NEAR(gear.dry_Nm(0.0, 0.0, 0.0), 6.0, 1e-12);
  EXPECT_NEAR(gear.dry_Nm(0.2, 0.0, 1.0), 1.05 * (4.0 + 2.0 * std::exp(-1.0)), 1e-12);
  EXPECT_NEAR(gear.dry_Nm(-0.2, 0.0, -1.0), 0.95 * (4.0 + 2.0 * std::exp(-1.0)), 1e-12);
  EXPECT_NEAR(gear.dry_Nm(5.0, 10.0, 1.0), 1.05 * (4.0 + 0.1 * 10.0), 1e-12) << "driving";
  EXPECT_NEAR(gear.dry_Nm(5.0, -10.0, 1.0), 1.05 * (4.0 + 0.2 * 10.0), 1e-12) << "driven back";
  EXPECT_NEAR(gear.dry_Nm(-5.0, -10.0, -1.0), 0.95 * (4.0 + 0.1 * 10.0), 1e-12) << "driving the other way";
  EXPECT_NEAR(gear.viscous_Nm_s_rad(1.0), 1.05 * 7.0, 1e-12);
  EXPECT_NEAR(gear.viscous_Nm_s_rad(-1.0), 0.95 * 7.0, 1e-12);
}

TEST(GearFriction, LoadShareMakesNoStepWhereTheLoadChangesSign) {
  const GearFriction gear(rich(), {}, 24.0);
  EXPECT_NEAR(gear.dry_Nm(1.0, 1e-9, 1.0), gear.dry_Nm(1.0, -1e-9, 1.0), 1e-8);
}

TEST(GearFriction, WarmthThinsTheGreaseAndAShareOfTheDryPart) {
  const GearFriction warm(rich(), {}, 50.0);
  const double factor = std::exp(-0.03 * 26.0);
  EXPECT_NEAR(warm.viscous_Nm_s_rad(0.0), 7.0 * factor, 1e-12);
  EXPECT_NEAR(warm.dry_Nm(9.0, 0.0, 0.0), 4.0 * (0.75 + 0.25 * factor), 1e-12);
  EXPECT_NEAR(warm.dry_Nm(9.0, -10.0, 0.0) - warm.dry_Nm(9.0, 0.0, 0.0), 2.0, 1e-12) << "load is as ever";
  EXPECT_GT(GearFriction(rich(), {}, 0.0).viscous_Nm_s_rad(0.0), 7.0);
}

/// Closed form of a first-order lag: T - ambient = P R (1 - exp(-t / tau)).
TEST(GearFriction, WarmsAsAFirstOrderLag) {
  GearFriction gear(rich(), {0.5, 100.0}, 24.0);
  EXPECT_TRUE(gear.heats());
  for (int i = 0; i < 400000; ++i) gear.heat(40.0, 0.25e-3);
  EXPECT_NEAR(gear.temperature_degC(), 24.0 + 20.0 * (1.0 - std::exp(-1.0)), 1e-3);
  gear.reset();
  EXPECT_EQ(gear.temperature_degC(), 24.0);
}

TEST(GearFriction, CoolsToItsSurroundings) {
  GearFriction gear(rich(), {0.5, 100.0}, 24.0);
  for (int i = 0; i < 100; ++i) gear.heat(1000.0, 0.1);
  ASSERT_GT(gear.temperature_degC(), 40.0);
  for (int i = 0; i < 20000; ++i) gear.heat(0.0, 0.1);
  EXPECT_NEAR(gear.temperature_degC(), 24.0, 1e-5);
}

}  // namespace
}  // namespace sprung::sim
