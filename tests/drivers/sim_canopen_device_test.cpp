#include <gtest/gtest.h>

#include <vector>

#include "drivers/canopen/objects.h"
#include "drivers/sim/canopen_device.h"
#include "drivers/profiles/gold/gold_device_objects.h"

namespace sprung::sim {
namespace {

using canopen::NmtCommand;
using canopen::NmtState;

class CanopenDeviceTest : public testing::Test, public DeviceApplication {
 protected:
  CanopenDeviceTest() {
    outbox_.open(&out_);
    device_.tick(0);
  }
  void written(canopen::ObjectId id) noexcept override { last_written_ = id.index; }
  void connection_lost() noexcept override { ++lost_; }
  void connection_back() noexcept override { ++back_; }
  void reset() noexcept override { ++resets_; }

  /// Frames of one identifier since the last call of drop().
  std::vector<CanFrame> frames(std::uint32_t id) const {
    std::vector<CanFrame> found;
    for (const BusFrame& entry : out_) {
      if (entry.frame.id == id) found.push_back(entry.frame);
    }
    return found;
  }
  void drop() { out_.clear(); }
  canopen::SdoMessage ask(const CanFrame& request) {
    drop();
    device_.receive(request, 0);
    const auto replies = frames(0x583);
    return replies.size() == 1 ? canopen::decode_sdo_reply(replies[0]) : canopen::SdoMessage{};
  }
  std::uint32_t write(std::uint16_t index, int sub, std::uint32_t value, int size) {
    const auto reply =
        ask(canopen::sdo_write_request(3, {index, static_cast<std::uint8_t>(sub)}, value, size));
    EXPECT_NE(reply.kind, canopen::SdoKind::kInvalid);
    return reply.kind == canopen::SdoKind::kAbort ? reply.value : 0;
  }
  void nmt(NmtCommand command, int node) { device_.receive(canopen::nmt_frame(command, node), 0); }
  std::vector<int> emergencies() const {
    std::vector<int> codes;
    for (const CanFrame& frame : frames(0x083))
      codes.push_back(static_cast<int>(canopen::get_le(frame.data.data(), 2)));
    return codes;
  }
  void hear(std::int64_t time_us) {
    device_.receive(canopen::heartbeat_frame(127, NmtState::kOperational), time_us);
  }

