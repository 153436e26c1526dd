#include "drivers/profiles/epos2/epos2_device.h"

#include <cmath>
#include <set>

#include "drivers/profiles/epos2/epos2_units.h"
#include "tests/simulation/node/drive_bench.h"

namespace sprung::sim {
namespace {

using namespace epos2;

constexpr double kTorque_Nm_A = 50.0 * 0.217;
constexpr double kEpos2DeviceCountsPerRad = 16384 * 50.0 / (2 * M_PI);

/// Facts canopen 2.2, column "value & 0x417F".
TEST(Epos2Drive, ShowsTheTwelveStatusWords) {
  DriveBench bench(epos2_setup(), 0.0);
  std::set<int> seen;
  const auto look = [&] { seen.insert(bench.status() & 0x417F); };
  const auto walk = [&](double time_s, double speed_rad_s) {
    for (double t = 0.0; t < time_s; t += 0.00025) {
      bench.run(0.00025, speed_rad_s);
      look();
    }
  };
  walk(0.01, 0.0);
  bench.write(canopen::kMode, kModeCurrent, 1);
  for (const int word : {0x06, 0x07, 0x0F}) {
    bench.write(canopen::kControlWord, word, 2);
    walk(0.04, 0.0);
  }
  bench.write(0x605E, 2, 2);
  walk(0.01, 1.0);
  bench.write(canopen::kControlWord, 0x02, 2);
  walk(0.01, 1.0);
  EXPECT_EQ(seen, (std::set<int>{0x0000, 0x0100, 0x0140, 0x0121, 0x0123, 0x4123, 0x4133, 0x0137, 0x0117}));
  bench.drive->raise_fault(0x2310);
  look();
  bench.run(0.0005);
  look();
  EXPECT_TRUE(seen.count(0x010F) == 1 || seen.count(0x0108) == 1);
  EXPECT_EQ(bench.status() & 0x417F, 0x0108);
}

TEST(Epos2Drive, FollowingErrorBrakesWithPowerByItsOption) {
  DriveBench bench;
  bench.write(0x605E, 2, 2);
  bench.write(kPositionRegulator, 0, 2, 1);
  bench.start(kModePosition);
  bench.run(0.02, 1.0);
  EXPECT_EQ(bench.status() & 0x417F, 0x011F);  // fault reaction, enabled
  EXPECT_LT(bench.drive->motor_torque_Nm(), -20.0);
  EXPECT_EQ(bench.emergencies, std::vector<int>{0x8611});
  bench.run(0.002, 0.0);
  EXPECT_EQ(bench.status() & 0x417F, 0x0108);
  EXPECT_EQ(bench.drive->motor_torque_Nm(), 0.0);
}

TEST(Epos2Drive, FollowingErrorIsOffAtItsLargestValue) {
  DriveBench bench;
  bench.write(kMaxFollowingError, 0xFFFFFFFF, 4);
  bench.start(kModePosition);
  bench.run(0.1, 1.0);
  EXPECT_TRUE(bench.emergencies.empty());
  EXPECT_NEAR(bench.read_i16(0x20F4), -0.1 * kEpos2DeviceCountsPerRad, 2.0);
}

TEST(Epos2Drive, BeyondItsPositionLimitsItFaultsInEveryModeOnceItHasPower) {
  for (const std::int8_t mode : {kModeCurrent, kModePosition}) {
    DriveBench bench;
    bench.write(kMaxFollowingError, 0xFFFFFFFF, 4);
    bench.write(kPositionLimits, -1000, 4, 1);
    bench.write(kPositionLimits, 2000, 4, 2);
    bench.start(mode);
    bench.run(0.01, 0.1);
    EXPECT_TRUE(bench.emergencies.empty());
    bench.run(0.5, 0.1);
    EXPECT_EQ(bench.emergencies, std::vector<int>{0xFF09}) << "mode " << int{mode};
    EXPECT_EQ(bench.drive->motor_torque_Nm(), 0.0);
  }
}

TEST(Epos2Drive, CurrentModeGivesTheCurrentInMilliamperes) {
  DriveBench bench;
  bench.start(kModeCurrent);
  bench.write(kCurrentSetting, -1500, 2);
  bench.run(0.02);
  EXPECT_NEAR(bench.drive->motor_torque_Nm(), -1.5 * kTorque_Nm_A, 1e-3);
  EXPECT_EQ(bench.read_i16(canopen::kCurrentActual), -1500);
  EXPECT_EQ(bench.read_i16(0x2031), -1500);
  EXPECT_NEAR(bench.read_i16(0x2027), -1500, 300);  // still on its way
  bench.run(0.1);
  EXPECT_EQ(bench.read_i16(0x2027), -1500);
}

TEST(Epos2Drive, PeakCurrentClampsAndShowsBit11) {
  DriveBench bench;
  bench.write(kMotorData, 3000, 2, 2);
  bench.start(kModeCurrent);
  bench.write(kCurrentSetting, 5000, 2);
  bench.run(0.05);
  EXPECT_EQ(bench.read_i16(canopen::kCurrentActual), 3000);
  EXPECT_NE(bench.status() & 0x800, 0);
  bench.write(kCurrentSetting, 1000, 2);
  bench.run(0.05);
  EXPECT_EQ(bench.status() & 0x800, 0);
}

/// 0x6410:05 = 1 s and twice the continuous current: warm after -ln(1 - 1/4) = 0.288 s.
TEST(Epos2Drive, WarmWindingGetsTheContinuousCurrentOnly) {
  DriveBench bench;
  bench.write(kMotorData, 2000, 2, 1);
  bench.write(kMotorData, 10, 2, 5);
  bench.start(kModeCurrent);
  bench.write(kCurrentSetting, 4000, 2);
  bench.run(0.27);
  EXPECT_EQ(bench.read_i16(canopen::kCurrentActual), 4000);
  EXPECT_EQ(bench.status() & 0x800, 0);
  bench.run(0.05);
  EXPECT_EQ(bench.read_i16(canopen::kCurrentActual), 2000);
  EXPECT_NE(bench.status() & 0x800, 0);
  bench.write(kCurrentSetting, 0, 2);
  bench.run(1.0);
  bench.write(kCurrentSetting, 4000, 2);
  bench.run(0.05);
  EXPECT_EQ(bench.read_i16(canopen::kCurrentActual), 4000);  // has cooled
}

TEST(Epos2Drive, SpeedCapTakesTheCurrent) {
  DriveBench bench;
  bench.write(kMotorData, 955, 4, 4);  // 2 rad/s of the output
  bench.start(kModeCurrent);
  bench.write(kCurrentSetting, 2000, 2);
  bench.run(0.05, 1.0);
  EXPECT_NEAR(bench.read_i16(canopen::kCurrentActual), 2000, 1);
  bench.run(0.05, 2.2);
  EXPECT_LT(bench.drive->motor_torque_Nm(), 0.0);
}

TEST(Epos2Drive, PositionModeIsTheSpringAndDamperOfItsUnits) {
  DriveBench bench;
  const double stiffness_Nm_rad = 500.0, damping_Nm_s_rad = 30.0;
  const double scale = 1e3 / kTorque_Nm_A / kEpos2DeviceCountsPerRad;
  bench.write(kPositionRegulator, std::llround(stiffness_Nm_rad * scale / kProportionalUnit_mA_qc), 2, 1);
  bench.write(kPositionRegulator, 0, 2, 2);
  bench.write(kPositionRegulator, std::llround(damping_Nm_s_rad * scale / kDerivativeUnit_mA_s_qc), 2, 3);
  bench.write(kMaxFollowingError, 0xFFFFFFFF, 4);
  bench.start(kModePosition);
  EXPECT_NEAR(bench.drive->motor_torque_Nm(), 0.0, 0.1);  // enters where it is
  bench.shaft_rad -= 0.1;
  bench.run(0.05);
  EXPECT_NEAR(bench.drive->motor_torque_Nm(), 50.0, 0.5);
  EXPECT_EQ(bench.status() & 0x400, 0);
  bench.write(kPositionSetting, bench.read_i32(canopen::kPositionActual), 4);
  bench.run(0.05);
  EXPECT_NEAR(bench.drive->motor_torque_Nm(), 0.0, 0.1);
  EXPECT_NE(bench.status() & 0x400, 0);  // target reached
  bench.run(0.1, 0.2);
  EXPECT_NEAR(bench.drive->motor_torque_Nm(), -0.02 * 500 - 0.2 * 30, 0.8);
}

/// Torque 0.1 rad off its set-point, at rest or turning.
double held_Nm(const PositionLoopConfig& truth, double speed_rad_s) {
  SimDriveSetup setup = epos2_setup();
  setup.truth.position_loop = truth;
  DriveBench bench(setup);
  bench.write(kMaxFollowingError, 0xFFFFFFFF, 4);
  bench.start(kModePosition);
  bench.shaft_rad -= 0.1 + 0.05 * speed_rad_s;
  bench.run(0.05, speed_rad_s);
  return bench.drive->motor_torque_Nm();
}

TEST(Epos2Drive, PositionLoopMayHaveAnotherStiffnessAndDampingThanItsObjectsSay) {
  const double still_Nm = held_Nm({}, 0.0), moving_Nm = held_Nm({}, 0.5);
  EXPECT_NEAR(held_Nm({1.2, 1.0, 0.0}, 0.0), 1.2 * still_Nm, 0.02 * still_Nm);
  EXPECT_NEAR(held_Nm({1.0, 0.8, 0.0}, 0.0), still_Nm, 1e-9);
  EXPECT_NEAR(held_Nm({1.0, 0.8, 0.0}, 0.5) - still_Nm, 0.8 * (moving_Nm - still_Nm), 0.5);
}

TEST(Epos2Drive, ModesThatAreNotSimulatedAreRefusedAndNotShown) {
  DriveBench bench;
  bench.start(kModeCurrent);
  for (const int mode : {6, 7, -4, 10}) {
    EXPECT_EQ(bench.try_write(canopen::kMode, mode, 1), canopen::kAbortRange) << mode;
    bench.run(0.01);
    EXPECT_EQ(static_cast<std::int8_t>(bench.read(canopen::kModeDisplay)), kModeCurrent) << mode;
  }
}

TEST(Epos2Drive, CountsBeginAtZeroAndWrapInTheCounter) {
  DriveBench bench;
  EXPECT_EQ(bench.read_i32(canopen::kPositionActual), 0);
  bench.run(0.1, -0.5);
  EXPECT_NEAR(bench.read_i32(canopen::kPositionActual), -0.05 * kEpos2DeviceCountsPerRad, 1.0);
  EXPECT_EQ(bench.read(kEncoderCounter),
            static_cast<std::uint32_t>(bench.read_i32(canopen::kPositionActual)));
  EXPECT_NEAR(bench.read_i32(0x606C), -0.5 * 50 * 60 / (2 * M_PI), 15.0);  // one count a tick is 15 rpm
  EXPECT_EQ(bench.read(kEncoderPulses, 1), 4096U);
}

/// What `sprung home` by the index needs: the pulse is where sim.yaml says, whatever the counter's zero.
TEST(Epos2Drive, CounterAtIndexGivesTheTrueAngle) {
  SimDriveSetup setup = epos2_setup();
  setup.truth.index_angle_rad = 0.7;
  DriveBench bench(setup);
  EXPECT_EQ(bench.read_i32(kCounterAtIndex), 0);
  bench.run(0.5, 0.4);  // 1.6 motor turns
  const double index_rad = bench.shaft_rad +
                           (bench.read_i32(kCounterAtIndex) - bench.read_i32(kEncoderCounter)) /
                               kEpos2DeviceCountsPerRad;
  EXPECT_NEAR(std::remainder(index_rad * 50.0 - 0.7, 2 * M_PI), 0.0, 1e-2);
}

TEST(Epos2Drive, RefusesRemappingInOperational) {
  DriveBench bench;
  EXPECT_EQ(bench.try_write(0x1400, 0xC0000204, 4, 1), 0U);
  bench.nmt(canopen::NmtCommand::kStart);
  EXPECT_EQ(bench.try_write(0x1400, 0x204, 4, 1), 0x0F00FFC0U);
}

}  // namespace
}  // namespace sprung::sim
