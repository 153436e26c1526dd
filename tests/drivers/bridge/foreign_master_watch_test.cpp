#include "drivers/bridge/foreign_master_watch.h"

#include <gtest/gtest.h>

#include "drivers/canopen/protocol.h"
#include "tests/support/bridge_fixture.h"

namespace sprung {
namespace {

CanFrame frame(std::uint32_t id, int length = 8) {
  CanFrame result;
  result.id = id;
  result.length = static_cast<std::uint8_t>(length);
  return result;
}

TEST(MasterFrame, OnlyWhatAMasterSendsIsOne) {
  EXPECT_EQ(master_frame(frame(0x000, 2), false), MasterFrame::kNmt);
  EXPECT_EQ(master_frame(frame(0x080, 0), false), MasterFrame::kSync);
  EXPECT_EQ(master_frame(frame(0x77F, 1), false), MasterFrame::kHeartbeat);
  EXPECT_EQ(master_frame(frame(0x5FF), false), MasterFrame::kAnswer) << "a drive with the bridge's own id";
  for (const std::uint32_t id : {0x201U, 0x301U, 0x401U, 0x501U})
    EXPECT_EQ(master_frame(frame(id), true), MasterFrame::kSetPoint) << std::hex << id;
  // What a node sends, and services: emergency, TPDOs, SDO both ways, heartbeat.
  for (const std::uint32_t id : {0x081U, 0x181U, 0x281U, 0x381U, 0x481U, 0x581U, 0x601U, 0x701U})
    EXPECT_EQ(master_frame(frame(id), true), MasterFrame::kNone) << std::hex << id;
  EXPECT_EQ(master_frame(frame(0x205), false), MasterFrame::kNone) << "to somebody else's node";
}

TEST(MasterFrame, EachHasItsWordsForPeople) {
  EXPECT_STREQ(text(MasterFrame::kHeartbeat), "heartbeat of node 127");
  EXPECT_STREQ(text(MasterFrame::kSync), "SYNC");
  EXPECT_STREQ(text(MasterFrame::kNmt), "NMT command");
  EXPECT_STREQ(text(MasterFrame::kSetPoint), "set-point (RPDO)");
  EXPECT_STREQ(text(MasterFrame::kAnswer), "answer of node 127");
  EXPECT_STREQ(text(MasterFrame::kNone), "");
  EXPECT_NE(std::string(remedy(MasterFrame::kAnswer)).find("id of its own"), std::string::npos);
  EXPECT_EQ(std::string(remedy(MasterFrame::kSync)).find("127"), std::string::npos);
}

TEST(MasterFrame, ErrorAndRemoteFramesAreNone) {
  CanFrame error = frame(0x000);
  error.error = true;
  EXPECT_EQ(master_frame(error, true), MasterFrame::kNone);
  CanFrame remote = frame(0x080, 0);
  remote.remote = true;
  EXPECT_EQ(master_frame(remote, true), MasterFrame::kNone);
}

class ForeignMaster : public test::PoweredBridge {
 protected:
  void hear(const CanFrame& frame, int times = 1) {
    for (int i = 0; i < times; ++i) bench_.bridge->receive(0, frame, bench_.time_us);
    bench_.tick();
  }
};

TEST_F(ForeignMaster, OneCommandDampsTheRobotAndIsNamed) {
  hear(frame(0x201, 7));
  EXPECT_EQ(level(), SafetyLevel::kDamping);
  EXPECT_EQ(cause(), SafetyCause::kForeignMaster);
  EXPECT_TRUE(latched());
  EXPECT_EQ(bench_.detail().find("another master commands on bus leg"), 0U) << bench_.detail();
  EXPECT_NE(bench_.detail().find("set-point (RPDO) 0x201"), std::string::npos);
  EXPECT_EQ(bench_.bridge->bus_state().buses[0].unexpected, 1);
}

TEST_F(ForeignMaster, OneThatGoesOnStopsTheDrivesAtOnce) {
  hear(canopen::sync_frame(), 3);
  EXPECT_EQ(level(), SafetyLevel::kQuickStop);
  EXPECT_EQ(cause(), SafetyCause::kForeignMaster);
}

TEST_F(ForeignMaster, HeartbeatAloneIsCountedAndStopsNothing) {
  hear(canopen::heartbeat_frame(canopen::kBridgeNode, canopen::NmtState::kOperational), 5);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
  EXPECT_EQ(bench_.bridge->bus_state().buses[0].unexpected, 5);
}

TEST_F(ForeignMaster, RobotComesBackAfterAClearWhenItIsGone) {
  hear(canopen::nmt_frame(canopen::NmtCommand::kEnterPreOperational, 0));
  bench_.run(900);
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone) << bench_.detail();
  bench_.enable();
  EXPECT_EQ(enabled(), 2);
  hear(canopen::sync_frame());
  EXPECT_EQ(cause(), SafetyCause::kForeignMaster);
}

}  // namespace
}  // namespace sprung
