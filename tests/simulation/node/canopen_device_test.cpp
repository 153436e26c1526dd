#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include "drivers/canopen/objects.h"
#include "tests/simulation/node/canopen_device_fixture.h"

namespace sprung::sim {
namespace {

using canopen::NmtCommand;
using canopen::NmtState;

constexpr std::uint32_t kCanopenDeviceSave = 0x65766173;
constexpr std::uint32_t kCanopenDeviceLoad = 0x64616F6C;

TEST_F(CanopenDeviceTest, FirstTickSendsBootUpThenPreOperational) {
  ASSERT_EQ(frames(0x703).size(), 1U);
  EXPECT_EQ(frames(0x703)[0].data[0], 0);
  EXPECT_EQ(node.state(), NmtState::kPreOperational);
}

TEST_F(CanopenDeviceTest, FollowsNmtForItselfAndForAll) {
  nmt(NmtCommand::kStart, 2);
  EXPECT_FALSE(node.operational());
  nmt(NmtCommand::kStart, 3);
  EXPECT_TRUE(node.operational());
  nmt(NmtCommand::kStop, 0);
  EXPECT_EQ(node.state(), NmtState::kStopped);
  EXPECT_EQ(lost, 1);
  nmt(NmtCommand::kEnterPreOperational, 0);
  EXPECT_EQ(node.state(), NmtState::kPreOperational);
  EXPECT_EQ(lost, 1);
}

TEST_F(CanopenDeviceTest, ResetCommunicationRestoresCommunicationOnly) {
  write(canopen::kHeartbeatProducer, 0, 7, 2);
  write(canopen::kTargetTorque, 0, 50, 2);
  node.raise(0x2310);
  drop();
  nmt(NmtCommand::kResetCommunication);
  EXPECT_EQ(frames(0x703).size(), 1U);
  EXPECT_EQ(read(canopen::kHeartbeatProducer), 0U);
  EXPECT_EQ(read(canopen::kTargetTorque), 50U);
  EXPECT_EQ(read(canopen::kErrorRegister), 0x03U);  // what is wrong with the drive stays
  EXPECT_EQ(read(canopen::kErrorHistory, 1), 0x2310U);
  EXPECT_EQ(resets, 0);
}

TEST_F(CanopenDeviceTest, ResetNodeRestoresAllAndTellsTheApplication) {
  write(canopen::kTargetTorque, 0, 50, 2);
  node.raise(0x2310);
  drop();
  nmt(NmtCommand::kResetNode, 0);
  EXPECT_EQ(frames(0x703).size(), 1U);
  EXPECT_EQ(read(canopen::kTargetTorque), 0U);
  EXPECT_EQ(read(canopen::kErrorRegister), 0U);
  EXPECT_EQ(read(canopen::kErrorHistory), 0U);
  EXPECT_EQ(resets, 1);
  EXPECT_EQ(node.state(), NmtState::kPreOperational);
}

TEST_F(CanopenDeviceTest, PowerCycleBootsWithWhatWasStored) {
  write(canopen::kHeartbeatProducer, 0, 7, 2);
  EXPECT_EQ(read(canopen::kStoreParameters, 1), 1U);  // saves on command
  EXPECT_EQ(write(canopen::kStoreParameters, 1, kCanopenDeviceSave, 4), 0U);
  write(canopen::kHeartbeatProducer, 0, 9, 2);
  nmt(NmtCommand::kStart);
  node.raise(0x2310);
  drop();
  node.power_cycle();
  receive(canopen::sync_frame());
  node.raise(0x3220);
  EXPECT_EQ(out.size(), 0);  // still without a voice
  node.tick(0);
  EXPECT_EQ(frames(0x703).at(0).data[0], 0x00);
  EXPECT_EQ(node.state(), NmtState::kPreOperational);
  EXPECT_EQ(resets, 1);
  EXPECT_EQ(read(canopen::kHeartbeatProducer), 7U);
}

TEST_F(CanopenDeviceTest, LoadedDefaultsCountFromTheNextReset) {
  write(canopen::kHeartbeatProducer, 0, 7, 2);
  write(canopen::kMaxTorque, 0, 900, 2);
  write(canopen::kStoreParameters, 1, kCanopenDeviceSave, 4);
  EXPECT_EQ(write(canopen::kRestoreDefaults, 1, kCanopenDeviceLoad, 4), 0U);
  EXPECT_EQ(read(canopen::kRestoreDefaults, 1), 1U);
  EXPECT_EQ(read(canopen::kHeartbeatProducer), 7U);
  nmt(NmtCommand::kResetCommunication);
  EXPECT_EQ(read(canopen::kHeartbeatProducer), 0U);
  EXPECT_EQ(read(canopen::kMaxTorque), 900U);
  nmt(NmtCommand::kResetNode);
  EXPECT_EQ(read(canopen::kMaxTorque), 50000U);
}

TEST_F(CanopenDeviceTest, StoppedServesNoSdoAndNoPdo) {
  nmt(NmtCommand::kStop);
  EXPECT_EQ(ask(canopen::sdo_read_request(3, {canopen::kIdentity, 1})).kind, canopen::SdoKind::kInvalid);
  receive(canopen::sync_frame());
  node.raise(0x2310);
  node.tick(1000);
  EXPECT_EQ(out.size(), 0);
}

TEST_F(CanopenDeviceTest, ProducesHeartbeatWithItsStateAlsoWhenStopped) {
  write(canopen::kHeartbeatProducer, 0, 5, 2);
  nmt(NmtCommand::kStart);
  drop();
  tick_until(20000);
  const auto beats = frames(0x703);
  ASSERT_EQ(beats.size(), 5U);
  EXPECT_EQ(beats[0].data[0], 0x05);
  nmt(NmtCommand::kStop);
  drop();
  tick_until(25000);
  ASSERT_EQ(frames(0x703).size(), 1U);
  EXPECT_EQ(frames(0x703)[0].data[0], 0x04);
}

TEST_F(CanopenDeviceTest, SyncMayCarryACounter) {
  map(0x1800, 0x40000183, 1, {0x60410010});
  nmt(NmtCommand::kStart);
  drop();
  receive(canopen::sync_frame());
  receive({canopen::kSyncId, 1, {17}, false});
  EXPECT_EQ(frames(0x183).size(), 2U);
}

TEST_F(CanopenDeviceTest, ApplicationSamplesBeforeSyncsPdosGo) {
  map(0x1800, 0x40000183, 1, {0x60640020});
  receive(canopen::sync_frame());
  EXPECT_EQ(syncs, 0);  // not operational
  nmt(NmtCommand::kStart);
  drop();
  receive(canopen::sync_frame());
  ASSERT_EQ(frames(0x183).size(), 1U);
  EXPECT_EQ(canopen::get_le(frames(0x183)[0].data.data(), 4), 1U);
}

TEST_F(CanopenDeviceTest, CutCableNeitherHearsNorSpeaks) {
  outbox.set_cut(true);
  nmt(NmtCommand::kStart);
  EXPECT_FALSE(node.operational());
  drop();
  node.raise(0x2310);
  EXPECT_EQ(out.size(), 0);
}

TEST_F(CanopenDeviceTest, LateFramesGoOutWithTime) {
  outbox.set_fault(FaultKind::kFramesLate, 0.002, true);
  drop();
  receive(canopen::sdo_read_request(kNode, {canopen::kIdentity, 1}));
  tick_until(1750);
  EXPECT_EQ(frames(0x583).size(), 0U);
  tick_until(2000);
  EXPECT_EQ(frames(0x583).size(), 1U);
}

}  // namespace
}  // namespace sprung::sim
