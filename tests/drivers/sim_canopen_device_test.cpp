#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include "drivers/canopen/objects.h"
#include "drivers/sim/canopen_device.h"
#include "tests/drivers/sim_node_bench.h"
#include "tests/support/allocation_count.h"

namespace sprung::sim {
namespace {

using canopen::NmtCommand;
using canopen::NmtState;

constexpr std::uint32_t kSave = 0x65766173;
constexpr std::uint32_t kLoad = 0x64616F6C;

/// A node with the objects of a Gold.
class CanopenDeviceTest : public testing::Test, protected NodeBench {
 protected:
  CanopenDeviceTest() : NodeBench("gold") {}
};

/// With those of an EPOS2.
class EposDeviceTest : public testing::Test, protected NodeBench {
 protected:
  EposDeviceTest() : NodeBench("epos2") {}
};

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
  EXPECT_EQ(write(canopen::kStoreParameters, 1, kSave, 4), 0U);
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
  write(canopen::kStoreParameters, 1, kSave, 4);
  EXPECT_EQ(write(canopen::kRestoreDefaults, 1, kLoad, 4), 0U);
  EXPECT_EQ(read(canopen::kRestoreDefaults, 1), 1U);
  EXPECT_EQ(read(canopen::kHeartbeatProducer), 7U);
  nmt(NmtCommand::kResetCommunication);
  EXPECT_EQ(read(canopen::kHeartbeatProducer), 0U);
  EXPECT_EQ(read(canopen::kMaxTorque), 900U);
  nmt(NmtCommand::kResetNode);
  EXPECT_EQ(read(canopen::kMaxTorque), 50000U);
}

TEST_F(CanopenDeviceTest, ServesSdoAndTellsTheApplicationOfWrites) {
  EXPECT_EQ(read(canopen::kIdentity, 2), 0x00030923U);
  EXPECT_EQ(write(canopen::kControlWord, 0, 6, 2), 0U);
  EXPECT_EQ(last_written, canopen::kControlWord);
  nmt(NmtCommand::kStart);
  EXPECT_EQ(write(canopen::kControlWord, 0, 7, 2), 0U);
  EXPECT_EQ(dictionary.get({canopen::kControlWord, 0}), 7);
}

TEST_F(CanopenDeviceTest, ServesSegmentedTransfersBothWays) {
  EXPECT_EQ(read_bytes(0x1008), "Elmo Gold drive");
  EXPECT_EQ(write_bytes(0x2012, 0, std::string("\x01\x02\x03\x04\x05\x06\x07\x08", 8)), 0U);
  EXPECT_EQ(dictionary.get({0x2012, 0}), 0x0807060504030201);
  EXPECT_EQ(last_written, 0x2012);
}

TEST_F(CanopenDeviceTest, GivesUpATransferThatTheClientForgets) {
  ask(canopen::sdo_read_request(kNode, {0x1008, 0}));
  drop();
  tick_until(canopen::SdoServer::kDefaultTimeout_us);
  const auto replies = frames(0x583);
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(canopen::decode_sdo_reply(replies[0]).value, canopen::kAbortTimeout);
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

TEST_F(CanopenDeviceTest, LostHeartbeatRaises8130OnceAndTellsTheApplication) {
  write(canopen::kHeartbeatConsumer, 1, (127U << 16) | 20U, 4);
  drop();
  tick_until(100000);
  EXPECT_EQ(lost, 0);  // not armed before the first heartbeat
  hear_master();
  tick_until(119750);
  EXPECT_EQ(lost, 0);
  tick_until(140000);
  EXPECT_EQ(lost, 1);
  EXPECT_TRUE(node.master_lost());
  EXPECT_EQ(emergencies(), std::vector<int>{0x8130});
  hear_master();
  EXPECT_EQ(back, 1);
  EXPECT_FALSE(node.master_lost());
}

TEST_F(CanopenDeviceTest, ResetCommunicationEndsALoss) {
  write(canopen::kHeartbeatConsumer, 1, (127U << 16) | 20U, 4);
  hear_master();
  tick_until(20000);
  ASSERT_TRUE(node.master_lost());
  nmt(NmtCommand::kResetCommunication);
  EXPECT_FALSE(node.master_lost());
  EXPECT_EQ(back, 1);
}

/// 0x1029: 1 = no change of the NMT state, 2 = stopped; where there is none the make decides.
TEST_F(CanopenDeviceTest, NmtStateAfterALossFollowsItsObject) {
  for (const auto& [behaviour, expected] :
       std::vector<std::pair<int, NmtState>>{{1, NmtState::kOperational}, {2, NmtState::kStopped}}) {
    nmt(NmtCommand::kResetNode);
    write(canopen::kErrorBehaviour, 1, behaviour, 1);
    write(canopen::kHeartbeatConsumer, 1, (127U << 16) | 20U, 4);
    nmt(NmtCommand::kStart);
    hear_master();
    lost = 0;
    tick_until(time_us + 20000);
    EXPECT_EQ(node.state(), expected) << behaviour;
    EXPECT_EQ(lost, 1) << behaviour;
  }
}

TEST_F(CanopenDeviceTest, GuardedNodeAnswersAndLifeGuardingIsAHeartbeatLoss) {
  write(canopen::kGuardTime, 0, 10, 2);
  write(canopen::kLifeTimeFactor, 0, 2, 1);
  drop();
  receive(canopen::guard_request(4));
  EXPECT_EQ(out.size(), 0);
  receive(canopen::guard_request(kNode));
  nmt(NmtCommand::kStop);
  receive(canopen::guard_request(kNode));
  ASSERT_EQ(frames(0x703).size(), 2U);
  EXPECT_EQ(frames(0x703)[0].data[0], 0x7F);
  EXPECT_EQ(frames(0x703)[1].data[0], 0x84);
  nmt(NmtCommand::kEnterPreOperational);
  tick_until(20000);
  EXPECT_EQ(lost, 1);
  EXPECT_EQ(emergencies(), std::vector<int>{0x8130});
}

TEST_F(CanopenDeviceTest, ShortPdoRaises8210UntilOneIsLongEnough) {
  nmt(NmtCommand::kStart);
  drop();
  receive({0x203, 1, {6}, false});  // default RPDO1: the control word, 2 bytes
  receive({0x203, 1, {6}, false});
  EXPECT_EQ(emergencies(), std::vector<int>{0x8210});
  EXPECT_EQ(dictionary.get({canopen::kErrorRegister, 0}), 0x11);
  EXPECT_EQ(last_written, 0);
  EXPECT_EQ(lost, 0);
  receive({0x203, 3, {6}, false});
  EXPECT_EQ(emergencies(), (std::vector<int>{0x8210, 0}));
  EXPECT_EQ(last_written, canopen::kControlWord);
}

TEST(CanopenDevice, ShortPdoLosesTheConnectionWhereTheMakeSaysSo) {
  DevicePolicy policy;
  policy.short_pdo_loses_connection = true;
  policy.after_communication_error = 0;
  NodeBench bench("epos2", policy);
  bench.nmt(NmtCommand::kStart);
  bench.receive({0x203, 1, {6}, false});
  EXPECT_EQ(bench.lost, 1);
  EXPECT_EQ(bench.node.state(), NmtState::kPreOperational);
  EXPECT_TRUE(bench.node.errors().stands(0x8210));
}

TEST_F(CanopenDeviceTest, EmergencySaysWhenTheLastOfSeveralErrorsIsOver) {
  drop();
  node.raise(0x3220);
  node.raise(0x4210);
  node.clear(0x3220);
  EXPECT_EQ(emergencies(), (std::vector<int>{0x3220, 0x4210}));
  EXPECT_EQ(frames(0x083)[1].data[2], 0x0D);
  node.clear(0x4210);
  node.clear_errors();
  EXPECT_EQ(emergencies(), (std::vector<int>{0x3220, 0x4210, 0}));
  EXPECT_EQ(frames(0x083)[2].data[2], 0x00);
  node.raise(0x2310);
  node.raise(0x3210);
  drop();
  node.clear_errors();
  EXPECT_EQ(emergencies(), std::vector<int>{0});
}

TEST_F(CanopenDeviceTest, HistoryIsClearedByZeroOnly) {
  node.raise(0x2310);
  EXPECT_EQ(read(canopen::kErrorHistory, 1), 0x2310U);
  EXPECT_EQ(write(canopen::kErrorHistory, 0, 1, 1), canopen::kAbortRange);
  EXPECT_EQ(write(canopen::kErrorHistory, 0, 0, 1), 0U);
  EXPECT_EQ(read(canopen::kErrorHistory), 0U);
  EXPECT_EQ(read(canopen::kErrorHistory, 1), 0U);
}

TEST_F(EposDeviceTest, EmergencyObjectCanBeMovedAndSwitchedOff) {
  EXPECT_EQ(write(canopen::kEmergencyCobId, 0, 0x80000083, 4), 0U);
  drop();
  node.raise(0x2310);
  EXPECT_EQ(out.size(), 0);
  EXPECT_EQ(write(canopen::kEmergencyCobId, 0, 0x90, 4), 0U);
  drop();
  node.raise(0x3220);
  EXPECT_EQ(frames(0x090).size(), 1U);
}

TEST_F(CanopenDeviceTest, CutCableNeitherHearsNorSpeaks) {
  outbox.set_cut(true);
  nmt(NmtCommand::kStart);
  EXPECT_FALSE(node.operational());
  drop();
  node.raise(0x2310);
  EXPECT_EQ(out.size(), 0);
}

/// A node in bus-off finds its error when the bus is back (facts canopen 2.5).
TEST_F(CanopenDeviceTest, BusOffAndErrorPassiveAreCommunicationErrors) {
  outbox.set_fault(FaultKind::kBusOff, 0.0, true);
  tick_until(1000);
  EXPECT_EQ(lost, 1);
  outbox.set_fault(FaultKind::kBusOff, 0.0, false);
  tick_until(2000);
  EXPECT_EQ(back, 1);
  EXPECT_EQ(read(canopen::kErrorHistory, 1), 0x81FDU);
  drop();
  outbox.set_fault(FaultKind::kErrorPassive, 0.0, true);
  tick_until(3000);
  EXPECT_EQ(emergencies(), std::vector<int>{0x8120});
  EXPECT_EQ(lost, 2);
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

TEST_F(EposDeviceTest, ReadsAndWritesWithoutAllocating) {
  nmt(NmtCommand::kStart);
  const CanFrame requests[] = {canopen::sdo_read_request(kNode, {0x1008, 0}),
                               canopen::sdo_read_segment_request(kNode, false),
                               canopen::sdo_write_request(kNode, {0x1010, 1}, kSave, 4),
                               canopen::sdo_write_request(kNode, {0x1011, 1}, kLoad, 4),
                               canopen::nmt_frame(NmtCommand::kResetNode, 0),
                               canopen::guard_request(kNode)};
  const std::int64_t before = test::allocation_count();
  for (const CanFrame& request : requests) receive(request);
  node.raise(0x2310);
  tick_until(2000);
  node.power_cycle();
  EXPECT_EQ(test::allocation_count(), before);
}

/// An EPOS2 with a label that can be written and a domain that is empty.
canopen::Eds with_label() {
  canopen::Eds eds = load_eds("epos2", NodeBench::kNode);
  canopen::EdsObject label;
  label.id = {0x2100, 0};
  label.type = ObjectType::kVisibleString;
  label.access = Access::kReadWrite;
  canopen::EdsObject program = label;
  program.id = {0x2101, 0};
  program.type = ObjectType::kDomain;
  eds.objects.push_back(label);
  eds.objects.push_back(program);
  return eds;
}

/// Every code of facts canopen 1.4: the request that raises it, or why this device never does.
TEST_F(EposDeviceTest, RaisesEveryAbortCodeWhereItShould) {
  const auto raw = [this](const CanFrame& frame) { return ask(frame).value; };
  const auto start_read = [this] { ask(canopen::sdo_read_request(kNode, {0x1008, 0})); };
  const auto refuse = [this](std::uint32_t code) {
    refused_index = 0x6410;
    refusal = code;
    return write(0x6410, 1, 1000, 2);
  };
  const auto map_off = [this] {
    write(0x1801, 1, 0xC0000283, 4);
    write(0x1A01, 0, 0, 1);
  };
  const std::vector<std::pair<std::uint32_t, std::function<std::uint32_t()>>> rows = {
      {0x05030000, [&] { return start_read(), raw(canopen::sdo_read_segment_request(kNode, true)); }},
      {0x05040000,
       [&] {
         start_read();
         drop();
         tick_until(time_us + canopen::SdoServer::kDefaultTimeout_us);
         return canopen::decode_sdo_reply(frames(0x583).at(0)).value;
       }},
      {0x05040001,
       [&] {
         return raw({0x603, 8, {0xC6, 0x00, 0x10, 0}, false});
       }},  // block download
      // 05040002, 3, 4 (block size, sequence, CRC): no block transfer, so its beginning is refused already.
      {0x05040005,
       [&] {
         return raw(canopen::sdo_write_begin(kNode, {0x1017, 0}, 100000));
       }},
      // 06010000 (access unsupported): every object here can be read or written, and has a code of its own.
      {0x06010001, [&] { return read(0x20C1); }},
      {0x06010002, [&] { return write(0x6041, 0, 0, 2); }},
      {0x06020000, [&] { return read(0x603F); }},
      {0x06040041, [&] { return map_off(), write(0x1A01, 1, 0x64100510, 4); }},
      {0x06040042,
       [&] {
         map_off();
         for (int sub = 1; sub <= 3; ++sub) write(0x1A01, sub, 0x60640020, 4);
         return write(0x1A01, 0, 3, 1);
       }},
      {0x06040043,
       [&] {
         write(0x1016, 1, (127U << 16) | 20U, 4);
         return write(0x1016, 2, (127U << 16) | 20U, 4);
       }},
      // 06040047 (internal incompatibility), 06060000 (hardware), 08000000 (general), 08000021 (local control), 08000023 (no
      // dictionary): a simulated device has no such state; an application may raise them by check_write() as below.
      {0x06060000, [&] { return refuse(canopen::kAbortHardware); }},
      {0x06070010,
       [&] {
         NodeBench label(with_label());
         return label.write_bytes(0x2100, 0, std::string(ObjectDictionary::kTextBytes + 1, 'x'));
       }},
      {0x06070012, [&] { return write(0x1017, 0, 5, 4); }},
      {0x06070013, [&] { return write(0x1017, 0, 5, 1); }},
      {0x06090011, [&] { return read(0x1018, 9); }},
      {0x06090030, [&] { return write(0x1800, 2, 245, 1); }},
      {0x06090031, [&] { return write(0x6410, 1, 5001, 2); }},
      {0x06090032, [&] { return write(0x2210, 1, 15, 4); }},
      // 06090036 (maximum below minimum): the application's, which knows the pairs.
      {0x06090036, [&] { return refuse(canopen::kAbortMaxBelowMin); }},
      {0x060A0023, [&] { return refuse(canopen::kAbortResource); }},
      {0x08000020, [&] { return write(0x1010, 1, 1, 4); }},
      {0x08000022, [&] { return write(0x1A00, 0, 0, 1); }},  // TPDO1 is valid
      {0x08000024,
       [&] {
         NodeBench label(with_label());
         return label.read(0x2101);
       }},
      {0x0F00FFC0,
       [&] {
         DevicePolicy policy;
         policy.remap_in_operational = canopen::kAbortMaxonNmtState;
         NodeBench strict("epos2", policy);
         strict.nmt(NmtCommand::kStart);
         return strict.write(0x1801, 1, 0xC0000283, 4);
       }},
      // 0F00FFBF, BE, BC, B9 (command, password, service mode, node id): of maxon's service commands, which are not simulated.
  };
  for (const auto& [code, request] : rows) EXPECT_EQ(request(), code) << std::hex << code;
}

}  // namespace
}  // namespace sprung::sim