  static GoldCommissioning node_three() {
    GoldCommissioning gold;
    gold.node = 3;
    return gold;
  }
  ObjectDictionary dictionary_ = gold_dictionary(node_three());
  FrameBatch out_;
  Outbox outbox_{0};
  CanopenDevice device_{3, dictionary_, *this, outbox_};
  int last_written_ = 0;
  int lost_ = 0;
  int back_ = 0;
  int resets_ = 0;
};

TEST_F(CanopenDeviceTest, FirstTickSendsBootUpThenPreOperational) {
  ASSERT_EQ(frames(0x703).size(), 1U);
  EXPECT_EQ(frames(0x703)[0].data[0], 0);
  EXPECT_EQ(device_.state(), NmtState::kPreOperational);
}

TEST_F(CanopenDeviceTest, FollowsNmtForItselfAndForAll) {
  nmt(NmtCommand::kStart, 2);
  EXPECT_FALSE(device_.operational());
  nmt(NmtCommand::kStart, 3);
  EXPECT_TRUE(device_.operational());
  nmt(NmtCommand::kStop, 0);
  EXPECT_EQ(device_.state(), NmtState::kStopped);
  EXPECT_EQ(lost_, 1);
  nmt(NmtCommand::kEnterPreOperational, 0);
  EXPECT_EQ(device_.state(), NmtState::kPreOperational);
  EXPECT_EQ(lost_, 1);
}

TEST_F(CanopenDeviceTest, ResetCommunicationRestoresCommunicationOnly) {
  write(canopen::kHeartbeatProducer, 0, 7, 2);
  write(canopen::kTargetTorque, 0, 50, 2);
  drop();
  nmt(NmtCommand::kResetCommunication, 3);
  EXPECT_EQ(frames(0x703).size(), 1U);
  EXPECT_EQ(dictionary_.get({canopen::kHeartbeatProducer, 0}), 0);
  EXPECT_EQ(dictionary_.get({canopen::kTargetTorque, 0}), 50);
  EXPECT_EQ(resets_, 0);
}

TEST_F(CanopenDeviceTest, ResetNodeRestoresAllAndTellsTheApplication) {
  write(canopen::kTargetTorque, 0, 50, 2);
  drop();
  nmt(NmtCommand::kResetNode, 0);
  EXPECT_EQ(frames(0x703).size(), 1U);
  EXPECT_EQ(dictionary_.get({canopen::kTargetTorque, 0}), 0);
  EXPECT_EQ(resets_, 1);
  EXPECT_EQ(device_.state(), NmtState::kPreOperational);
}

TEST_F(CanopenDeviceTest, ServesSdoAndTellsTheApplicationOfWrites) {
  const auto reply = ask(canopen::sdo_read_request(3, {canopen::kIdentity, 2}));
  EXPECT_EQ(reply.kind, canopen::SdoKind::kUpload);
  EXPECT_EQ(reply.value, 0x00030923U);
  EXPECT_EQ(write(canopen::kControlWord, 0, 6, 2), 0U);
  EXPECT_EQ(last_written_, canopen::kControlWord);
  EXPECT_EQ(write(canopen::kStatusWord, 0, 6, 2), canopen::kAbortReadOnly);
  EXPECT_EQ(write(0x1A00, 0, 0, 1), canopen::kAbortDeviceState);  // TPDO1 is valid
}

TEST_F(CanopenDeviceTest, AbortsServicesItDoesNotHave) {
  CanFrame block{0x603, 8, {0xC6, 0x00, 0x10, 0}, false};
  const auto reply = ask(block);
  EXPECT_EQ(reply.kind, canopen::SdoKind::kAbort);
  EXPECT_EQ(reply.value, canopen::kAbortCommand);
}

TEST_F(CanopenDeviceTest, StoppedServesNoSdoAndNoPdo) {
  nmt(NmtCommand::kStop, 3);
  EXPECT_EQ(ask(canopen::sdo_read_request(3, {canopen::kIdentity, 1})).kind, canopen::SdoKind::kInvalid);
  device_.receive(canopen::sync_frame(), 0);
  device_.tick(1000);
  EXPECT_EQ(out_.size(), 0);
}

TEST_F(CanopenDeviceTest, ProducesHeartbeatWithItsState) {
  write(canopen::kHeartbeatProducer, 0, 5, 2);
  nmt(NmtCommand::kStart, 3);
  drop();
  for (std::int64_t time_us = 0; time_us <= 20000; time_us += 250) device_.tick(time_us);
  const auto beats = frames(0x703);
  ASSERT_EQ(beats.size(), 5U);
  EXPECT_EQ(beats[0].data[0], 0x05);
}

TEST_F(CanopenDeviceTest, LostHeartbeatRaises8130OnceAndTellsTheApplication) {
  write(canopen::kHeartbeatConsumer, 1, (127U << 16) | 20U, 4);
  drop();
  device_.tick(100000);
  EXPECT_EQ(lost_, 0);  // not armed before the first heartbeat
  hear(100000);
  device_.tick(119750);
  EXPECT_EQ(lost_, 0);
  device_.tick(120000);
  device_.tick(140000);
  EXPECT_EQ(lost_, 1);
  EXPECT_EQ(emergencies(), std::vector<int>{0x8130});
  hear(150000);
  EXPECT_EQ(back_, 1);
}

TEST_F(CanopenDeviceTest, OtherNodesHeartbeatDoesNotCount) {
  write(canopen::kHeartbeatConsumer, 1, (127U << 16) | 20U, 4);
  hear(0);
  device_.receive(canopen::heartbeat_frame(5, NmtState::kOperational), 19000);
  device_.tick(20000);
  EXPECT_EQ(lost_, 1);
}

TEST_F(CanopenDeviceTest, ShortPdoRaises8210) {
  nmt(NmtCommand::kStart, 3);
  drop();
  device_.receive({0x203, 1, {6}, false}, 0);  // default RPDO1: the control word, 2 bytes
  EXPECT_EQ(emergencies(), std::vector<int>{0x8210});
  EXPECT_EQ(dictionary_.get({canopen::kErrorRegister, 0}), 0x11);
}

TEST_F(CanopenDeviceTest, HistoryIsNewestFirstLimitedAndClearable) {
  for (int i = 0; i < kErrorHistoryLength + 3; ++i) device_.raise(static_cast<std::uint16_t>(0x3200 + i));
  EXPECT_EQ(dictionary_.get({canopen::kErrorHistory, 0}), kErrorHistoryLength);
  EXPECT_EQ(dictionary_.get({canopen::kErrorHistory, 1}), 0x3200 + kErrorHistoryLength + 2);
  EXPECT_EQ(dictionary_.get({canopen::kErrorHistory, 16}), 0x3203);
  EXPECT_EQ(dictionary_.get({canopen::kErrorRegister, 0}), 0x05);
  EXPECT_EQ(write(canopen::kErrorHistory, 0, 1, 1), canopen::kAbortTooHigh);
  EXPECT_EQ(write(canopen::kErrorHistory, 0, 0, 1), 0U);
  EXPECT_EQ(dictionary_.get({canopen::kErrorHistory, 0}), 0);
}

TEST_F(CanopenDeviceTest, ClearedErrorsAreTold) {
  device_.raise(0x2310);
  drop();
  device_.clear_errors();
  device_.clear_errors();
  EXPECT_EQ(emergencies(), std::vector<int>{0});
}

TEST_F(CanopenDeviceTest, CutCableNeitherHearsNorSpeaks) {
  outbox_.set_cut(true);
  nmt(NmtCommand::kStart, 3);
  EXPECT_FALSE(device_.operational());
  drop();
  device_.raise(0x2310);
  EXPECT_EQ(out_.size(), 0);
}

}  // namespace
}  // namespace sprung::sim
