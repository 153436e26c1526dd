// Lost heartbeats, short PDOs, emergencies, a bus that is off.
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
  EXPECT_EQ(lost, 1) << "stopped is a lost connection";
  tick_until(20000);
  EXPECT_EQ(lost, 2);
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

}  // namespace
}  // namespace sprung::sim
