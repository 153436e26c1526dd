#include "estimator/torsion_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sprung {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

GearTorsion gear() {
  GearTorsion g;
  g.stiffness_Nm_rad = 25000.0;
  g.second_stiffness_Nm_rad = 34000.0;
  g.second_from_Nm = 14.0;
  g.angle_std_rad = 1e-5;
  return g;
}

/// Facts papers D8: K1 up to T1, K2 beyond; odd.
TEST(TorsionSensorTest, TwistIsTorqueByTwoStiffnesses) {
  const double knee_rad = 14.0 / 25000.0;
  EXPECT_NEAR(torsion_torque(gear(), 0.0002, 0.0).torque_Nm, 5.0, 1e-9);
  EXPECT_NEAR(torsion_torque(gear(), knee_rad + 0.001, 0.0).torque_Nm, 14.0 + 34.0, 1e-9);
  EXPECT_NEAR(torsion_torque(gear(), -knee_rad - 0.001, 0.0).torque_Nm, -48.0, 1e-9);
  GearTorsion single = gear();
  single.second_from_Nm = 0.0;
  EXPECT_NEAR(torsion_torque(single, 0.002, 0.0).torque_Nm, 50.0, 1e-9);
}

TEST(TorsionSensorTest, ItsErrorIsTheAnglesTimesTheSlope) {
  EXPECT_NEAR(torsion_torque(gear(), 1e-4, 1e-5).std_Nm, 0.25, 1e-12);
  EXPECT_NEAR(torsion_torque(gear(), 1e-2, 1e-5).std_Nm, 0.34, 1e-12);
}

/// Facts papers D7: 0.29 mrad would be 7.3 Nm.
TEST(TorsionSensorTest, KinematicErrorIsRemovedBeforeItLooksLikeTorque) {
  GearTorsion g = gear();
  g.kinematic_error[0] = {2.0, 0.0, 0.00029};
  g.kinematic_error[1] = {0.98, 0.00005, 0.0};
  for (double a = -20.0; a < 20.0; a += 0.37) {
    const double seen_rad = 0.5 + 0.00029 * std::sin(2.0 * a) + 0.00005 * std::cos(0.98 * a);
    g.kinematic_terms = 2;
    EXPECT_NEAR(torsion_torque(g, twist_rad(g, 0.5 + 0.0002, seen_rad, a), 0.0).torque_Nm, 5.0, 1e-6);
  }
  g.kinematic_terms = 0;
  EXPECT_GT(std::abs(torsion_torque(g, twist_rad(g, 0.5, 0.5 + 0.00029, 0.0), 0.0).torque_Nm), 7.0);
}

TEST(TorsionSensorTest, WithoutALinkAngleThereIsNoTorque) {
  const TorsionTorque none = torsion_torque(gear(), twist_rad(gear(), 1.0, std::nan(""), 0.0), 0.0);
  EXPECT_TRUE(std::isnan(none.torque_Nm));
  EXPECT_EQ(none.std_Nm, kInfinite);
}

TEST(TorsionSensorTest, TwistOfATorqueIsTheInverse) {
  for (double torque_Nm : {-60.0, -14.0, -3.0, 0.0, 9.0, 30.0})
    EXPECT_NEAR(torsion_torque(gear(), twist_of_rad(gear(), torque_Nm), 0.0).torque_Nm, torque_Nm, 1e-9);
}

TEST(TorsionZeroTest, AMoveToAndFroFindsTheZeroAlthoughFrictionIsWrong) {
  TorsionZero zero;
  zero.reset();
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, 4e-5);
  const double before_rad = zero.std_rad();
  for (int k = 0; k < 4000; ++k) {
    const double wrong_rad = k < 2000 ? 2e-5 : -2e-5;  // 0.5 Nm of friction
    zero.observe(1e-4 + 3e-4 + wrong_rad + noise(random), 1e-4, 0.001);
  }
  EXPECT_NEAR(zero.zero_rad(), 3e-4, 2e-5);
  EXPECT_LT(zero.std_rad(), 0.1 * before_rad);
  const double found_rad = zero.zero_rad();
  zero.observe(std::nan(""), 0.0, 0.001);
  EXPECT_EQ(zero.zero_rad(), found_rad);
}

TEST(TorsionSensorTest, FusionWeightsByInverseVariance) {
  const TorsionTorque both = fused({10.0, 4.0}, {20.0, 2.0});
  EXPECT_NEAR(both.torque_Nm, 18.0, 1e-12);
  EXPECT_NEAR(both.std_Nm, 1.0 / std::sqrt(1.0 / 16.0 + 1.0 / 4.0), 1e-12);
  EXPECT_EQ(fused({10.0, 4.0}, {}).torque_Nm, 10.0);
  EXPECT_EQ(fused({}, {20.0, 2.0}).torque_Nm, 20.0);
  EXPECT_EQ(fused({10.0, 0.0}, {20.0, 2.0}).torque_Nm, 10.0);
}

}  // namespace
}  // namespace sprung
