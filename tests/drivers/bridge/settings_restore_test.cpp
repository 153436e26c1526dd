// What boot has overwritten comes back at an orderly end, where robot.yaml asks for that.
#include "drivers/bridge/settings_restore.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/canopen/nmt.h"
#include "drivers/canopen/objects.h"
#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

using namespace canopen;
using test::BridgeBench;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class RestoredSettings : public ::testing::Test {
 protected:
  static RobotConfig robot(bool restores) {
    RobotConfig robot = test::two_drive_robot();
    robot.actuators[0].restore_settings = restores;
    return robot;
  }
  /// Boots with a rating of somebody else's in the first drive, then ends in order.
  void boot_and_end(BridgeBench& bench) {
    bench.drives[0].objects[{kRatedCurrent, 0}] = 2500;
    bench.drives[0].objects[{kHeartbeatConsumer, 1}] = 0x00050064;
    ASSERT_TRUE(bench.boot()) << bench.detail();
    ASSERT_EQ((bench.drives[0].objects[{kRatedCurrent, 0}]), 7000U);
    bench.enable();
    resets_ = bench.drives[0].resets;
    bench.bridge->begin_shutdown(bench.time_us);
    for (int i = 0; i < 3000 && !bench.bridge->shut_down(); ++i) bench.tick();
    ASSERT_TRUE(bench.bridge->shut_down());
  }
  int resets_ = 0;
};

TEST_F(RestoredSettings, ComeBackWithoutPowerThenCommunicationIsReset) {
  BridgeBench bench(robot(true));
  boot_and_end(bench);
  test::FakeDrive& drive = bench.drives[0];
  EXPECT_EQ((drive.objects[{kRatedCurrent, 0}]), 2500U);
  EXPECT_EQ((drive.objects[{kHeartbeatConsumer, 1}]), 0x007F0014U) << "the reset brings that back";
  EXPECT_EQ(drive.resets, resets_ + 1);
  EXPECT_EQ(drive.received.back(), nmt_frame(NmtCommand::kResetCommunication, 1));
  EXPECT_EQ(bench.enabled(), 0);
  EXPECT_THAT(bench.bridge->restore_report(), ElementsAre("hip_motor: has its settings back"));
}

TEST_F(RestoredSettings, StayWhereNobodyAsks) {
  BridgeBench bench(robot(false));
  boot_and_end(bench);
  EXPECT_EQ((bench.drives[0].objects[{kRatedCurrent, 0}]), 7000U);
  EXPECT_EQ(bench.drives[0].resets, resets_);
  EXPECT_THAT(bench.bridge->restore_report(), IsEmpty());
}

TEST_F(RestoredSettings, DriveThatRefusesIsNamedAndEndsNothing) {
  BridgeBench bench(robot(true));
  bench.drives[0].objects[{kMaxTorque, 0}] = 100;
  bench.on_answers = [&bench](std::vector<CanFrame>&) {
    if (bench.bridge->operational()) bench.drives[0].aborts[{kMaxTorque, 0}] = kAbortDeviceState;
  };
  boot_and_end(bench);
  EXPECT_EQ((bench.drives[0].objects[{kRatedCurrent, 0}]), 2500U);
  EXPECT_THAT(bench.bridge->restore_report(),
              ElementsAre("hip_motor: settings are NOT all as before (1 refused or not answered): switch its "
                          "supply off and on"));
}

TEST_F(RestoredSettings, SilentDriveDoesNotHoldTheEndForLong) {
  BridgeBench bench(robot(true));
  ASSERT_TRUE(bench.boot());
  bench.bridge->begin_shutdown(bench.time_us);
  bench.drives[0].dead = true;
  const std::int64_t since_us = bench.time_us;
  for (int i = 0; i < 5000 && !bench.bridge->shut_down(); ++i) bench.tick();
  EXPECT_TRUE(bench.bridge->shut_down());
  EXPECT_LE(bench.time_us - since_us, 2'001'000);
}

TEST(SettingsRestore, StepsOnlyWhatIsOutsideCommunicationAndCountsWhatIsRefused) {
  const std::vector<Overwritten> overwritten = {{{{kHeartbeatProducer, 0}, 2, 0, false}, 5},
                                                {{{kRatedCurrent, 0}, 4, 2500, false}, 7000},
                                                {{{kTorqueOffset, 0}, 2, 300, true}, 0}};
  SettingsRestore restore;
  EXPECT_FALSE(restore.begun());
  restore.begin(overwritten);
  SdoClient sdo(4, 100'000);
  CanFrame out;
  ASSERT_TRUE(restore.step(0, 4, sdo, out));
  EXPECT_EQ(out, sdo_write_request(4, {kRatedCurrent, 0}, 2500, 4));
  sdo.receive(sdo_write_reply(4, {kRatedCurrent, 0}));
  ASSERT_TRUE(restore.step(1000, 4, sdo, out));
  EXPECT_EQ(out, sdo_write_request(4, {kTorqueOffset, 0}, 300, 2));
  sdo.receive(sdo_server_abort(4, {kTorqueOffset, 0}, kAbortRange));
  ASSERT_TRUE(restore.step(2000, 4, sdo, out));
  EXPECT_EQ(out, nmt_frame(NmtCommand::kResetCommunication, 4));
  EXPECT_TRUE(restore.done());
  EXPECT_EQ(restore.failed(), 1);
  EXPECT_FALSE(restore.step(3000, 4, sdo, out));
}

}  // namespace
}  // namespace sprung
