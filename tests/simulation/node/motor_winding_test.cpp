#include "simulation/node/motor_winding.h"

#include <gtest/gtest.h>

#include "tests/simulation/node/drive_bench.h"

namespace sprung::sim {
namespace {

constexpr double kPegasus_Nm_A = 50.0 * 0.217;

SimDriveConfig ec90(double voltage_share = 1.0) {
  SimDriveConfig drive;
  drive.torque_constant_Nm_A = 0.217;
  drive.winding = WindingConfig{2.3, std::nullopt, voltage_share};
  return drive;
}

/// Most torque at the gear's output that 48 V leave at this speed.
double most_Nm(double speed_rad_s, double voltage_share = 1.0, double target_A = 1e3) {
  MotorWinding winding(ec90(voltage_share), 50.0, true);
  winding.turn(speed_rad_s, 1.0);
  return kPegasus_Nm_A * winding.reachable_A(target_A, 48.0);
}

/// facts D12: EC 90 flat behind 50:1 at 48 V.
TEST(MotorWinding, TorqueFallsAlongTheLineOfTheDataSheet) {
  EXPECT_NEAR(most_Nm(0.0), 226.4, 0.1);
  EXPECT_NEAR(most_Nm(3.4), 52.0, 1.0);
  EXPECT_NEAR(most_Nm(3.9), 26.0, 1.0);
  EXPECT_NEAR(most_Nm(4.1), 17.0, 1.0);
  EXPECT_NEAR(most_Nm(48.0 / kPegasus_Nm_A), 0.0, 1e-9) << "no-load speed";
}

TEST(MotorWinding, WhatThePowerStageKeepsMakesItSlower) {
  EXPECT_NEAR(most_Nm(0.9 * 48.0 / kPegasus_Nm_A, 0.9), 0.0, 1e-9);
  EXPECT_LT(most_Nm(4.1, 0.9), 0.0) << "dragged faster than it can turn, it brakes";
}

TEST(MotorWinding, BothDirectionsHaveTheSameLineAndBrakingHasMore) {
  EXPECT_NEAR(most_Nm(-3.4, 1.0, -1e3), -most_Nm(3.4), 1e-9);
  EXPECT_NEAR(most_Nm(3.4, 1.0, -1e3), -most_Nm(-3.4), 1e-9);
  EXPECT_GT(most_Nm(-3.4), most_Nm(0.0));
}

TEST(MotorWinding, WhatCanBeReachedIsLeftAsItIs) {
  MotorWinding winding(ec90(), 50.0, true);
  winding.turn(1.0, 1.0);
  EXPECT_EQ(winding.reachable_A(2.125, 48.0), 2.125);
  EXPECT_EQ(winding.reachable_A(-2.125, 48.0), -2.125);
}

TEST(MotorWinding, IdealOnesReachEverythingAndStillTellTheirVoltage) {
  MotorWinding told(ec90(), 50.0, false);
  told.turn(3.0, 1.0);
  EXPECT_EQ(told.reachable_A(50.0, 48.0), 50.0);
  EXPECT_NEAR(told.state(2.0).voltage_V, 4.6 + 3.0 * kPegasus_Nm_A, 1e-12);
  MotorWinding unknown(SimDriveConfig{}, 50.0, true);
  unknown.turn(3.0, 1.0);
  EXPECT_EQ(unknown.reachable_A(50.0, 48.0), 50.0);
  EXPECT_EQ(unknown.state(50.0).power_W, 0.0);
}

/// Copper's loss and what goes to the shaft; braking gives back what copper leaves.
TEST(MotorWinding, PowerIsTheSumOfLossAndWork) {
  MotorWinding winding(ec90(), 50.0, true);
  winding.turn(2.0, 1.0);
  const double work_W = 2.0 * kPegasus_Nm_A * 3.0;
  EXPECT_NEAR(winding.state(3.0).power_W, 2.3 * 9.0 + work_W, 1e-9);
  EXPECT_NEAR(winding.state(-3.0).power_W, 2.3 * 9.0 - work_W, 1e-9);
}

TEST(MotorWinding, BackEmfOfItsOwnAndFluxBesideTheCurrentCount) {
  SimDriveConfig drive = ec90();
  drive.winding->back_emf_V_s_rad = 0.1;
  MotorWinding winding(drive, 50.0, true);
  winding.turn(2.0, 1.0);
  EXPECT_NEAR(winding.state(0.0).voltage_V, 10.0, 1e-12);
  winding.turn(2.0, -0.5);
  EXPECT_NEAR(winding.state(0.0).voltage_V, -5.0, 1e-12);
}

SimDriveSetup real_setup() {
  SimDriveSetup setup = epos2_setup();
  setup.actuator.speed_limit_rad_s = 0.0;  // no cap: voltage alone
  setup.truth.winding = WindingConfig{2.3, std::nullopt, 1.0};
  setup.real_winding = true;
  return setup;
}

/// Torque of a drive that is asked for 9 A while its shaft turns.
double driven_Nm(const SimDriveSetup& setup, double speed_rad_s, int* status = nullptr) {
  DriveBench bench(setup);
  bench.write(0x6410, 25000, 4, 4);  // speed cap out of the way
  bench.write(0x6410, 10000, 2, 2);
  bench.start(-3);
  bench.write(0x2030, 9000, 2);
  bench.run(0.02, speed_rad_s);
  if (status != nullptr) *status = bench.status();
  return bench.drive->motor_torque_Nm();
}

TEST(MotorWindingOfADrive, GivesWhatVoltageAllowsAndShowsThatItIsLimited) {
  int status = 0;
  EXPECT_NEAR(driven_Nm(real_setup(), 3.9, &status), 26.0, 1.0);
  EXPECT_NE(status & (1 << 11), 0);
  EXPECT_NEAR(driven_Nm(real_setup(), 0.5, &status), 9.0 * kPegasus_Nm_A, 0.1);
  EXPECT_EQ(status & (1 << 11), 0);
  EXPECT_NEAR(driven_Nm(real_setup(), -3.9), 9.0 * kPegasus_Nm_A, 0.1) << "braking has voltage enough";
}

TEST(MotorWindingOfADrive, IdealOneGivesWhatItWasAsked) {
  SimDriveSetup setup = real_setup();
  setup.real_winding = false;
  EXPECT_NEAR(driven_Nm(setup, 3.9), 9.0 * kPegasus_Nm_A, 0.1);
}

TEST(MotorWindingOfADrive, LowerSupplyMakesItWeakerAndShaftThatIsPutElsewhereNot) {
  DriveBench bench(real_setup());
  bench.write(0x6410, 25000, 4, 4);
  bench.write(0x6410, 10000, 2, 2);
  bench.start(-3);
  bench.write(0x2030, 9000, 2);
  bench.drive->set_supply_V(40.0);
  bench.run(0.02, 3.4);
  EXPECT_NEAR(bench.drive->motor_torque_Nm(), kPegasus_Nm_A * (40.0 - kPegasus_Nm_A * 3.4) / 2.3, 0.5);
  bench.run(0.02);
  const double held_Nm = bench.drive->motor_torque_Nm();
  bench.shaft_rad += 1.0;
  bench.drive->forget_motion();
  bench.run(0.00025);
  EXPECT_NEAR(bench.drive->motor_torque_Nm(), held_Nm, 1e-6);
}

}  // namespace
}  // namespace sprung::sim
