// What a drive can do to the bridge: emergencies, restarts, heartbeats, modes.
#include <gmock/gmock.h>

#include "drivers/canopen/objects.h"
#include "tests/drivers/bridge/faults_fixture.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;
using namespace canopen;

TEST_F(BridgeFaults, DriveThatGotAShortSetpointSaysSoAndStopsTheRobot) {
  bench_.drives[0].pending_emergency = 0x8210;
  bench_.tick();
  EXPECT_EQ(health(0).emergencies, 1);
  EXPECT_EQ(health(0).last_emergency_code, 0x8210);
  EXPECT_EQ(health(0).error_register, 1);
  expect_damping(SafetyCause::kDriveFault, "hip_motor: drive fault 0x8210");
  expect_cleared();
}

/// The status word may come first: drives send both when they like.
TEST_F(BridgeFaults, EmergencyThatComesAfterTheStatusWordSaysWhatItWas) {
  bench_.drives[0].power = PowerState::kFault;
  bench_.tick();
  EXPECT_EQ(cause(), SafetyCause::kDriveFault);
  EXPECT_THAT(bench_.detail(), ::testing::HasSubstr("hip_motor: drive fault 0x0000"));
  bench_.drives[0].pending_emergency = 0x2310;
  bench_.tick();
  EXPECT_THAT(bench_.detail(), ::testing::HasSubstr("hip_motor: drive fault 0x2310"));
  bench_.drives[0].pending_emergency = 0x4210;  // what comes after it is not the cause
  bench_.tick();
  expect_damping(SafetyCause::kDriveFault, "hip_motor: drive fault 0x2310");
}

TEST_F(BridgeFaults, EmergencyOfEveryClassIsADriveFaultWithItsText) {
  for (const int code : {0x1000, 0x2310, 0x3210, 0x4210, 0x5113, 0x6320, 0x7320, 0x8611, 0xFF0B}) {
    SCOPED_TRACE(code);
    bench_.drives[0].pending_emergency = static_cast<std::uint16_t>(code);
    bench_.tick();
    EXPECT_THAT(bench_.detail(), HasSubstr(emergency_text(static_cast<std::uint16_t>(code))));
    expect_damping(SafetyCause::kDriveFault, "hip_motor: drive fault 0x");
    expect_cleared();
  }
}

TEST_F(BridgeFaults, DriveThatRestartsInMidRunIsNamedAndConfiguredAgain) {
  bench_.drives[1].restart_now = true;
  bench_.run(2);
  EXPECT_EQ(health(1).boot_ups, 1);
  EXPECT_FALSE(health(1).operational);
  expect_damping(SafetyCause::kDriveSilent, "knee_motor: no longer operational: it has restarted");
  expect_cleared();
  EXPECT_THAT(recovery(1), HasSubstr("configured again"));
}

TEST_F(BridgeFaults, HeartbeatThatStopsIsCountedOnce) {
  bench_.drives[0].mute_heartbeat = true;
  bench_.run(120);
  EXPECT_EQ(health(0).heartbeat_losses, 1);
  expect_damping(SafetyCause::kDriveSilent, "hip_motor: no heartbeat");
  bench_.drives[0].mute_heartbeat = false;
  expect_cleared();
}

TEST_F(BridgeFaults, FramesOnTheHeartbeatIdentifierThatAreNoneKeepNobodyAlive) {
  bench_.drives[0].mute_heartbeat = true;
  for (int i = 0; i < 500; ++i) {
    if (i % 20 == 0) bench_.bridge->receive(0, canopen::guard_request(1), bench_.time_us);
    bench_.tick();
  }
  EXPECT_EQ(health(0).heartbeat_losses, 1);
  EXPECT_EQ(cause(), SafetyCause::kDriveSilent);
}

TEST_F(BridgeFaults, DriveThatHasRestartedGetsNoSetpointsUntilItIsConfigured) {
  bench_.command_all(DriveMode::kTorque, 5.0);
  bench_.tick();
  ASSERT_EQ(bench_.sent(canopen::rpdo_id(0, 1)).size(), 1U);
  bench_.drives[0].restart_now = true;
  bench_.run(2);
  EXPECT_TRUE(bench_.sent(canopen::rpdo_id(0, 1)).empty());
  EXPECT_TRUE(bench_.sent(canopen::rpdo_id(1, 1)).empty());
  EXPECT_EQ(bench_.sent(canopen::rpdo_id(0, 2)).size(), 1U);
  expect_cleared();
}

TEST_F(BridgeFaults, SecondDeviceThatRestartsDoesNotTakeTheControlWordFromTheFirst) {
  bench_.bridge->receive(0, canopen::heartbeat_frame(1, canopen::NmtState::kBootUp), bench_.time_us);
  bench_.run(5);
  EXPECT_EQ(cause(), SafetyCause::kDuplicateNode);
  EXPECT_EQ(bench_.sent(canopen::rpdo_id(0, 1)).size(), 1U) << "it is damped, and then stopped";
}

TEST_F(BridgeFaults, LostModeDisplayIsReadBySdo) {
  bench_.drives[0].mute_mode_display = true;
  bench_.command_all(DriveMode::kPosition, 0.0, 0.1);
  bench_.run(40);
  EXPECT_EQ(bench_.state.actuators[0].shown_mode, DriveMode::kTorque) << "not confirmed";
  bench_.run(40);
  EXPECT_EQ(bench_.state.actuators[0].shown_mode, DriveMode::kPosition);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
}

TEST_F(BridgeFaults, DriveThatNeverConfirmsItsModeStopsTheRobotAfterASecond) {
  bench_.drives[0].keeps_mode = true;
  bench_.command_all(DriveMode::kPosition, 0.0, 0.1);
  bench_.run(990);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
  bench_.run(20);
  expect_damping(SafetyCause::kDriveFault,
                 "hip_motor: shows mode 10, a second after it was told to switch to position");
  bench_.drives[0].keeps_mode = false;
  bench_.command_all(DriveMode::kDisabled);
  expect_cleared();
}

}  // namespace
}  // namespace sprung
