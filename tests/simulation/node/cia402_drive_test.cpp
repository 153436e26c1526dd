#include "simulation/node/cia402_drive.h"

#include <cmath>

#include "drivers/profiles/epos2/epos2_units.h"
#include "tests/simulation/node/drive_bench.h"

namespace sprung::sim {
namespace {

using epos2::kCurrentSetting;
using epos2::kModeCurrent;
using epos2::kModePosition;

constexpr double kCia402DriveTorque_Nm_A = 50.0 * 0.217;

bool in_fault(DriveBench& bench) { return (bench.status() & 0x4F) == 0x08; }

TEST(Cia402Drive, UnderVoltageStandsUntilTheSupplyIsBack) {
  DriveBench bench;
  bench.start(kModeCurrent);
  bench.drive->set_fault(FaultKind::kUnderVoltage, 8.0, true);
  bench.run(0.01);
  EXPECT_EQ(bench.emergencies, std::vector<int>{0x3220});
  bench.reset_fault();
  EXPECT_TRUE(in_fault(bench));
  bench.drive->set_fault(FaultKind::kUnderVoltage, 8.0, false);
  bench.run(0.01);
  EXPECT_TRUE(in_fault(bench));
  bench.reset_fault();
  EXPECT_FALSE(in_fault(bench));
  EXPECT_EQ(bench.emergencies, (std::vector<int>{0x3220, 0}));
}

TEST(Cia402Drive, TooMuchSupplyIsOverVoltageAndNoneGivenIsTooLittle) {
  DriveBench bench;
  bench.start(kModeCurrent);
  bench.drive->set_fault(FaultKind::kUnderVoltage, 70.0, true);
  bench.run(0.001);
  EXPECT_EQ(bench.emergencies.back(), 0x3210);
  DriveBench other;
  other.start(kModeCurrent);
  other.drive->set_fault(FaultKind::kUnderVoltage, 0.0, true);
  other.run(0.001);
  EXPECT_EQ(other.emergencies.back(), 0x3220);
}

TEST(Cia402Drive, OverTemperatureStandsUntilItHasCooled) {
  DriveBench bench;
  bench.start(kModeCurrent);
  bench.drive->set_fault(FaultKind::kOverTemperature, 0.0, true);
  bench.run(0.01);
  bench.reset_fault();
  EXPECT_TRUE(in_fault(bench));
  EXPECT_EQ(bench.emergencies, std::vector<int>{0x4210});
  bench.drive->set_fault(FaultKind::kOverTemperature, 0.0, false);
  bench.reset_fault();
  EXPECT_FALSE(in_fault(bench));
}

TEST(Cia402Drive, OverCurrentIsOverAtOnce) {
  DriveBench bench;
  bench.start(kModeCurrent);
  bench.write(kCurrentSetting, 1000, 2);
  bench.run(0.02);
  bench.drive->set_fault(FaultKind::kOverCurrent, 0.0, true);
  bench.run(0.001);
  EXPECT_EQ(bench.drive->motor_torque_Nm(), 0.0);
  bench.reset_fault();
  EXPECT_FALSE(in_fault(bench));
}

/// The loop brings what the sensor shows to the set-point, so the true current is off by the sensor's error.
TEST(Cia402Drive, CurrentSensorOffsetShiftsTheTrueTorque) {
  DriveBench bench;
  bench.start(kModeCurrent);
  bench.drive->set_fault(FaultKind::kCurrentOffset, 0.5, true);
  bench.write(kCurrentSetting, 2000, 2);
  bench.run(0.05);
  EXPECT_NEAR(bench.drive->motor_torque_Nm(), 1.5 * kCia402DriveTorque_Nm_A, 1e-3);
  EXPECT_EQ(bench.read_i16(canopen::kCurrentActual), 2000);
  bench.drive->set_fault(FaultKind::kCurrentOffset, 0.5, false);
  bench.run(0.05);
  EXPECT_NEAR(bench.drive->motor_torque_Nm(), 2.0 * kCia402DriveTorque_Nm_A, 1e-3);
}

TEST(Cia402Drive, GainAndOffsetOfItsCurrentSensorMakeTheTrueTorqueAnother) {
  SimDriveSetup setup = epos2_setup();
  setup.truth.current_sensor = {0.05, 1.02};
  DriveBench bench(setup);
  bench.start(kModeCurrent);
  bench.write(kCurrentSetting, 2000, 2);
  bench.run(0.05);
  EXPECT_EQ(bench.read_i16(canopen::kCurrentActual), 2000) << "the loop regulates what is shown";
  EXPECT_NEAR(bench.drive->motor_torque_Nm(), (2.0 - 0.05) / 1.02 * kCia402DriveTorque_Nm_A, 1e-3);
}

TEST(Cia402Drive, FollowingErrorOfItsOwnIsAFaultInPositionModeAlone) {
  SimDriveSetup setup = epos2_setup();
  setup.truth.position_loop.following_error_rad = 0.1;
  for (const bool position : {false, true}) {
    DriveBench bench(setup);
    bench.write(0x6065, 0xFFFFFFFF, 4);
    bench.start(position ? kModePosition : kModeCurrent);
    bench.run(0.09, 1.0);
    EXPECT_TRUE(bench.emergencies.empty());
    bench.run(0.02, 1.0);
    EXPECT_EQ(bench.emergencies, position ? std::vector<int>{0x8611} : std::vector<int>{});
  }
}

TEST(Cia402Drive, EncoderFaultsReachTheShownPosition) {
  DriveBench bench;
  bench.drive->set_fault(FaultKind::kEncoderJump, 0.1, true);
  bench.run(0.001);
  EXPECT_NEAR(bench.read_i32(canopen::kPositionActual), 0.1 * 16384 * 50 / (2 * M_PI), 1.0);
  bench.drive->set_fault(FaultKind::kEncoderStuck, 0.0, true);
  const int stuck = bench.read_i32(canopen::kPositionActual);
  bench.run(0.1, 1.0);
  EXPECT_EQ(bench.read_i32(canopen::kPositionActual), stuck);
}

TEST(Cia402Drive, PowerCycleForgetsWhatWasNotStoredAndCountsFromZero) {
  DriveBench bench;
  bench.write(canopen::kAbortConnectionOption, 2, 2);
  bench.start(kModeCurrent);
  bench.write(kCurrentSetting, 1000, 2);
  bench.run(0.1, 0.5);
  ASSERT_NE(bench.read_i32(canopen::kPositionActual), 0);
  bench.drive->set_fault(FaultKind::kPowerCycle, 0.0, true);
  EXPECT_EQ(bench.drive->motor_torque_Nm(), 0.0);
  EXPECT_FALSE(bench.drive->operational());
  bench.run(0.1, 0.5);
  EXPECT_EQ(bench.boot_ups, 1);
  bench.drive->set_fault(FaultKind::kPowerCycle, 0.0, false);
  bench.run(0.01);
  EXPECT_EQ(bench.boot_ups, 2);
  EXPECT_EQ(bench.read_i32(canopen::kPositionActual), 0);
  EXPECT_EQ(bench.read_i16(canopen::kAbortConnectionOption), 3);  // the maker's default
  EXPECT_EQ(bench.status() & 0x6F, 0x40);
}

TEST(Cia402Drive, StartsInFaultThatAFaultResetEnds) {
  SimDriveSetup setup = epos2_setup();
  setup.truth.starts_in_fault = true;
  DriveBench bench(setup);
  EXPECT_TRUE(in_fault(bench));
  EXPECT_EQ(bench.emergencies, std::vector<int>{0x8120});
  EXPECT_EQ(bench.read(canopen::kErrorHistory, 1) & 0xFFFF, 0x8120U);
  bench.nmt(canopen::NmtCommand::kResetCommunication);
  bench.run(0.01);
  EXPECT_TRUE(in_fault(bench));
  bench.reset_fault();
  EXPECT_FALSE(in_fault(bench));
  EXPECT_EQ(bench.emergencies.back(), 0);
}

/// A drive with this 0x6007 misses the master's heartbeat for 30 ms.
void lose_master(DriveBench& bench, int option) {
  bench.write(canopen::kAbortConnectionOption, option, 2);
  bench.write(canopen::kHeartbeatConsumer, (127 << 16) | 20, 4, 1);
  bench.start(kModeCurrent);
  const CanFrame heartbeat = canopen::heartbeat_frame(127, canopen::NmtState::kOperational);
  bench.send(heartbeat);
  bench.run(0.03);
  EXPECT_EQ(bench.emergencies, std::vector<int>{0x8130});
  bench.send(heartbeat);
  bench.run(0.001);
}

TEST(Cia402Drive, LostMasterFollowsItsOption) {
  const int expected[] = {0x27, 0x08, 0x40, 0x40};
  for (int option = 0; option < 4; ++option) {
    DriveBench bench;
    lose_master(bench, option);
    EXPECT_EQ(bench.status() & (option == 1 ? 0x4F : 0x6F), expected[option]) << option;
  }
}

TEST(Cia402Drive, LatchedCommunicationFaultNeedsResetCommunicationBeforeFaultReset) {
  DriveBench bench;
  lose_master(bench, 1);
  bench.reset_fault();
  EXPECT_TRUE(in_fault(bench));
  EXPECT_EQ(bench.read(canopen::kErrorRegister), 0x11U);
  bench.nmt(canopen::NmtCommand::kResetCommunication);
  bench.run(0.01);
  EXPECT_TRUE(in_fault(bench));
  bench.reset_fault();
  EXPECT_FALSE(in_fault(bench));
  EXPECT_EQ(bench.read(canopen::kErrorRegister), 0U);
}

TEST(Cia402Drive, LatchedCommunicationErrorWithoutFaultEndsWithResetCommunication) {
  DriveBench bench;
  lose_master(bench, 2);
  EXPECT_EQ(bench.read(canopen::kErrorRegister), 0x11U);
  bench.nmt(canopen::NmtCommand::kResetCommunication);
  bench.run(0.001);
  EXPECT_EQ(bench.read(canopen::kErrorRegister), 0U);
  EXPECT_EQ(bench.emergencies, (std::vector<int>{0x8130, 0}));
}

TEST(Cia402Drive, PassingCommunicationErrorEndsWhenTheMasterIsBack) {
  SimDriveSetup setup = epos2_setup();
  setup.truth.latches_communication_faults = false;
  DriveBench bench(setup);
  lose_master(bench, 2);
  EXPECT_EQ(bench.read(canopen::kErrorRegister), 0U);
  DriveBench faulted(setup);
  lose_master(faulted, 1);
  faulted.reset_fault();
  EXPECT_FALSE(in_fault(faulted));
}

TEST(Cia402Drive, ModeIsInForceWhenItIsConfirmed) {
  SimDriveSetup setup = epos2_setup();
  setup.truth.mode_delay_s = 0.002;
  DriveBench bench(setup);
  bench.start(kModeCurrent);
  bench.write(kCurrentSetting, 1000, 2);
  bench.run(0.02);
  bench.write(canopen::kMode, kModePosition, 1);
  bench.run(0.00175);
  EXPECT_EQ(static_cast<std::int8_t>(bench.read(canopen::kModeDisplay)), kModeCurrent);
  EXPECT_NEAR(bench.drive->motor_torque_Nm(), kCia402DriveTorque_Nm_A, 1e-3);
  bench.run(0.0005);
  EXPECT_EQ(static_cast<std::int8_t>(bench.read(canopen::kModeDisplay)), kModePosition);
  EXPECT_LT(bench.drive->motor_torque_Nm(), kCia402DriveTorque_Nm_A);
}

/// Torque 1 ms after a step of the position set-point, the joint held.
double torque_after_step_Nm(double smoothing_s) {
  SimDriveSetup setup = epos2_setup();
  setup.truth.smoothing_s = smoothing_s;
  DriveBench bench(setup);
  bench.start(kModePosition);
  bench.run(0.02);
  bench.write(epos2::kPositionSetting, bench.read_i32(canopen::kPositionActual) + 200, 4);
  bench.run(0.001);
  return bench.drive->motor_torque_Nm();
}

TEST(Cia402Drive, SetPointIsDrawnInOverTheSmoothingTime) {
  const double own_Nm = torque_after_step_Nm(0.0);
  EXPECT_GT(own_Nm, 0.1);
  EXPECT_EQ(torque_after_step_Nm(0.001), own_Nm) << "an EPOS2's own is 1 ms";
  EXPECT_LT(torque_after_step_Nm(0.004), 0.5 * own_Nm);
}

TEST(Cia402Drive, LossOfTheMasterIsToldWhenTheLinkIsBack) {
  DriveBench bench;
  bench.write(canopen::kHeartbeatConsumer, (127 << 16) | 20, 4, 1);
  bench.start(kModeCurrent);
  bench.send(canopen::heartbeat_frame(127, canopen::NmtState::kOperational));
  const auto link_down = [&](bool on) {
    bench.drive->outbox().set_fault(FaultKind::kLinkDown, 0.0, on);
    bench.drive->set_fault(FaultKind::kLinkDown, 0.0, on);
  };
  link_down(true);
  bench.run(0.05);
  EXPECT_TRUE(bench.emergencies.empty());
  link_down(false);
  bench.run(0.001);
  ASSERT_FALSE(bench.emergencies.empty());
  EXPECT_EQ(bench.emergencies.back(), 0x8130);
}

TEST(Cia402Drive, BusOffIsToldWhenTheBusIsBack) {
  DriveBench bench;
  bench.start(kModeCurrent);
  const auto bus_off = [&](bool on) {
    bench.drive->outbox().set_fault(FaultKind::kBusOff, 0.0, on);
    bench.drive->set_fault(FaultKind::kBusOff, 0.0, on);
  };
  bus_off(true);
  bench.run(0.05);
  EXPECT_TRUE(bench.emergencies.empty());
  bus_off(false);
  bench.run(0.001);
  EXPECT_EQ(bench.emergencies.back(), 0x81FD);
  EXPECT_NE(bench.status() & 0x6F, 0x27);  // 0x6007 default 3: quick stop
}

}  // namespace
}  // namespace sprung::sim
