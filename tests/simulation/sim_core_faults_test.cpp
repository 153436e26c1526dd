// What the simulated robot does when drives, cables and buses fail.
#include <gtest/gtest.h>

#include "drivers/can/can_errors.h"
#include "tests/simulation/node/test_master.h"

namespace sprung::sim {
namespace {

TEST(SimCoreFaults, LostHeartbeatTakesThePowerAfterTwentyMilliseconds) {
  SimMaster master;
  master.boot();
  master.enable();
  master.drive(5, {{1, {0, 0, 10}}, {2, {100, 0, 10}}});
  ASSERT_TRUE(master.powered(2));
  master.heartbeat = false;
  master.drive(18, {{1, {0, 0, 10}}, {2, {100, 0, 10}}});
  EXPECT_TRUE(master.powered(2));
  master.drive(5, {{1, {0, 0, 10}}, {2, {100, 0, 10}}});
  EXPECT_FALSE(master.powered(1));
  EXPECT_FALSE(master.powered(2));
  EXPECT_EQ(master.drives[2].emergencies, std::vector<int>{0x8130});
  EXPECT_EQ(master.sim.truth().joints[1].true_motor_torque_Nm, 0.0);
  EXPECT_EQ(master.read(2, canopen::kErrorRegister), 0x11U);
  master.heartbeat = true;
  master.ticks(3);
  EXPECT_EQ(master.drives[2].emergencies, (std::vector<int>{0x8130, 0}));
  EXPECT_FALSE(master.powered(2));  // never by itself
}

TEST(SimCoreFaults, InjectedFaultIsShownAndResets) {
  SimMaster master;
  master.boot();
  master.enable();
  master.control(SimControlKind::kDriveFault, 1, 0.0);
  master.ticks(3);
  EXPECT_EQ(master.drives[2].emergencies, std::vector<int>{0x2310});
  EXPECT_EQ(master.drives[2].status_word & 0x4F, 0x08);
  EXPECT_TRUE(master.powered(1));
  EXPECT_EQ(master.read(2, canopen::kErrorCode), 0x2310U);
  EXPECT_EQ(master.read(2, canopen::kErrorHistory, 1), 0x2310U);
  master.control_word(0x00);
  master.control_word(0x80);
  master.ticks(2);
  EXPECT_EQ(master.drives[2].emergencies, (std::vector<int>{0x2310, 0}));
  EXPECT_EQ(master.drives[2].status_word & 0x4F, 0x40);
  EXPECT_EQ(master.read(2, canopen::kErrorCode), 0U);
}

TEST(SimCoreFaults, CutCableSilencesADriveThatThenPowersOff) {
  SimMaster master;
  master.boot();
  master.enable();
  master.control(SimControlKind::kDriveSilent, 0, 1.0);
  master.tick();
  const int answers = master.drives[1].tpdo1_count;
  master.ticks(30);
  EXPECT_EQ(master.drives[1].tpdo1_count, answers);
  EXPECT_TRUE(master.powered(2));
  master.control(SimControlKind::kDriveSilent, 0, 0.0);
  master.ticks(2);
  EXPECT_GT(master.drives[1].tpdo1_count, answers);
  EXPECT_FALSE(master.powered(1));
}

TEST(SimCoreFaults, BusOffSilencesEveryNodeAndIsToldByErrorFrames) {
  SimMaster master;
  master.boot();
  master.enable();
  master.fault(FaultKind::kBusOff, -1, 0.0, 0.05);
  master.tick();
  ASSERT_EQ(master.error_frames.size(), 1U);
  EXPECT_TRUE(tells_bus_lost(master.error_frames[0]));
  const int answers = master.drives[1].tpdo1_count;
  const std::int64_t cycle = master.sim.cycle();
  master.ticks(40);
  EXPECT_EQ(master.drives[1].tpdo1_count, answers);
  EXPECT_EQ(master.sim.cycle(), cycle + 40);  // the plant lives on
  master.ticks(15);
  ASSERT_EQ(master.error_frames.size(), 2U);
  EXPECT_TRUE(tells_bus_restarted(master.error_frames[1]));
  EXPECT_GT(master.drives[1].tpdo1_count, answers);
  EXPECT_FALSE(master.powered(1) || master.powered(2));
  const std::vector<int>& told = master.drives[1].emergencies;
  EXPECT_NE(std::find(told.begin(), told.end(), 0x81FD), told.end());
}

TEST(SimCoreFaults, FullQueueKeepsTheMastersFramesFromTheNodes) {
  SimMaster master;
  master.boot();
  master.enable();
  master.fault(FaultKind::kQueueFull, -1, 0.0, 0.01);
  master.tick();
  const int answers = master.drives[1].tpdo1_count;
  master.ticks(5);
  EXPECT_EQ(master.drives[1].tpdo1_count, answers);
  EXPECT_EQ(master.error_frames.size(), 6U);
  EXPECT_TRUE(tells_queue_full(master.error_frames.back()));
  master.ticks(10);
  EXPECT_GT(master.drives[1].tpdo1_count, answers);
  EXPECT_TRUE(master.powered(1));  // shorter than the heartbeat consumer's 20 ms
}

TEST(SimCoreFaults, SecondDeviceOfOneNodeIdBootsAndAnswersToo) {
  SimMaster master;
  master.boot();
  master.ticks(2);
  const std::size_t states = master.drives[2].nmt_states.size();
  master.fault(FaultKind::kDuplicateNode, 1, 0.0, 0.02);
  master.tick();
  ASSERT_GT(master.drives[2].nmt_states.size(), states);
  EXPECT_EQ(master.drives[2].nmt_states[states], 0x00);
  const int answers = master.drives[2].tpdo1_count;
  const int others = master.drives[1].tpdo1_count;
  master.ticks(10);
  EXPECT_EQ(master.drives[2].tpdo1_count, answers + 20);
  EXPECT_EQ(master.drives[1].tpdo1_count, others + 10);
  master.ticks(20);
  const int after = master.drives[2].tpdo1_count;
  master.ticks(10);
  EXPECT_EQ(master.drives[2].tpdo1_count, after + 10);
}

TEST(SimCoreFaults, PowerCycledDriveBootsAgain) {
  SimMaster master;
  master.boot();
  master.enable();
  master.fault(FaultKind::kPowerCycle, 1, 0.0, 0.02);
  master.ticks(10);
  const int answers = master.drives[2].tpdo1_count;
  const std::size_t states = master.drives[2].nmt_states.size();
  master.ticks(20);
  EXPECT_EQ(master.drives[2].tpdo1_count, answers);
  ASSERT_EQ(master.drives[2].nmt_states.size(), states + 1);
  EXPECT_EQ(master.drives[2].nmt_states.back(), 0x00);
  EXPECT_TRUE(master.powered(1));
}

}  // namespace
}  // namespace sprung::sim
